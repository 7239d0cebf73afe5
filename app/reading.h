// A point that a user has asked for, in the file's own terms; and its parts in words.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "timeseries/field.h"
#include "timeseries/grid.h"
#include "timeseries/number.h"

namespace app {

struct Reading {
    std::array<std::size_t, 3> index{};  // along x, y, z
    timeseries::Number value;
    glm::dvec3 position{0};  // the grid's
    glm::dvec3 world{0};     // render::Lattice's
    std::size_t step = 0;
};

// "0.35 m"; without the unit where it says nothing.
std::string withUnit(const std::string& number, const std::string& unit);
// As few digits as tell the value among those of its own type, with its unit.
std::string valueText(const timeseries::Number& value, timeseries::ValueType type,
                      const std::string& unit);
// Where the point is along one axis: "0.35 m   [12]".
std::string placeText(const timeseries::Axis& axis, double position, std::size_t index);

}  // namespace app

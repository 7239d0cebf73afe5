// A point that a user has asked for, in the file's own terms; and its parts in words.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/exploration/exploration.h"
#include "timeseries/index/number.h"

namespace app {

struct Reading {
    std::array<std::size_t, 3> index{};  // along x, y, z
    timeseries::Number value;
    std::optional<double> between{};  // seen there, interpolated; the point is the nearest
    glm::dvec3 position{0};           // the grid's, in space
    glm::dvec3 world{0};              // render::PlacedPoints's
    std::size_t step = 0;
    std::string cell{};  // as cellText() has it
};

// A number with a unit, where there is one to be shown.
std::string withUnit(const std::string& number, const std::string& unit);
// "612.34 K": as few digits as tell the value among those of its own type.
std::string valueText(const Reading& reading, const Shown& shown);
// "850.3 K between points"; "" where a point itself is seen.
std::string betweenText(const Reading& reading, const Shown& shown);
// Coordinates along the grid's axes, as these are labelled: where they are turned, not the place's.
glm::dvec3 alongAxes(const Reading& reading, const timeseries::Grid& grid);
// The one that all axes have, "" of numbers alone; nothing where they differ.
std::optional<std::string> unitOfSpace(const timeseries::Grid& grid);
// "0.125 m   [37]": along an axis (0 x, 1 y, 2 z), with the index.
std::string positionText(const Reading& reading, const Shown& shown, std::size_t axis);
// "lon", "10.5 °E   [37]": a line for each axis, and for x, y and z of space where the axes are
// turned, for longitude and latitude where the file tells these beside its axes.
struct PlaceLine {
    std::string name, text;
};
std::vector<PlaceLine> placeLines(const Reading& reading, const Shown& shown);
// Longitude and latitude, where they are known.
std::optional<glm::dvec2> onEarth(const Reading& reading, const timeseries::Grid& grid);
// "37, hexahedron", "37, triangle, level 2": which cell a point stands for, where a mesh's values
// are its cells'; "" elsewhere.
std::string cellText(const timeseries::Grid& grid, const std::array<std::size_t, 3>& index);

}  // namespace app

// Arrays of several numbers a point, as variables: each number, and of few the magnitude.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"

namespace timeseries {

struct Component {
    std::uint64_t of = 1;                    // numbers of a row
    std::optional<std::uint64_t> which = 0;  // nothing: the magnitude, in float64
};

struct ComponentVariable {
    Component component;
    std::string name;  // "v", "v magnitude", "v[0]"
    ValueType type;
    std::string storedAs;  // "float32, 3 components; magnitude in float64"
};

// Of rows of so many; none where that is no number that anybody has.
std::vector<ComponentVariable> componentsOf(const std::string& name, ValueType type,
                                            std::uint64_t count);

// Of each row, one behind the other.
Values componentOf(Values rows, const Component& component);

}  // namespace timeseries

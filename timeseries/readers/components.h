// What a file calls its arrays, as variables: of several numbers a point each number, and of few
// the magnitude; of one name each.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/reader.h"

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

// As everybody works it out: to the last bit what the square root of the sum of squares is, where
// that is neither too large nor too small a number. NaN of one that is.
double lengthOf(double x, double y, double z);

// Of each row, one behind the other.
Values componentOf(Values rows, const Component& component);

// A variable that has the name of one before it has another: "T (2)". For by its name a variable is
// chosen, found in the other files of a series, and kept on disk.
void tellApart(std::span<Variable> variables);

}  // namespace timeseries

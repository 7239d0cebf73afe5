// One variable at one time step, as read: typed values on a grid, and which of them are missing.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "timeseries/grid/grid.h"

namespace timeseries {

// In the order of Values' alternatives.
enum class ValueType { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

using Values =
    std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::uint16_t>,
                 std::vector<std::int16_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                 std::vector<std::uint64_t>, std::vector<std::int64_t>, std::vector<float>,
                 std::vector<double>>;

// "uint8", "float32", ...
std::string_view typeName(ValueType type);

struct Field {
    std::shared_ptr<const Grid> grid;
    Values values;  // [z][y][x], x fastest, grid->count() of them
    std::vector<bool>
        missing;              // per point; empty when none is. NaN is missing without being marked
    bool categories = false;  // values are names of classes: nothing lies between two of them
    // What it has at its grid's nodes, where cells have the values
    // (timeseries/index/node_values.h): who needs them sets them.
    std::vector<double> atNodes = {};

    ValueType type() const { return static_cast<ValueType>(values.index()); }
    // Of memory, the grid's aside.
    std::uint64_t bytes() const;
};

}  // namespace timeseries

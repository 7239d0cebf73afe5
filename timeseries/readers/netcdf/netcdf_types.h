// The netCDF library's types of numbers.
#pragma once

#include <netcdf.h>

#include <array>
#include <cstdint>
#include <optional>

#include "timeseries/grid/field.h"

namespace timeseries {

// Nothing of what is no number.
inline std::optional<ValueType> valueType(nc_type type) {
    switch (type) {
        case NC_BYTE:
            return ValueType::I8;
        case NC_UBYTE:
            return ValueType::U8;
        case NC_SHORT:
            return ValueType::I16;
        case NC_USHORT:
            return ValueType::U16;
        case NC_INT:
            return ValueType::I32;
        case NC_UINT:
            return ValueType::U32;
        case NC_INT64:
            return ValueType::I64;
        case NC_UINT64:
            return ValueType::U64;
        case NC_FLOAT:
            return ValueType::F32;
        case NC_DOUBLE:
            return ValueType::F64;
        default:
            return std::nullopt;
    }
}

inline std::uint64_t typeBytes(ValueType type) {
    constexpr std::array<std::uint64_t, 10> kBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

}  // namespace timeseries

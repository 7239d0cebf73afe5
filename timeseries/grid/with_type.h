// From a type of values, known when the program runs, to code of that type.
#pragma once

#include <cstdint>

#include "timeseries/grid/field.h"

namespace timeseries {

// DO(T) for each of them: for explicit instantiations.
#define ISOCHRON_EACH_TYPE(DO) \
    DO(std::uint8_t)           \
    DO(std::int8_t)            \
    DO(std::uint16_t)          \
    DO(std::int16_t)           \
    DO(std::uint32_t) DO(std::int32_t) DO(std::uint64_t) DO(std::int64_t) DO(float) DO(double)

// Returns use(T{}), T being the type's own.
template <typename Use>
auto withType(ValueType type, Use use) {
    switch (type) {
        case ValueType::U8:
            return use(std::uint8_t{});
        case ValueType::I8:
            return use(std::int8_t{});
        case ValueType::U16:
            return use(std::uint16_t{});
        case ValueType::I16:
            return use(std::int16_t{});
        case ValueType::U32:
            return use(std::uint32_t{});
        case ValueType::I32:
            return use(std::int32_t{});
        case ValueType::U64:
            return use(std::uint64_t{});
        case ValueType::I64:
            return use(std::int64_t{});
        case ValueType::F32:
            return use(float{});
        case ValueType::F64:
            break;
    }
    return use(double{});
}

}  // namespace timeseries

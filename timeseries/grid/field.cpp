#include "timeseries/grid/field.h"

#include <array>

namespace timeseries {

std::string_view typeName(ValueType type) {
    constexpr std::array<std::string_view, 10> names = {"uint8",   "int8",   "uint16", "int16",
                                                        "uint32",  "int32",  "uint64", "int64",
                                                        "float32", "float64"};
    return names[static_cast<std::size_t>(type)];
}

std::uint64_t Field::bytes() const {
    return std::visit([](const auto& of) { return of.size() * sizeof(of[0]); }, values) +
           missing.size() / 8 + atNodes.size() * sizeof(double);
}

}  // namespace timeseries

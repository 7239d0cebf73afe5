#include "timeseries/readers/arrays/array_header.h"

#include <fmt/format.h>

#include "timeseries/readers/reader.h"

namespace timeseries {

std::uint64_t ArrayHeader::pointCount() const {
    std::uint64_t count = 1;
    for (const ArrayAxis& axis : axes)
        if (__builtin_mul_overflow(count, axis.size, &count))
            fail("sizes", "expected at most 2^64 - 1 values");
    return count;
}

std::size_t ArrayHeader::valueBytes() const {
    constexpr std::array<std::size_t, 10> kBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

std::string_view ArrayHeader::keyValue(std::string_view key) const {
    for (const auto& [of, value] : keyValues)
        if (of == key) return value;
    return "";
}

void ArrayHeader::fail(std::string_view place, std::string_view what) const {
    std::string sentence = fmt::format("{}{}{}", place, place.empty() ? "" : ": ", what);
    for (char& c : sentence)
        if (c >= '\0' && c < ' ') c = ' ';
    throw FileError(path.string() + ": " + sentence);
}

}  // namespace timeseries

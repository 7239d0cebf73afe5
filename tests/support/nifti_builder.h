// NIfTI headers for tests, by the offsets of nifti1.h and nifti2.h.
#pragma once

#include "tests/support/array_builder.h"

namespace tests {

using namespace std::string_literals;

// Of one file, whose values follow: 352 bytes.
inline BinaryHeader nifti1(std::int16_t type, const std::vector<std::int16_t>& dim,
                           std::endian order = std::endian::little) {
    BinaryHeader header(352, order);
    header.put(0, std::int32_t{348}).put(40, dim).put(70, type).put(108, 352.0f);
    header.put(344, "n+1\0"s);
    return header;
}

// 544 bytes.
inline BinaryHeader nifti2(std::int16_t type, const std::vector<std::int64_t>& dim,
                           std::endian order = std::endian::little) {
    BinaryHeader header(544, order);
    header.put(0, std::int32_t{540}).put(4, "n+2\0\r\n\x1a\n"s).put(12, type).put(16, dim);
    header.put(168, std::int64_t{544});
    return header;
}

}  // namespace tests

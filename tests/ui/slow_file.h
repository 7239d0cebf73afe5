// A file whose middle step takes many seconds to reach and little room to keep: NRRD in one gzip
// stream is inflated from its begin, and each step is the same compressed piece again (RFC 1952,
// 2.2: members follow each other).
#pragma once

#include <fmt/format.h>

#include "tests/support/array_builder.h"

namespace ui {

inline std::filesystem::path writeSlowFile(const std::filesystem::path& file) {
    constexpr std::size_t kSide = 192, kSteps = 4000;
    std::string values;
    for (std::size_t z = 0; z < kSide; ++z) values.append(kSide * kSide, static_cast<char>(z));
    const std::string step = tests::byGzip(values);
    std::ofstream out(file, std::ios::binary);
    out << fmt::format(
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: {0} {0} {0} {1}\n"
        "kinds: space space space time\nencoding: gzip\n\n",
        kSide, kSteps);
    for (std::size_t i = 0; i < kSteps; ++i) out << step;
    return file;
}

}  // namespace ui

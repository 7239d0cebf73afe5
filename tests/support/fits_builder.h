// FITS files for tests, card by card: big-endian numbers in blocks of 2880 bytes.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <string>
#include <vector>

#include "tests/support/array_builder.h"

namespace tests::fits {

// Cards of 80 letters, and END, to whole blocks of 2880.
inline std::string cards(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += fmt::format("{:80}", line);
    text += fmt::format("{:80}", "END");
    text.resize((text.size() + 2879) / 2880 * 2880, ' ');
    return text;
}

inline std::string padded(std::string bytes) {
    bytes.resize((bytes.size() + 2879) / 2880 * 2880, '\0');
    return bytes;
}

inline std::vector<std::string> sizes(int bitpix, const std::vector<int>& axes) {
    std::vector<std::string> lines{fmt::format("BITPIX  = {:20}", bitpix),
                                   fmt::format("NAXIS   = {:20}", axes.size())};
    for (std::size_t i = 0; i < axes.size(); ++i)
        lines.push_back(fmt::format("NAXIS{}  = {:20}", i + 1, axes[i]));
    return lines;
}

inline std::string image(int bitpix, const std::vector<int>& axes, std::vector<std::string> more,
                         const std::string& bytes,
                         const std::string& first = "SIMPLE  =                    T") {
    std::vector<std::string> lines = sizes(bitpix, axes);
    lines.insert(lines.begin(), first);
    lines.insert(lines.end(), more.begin(), more.end());
    return cards(lines) + padded(bytes);
}

// 2 x 3 x 4 pixels, 0 to 23.
inline std::string slab(const std::vector<std::string>& more) {
    return image(16, {2, 3, 4}, more, bytesOf(ramp<std::int16_t>(24), std::endian::big));
}

}  // namespace tests::fits

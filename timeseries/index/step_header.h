// The first bytes of a sorted step on disk, as FORMAT.md lays them out.
#pragma once

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "timeseries/index/bit_fields.h"

namespace timeseries {

constexpr std::array<char, 8> kStepMagic{'i', 's', 'o', 's', 't', 'e', 'p', '\n'};
constexpr std::uint32_t kStepVersion = 1;
constexpr std::uint32_t kEndianMark = 0x01020304, kOtherEndianMark = 0x04030201;
constexpr std::size_t kHeaderBytes = 4096;  // on disk; beyond those of StepHeader all 0

// What every sum in the file is of its bytes.
inline std::uint64_t sumOfBytes(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

struct StepSection {
    std::uint64_t at = 0, bytes = 0, sum = 0;  // XXH3
};

struct StepHeader {
    std::array<char, 8> magic = kStepMagic;
    std::uint32_t version = kStepVersion;
    std::uint32_t endian = kEndianMark;
    std::uint64_t fileBytes = 0;
    std::uint32_t type = 0;  // ValueType
    std::uint32_t blockPoints = 0;
    std::array<std::uint32_t, 3> size{};
    std::uint32_t spare = 0;
    std::uint64_t points = 0, missing = 0, blocks = 0;
    // Bit patterns of the type: least, greatest, and those that are finite.
    std::array<std::uint64_t, 4> extent{};
    std::uint64_t anyFinite = 0;  // 1, or 0 when extent has no finite ones
    StepSection directory, summary;
    std::uint64_t sum = 0;  // of all before it
};
static_assert(sizeof(StepHeader) == 168 && offsetof(StepHeader, sum) == 160);

// Of the summary, which is the quantiles, their number first, and then a text.
constexpr std::uint64_t kMostSummary = std::uint64_t{1} << 24;

}  // namespace timeseries

// What no file is believed to be larger than.
#pragma once

#include <cstdint>

namespace timeseries {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 32;  // SortedStep's indices
// A step of so many points needs no longer axis, and an axis costs 8 bytes a point.
constexpr std::uint64_t kMaxAxis = std::uint64_t{1} << 24;
constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 20;
// What a byte of deflate unpacks to: 1032 (RFC 1951: two bits for 258 bytes), and some to spare.
constexpr std::uint64_t kMaxInflated = 1100;
// The chunks of a block that hold values of others, too, of further steps mostly, are kept unpacked
// up to so many bytes.
constexpr double kMaxKeptChunks = 1 << 28;

}  // namespace timeseries

// Ascending numbers in few bytes: the gaps between them in classes, by an entropy coder (zstd), and
// what a class leaves open of a gap in bits behind them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "timeseries/index/bit_fields.h"

namespace timeseries {

// Appends to `out`. REQUIRES: strictly ascending, not empty.
void encodeIds(std::span<const std::uint32_t> ids, Bytes& out);

// As many as `ids` has; false where the bytes do not say so many, strictly ascending and below
// 2^32. REQUIRES: kReadBeyond bytes behind them are readable. Throws std::bad_alloc.
bool decodeIds(std::span<const std::byte> from, std::span<std::uint32_t> ids);

}  // namespace timeseries

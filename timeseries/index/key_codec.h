// A block's values in few bytes: their keys (timeseries/index/ordered_key.h) less the least one, in
// as many bits as the greatest needs, or places in a list of the keys that there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "timeseries/index/bit_fields.h"

namespace timeseries {

enum class KeyCodec : std::uint8_t { Residual, Dictionary };

struct KeyLayout {
    KeyCodec codec = KeyCodec::Residual;
    std::uint8_t bits = 0;   // of a field
    std::uint8_t shift = 0;  // bits that are 0 in all of them
};

// Keys in the order in which they are to be read. `ascending`: the same ones in their order.
// Appends to `out`. REQUIRES: both of one size, not empty.
template <typename Key>
KeyLayout encodeKeys(std::span<const Key> keys, std::span<const Key> ascending, Bytes& out);

// As many as `keys` has; false where the bytes do not say so many between `least` and `greatest`.
// REQUIRES: kReadBeyond bytes behind them are readable. Throws std::bad_alloc.
template <typename Key>
bool decodeKeys(std::span<const std::byte> from, KeyLayout layout, Key least, Key greatest,
                std::span<Key> keys);

}  // namespace timeseries

#include "timeseries/index/key_codec.h"

#include <algorithm>
#include <vector>

namespace timeseries {
namespace {

constexpr std::size_t kDictionaryHead = 5;  // how many there are, and of how many bits each

template <typename Key, typename FieldOf>
void pack(std::span<const Key> keys, const FieldOf& fieldOf, int bits, Bytes& out) {
    out.reserve(out.size() + bytesOfFields(keys.size(), bits));
    BitWriter writer(out);
    for (const Key key : keys) writer.put(fieldOf(key), bits);
    writer.end();
}

template <typename Key>
void unpack(const std::byte* from, int bits, std::span<Key> fields) {
    const std::uint64_t mask = lowBits(bits);
    if (bits <= 57) {  // and the seven before it in its first byte
        std::uint64_t bit = 0;
        const auto next = [&](int taken) {
            const std::uint64_t word = load<std::uint64_t>(from + bit / 8) >> (bit % 8);
            bit += static_cast<std::uint64_t>(taken);
            return word;
        };
        std::size_t i = 0;
        if (bits <= 28)
            for (; i + 2 <= fields.size(); i += 2) {
                const std::uint64_t two = next(2 * bits);
                fields[i] = static_cast<Key>(two & mask);
                fields[i + 1] = static_cast<Key>(two >> bits & mask);
            }
        for (; i < fields.size(); ++i) fields[i] = static_cast<Key>(next(bits) & mask);
    } else {
        for (std::size_t i = 0; i < fields.size(); ++i)
            fields[i] = static_cast<Key>(fieldAt(from, i, bits));
    }
}

}  // namespace

template <typename Key>
KeyLayout encodeKeys(std::span<const Key> keys, std::span<const Key> ascending, Bytes& out) {
    const Key least = ascending.front();
    Key all = 0;
    std::size_t distinct = 1;
    for (std::size_t i = 1; i < ascending.size(); ++i) {
        all |= static_cast<Key>(ascending[i] - least);
        distinct += ascending[i] != ascending[i - 1];
    }
    const int shift = all == 0 ? 0 : std::countr_zero(all);
    const auto residual = [&](Key key) { return static_cast<Key>((key - least) >> shift); };
    const auto bits = static_cast<int>(std::bit_width(residual(ascending.back())));
    const auto places = static_cast<int>(std::bit_width(distinct - 1));
    const auto layout = [&](KeyCodec codec, int width) {
        return KeyLayout{codec, static_cast<std::uint8_t>(width), static_cast<std::uint8_t>(shift)};
    };

    if (kDictionaryHead + bytesOfFields(distinct, bits) + bytesOfFields(keys.size(), places) >=
        bytesOfFields(keys.size(), bits)) {
        pack(keys, residual, bits, out);
        return layout(KeyCodec::Residual, bits);
    }
    std::vector<Key> dictionary(ascending.begin(), ascending.end());
    dictionary.erase(std::unique(dictionary.begin(), dictionary.end()), dictionary.end());
    const auto placeOf = [&](Key key) {
        return static_cast<Key>(std::ranges::lower_bound(dictionary, key) - dictionary.begin());
    };
    append(out, static_cast<std::uint32_t>(distinct));
    append(out, static_cast<std::uint8_t>(bits));
    pack(std::span<const Key>(dictionary), residual, bits, out);
    pack(keys, placeOf, places, out);
    return layout(KeyCodec::Dictionary, places);
}

template <typename Key>
bool decodeKeys(std::span<const std::byte> from, KeyLayout layout, Key least, Key greatest,
                std::span<Key> keys) {
    constexpr int kMost = 8 * sizeof(Key);
    if (layout.bits > kMost || layout.shift >= kMost) return false;
    if (layout.codec == KeyCodec::Residual) {
        if (from.size() != bytesOfFields(keys.size(), layout.bits)) return false;
        unpack(from.data(), layout.bits, keys);
    } else if (layout.codec == KeyCodec::Dictionary) {
        if (from.size() < kDictionaryHead) return false;
        const std::size_t distinct = load<std::uint32_t>(from.data());
        const int bits = load<std::uint8_t>(from.data() + 4);
        if (distinct > keys.size() || bits > kMost) return false;
        const std::uint64_t listed = bytesOfFields(distinct, bits);
        if (from.size() != kDictionaryHead + listed + bytesOfFields(keys.size(), layout.bits))
            return false;
        std::vector<Key> dictionary(distinct);
        unpack<Key>(from.data() + kDictionaryHead, bits, dictionary);
        unpack(from.data() + kDictionaryHead + listed, layout.bits, keys);
        Key last = 0;
        for (const Key place : keys) last = std::max(last, place);
        if (last >= distinct) return false;
        for (Key& key : keys) key = dictionary[key];
    } else {
        return false;
    }
    // Two loops, which compilers turn into vectors.
    const auto most = static_cast<Key>(greatest - least);
    Key residual = 0;
    for (const Key key : keys) residual = std::max(residual, key);
    for (Key& key : keys) key = static_cast<Key>(least + static_cast<Key>(key << layout.shift));
    return residual <= static_cast<Key>(most >> layout.shift);
}

#define ISOCHRON_KEYS(Key)                                                             \
    template KeyLayout encodeKeys(std::span<const Key>, std::span<const Key>, Bytes&); \
    template bool decodeKeys(std::span<const std::byte>, KeyLayout, Key, Key, std::span<Key>);
ISOCHRON_KEYS(std::uint8_t)
ISOCHRON_KEYS(std::uint16_t)
ISOCHRON_KEYS(std::uint32_t)
ISOCHRON_KEYS(std::uint64_t)
#undef ISOCHRON_KEYS

}  // namespace timeseries

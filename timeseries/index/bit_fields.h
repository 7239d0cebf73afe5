// Numbers of few bits each, one after the other, the least significant bit first.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace timeseries {

static_assert(std::endian::native == std::endian::little, "bytes on disk are as those in memory");

using Bytes = std::vector<std::byte>;

// Behind encoded bytes so many more must be readable: fields are read by whole words.
constexpr std::size_t kReadBeyond = 16;

constexpr std::uint64_t lowBits(int bits) {
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}
constexpr std::uint64_t bytesOfFields(std::uint64_t count, int bits) {
    return (count * static_cast<std::uint64_t>(bits) + 7) / 8;
}

template <typename T>
void append(Bytes& out, T value) {
    const std::size_t at = out.size();
    out.resize(at + sizeof value);
    std::memcpy(out.data() + at, &value, sizeof value);
}
template <typename T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

// Fields that follow each other in `out`, of up to 64 bits each, which may differ.
class BitWriter {
 public:
    explicit BitWriter(Bytes& out) : out_(out) {}
    // REQUIRES: value has no more than `bits` bits.
    void put(std::uint64_t value, int bits) {
        held_ |= value << count_;
        if (count_ + bits >= 64) {
            append(out_, held_);
            held_ = count_ == 0 ? 0 : value >> (64 - count_);
            count_ -= 64;
        }
        count_ += bits;
    }
    // To be called last: what is left, in whole bytes.
    void end() {
        for (; count_ > 0; count_ -= 8, held_ >>= 8) append(out_, static_cast<std::uint8_t>(held_));
    }

 private:
    Bytes& out_;
    std::uint64_t held_ = 0;
    int count_ = 0;  // of the bits held
};

// Field `i` of so many bits. Reads up to kReadBeyond bytes from the one that it begins in.
inline std::uint64_t fieldAt(const std::byte* from, std::uint64_t i, int bits) {
    const std::uint64_t bit = i * static_cast<std::uint64_t>(bits);
    const std::byte* const at = from + bit / 8;
    const int skipped = static_cast<int>(bit % 8);
    std::uint64_t value = load<std::uint64_t>(at) >> skipped;
    if (skipped + bits > 64) value |= load<std::uint64_t>(at + 8) << (64 - skipped);
    return value & lowBits(bits);
}

}  // namespace timeseries

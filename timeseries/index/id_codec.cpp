#include "timeseries/index/id_codec.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>
#include <vector>

namespace timeseries {
namespace {

// A gap is the difference to the number before, less 1. Gaps below kSmall are classes of their own;
// four classes an octave hold the others: two bits below the leading one name the class, the rest
// stands in bits of its own.
constexpr std::uint32_t kSmall = 16;
constexpr std::uint32_t kGapClasses = kSmall + 4 * (32 - 4);  // gaps of up to 32 bits
constexpr int kLevel = 3;                                     // more costs time and gains a percent

// That the class leaves open.
constexpr std::uint32_t openBits(std::uint8_t gapClass) {
    return gapClass < kSmall ? 0 : (gapClass - kSmall) / 4u + 2;
}

struct alignas(16) GapClass {
    std::uint32_t least = 0;  // gap
    std::uint32_t open = 0;   // as many ones as there are open bits
    int bits = 0;             // which are so many
};

constexpr std::array<GapClass, 256> classTable() {
    std::array<GapClass, 256> table{};
    for (std::uint32_t c = 0; c < kGapClasses; ++c) {
        const auto bits = static_cast<int>(openBits(static_cast<std::uint8_t>(c)));
        const std::uint32_t least = c < kSmall ? c : (4u | (c & 3)) << bits;
        table[c] = {least, (1u << bits) - 1, bits};
    }
    return table;
}
constexpr auto kTable = classTable();

std::uint32_t classOf(std::uint32_t gap) {
    if (gap < kSmall) return gap;
    const int width = std::bit_width(gap);
    return kSmall + (static_cast<std::uint32_t>(width - 5) << 2 | (gap >> (width - 3) & 3));
}

struct FreeDecoder {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};
struct FreeEncoder {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

void encodeIds(std::span<const std::uint32_t> ids, Bytes& out) {
    static thread_local const std::unique_ptr<ZSTD_CCtx, FreeEncoder> context(ZSTD_createCCtx());
    if (!context) throw std::bad_alloc();
    static thread_local std::vector<std::uint8_t> classes;
    static thread_local Bytes packed, open;
    classes.resize(ids.size() - 1);
    open.clear();
    BitWriter bits(open);
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const std::uint32_t gap = ids[i + 1] - ids[i] - 1, of = classOf(gap);
        classes[i] = static_cast<std::uint8_t>(of);
        bits.put(gap - kTable[of].least, kTable[of].bits);
    }
    bits.end();

    packed.resize(ZSTD_compressBound(classes.size()));
    const std::size_t size = ZSTD_compressCCtx(context.get(), packed.data(), packed.size(),
                                               classes.data(), classes.size(), kLevel);
    if (ZSTD_isError(size)) throw std::bad_alloc();  // there is room: nothing else can fail
    append(out, ids[0]);
    append(out, static_cast<std::uint32_t>(size));
    out.insert(out.end(), packed.data(), packed.data() + size);
    out.insert(out.end(), open.begin(), open.end());
}

bool decodeIds(std::span<const std::byte> from, std::span<std::uint32_t> ids) {
    constexpr std::size_t kHead = 8;
    if (from.size() < kHead || ids.empty()) return false;
    std::uint64_t id = load<std::uint32_t>(from.data());
    const std::size_t packed = load<std::uint32_t>(from.data() + 4);
    from = from.subspan(kHead);
    if (packed > from.size()) return false;

    const std::size_t count = ids.size() - 1;
    static thread_local std::vector<std::uint8_t> room;
    room.resize(std::max(room.size(), count));
    std::uint8_t* const classes = room.data();
    static thread_local const std::unique_ptr<ZSTD_DCtx, FreeDecoder> context(ZSTD_createDCtx());
    if (!context) throw std::bad_alloc();
    if (ZSTD_decompressDCtx(context.get(), classes, count, from.data(), packed) != count)
        return false;
    from = from.subspan(packed);

    std::uint8_t greatest = 0;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) greatest = std::max(greatest, classes[i]);
    for (std::size_t i = 0; i < count; ++i) bits += openBits(classes[i]);
    if (greatest >= kGapClasses || (bits + 7) / 8 != from.size()) return false;

    ids[0] = static_cast<std::uint32_t>(id);
    std::uint64_t bit = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const GapClass& of = kTable[classes[i]];
        const std::uint64_t open = load<std::uint64_t>(from.data() + bit / 8) >> (bit % 8);
        bit += static_cast<std::uint64_t>(of.bits);
        id += std::uint64_t{of.least} + (open & of.open) + 1;
        ids[i + 1] = static_cast<std::uint32_t>(id);
    }
    return id <= ~std::uint32_t{0};
}

}  // namespace timeseries

#include "timeseries/readers/zarr/zarr_codecs.h"

#include <blosc.h>
#include <bzlib.h>
#include <fmt/format.h>
#include <lz4.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "timeseries/readers/limits.h"

namespace timeseries {
namespace {

struct NamedCodec {
    std::string_view name;
    ZarrCodec codec;
};
constexpr std::array kCodecs{
    NamedCodec{"zlib", ZarrCodec::Zlib},     NamedCodec{"gzip", ZarrCodec::Gzip},
    NamedCodec{"bz2", ZarrCodec::Bzip2},     NamedCodec{"zstd", ZarrCodec::Zstd},
    NamedCodec{"lz4", ZarrCodec::Lz4},       NamedCodec{"blosc", ZarrCodec::Blosc},
    NamedCodec{"crc32c", ZarrCodec::Crc32c},
};

std::string_view codecName(ZarrCodec codec) {
    return std::ranges::find(kCodecs, codec, &NamedCodec::codec)->name;
}

[[noreturn]] void refuseChunk(const std::string& what) { throw std::invalid_argument(what); }

std::uint32_t littleEndian32(const std::byte* at) {
    std::uint32_t number = 0;
    for (int i = 3; i >= 0; --i) number = number << 8 | std::to_integer<std::uint32_t>(at[i]);
    return number;
}

// The most that a byte unpacks to, beside some for all: of Zstandard, which Blosc may hold, a block
// of 128 KiB in 4 bytes (RFC 8878, section 3.1.1.2); of LZ4 255.
// bzip2 packs megabytes of one value into 50 bytes, so that more is believed of any.
bool canHold(ZarrCodec codec, std::uint64_t packed, std::uint64_t bytes) {
    constexpr std::uint64_t kFree = 1 << 20;
    switch (codec) {
        case ZarrCodec::Zlib:
        case ZarrCodec::Gzip:
            return bytes <= kMaxInflated * packed + kFree;
        case ZarrCodec::Bzip2:
            return bytes <= kMaxInflated * packed + 64 * kFree;
        case ZarrCodec::Lz4:
            return bytes <= 256 * packed + kFree;
        default:
            return bytes <= 33000 * packed + kFree;
    }
}

// Each of these unpacks into `out` and returns how many bytes it is, of more than there is room for
// nothing, as of damaged ones.
using Unpacked = std::optional<std::uint64_t>;

// One stream, or of gzip several behind each other.
Unpacked inflateAll(ZarrBytes& packed, ZarrBytes& out, bool gzip) {
    z_stream stream{};
    if (inflateInit2(&stream, gzip ? 15 + 16 : 15) != Z_OK) throw std::bad_alloc();
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    int status = inflate(&stream, Z_FINISH);
    while (gzip && status == Z_STREAM_END && stream.avail_in > 0 && stream.avail_out > 0)
        status = inflateReset(&stream) == Z_OK ? inflate(&stream, Z_FINISH) : Z_DATA_ERROR;
    const std::uint64_t left = stream.avail_out;
    inflateEnd(&stream);
    return status == Z_STREAM_END ? Unpacked(out.size() - left) : std::nullopt;
}

Unpacked unpackBzip2(ZarrBytes& packed, ZarrBytes& out) {
    auto bytes = static_cast<unsigned>(out.size());
    const int status = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(out.data()), &bytes,
                                                  reinterpret_cast<char*>(packed.data()),
                                                  static_cast<unsigned>(packed.size()), 0, 0);
    return status == BZ_OK ? Unpacked(bytes) : std::nullopt;
}

Unpacked unpackZstd(const ZarrBytes& packed, ZarrBytes& out) {
    const std::size_t bytes = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    return ZSTD_isError(bytes) ? std::nullopt : Unpacked(bytes);
}

Unpacked unpackBlosc(const ZarrBytes& packed, ZarrBytes& out) {
    std::size_t bytes = 0;
    if (blosc_cbuffer_validate(packed.data(), packed.size(), &bytes) < 0) return std::nullopt;
    if (bytes != out.size()) return bytes;
    if (bytes == 0) return 0;
    const int unpacked = blosc_decompress_ctx(packed.data(), out.data(), out.size(), 1);
    return unpacked < 0 ? std::nullopt : Unpacked(unpacked);
}

// numcodecs' LZ4: the size in 4 bytes, little-endian, then a block.
Unpacked unpackLz4(const ZarrBytes& packed, ZarrBytes& out) {
    if (packed.size() < 4) return std::nullopt;
    if (const std::uint32_t bytes = littleEndian32(packed.data()); bytes != out.size())
        return bytes;
    const int unpacked = LZ4_decompress_safe(
        reinterpret_cast<const char*>(packed.data() + 4), reinterpret_cast<char*>(out.data()),
        static_cast<int>(packed.size() - 4), static_cast<int>(out.size()));
    return unpacked < 0 ? std::nullopt : Unpacked(unpacked);
}

Unpacked unpackInto(ZarrCodec codec, ZarrBytes& packed, ZarrBytes& out) {
    switch (codec) {
        case ZarrCodec::Zlib:
        case ZarrCodec::Gzip:
            return inflateAll(packed, out, codec == ZarrCodec::Gzip);
        case ZarrCodec::Bzip2:
            return unpackBzip2(packed, out);
        case ZarrCodec::Lz4:
            return unpackLz4(packed, out);
        case ZarrCodec::Blosc:
            return unpackBlosc(packed, out);
        default:
            return unpackZstd(packed, out);
    }
}

ZarrBytes decompressed(ZarrCodec codec, ZarrBytes packed, std::uint64_t bytes) {
    if (!canHold(codec, packed.size(), bytes))
        refuseChunk(fmt::format("expected {} bytes, which {} of {} cannot hold", bytes,
                                packed.size(), codecName(codec)));
    ZarrBytes out(bytes);
    const Unpacked unpacked = unpackInto(codec, packed, out);
    if (!unpacked)
        refuseChunk(fmt::format("expected {} bytes packed by {}, found others, or more", bytes,
                                codecName(codec)));
    if (*unpacked != bytes)
        refuseChunk(fmt::format("expected {} bytes packed by {}, found {}", bytes, codecName(codec),
                                *unpacked));
    return out;
}

// The sum stands behind the bytes, little-endian (Zarr's "CRC32C codec", version 1.0).
ZarrBytes withoutChecksum(ZarrBytes summed) {
    if (summed.size() < 4) refuseChunk("expected a checksum (crc32c)");
    const std::uint32_t told = littleEndian32(summed.data() + summed.size() - 4);
    summed.resize(summed.size() - 4);
    if (crc32cOf(summed) != told)
        refuseChunk("expected bytes of their checksum (crc32c), found others");
    return summed;
}

}  // namespace

std::uint32_t crc32cOf(std::span<const std::byte> bytes) {
    static const auto kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t rest = byte;
            for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0x82F63B78u : 0u);
            table[byte] = rest;
        }
        return table;
    }();
    std::uint32_t sum = 0xFFFFFFFFu;
    for (const std::byte byte : bytes)
        sum = sum >> 8 ^ kTable[(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xFF];
    return ~sum;
}

std::optional<ZarrCodec> zarrCodecOf(std::string_view name) {
    constexpr std::string_view kNumcodecs = "numcodecs.";
    if (name.starts_with(kNumcodecs)) name.remove_prefix(kNumcodecs.size());
    const auto found = std::ranges::find(kCodecs, name, &NamedCodec::name);
    return found == kCodecs.end() ? std::nullopt : std::optional(found->codec);
}

ZarrBytes unpackZarrChunk(ZarrBytes packed, std::span<const ZarrCodec> codecs,
                          std::uint64_t bytes) {
    // The checksums that were packed with the values.
    std::uint64_t inner =
        4 * static_cast<std::uint64_t>(std::ranges::count(codecs, ZarrCodec::Crc32c));
    for (std::size_t i = codecs.size(); i-- > 0;) {
        if (codecs[i] == ZarrCodec::Crc32c) {
            packed = withoutChecksum(std::move(packed));
            inner -= 4;
        } else {
            packed = decompressed(codecs[i], std::move(packed), bytes + inner);
        }
    }
    if (packed.size() != bytes)
        refuseChunk(fmt::format("expected {} bytes, found {}", bytes, packed.size()));
    return packed;
}

}  // namespace timeseries

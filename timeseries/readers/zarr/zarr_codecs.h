// How the bytes of a chunk of a Zarr array are packed: the bytes -> bytes codecs of version 3
// (Zarr specification 3.1, "Codecs"), and the compressors of version 2, which are numcodecs'.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace timeseries {

using ZarrBytes = std::vector<std::byte>;

enum class ZarrCodec { Zlib, Gzip, Bzip2, Zstd, Blosc, Lz4, Crc32c };

// By its name in an array's metadata, also behind "numcodecs.". Nothing when it is not read.
std::optional<ZarrCodec> zarrCodecOf(std::string_view name);

// No chunk has more bytes than Blosc can pack (c-blosc, BLOSC_MAX_BUFFERSIZE).
constexpr std::uint64_t kMaxChunkBytes = (std::uint64_t{1} << 31) - 1 - 16;
// The most bytes that pack so many: those that cannot be packed grow a little.
constexpr std::uint64_t mostPackedBytes(std::uint64_t bytes) { return bytes + bytes / 8 + 65536; }

// What `codecs`, in the order in which they packed, made of exactly so many bytes. REQUIRES: one of
// them at most is no Crc32c, bytes <= kMaxChunkBytes, packed.size() <= mostPackedBytes(bytes).
// Throws std::invalid_argument: what was expected and found.
ZarrBytes unpackZarrChunk(ZarrBytes packed, std::span<const ZarrCodec> codecs, std::uint64_t bytes);

// CRC-32C (RFC 3720, appendix B.4).
std::uint32_t crc32cOf(std::span<const std::byte> bytes);

}  // namespace timeseries

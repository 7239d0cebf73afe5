// Zarr stores for tests: chunks packed by the libraries themselves, metadata as text.
#pragma once

#include <blosc.h>
#include <bzlib.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lz4.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/deflated.h"
#include "tests/support/files.h"

namespace tests::zarr {

using Lengths = std::vector<std::size_t>;
using Pack = std::function<std::string(const std::string&)>;

inline std::string listed(const Lengths& lengths) {
    return fmt::format("[{}]", fmt::join(lengths, ", "));
}

inline std::string byBzip2(const std::string& bytes) {
    std::string out(bytes.size() * 2 + 1000, '\0'), in = bytes;
    auto size = static_cast<unsigned>(out.size());
    EXPECT_EQ(BZ2_bzBuffToBuffCompress(out.data(), &size, in.data(),
                                       static_cast<unsigned>(in.size()), 9, 0, 0),
              BZ_OK);
    return out.substr(0, size);
}

inline std::string byZstd(const std::string& bytes) {
    std::string out(ZSTD_compressBound(bytes.size()), '\0');
    return out.substr(0, ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
}

inline std::string byBlosc(const std::string& bytes) {
    std::string out(bytes.size() + BLOSC_MAX_OVERHEAD, '\0');
    const int size = blosc_compress_ctx(5, BLOSC_SHUFFLE, 4, bytes.size(), bytes.data(), out.data(),
                                        out.size(), "lz4", 0, 1);
    EXPECT_GT(size, 0);
    return out.substr(0, static_cast<std::size_t>(size));
}

// As numcodecs does.
inline std::string byLz4(const std::string& bytes) {
    std::string out(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(bytes.size()))),
                    '\0');
    const int size = LZ4_compress_default(bytes.data(), out.data(), static_cast<int>(bytes.size()),
                                          static_cast<int>(out.size()));
    return littleEndian(bytes.size(), 4) + out.substr(0, static_cast<std::size_t>(size));
}

// CRC-32C by its polynomial, bit by bit.
inline std::string withCrc32c(const std::string& bytes) {
    std::uint32_t sum = 0xFFFFFFFFu;
    for (const char c : bytes) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0x82F63B78u : sum >> 1;
    }
    return bytes + littleEndian(~sum, 4);
}

inline std::string unpacked(const std::string& bytes) { return bytes; }

// Calls use(at) for each place of such a box, the last dimension fastest.
template <typename Use>
void forEachAt(const Lengths& lengths, Use use) {
    Lengths at(lengths.size(), 0);
    while (true) {
        use(at);
        std::size_t d = lengths.size();
        for (; d > 0; at[--d] = 0)
            if (++at[d - 1] < lengths[d - 1]) break;
        if (d == 0) return;
    }
}

// How an array lies in its folder.
struct Layout {
    Lengths shape, chunk;
    Lengths order = {};  // the dimensions as they follow each other in a chunk; none: in order
    bool bigEndian = false;
    std::string keyStart = "", separator = ".";
    Pack pack = unpacked;
    std::function<bool(const Lengths&)> isWritten = [](const Lengths&) { return true; };
};

inline std::string keyOf(const Layout& layout, const Lengths& chunk) {
    std::string key = layout.keyStart;
    for (const std::size_t along : chunk)
        key += (key.empty() ? "" : layout.separator) + std::to_string(along);
    return key.empty() ? "0" : key;
}

template <typename T>
std::string bytesOf(T value, bool bigEndian) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (bigEndian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// The bytes of a chunk before they are packed; beyond the array they are 99.
template <typename T>
std::string chunkOf(const Layout& layout, const Lengths& chunk,
                    const std::function<T(const Lengths&)>& value) {
    const std::size_t rank = layout.shape.size();
    Lengths order = layout.order;
    if (order.empty()) {
        order.resize(rank);
        std::iota(order.begin(), order.end(), std::size_t{0});
    }
    Lengths turned(rank);
    for (std::size_t i = 0; i < rank; ++i) turned[i] = layout.chunk[order[i]];
    std::string bytes;
    forEachAt(turned, [&](const Lengths& within) {
        Lengths at(rank);
        bool inside = true;
        for (std::size_t i = 0; i < rank; ++i) {
            at[order[i]] = chunk[order[i]] * layout.chunk[order[i]] + within[i];
            inside = inside && at[order[i]] < layout.shape[order[i]];
        }
        bytes += bytesOf(inside ? value(at) : static_cast<T>(99), layout.bigEndian);
    });
    return bytes;
}

template <typename T>
void writeChunks(const std::filesystem::path& folder, const Layout& layout,
                 const std::function<T(const Lengths&)>& value) {
    Lengths chunks;
    for (std::size_t d = 0; d < layout.shape.size(); ++d)
        chunks.push_back((layout.shape[d] + layout.chunk[d] - 1) / layout.chunk[d]);
    forEachAt(chunks, [&](const Lengths& chunk) {
        if (!layout.isWritten(chunk)) return;
        const std::filesystem::path file = folder / keyOf(layout, chunk);
        std::filesystem::create_directories(file.parent_path());
        writeBytes(file, layout.pack(chunkOf<T>(layout, chunk, value)));
    });
}

// An object of these members, with others in their places.
inline std::string jsonOf(std::map<std::string, std::string> members,
                          const std::map<std::string, std::string>& others) {
    for (const auto& [name, value] : others) members[name] = value;
    std::string text;
    for (const auto& [name, value] : members)
        text += fmt::format("{}\"{}\": {}", text.empty() ? "{" : ", ", name, value);
    return text + "}";
}

// .zarray, with others of its members in the place of these.
inline std::string v2Array(const Layout& layout, const std::string& dtype,
                           const std::map<std::string, std::string>& others = {}) {
    std::map<std::string, std::string> members{
        {"zarr_format", "2"},
        {"shape", listed(layout.shape)},
        {"chunks", listed(layout.chunk)},
        {"dtype", '"' + dtype + '"'},
        {"compressor", "null"},
        {"fill_value", "null"},
        {"filters", "null"},
        {"order", "\"C\""},
    };
    return jsonOf(std::move(members), others);
}

// zarr.json of an array, alike.
inline std::string v3Array(const Layout& layout, const std::string& type,
                           const std::map<std::string, std::string>& others = {}) {
    std::map<std::string, std::string> members{
        {"zarr_format", "3"},
        {"node_type", "\"array\""},
        {"shape", listed(layout.shape)},
        {"data_type", '"' + type + '"'},
        {"chunk_grid",
         fmt::format(R"({{"name": "regular", "configuration": {{"chunk_shape": {}}}}})",
                     listed(layout.chunk))},
        {"chunk_key_encoding", R"({"name": "default", "configuration": {"separator": "/"}})"},
        {"fill_value", "0"},
        {"codecs", R"([{"name": "bytes", "configuration": {"endian": "little"}}])"},
        {"attributes", "{}"},
    };
    return jsonOf(std::move(members), others);
}

inline void put(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    writeBytes(file, text);
}

// A group of version 2 in the test's folder, emptied.
inline std::filesystem::path v2Group() {
    const std::filesystem::path store = freshFolder() / "store.zarr";
    put(store / ".zgroup", R"({"zarr_format": 2})");
    return store;
}
inline std::filesystem::path v3Group(const std::string& attributes = "{}") {
    const std::filesystem::path store = freshFolder() / "store.zarr";
    put(store / "zarr.json",
        R"({"zarr_format": 3, "node_type": "group", "attributes": )" + attributes + "}");
    return store;
}

// A coordinate of doubles in one chunk, of version 2.
inline void putCoordinate(const std::filesystem::path& store, const std::string& name,
                          const std::vector<double>& values, const std::string& attributes = "") {
    const Layout layout{.shape = {values.size()}, .chunk = {values.size()}};
    put(store / name / ".zarray", v2Array(layout, "<f8"));
    put(store / name / ".zattrs", fmt::format(R"({{"_ARRAY_DIMENSIONS": ["{}"]{}{}}})", name,
                                              attributes.empty() ? "" : ", ", attributes));
    writeChunks<double>(store / name, layout, [&](const Lengths& at) { return values[at[0]]; });
}

// A value whose digits tell where it lies, of lengths below ten.
template <typename T>
T digitsOf(const Lengths& at) {
    std::size_t n = 0;
    for (const std::size_t along : at) n = n * 10 + along;
    return static_cast<T>(n);
}

}  // namespace tests::zarr

// Bytes packed by zlib, and numbers as bytes.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>

namespace tests {

// As a zlib stream, or with 16 more as gzip's (zlib.h, deflateInit2).
inline std::string deflated(const std::string& bytes, int windowBits) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string in = bytes, out(deflateBound(&stream, in.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}
inline std::string byZlib(const std::string& bytes) { return deflated(bytes, 15); }
inline std::string byGzip(const std::string& bytes) { return deflated(bytes, 15 + 16); }

inline std::string littleEndian(std::uint64_t number, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> 8 * i & 0xFF);
    return out;
}

}  // namespace tests

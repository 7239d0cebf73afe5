// Arrays in files for tests: a header by hand, then bytes.
#pragma once

#include <bzlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/deflated.h"
#include "tests/support/files.h"
#include "tests/support/read_variables.h"
#include "timeseries/readers/reader.h"

namespace tests {

template <typename T>
std::string bytesOf(const std::vector<T>& values, std::endian order = std::endian::little) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    if (order != std::endian::native)
        for (std::size_t i = 0; i < bytes.size(); i += sizeof(T))
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                         bytes.begin() + static_cast<std::ptrdiff_t>(i + sizeof(T)));
    return bytes;
}

inline std::string bzipped(const std::string& bytes) {
    // The most it can take (bzlib's manual, 3.5.1).
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 601);
    std::string out(size, '\0');
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()), 9, 0, 0);
    out.resize(size);
    return out;
}

// In one of the encodings "raw", "gzip" and "bzip2".
inline std::string encoded(const std::string& encoding, const std::string& bytes) {
    return encoding == "gzip" ? byGzip(bytes) : encoding == "bzip2" ? bzipped(bytes) : bytes;
}

// "NRRD0004", the lines, a blank line, the bytes.
inline std::string nrrd(const std::string& lines, const std::string& bytes) {
    return "NRRD0004\n" + lines + "\n" + bytes;
}

// A binary header of so many bytes, zero but for what is put where.
class BinaryHeader {
 public:
    BinaryHeader(std::size_t bytes, std::endian order) : bytes_(bytes, '\0'), order_(order) {}
    template <typename T>
    BinaryHeader& put(std::size_t at, const std::vector<T>& values) {
        const std::string bytes = bytesOf(values, order_);
        bytes_.replace(at, bytes.size(), bytes);
        return *this;
    }
    template <typename T>
    BinaryHeader& put(std::size_t at, T value) {
        return put(at, std::vector<T>{value});
    }
    BinaryHeader& put(std::size_t at, const std::string& text) {
        bytes_.replace(at, text.size(), text);
        return *this;
    }
    const std::string& bytes() const { return bytes_; }
    std::endian order() const { return order_; }

 private:
    std::string bytes_;
    std::endian order_;
};

// 0, 1, 2, ...
template <typename T>
std::vector<T> ramp(std::size_t count) {
    std::vector<T> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<T>(i);
    return values;
}

// Opens a file of these bytes.
inline std::unique_ptr<timeseries::Reader> openWritten(const std::string& bytes) {
    const std::filesystem::path path = tests::freshFolder() / "file.nrrd";
    tests::writeBytes(path, bytes);
    return open(path);
}

template <typename T>
std::vector<T> valuesOf(timeseries::Reader& reader, std::size_t step = 0) {
    return std::get<std::vector<T>>(reader.read(0, step).values);
}

// What the file is refused with, behind its path; "" when it is read whole.
inline std::string refusal(const std::filesystem::path& path) {
    try {
        const auto reader = open(path);
        for (std::size_t t = 0; t < reader->variables()[0].time->points.size(); ++t)
            reader->read(0, t);
    } catch (const timeseries::FileError& error) {
        const std::string text = error.what(), begin = path.string() + ": ";
        EXPECT_TRUE(text.starts_with(begin)) << text;
        EXPECT_NE(text.find("expected"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text.substr(std::min(begin.size(), text.size()));
    }
    return "";
}

}  // namespace tests

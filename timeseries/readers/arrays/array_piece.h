// One file that holds values of an array, decoded from its beginning on.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "timeseries/readers/arrays/array_stream.h"
#include "timeseries/readers/arrays/bzip2_file.h"

namespace timeseries {

class ArrayStream::Piece {
 public:
    // `bytes`: of the decoded values. Passes line skip and byte skip. Throws FileError.
    Piece(const ArrayHeader& header, const std::filesystem::path& path, std::uint64_t headerBytes,
          std::uint64_t bytes);
    ~Piece();
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;

    // Raw alone: any place, all of it. Throws FileError.
    void readAt(std::uint64_t position, char* out, std::size_t bytes) const;
    // The next decoded bytes; fewer at the end. Throws FileError.
    std::size_t next(char* out, std::size_t bytes);
    // Raw, compressed: expects what `next` gives to be there. Throws FileError.
    void expectNext(char* out, std::size_t bytes);
    // Where next() goes on.
    std::uint64_t position() const { return position_; }

    [[noreturn]] void fail(std::string_view what) const;

 private:
    void readPart(std::uint64_t position, char* out, std::size_t bytes) const;
    void skipLines();
    void openDecoder();
    void openGzip();

    const ArrayHeader& header_;
    std::filesystem::path path_;
    std::uint64_t offset_;  // of the first value in the file, when not compressed
    std::uint64_t bytes_, position_ = 0;
    int file_ = -1;
    gzFile gzip_ = nullptr;
    std::optional<Bzip2File> bzip2_;  // reads file_
};

}  // namespace timeseries

// The values of an array as one sequence, read where they are asked for: raw files by offset,
// compressed files and texts by decoding up to there. Holds a buffer, never a whole file.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "timeseries/readers/arrays/array_files.h"
#include "timeseries/readers/arrays/array_header.h"

namespace timeseries {

class ArrayStream {
 public:
    // REQUIRES: header outlives this. Opens no file yet.
    ArrayStream(const ArrayHeader& header, ArrayPieces pieces);
    ~ArrayStream();

    // `count` values from `first`, of the header's type and in this machine's byte order. Fastest
    // when `first` ascends from call to call. REQUIRES: out holds them. Throws FileError.
    void read(std::uint64_t first, std::uint64_t count, void* out);

    class Piece;

 private:
    Piece& open(std::size_t index, bool again);
    void readBytes(std::uint64_t first, std::uint64_t count, char* out);
    void fill(std::size_t index, std::uint64_t position);
    void readText(std::uint64_t first, std::uint64_t count, char* out);
    bool nextWord();
    void parseWord(void* out, std::uint64_t index) const;

    const ArrayHeader& header_;
    ArrayPieces pieces_;
    std::uint64_t pieceBytes_;
    std::unique_ptr<Piece> piece_;
    std::size_t pieceIndex_ = 0;
    std::vector<char> buffer_;        // of the open piece
    std::uint64_t bufferBegin_ = 0;   // its position in the piece
    std::size_t bufferUsed_ = 0;      // bytes in it
    std::size_t textAt_ = 0;          // of texts: the next byte in the buffer
    std::uint64_t textPosition_ = 0;  // of texts: how many values of the piece are passed
    std::string word_;
};

}  // namespace timeseries

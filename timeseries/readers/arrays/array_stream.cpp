#include "timeseries/readers/arrays/array_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/arrays/array_piece.h"
#include "timeseries/readers/text/number_text.h"

namespace timeseries {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
constexpr std::size_t kDirectBytes = 4096;  // so many bytes in a row are read without the buffer
constexpr std::size_t kMaxDigits = 400;     // digits of a number, written out in full

template <std::size_t N>
void reverse(char* values, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, values += N) std::reverse(values, values + N);
}

void toNative(char* values, std::uint64_t count, std::size_t valueBytes) {
    if (valueBytes == 2) reverse<2>(values, count);
    if (valueBytes == 4) reverse<4>(values, count);
    if (valueBytes == 8) reverse<8>(values, count);
}

bool separates(char c) {
    return c == ' ' || c == ',' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

ArrayStream::ArrayStream(const ArrayHeader& header, ArrayPieces pieces)
    : header_(header),
      pieces_(std::move(pieces)),
      pieceBytes_(pieces_.pieceCount * header.valueBytes()),
      buffer_(kBufferBytes) {}

ArrayStream::~ArrayStream() = default;

void ArrayStream::read(std::uint64_t first, std::uint64_t count, void* out) {
    auto* bytes = static_cast<char*>(out);
    if (header_.encoding == ArrayEncoding::Ascii) {
        readText(first, count, bytes);
        return;
    }
    const std::size_t size = header_.valueBytes();
    readBytes(first * size, count * size, bytes);
    if (header_.swapped) toNative(bytes, count, size);
}

ArrayStream::Piece& ArrayStream::open(std::size_t index, bool again) {
    if (!piece_ || pieceIndex_ != index || again) {
        piece_.reset();
        piece_ = std::make_unique<Piece>(header_, pieces_.paths[index], pieces_.headerBytes,
                                         pieceBytes_);
        pieceIndex_ = index;
        bufferBegin_ = textPosition_ = 0;
        bufferUsed_ = textAt_ = 0;
    }
    return *piece_;
}

void ArrayStream::readBytes(std::uint64_t first, std::uint64_t count, char* out) {
    while (count > 0) {
        const auto index = static_cast<std::size_t>(first / pieceBytes_);
        const std::uint64_t at = first % pieceBytes_;
        std::uint64_t part = std::min(count, pieceBytes_ - at);
        Piece& piece = open(index, false);
        if (header_.encoding == ArrayEncoding::Raw && part >= kDirectBytes) {
            piece.readAt(at, out, part);
        } else {
            if (at < bufferBegin_ || at >= bufferBegin_ + bufferUsed_) fill(index, at);
            part = std::min(part, bufferBegin_ + bufferUsed_ - at);
            std::memcpy(out, buffer_.data() + (at - bufferBegin_), part);
        }
        out += part;
        first += part;
        count -= part;
    }
}

// Puts what lies at `position` of the piece at the buffer's begin.
void ArrayStream::fill(std::size_t index, std::uint64_t position) {
    const auto bytesAt = [&](std::uint64_t p) {
        return static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size(), pieceBytes_ - p));
    };
    if (header_.encoding == ArrayEncoding::Raw) {
        piece_->readAt(position, buffer_.data(), bytesAt(position));
    } else {
        if (position < piece_->position()) open(index, true);
        while (piece_->position() < position)
            piece_->expectNext(buffer_.data(), static_cast<std::size_t>(std::min<std::uint64_t>(
                                                   buffer_.size(), position - piece_->position())));
        piece_->expectNext(buffer_.data(), bytesAt(position));
    }
    bufferBegin_ = position;
    bufferUsed_ = bytesAt(position);
}

// The next word of the open piece, at most kMaxDigits + 1 characters of it.
bool ArrayStream::nextWord() {
    word_.clear();
    while (true) {
        if (textAt_ == bufferUsed_) {
            bufferUsed_ = piece_->next(buffer_.data(), buffer_.size());
            textAt_ = 0;
            if (bufferUsed_ == 0) return !word_.empty();
        }
        const char c = buffer_[textAt_];
        if (separates(c) && !word_.empty()) return true;
        ++textAt_;
        if (!separates(c)) word_ += c;
        if (word_.size() > kMaxDigits) return true;
    }
}

void ArrayStream::parseWord(void* out, std::uint64_t index) const {
    withType(header_.type, [&]<typename T>(T) {
        const auto read = word_.size() > kMaxDigits ? std::nullopt : numberOfText<T>(word_);
        if (!read) {
            std::string shown = word_.substr(0, 40);
            for (char& c : shown)
                if (c < ' ' || c > '~') c = '?';
            piece_->fail(fmt::format("value {}: expected a number of type {}, found '{}'",
                                     index + 1, typeName(header_.type), shown));
        }
        std::memcpy(out, &*read, sizeof *read);
    });
}

void ArrayStream::readText(std::uint64_t first, std::uint64_t count, char* out) {
    const std::size_t size = header_.valueBytes();
    for (; count > 0; ++first, --count, out += size) {
        const auto index = static_cast<std::size_t>(first / pieces_.pieceCount);
        const std::uint64_t at = first % pieces_.pieceCount;
        open(index, false);
        if (at < textPosition_) open(index, true);
        do {
            if (!nextWord())
                piece_->fail(
                    fmt::format("expected {} values, found {}", pieces_.pieceCount, textPosition_));
        } while (textPosition_++ < at);
        parseWord(out, at);
    }
}

}  // namespace timeseries

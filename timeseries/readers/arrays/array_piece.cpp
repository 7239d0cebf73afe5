#include "timeseries/readers/arrays/array_piece.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kBytesWorthAThread = std::size_t{8} << 20;
constexpr std::size_t kMaxCall = std::size_t{1} << 30;  // zlib counts in int

}  // namespace

ArrayStream::Piece::Piece(const ArrayHeader& header, const std::filesystem::path& path,
                          std::uint64_t headerBytes, std::uint64_t bytes)
    : header_(header), path_(path), offset_(headerBytes), bytes_(bytes) {
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) fail("expected a file that can be read");
    try {
        skipLines();
        if (header.encoding == ArrayEncoding::Gzip || header.encoding == ArrayEncoding::Bzip2) {
            openDecoder();
            return;
        }
        struct stat status {};
        if (::fstat(file_, &status) != 0) fail("expected a file that can be read");
        const auto size = static_cast<std::uint64_t>(status.st_size);
        const bool raw = header.encoding == ArrayEncoding::Raw;
        if (header.byteSkip == -1)
            offset_ = size - std::min(size, bytes_);
        else
            offset_ += static_cast<std::uint64_t>(header.byteSkip);
        if (offset_ > size || (raw && size - offset_ < bytes_))
            fail(fmt::format("expected {} bytes of values behind what is skipped, found {}", bytes_,
                             size - std::min(size, offset_)));
    } catch (...) {
        if (gzip_) gzclose_r(gzip_);
        ::close(file_);
        throw;
    }
}

ArrayStream::Piece::~Piece() {
    if (gzip_) gzclose_r(gzip_);
    ::close(file_);
}

void ArrayStream::Piece::fail(std::string_view what) const {
    header_.fail(path_ == header_.path ? "values" : path_.string(), what);
}

void ArrayStream::Piece::skipLines() {
    std::array<char, 4096> chunk;
    for (std::uint64_t left = header_.lineSkip; left > 0;) {
        const ssize_t got = ::pread(file_, chunk.data(), chunk.size(), static_cast<off_t>(offset_));
        if (got <= 0) fail(fmt::format("expected {} lines to skip", header_.lineSkip));
        for (ssize_t i = 0; i < got && left > 0; ++i) {
            ++offset_;
            if (chunk[static_cast<std::size_t>(i)] == '\n') --left;
        }
    }
}

void ArrayStream::Piece::openGzip() {
    const int own = ::dup(file_);  // zlib closes it
    if (own < 0) fail("expected a file that can be read");
    gzip_ = gzdopen(own, "rb");
    if (gzip_) return;
    ::close(own);
    fail("expected memory to decode it");
}

void ArrayStream::Piece::openDecoder() {
    const bool gzip = header_.encoding == ArrayEncoding::Gzip;
    // zlib passes what is not compressed as it is.
    std::array<unsigned char, 3> start{};
    const auto at = static_cast<off_t>(offset_);
    const bool begins = ::pread(file_, start.data(), start.size(), at) == 3 &&
                        (gzip ? start[0] == 0x1f && start[1] == 0x8b
                              : start[0] == 'B' && start[1] == 'Z' && start[2] == 'h');
    if (!begins) fail(fmt::format("expected {} data", gzip ? "gzip" : "bzip2"));
    if (::lseek(file_, at, SEEK_SET) != at) fail("expected a file that can be read");
    if (gzip)
        openGzip();
    else
        bzip2_.emplace(file_);
    std::array<char, 4096> chunk;
    for (auto left = static_cast<std::uint64_t>(header_.byteSkip); left > 0;) {
        const std::size_t got = next(chunk.data(), std::min<std::uint64_t>(left, chunk.size()));
        if (got == 0) fail(fmt::format("expected {} bytes to skip", header_.byteSkip));
        left -= got;
    }
    position_ = 0;
}

void ArrayStream::Piece::readAt(std::uint64_t position, char* out, std::size_t bytes) const {
    const unsigned threads = threadsFor(bytes, kBytesWorthAThread);
    sharing(threads, [&](unsigned k) {
        const std::size_t first = bytes * k / threads, last = bytes * (k + 1) / threads;
        readPart(position + first, out + first, last - first);
    });
}

void ArrayStream::Piece::readPart(std::uint64_t position, char* out, std::size_t bytes) const {
    while (bytes > 0) {
        const ssize_t got =
            ::pread(file_, out, std::min(bytes, kMaxCall), static_cast<off_t>(offset_ + position));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) fail(fmt::format("expected values up to byte {}", bytes_));
        out += got;
        bytes -= static_cast<std::size_t>(got);
        position += static_cast<std::uint64_t>(got);
    }
}

std::size_t ArrayStream::Piece::next(char* out, std::size_t bytes) {
    std::size_t done = 0;
    while (done < bytes) {
        const std::size_t want = std::min(bytes - done, kMaxCall);
        std::ptrdiff_t got = 0;
        if (gzip_)
            got = gzread(gzip_, out + done, static_cast<unsigned>(want));
        else if (bzip2_)
            got = bzip2_->read(out + done, want);
        else
            got = ::pread(file_, out + done, want, static_cast<off_t>(offset_ + position_));
        if (got < 0 && !gzip_ && !bzip2_ && errno == EINTR) continue;
        int state = Z_OK;
        if (got == 0 && gzip_) gzerror(gzip_, &state);
        if (got < 0 || state != Z_OK)
            fail(
                fmt::format("expected whole {} data, found them damaged or cut after {} bytes of "
                            "values",
                            gzip_ ? "gzip" : "bzip2", position_));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
        position_ += static_cast<std::uint64_t>(got);
    }
    return done;
}

void ArrayStream::Piece::expectNext(char* out, std::size_t bytes) {
    if (next(out, bytes) < bytes)
        fail(fmt::format("expected {} bytes of values, found {}", bytes_, position_));
    if (position_ < bytes_ || !(gzip_ || bzip2_)) return;
    // The checksum stands behind the last value and is looked at when more is asked for. What is
    // more than a little is not of a damaged last byte, but of values that the header does not
    // declare.
    std::array<char, 4096> beyond;
    for (int i = 0; i < 16 && next(beyond.data(), beyond.size()) > 0; ++i) continue;
    position_ = bytes_;
}

}  // namespace timeseries

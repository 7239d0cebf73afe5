#include "timeseries/readers/arrays/bzip2_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>

namespace timeseries {
namespace {

constexpr std::size_t kPackedBytes = std::size_t{1} << 16;
constexpr std::string_view kMagic = "BZh";

}  // namespace

Bzip2File::Bzip2File(int file) : file_(file), packed_(kPackedBytes) {
    stream_.next_in = packed_.data();
}

Bzip2File::~Bzip2File() {
    if (inStream_) BZ2_bzDecompressEnd(&stream_);
}

// Has so many packed bytes at hand, unless the file ends before.
void Bzip2File::take(std::size_t enough) {
    if (stream_.avail_in >= enough) return;
    std::memmove(packed_.data(), stream_.next_in, stream_.avail_in);
    stream_.next_in = packed_.data();
    while (stream_.avail_in < enough && !fileEnds_) {
        const ssize_t got =
            ::read(file_, packed_.data() + stream_.avail_in, packed_.size() - stream_.avail_in);
        if (got < 0 && errno == EINTR) continue;
        fileEnds_ = got <= 0;
        if (got > 0) stream_.avail_in += static_cast<unsigned>(got);
    }
}

// Whether another stream begins here.
bool Bzip2File::begin() {
    take(kMagic.size());
    if (!std::string_view(stream_.next_in, stream_.avail_in).starts_with(kMagic)) return false;
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
    inStream_ = true;
    return true;
}

// As far as the room for what is decoded goes, or the stream. False where it is damaged or cut.
bool Bzip2File::decode() {
    while (stream_.avail_out > 0) {
        take(1);
        const int state = BZ2_bzDecompress(&stream_);
        if (state == BZ_STREAM_END) {
            BZ2_bzDecompressEnd(&stream_);
            inStream_ = false;
            return true;
        }
        const bool cut = fileEnds_ && stream_.avail_in == 0 && stream_.avail_out > 0;
        if (state != BZ_OK || cut) return false;
    }
    return true;
}

std::ptrdiff_t Bzip2File::read(char* out, std::size_t bytes) {
    stream_.next_out = out;
    stream_.avail_out =
        static_cast<unsigned>(std::min<std::size_t>(bytes, std::numeric_limits<unsigned>::max()));
    while (stream_.avail_out > 0 && (inStream_ || begin()))
        if (!decode()) return -1;
    return stream_.next_out - out;
}

}  // namespace timeseries

#include "render/image/png_rows.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <new>
#include <vector>

#include "timeseries/together.h"

namespace render {
namespace {

using Bytes = std::vector<std::uint8_t>;

// What one thread deflates by itself: small enough that all have some, large enough that starting
// anew costs nothing. Of so many the results are kept until they are written.
constexpr std::size_t kStripBytes = std::size_t{1} << 18, kStripsAtOnce = 64;

// What of the three neighbours, at the left, above and above that, is nearest to left + above -
// corner; of equally near ones the first (PNG 9.4). In 16 bits and without branches: for vectors.
std::uint8_t paeth(std::int16_t left, std::int16_t above, std::int16_t corner) {
    const auto magnitude = [](std::int16_t of) {
        return static_cast<std::int16_t>(of < 0 ? -of : of);
    };
    const auto across = static_cast<std::int16_t>(above - corner);
    const auto down = static_cast<std::int16_t>(left - corner);
    const std::int16_t byLeft = magnitude(across), byAbove = magnitude(down);
    const std::int16_t byCorner = magnitude(static_cast<std::int16_t>(across + down));
    const std::int16_t nearer = byLeft <= byAbove ? left : above;
    const std::int16_t byNearer = byLeft <= byAbove ? byLeft : byAbove;
    return static_cast<std::uint8_t>(byNearer <= byCorner ? nearer : corner);
}

// The rows of a strip, each behind the number of its filter.
class StripFilter {
 public:
    explicit StripFilter(const PngRows& rows)
        : rows_(rows), above_(rows.pixelBytes + rows.bytes), row_(rows.pixelBytes + rows.bytes) {}

    void operator()(std::size_t first, std::size_t last, Bytes& out) {
        constexpr std::uint8_t kPaeth = 4;
        std::ranges::fill(row_, std::uint8_t{0});
        if (first > 0) encode(first - 1);
        out.resize((last - first) * (1 + rows_.bytes));
        for (std::size_t y = first; y < last; ++y) {
            std::swap(above_, row_);
            encode(y);
            std::uint8_t* const to = &out[(y - first) * (1 + rows_.bytes)];
            to[0] = kPaeth;
            filter(to + 1);
        }
    }

 private:
    // A pixel of zeros stands before both rows.
    void encode(std::size_t y) { rows_.encode(y, std::span(row_).subspan(rows_.pixelBytes)); }
    void filter(std::uint8_t* to) const {
        const std::uint8_t* const corner = above_.data();
        const std::uint8_t* const left = row_.data();
        const std::uint8_t* const above = corner + rows_.pixelBytes;
        const std::uint8_t* const here = left + rows_.pixelBytes;
        const std::size_t count = rows_.bytes;
        for (std::size_t i = 0; i < count; ++i)
            to[i] = static_cast<std::uint8_t>(here[i] - paeth(left[i], above[i], corner[i]));
    }

    const PngRows& rows_;
    Bytes above_, row_;
};

struct Strip {
    Bytes deflated;
    uLong adler = 0, length = 0;  // of the bytes before
};

// Of what is so filtered, deflate's search finds little more than runs, in eight times the time.
void deflateStrip(std::span<std::uint8_t> bytes, bool isLast, Strip& out) {
    constexpr int kLevel = 1, kWithoutHeader = -15, kMemory = 8, kFlushBytes = 16;
    z_stream z{};
    if (deflateInit2(&z, kLevel, Z_DEFLATED, kWithoutHeader, kMemory, Z_RLE) != Z_OK)
        throw std::bad_alloc();
    out.deflated.resize(deflateBound(&z, bytes.size()) + kFlushBytes);
    z.next_in = bytes.data();
    z.avail_in = static_cast<uInt>(bytes.size());
    z.next_out = out.deflated.data();
    z.avail_out = static_cast<uInt>(out.deflated.size());
    deflate(&z, isLast ? Z_FINISH : Z_SYNC_FLUSH);  // ends at a byte; there is room for all
    out.deflated.resize(z.total_out);
    deflateEnd(&z);
    out.length = bytes.size();
    out.adler = adler32(adler32(0, nullptr, 0), bytes.data(), static_cast<uInt>(bytes.size()));
}

}  // namespace

void deflateRows(const PngRows& rows,
                 const std::function<void(std::span<const std::uint8_t>)>& write) {
    constexpr std::array<std::uint8_t, 2> kHeader{0x78, 0x01};  // RFC 1950: deflate, 32 KiB
    const std::size_t each = std::max<std::size_t>(1, kStripBytes / rows.bytes);
    const std::size_t count = (rows.count + each - 1) / each;
    write(kHeader);
    uLong adler = adler32(0, nullptr, 0);
    std::vector<Strip> strips;
    for (std::size_t first = 0; first < count; first += strips.size()) {
        strips.assign(std::min(kStripsAtOnce, count - first), {});
        std::atomic<std::size_t> next{0};
        timeseries::sharing(timeseries::threadsFor(strips.size(), 1), [&](unsigned) {
            StripFilter filtered(rows);
            Bytes bytes;
            for (std::size_t i = next++; i < strips.size(); i = next++) {
                const std::size_t y = (first + i) * each;
                filtered(y, std::min(y + each, rows.count), bytes);
                deflateStrip(bytes, first + i + 1 == count, strips[i]);
            }
        });
        for (const Strip& strip : strips) {
            write(strip.deflated);
            adler = adler32_combine(adler, strip.adler, static_cast<z_off_t>(strip.length));
        }
    }
    write(std::array{static_cast<std::uint8_t>(adler >> 24), static_cast<std::uint8_t>(adler >> 16),
                     static_cast<std::uint8_t>(adler >> 8), static_cast<std::uint8_t>(adler)});
}

}  // namespace render

#include "timeseries/readers/plot3d_layout.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace timeseries {
namespace {

constexpr std::uint32_t kMostLength = 65536, kMostGrids = 256;
constexpr std::uint64_t kFewest = 8;  // points: fewer might be anything
// Bytes that some writers leave behind, of a large grid.
std::uint64_t mostLeft(std::uint64_t points) { return std::min<std::uint64_t>(512, points / 2); }
constexpr std::uint64_t kMark = 4;  // of a record, before it and behind

class Words {
 public:
    Words(std::string_view start, bool swapped) : start_(start), swapped_(swapped) {}
    // The integer at a byte; none that is a length where there is none.
    std::uint32_t at(std::uint64_t byte) const {
        std::uint32_t word = 0;
        if (byte + 4 > start_.size()) return 0;
        std::memcpy(&word, start_.data() + byte, 4);
        return swapped_ ? __builtin_bswap32(word) : word;
    }

 private:
    std::string_view start_;
    bool swapped_;
};

struct Lengths {
    std::vector<std::array<std::size_t, 3>> grids;
    std::uint64_t points = 0, end = 0;  // of all; the byte behind
};

std::optional<Lengths> lengthsOf(const Words& words, bool marked, bool counted) {
    const std::uint64_t mark = marked ? kMark : 0;
    std::uint64_t at = 0;
    std::uint32_t count = 1;
    if (counted) {
        if (marked && words.at(0) != 4) return std::nullopt;
        count = words.at(mark);
        at = 4 + 2 * mark;
    }
    if (count < 1 || count > kMostGrids || (marked && words.at(at) != 12 * count))
        return std::nullopt;
    at += mark;
    Lengths lengths;
    for (std::uint32_t grid = 0; grid < count; ++grid) {
        std::array<std::size_t, 3> size;
        std::uint64_t points = 1;
        for (std::size_t& along : size) {
            along = words.at(at);
            if (along < 1 || along > kMostLength) return std::nullopt;
            points *= along;
            at += 4;
        }
        lengths.points += points;
        lengths.grids.push_back(size);
    }
    lengths.end = at + mark;
    if (lengths.points < kFewest) return std::nullopt;
    return lengths;
}

}  // namespace

std::optional<Plot3dLayout> plot3dLayoutOf(std::string_view start, std::uint64_t bytes) {
    std::optional<Plot3dLayout> best;
    std::uint64_t left = std::numeric_limits<std::uint64_t>::max();
    const auto take = [&](const Plot3dLayout& layout, std::uint64_t points, std::uint64_t end) {
        if (end > bytes || bytes - end > mostLeft(points) || bytes - end >= left) return;
        left = bytes - end;
        best = layout;
    };
    for (const bool swapped : {false, true})
        for (const bool marked : {false, true})
            for (const bool counted : {false, true}) {
                const auto lengths = lengthsOf(Words(start, swapped), marked, counted);
                if (!lengths) continue;
                const std::uint64_t mark = marked ? kMark : 0, record = 2 * mark,
                                    grids = lengths->grids.size(), points = lengths->points;
                for (const std::uint64_t real : {4u, 8u}) {
                    Plot3dLayout layout{.swapped = swapped, .real = real, .grids = lengths->grids};
                    layout.kind = Plot3dLayout::Kind::Places;
                    layout.first = lengths->end + mark;
                    const std::uint64_t places = lengths->end + record * grids + 3 * real * points;
                    take(layout, points, places);
                    layout.hasBlanks = true;
                    take(layout, points, places + 4 * points);
                    layout.hasBlanks = false;
                    layout.kind = Plot3dLayout::Kind::Flow;
                    // Mach number, angle of attack, Reynolds number and time stand before.
                    layout.time = lengths->end + mark + 3 * real;
                    layout.first = layout.time + real + record;
                    take(layout, points,
                         lengths->end + (2 * record + 4 * real) * grids + 5 * real * points);
                }
            }
    return best;
}

}  // namespace timeseries

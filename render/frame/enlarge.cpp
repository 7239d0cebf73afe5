#include "render/frame/enlarge.h"

#include <algorithm>
#include <cmath>

#include "render/together.h"

namespace render {
namespace {

// What a pixel takes along one direction: of a coarse pixel, and of the next.
struct Between {
    int first;
    float share;  // of the next
};

Between between(int pixel, int across) {
    const double place = (pixel + 0.5) / across - 0.5;
    const double first = std::floor(place);
    return {static_cast<int>(first), static_cast<float>(place - first)};
}

}  // namespace

void enlarge(const MemoryTargets::Plane& coarse, int across, const PixelBox& part,
             PlanePixels& pixels) {
    const std::size_t floats = floatsPerPixel(coarse.channels);
    const PixelBox& known = coarse.part;
    // A row of coarse pixels with one of nothing, or more, on either side.
    const int first = between(part.at.x, across).first;
    const int last = between(part.at.x + part.size.x - 1, across).first + 1;
    const std::size_t row = floats * static_cast<std::size_t>(last - first + 1);
    const std::size_t width = floats * static_cast<std::size_t>(part.size.x);
    pixels.resize(width * static_cast<std::size_t>(part.size.y));
    const int lo = std::max(first, known.at.x), hi = std::min(last, known.at.x + known.size.x - 1);
    // into += share * the coarse row y.
    const auto add = [&](int y, float share, float* into) {
        if (y < known.at.y || y >= known.at.y + known.size.y || lo > hi) return;
        const float* const from =
            coarse.pixels.data() + floats * (static_cast<std::size_t>(y - known.at.y) *
                                                 static_cast<std::size_t>(known.size.x) +
                                             static_cast<std::size_t>(lo - known.at.x));
        float* const to = into + floats * static_cast<std::size_t>(lo - first);
        const std::size_t count = floats * static_cast<std::size_t>(hi - lo + 1);
        for (std::size_t i = 0; i < count; ++i) to[i] += share * from[i];
    };
    const auto rowsOf = static_cast<std::size_t>(part.size.y);
    inParts(rowsOf, sharingThreads(), [&](std::size_t begin, std::size_t end) {
        std::vector<float> sums(row);
        for (std::size_t y = begin; y < end; ++y) {
            const Between rows = between(part.at.y + static_cast<int>(y), across);
            std::ranges::fill(sums, 0.0f);
            add(rows.first, 1 - rows.share, sums.data());
            add(rows.first + 1, rows.share, sums.data());
            float* out = pixels.data() + y * width;
            for (int x = 0; x < part.size.x; ++x) {
                const Between columns = between(part.at.x + x, across);
                const float* const at =
                    sums.data() + floats * static_cast<std::size_t>(columns.first - first);
                for (std::size_t c = 0; c < floats; ++c)
                    *out++ = (1 - columns.share) * at[c] + columns.share * at[floats + c];
            }
        }
    });
}

}  // namespace render

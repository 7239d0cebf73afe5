// Planes of coarse pixels in the picture's own.
#include "render/frame/enlarge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/reference/sampled_error.h"

namespace render {
namespace {

// What a tent as wide as two coarse pixels about each of them adds up to.
double tents(const MemoryTargets::Plane& coarse, int across, const glm::ivec2& pixel,
             std::size_t channel) {
    const std::size_t floats = floatsPerPixel(coarse.channels);
    double sum = 0;
    for (int y = 0; y < coarse.part.size.y; ++y)
        for (int x = 0; x < coarse.part.size.x; ++x) {
            const glm::dvec2 middle =
                (glm::dvec2(coarse.part.at + glm::ivec2(x, y)) + 0.5) * static_cast<double>(across);
            const glm::dvec2 away =
                glm::abs(glm::dvec2(pixel) + 0.5 - middle) / static_cast<double>(across);
            const auto at = static_cast<std::size_t>(y * coarse.part.size.x + x);
            sum += std::max(1 - away.x, 0.0) * std::max(1 - away.y, 0.0) *
                   static_cast<double>(coarse.pixels[floats * at + channel]);
        }
    return sum;
}

MemoryTargets::Plane noisePlane(Channels channels, const PixelBox& part) {
    MemoryTargets::Plane plane{channels, part, {}};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(0, 2);
    plane.pixels.resize(floatsPerPixel(channels) * static_cast<std::size_t>(part.size.x) *
                        static_cast<std::size_t>(part.size.y));
    for (float& value : plane.pixels) value = any(random);
    return plane;
}

TEST(Enlarge, IsASumOfTentsAndNothingBeyondThePart) {
    for (const Channels channels : {Channels::Weight, Channels::Over})
        for (const int across : {2, 3}) {
            const MemoryTargets::Plane coarse = noisePlane(channels, {{3, 2}, {9, 7}});
            // Wider than what is known, and cut in its middle.
            for (const PixelBox& part : {PixelBox{{0, 0}, {40, 33}}, PixelBox{{11, 9}, {6, 5}},
                                         PixelBox{{0, 0}, {3, 2}}}) {
                PlanePixels pixels;
                enlarge(coarse, across, part, pixels);
                const std::size_t floats = floatsPerPixel(channels);
                ASSERT_EQ(pixels.size(), floats * static_cast<std::size_t>(part.size.x) *
                                             static_cast<std::size_t>(part.size.y));
                for (int y = 0; y < part.size.y; ++y)
                    for (int x = 0; x < part.size.x; ++x)
                        for (std::size_t c = 0; c < floats; ++c)
                            ASSERT_NEAR(
                                pixels[floats * static_cast<std::size_t>(y * part.size.x + x) + c],
                                tents(coarse, across, part.at + glm::ivec2(x, y), c), 1e-5)
                                << x << ' ' << y;
            }
        }
}

// As the error that is told of such a picture has it.
TEST(Enlarge, IsWhatTheToldErrorTakesItFor) {
    const glm::ivec2 size(9, 7);
    const MemoryTargets::Plane coarse = noisePlane(Channels::Weight, {{0, 0}, size});
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < 2 * size.y; ++y)
        for (int x = 0; x < 2 * size.x; ++x) pixels.emplace_back(x, y);
    const std::vector<double> depth =
        enlarged(depthFrom({coarse.pixels.begin(), coarse.pixels.end()}, size), 2, size)(pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        ASSERT_NEAR(depth[i], tents(coarse, 2, pixels[i], 0), 1e-6);
}

}  // namespace
}  // namespace render

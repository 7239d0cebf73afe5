// Against every pixel's centre held against every triangle.
#include "render/annotate/hidden_area.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using namespace render;

constexpr Frustum kFrustum{
    .left = -1.2, .right = 0.9, .down = -1.1, .up = 1, .near = 0.1, .far = 9};

View viewOf(glm::ivec2 size) {
    return {.clipFromView = clipFromView(kFrustum), .viewFromWorld = glm::dmat4(1.0), .size = size};
}

// Of a pixel's centre, which may lie beyond the picture, on the plane one unit before the eye.
glm::dvec2 planeAt(glm::ivec2 pixel, glm::ivec2 size) {
    const glm::dvec2 share = (glm::dvec2(pixel) + 0.5) / glm::dvec2(size);
    return {kFrustum.left + share.x * (kFrustum.right - kFrustum.left),
            kFrustum.down + share.y * (kFrustum.up - kFrustum.down)};
}

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const HiddenArea& area, glm::dvec2 at) {
    constexpr double kRounding = 1e-12;
    for (std::size_t i = 0; i < area.corners.size(); i += 3) {
        const glm::dvec2 &a = area.corners[i], &b = area.corners[i + 1], &c = area.corners[i + 2];
        const double ab = turn(a, b, at), bc = turn(b, c, at), ca = turn(c, a, at);
        if (std::min({ab, bc, ca}) >= -kRounding || std::max({ab, bc, ca}) <= kRounding)
            return true;
    }
    return false;
}

// Whether the centres of all pixels so near lie in the area, as far as the picture goes.
bool insideAround(const HiddenArea& area, glm::ivec2 pixel, glm::ivec2 size, int reach) {
    for (int y = std::max(pixel.y - reach, 0); y <= std::min(pixel.y + reach, size.y - 1); ++y)
        for (int x = std::max(pixel.x - reach, 0); x <= std::min(pixel.x + reach, size.x - 1); ++x)
            if (!inside(area, planeAt({x, y}, size))) return false;
    return true;
}

// How often each pixel is told.
std::vector<int> told(const HiddenArea& area, glm::ivec2 size) {
    std::vector<int> times(std::size_t(size.x) * size.y);
    for (const PixelBox& box : hiddenPixels(area, viewOf(size)))
        for (int y = 0; y < box.size.y; ++y)
            for (int x = 0; x < box.size.x; ++x)
                ++times.at(std::size_t(box.at.y + y) * size.x + (box.at.x + x));
    return times;
}

// Between an ellipse of so many corners and a frame around the picture, as lenses leave it.
HiddenArea rim(int count, glm::dvec2 middle, glm::dvec2 half) {
    const auto at = [&](int i, double reach) {
        const double angle = 2 * std::numbers::pi * i / count;
        return middle + reach * half * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    HiddenArea area;
    for (int i = 0; i < count; ++i)
        for (const glm::dvec2& corner :
             {at(i, 1), at(i, 9), at(i + 1, 9), at(i, 1), at(i + 1, 1), at(i + 1, 9)})
            area.corners.push_back(corner);
    return area;
}

TEST(HiddenArea, OfARimAreAllPixelsWhoseNeighboursAreHiddenToo) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 20; ++round) {
        const glm::ivec2 size(20 + static_cast<int>(random() % 60),
                              20 + static_cast<int>(random() % 60));
        const HiddenArea area =
            rim(3 + static_cast<int>(random() % 30), {unit(random) - 0.6, unit(random) - 0.5},
                {0.3 + unit(random), 0.3 + unit(random)});
        const std::vector<int> times = told(area, size);
        int hidden = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const int is = times[std::size_t(y) * size.x + x];
                hidden += is;
                ASSERT_LE(is, 1) << "once";
                // Two around, as something seen may be narrower than from centre to centre.
                ASSERT_TRUE(is == 1 ? insideAround(area, {x, y}, size, 1)
                                    : !insideAround(area, {x, y}, size, 2))
                    << round << ": " << x << ' ' << y;
            }
        EXPECT_GT(hidden, size.x * size.y / 50);
        EXPECT_LT(hidden, size.x * size.y);
    }
}

TEST(HiddenArea, OfAnyTrianglesNeverHoldsAPixelThatIsSeen) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    const glm::ivec2 size(61, 47);
    int hidden = 0;
    for (int round = 0; round < 40; ++round) {
        HiddenArea area;
        for (int i = 0; i < 3 * (1 + round % 12); ++i)
            area.corners.push_back({place(random), place(random)});
        const std::vector<int> times = told(area, size);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (times[std::size_t(y) * size.x + x] > 0) {
                    ++hidden;
                    ASSERT_TRUE(insideAround(area, {x, y}, size, 1)) << round;
                }
    }
    EXPECT_GT(hidden, 10'000);
}

TEST(HiddenArea, MayBeNothingAndMayBeAll) {
    const glm::ivec2 size(31, 22);
    EXPECT_TRUE(hiddenPixels({}, viewOf(size)).empty());
    // Of two triangles whose common side crosses the picture; corners on its very border.
    const glm::dvec2 a(kFrustum.left, kFrustum.down), b(kFrustum.right, kFrustum.down),
        c(kFrustum.right, kFrustum.up), d(kFrustum.left, kFrustum.up);
    EXPECT_EQ(told({{a, b, c, a, d, c}}, size), std::vector<int>(31 * 22, 1));
}

}  // namespace

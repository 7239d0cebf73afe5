// Bodies that an eye is beside or within: what rays meet of them lies in their bounds, and what
// lies beside the picture is beside it, too.
#include "render/model/seen_bounds.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "render/model/tet_splat.h"
#include "render/splat/window_box.h"
#include "tests/support/cell_rays.h"
#include "tests/support/unstructured.h"

namespace render {
namespace seen_bounds {
namespace {

PixelRays raysOf(double near) {
    PixelRays rays{};
    rays.axis = {0, 0, -1};
    rays.focal = {300, 400};
    rays.perPixelX = {1 / rays.focal.x, 0, 0};
    rays.perPixelY = {0, 1 / rays.focal.y, 0};
    rays.near = near;
    return rays;
}

// Whether the ray of an offset meets a tetrahedron in front of the near plane.
bool meets(const PixelRays& rays, const glm::dvec2& offset, const std::array<glm::dvec3, 4>& at) {
    const auto slopes = tet::slopesOf(at);
    double from = rays.near, to = 1e30;
    for (std::size_t i = 0; i < 4; ++i) {
        const double share = (i == 0 ? 1 : 0) - glm::dot(slopes[i], at[0]);
        const double along = glm::dot(slopes[i], rays.along(offset));
        if (along > 0) from = std::max(from, -share / along);
        if (along < 0) to = std::min(to, -share / along);
        if (along == 0 && share < 0) return false;
    }
    return to > from;
}

TEST(SeenBounds, HoldAllThatRaysMeet) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    int met = 0, beside = 0;
    for (const double near : {1e-6, 0.01, 0.3}) {
        const PixelRays rays = raysOf(near);
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec3 middle(3 * any(random), 3 * any(random), 0.5 * any(random));
            std::array<glm::dvec3, 4> at;
            for (glm::dvec3& corner : at)
                corner = middle + glm::dvec3(any(random), any(random), any(random));
            SeenBounds bounds(rays);
            bounds.takeHull(at);
            const glm::dvec2 lo = bounds.lo(), hi = bounds.hi();
            for (int k = 0; k < 20; ++k) {
                const glm::dvec2 offset(600 * any(random), 600 * any(random));
                if (!meets(rays, offset, at)) continue;
                ++met;
                ASSERT_TRUE(offset.x >= lo.x && offset.y >= lo.y && offset.x <= hi.x &&
                            offset.y <= hi.y)
                    << offset.x << ", " << offset.y << " of near " << near;
            }
            beside += lo.x > 600 || lo.y > 600 || hi.x < -600 || hi.y < -600 ? 1 : 0;
        }
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(beside, 1000) << "or each is asked of everywhere";
}

TEST(SeenBounds, OfWhatIsBehindAreNone) {
    SeenBounds bounds(raysOf(0.1));
    bounds.take({0, 0, 1}, {3, 1, -0.05});
    EXPECT_GT(bounds.lo().x, bounds.hi().x);
}

// Of an edge along the view axis, from where it comes through the plane on.
TEST(SeenBounds, EndWhereEdgesPassTheNearPlane) {
    SeenBounds bounds(raysOf(0.5));
    bounds.take({1, 2, -1}, {1, 2, 1});
    EXPECT_NEAR(bounds.lo().x, 300, 0.1);
    EXPECT_NEAR(bounds.hi().x, 600, 0.1);
    EXPECT_NEAR(bounds.lo().y, 800, 0.1);
    EXPECT_NEAR(bounds.hi().y, 1600, 0.1);
}

// So few pixels are asked of a tetrahedron that the eye's plane crosses beside the picture.
TEST(SeenBounds, CellsBesideThePictureAreNotSeen) {
    const tests::CellWorld world(
        tests::stepOfPlaces(tests::gridOf(tests::atPoints(tests::bentBricks(tests::kCuts[0]))),
                            [](const auto& p) { return p.x; }),
        {"min:max"});
    const View view = tests::lookFrom(tests::cells::kFrom[2], {40, 30}, 0.1);
    const CellsView seen(world.placed, view);
    int crossed = 0, everywhere = 0;
    for (std::uint32_t cell = 0; cell < world.placed.mesh()->solids()->count(); ++cell)
        world.placed.mesh()->solids()->forEachTet(cell, [&](const std::array<std::uint32_t, 4>&
                                                                points) {
            std::array<glm::dvec3, 4> at;
            for (std::size_t i = 0; i < 4; ++i) at[i] = world.placed.alongAxes(points[i]);
            const auto depth = [&](const glm::dvec3& p) {
                return -(seen.viewFromAxes * glm::dvec4(p, 1)).z;
            };
            const auto [least, most] = std::ranges::minmax(at, {}, depth);
            if (depth(least) > seen.rays.near || depth(most) <= seen.rays.near) return;
            ++crossed;
            const WindowBox box = windowBox(seen, at);
            everywhere += box.lo.x <= 0 && box.lo.y <= 0 && box.hi.x >= 40 && box.hi.y >= 30;
            const auto s = tetSplatAt<double>(seen, {at, {0, 1, 2, 3}, 0, 3, OpacityPer::Length});
            EXPECT_NEAR(s.lo.x + seen.rays.centre.x, box.lo.x, 1e-6 * std::abs(box.lo.x));
            EXPECT_NEAR(s.hi.y + seen.rays.centre.y, box.hi.y, 1e-6 * std::abs(box.hi.y));
        });
    EXPECT_GT(crossed, 20);
    EXPECT_LT(everywhere, crossed / 2);
}

}  // namespace
}  // namespace seen_bounds
}  // namespace render

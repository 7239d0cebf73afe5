#include "render/points/view.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_clip_space.hpp>
#include <random>

#include "tests/support/scenes.h"

namespace render {
namespace {

View skewed() {
    View view = tests::lookFrom({2, -3, 1.5}, {640, 360});
    view.clipFromView = clipFromView({-0.3, 0.7, -0.2, 0.5, 0.05, 20});
    return view;
}

TEST(View, SymmetricFrustumIsGlmsPerspective) {
    const double tangent = std::tan(0.35), aspect = 16.0 / 9;
    const glm::dmat4 ours =
        clipFromView({-tangent * aspect, tangent * aspect, -tangent, tangent, 0.1, 50});
    const glm::dmat4 glms = glm::perspectiveRH_ZO(0.7, aspect, 0.1, 50.0);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(ours[c][r], glms[c][r], 1e-12) << c << ' ' << r;
}

TEST(View, DepthRunsFromZeroAtTheNearPlaneToOneAtTheFar) {
    const glm::dmat4 clip = clipFromView({-1, 2, -1, 1, 0.25, 8});
    for (const auto& [z, depth] : {std::pair(-0.25, 0.0), std::pair(-8.0, 1.0)}) {
        const glm::dvec4 p = clip * glm::dvec4(0.1, 0.1, z, 1);
        EXPECT_NEAR(p.z / p.w, depth, 1e-12);
    }
}

TEST(View, TheRayOfAPointsPixelPassesThroughThePoint) {
    const View view = skewed();
    const PixelRays rays = pixelRays(view);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 world(any(random), any(random), any(random));
        const Projected p = project(view, world);
        const glm::dvec3 back = rays.eye + p.depth * rays.along(p.window - rays.centre);
        EXPECT_LT(glm::length(back - world), 1e-12) << "point " << i;
    }
}

TEST(View, ProjectionAgreesWithTheClipMatrix) {
    const View view = skewed();
    const glm::dvec3 world(0.3, -0.4, 0.2);
    const glm::dvec4 clip = view.clipFromView * view.viewFromWorld * glm::dvec4(world, 1);
    const glm::dvec2 window = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.size);
    EXPECT_LT(glm::length(window - project(view, world).window), 1e-10);
    EXPECT_NEAR(clip.w, project(view, world).depth, 1e-12);
}

// Whatever is left over beyond the upper and right edges.
TEST(View, ACoarserOneSeesThePicturesPixelsSoManyAcrossInOne) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(641, 361)})
        for (const int across : {1, 2, 3}) {
            View view = skewed();
            view.size = size;
            const View coarse = coarser(view, across);
            EXPECT_EQ(coarse.size.x, (size.x + across - 1) / across);
            EXPECT_EQ(coarse.size.y, (size.y + across - 1) / across);
            for (int i = 0; i < 50; ++i) {
                const glm::dvec3 world(any(random), any(random), any(random));
                const Projected fine = project(view, world), seen = project(coarse, world);
                EXPECT_NEAR(seen.depth, fine.depth, 1e-12);
                EXPECT_LT(glm::length(static_cast<double>(across) * seen.window - fine.window),
                          1e-9);
            }
            EXPECT_NEAR(pixelRays(coarse).near, pixelRays(view).near, 1e-12);
        }
}

TEST(View, NearIsReadBackFromTheMatrix) { EXPECT_NEAR(pixelRays(skewed()).near, 0.05, 1e-12); }

}  // namespace
}  // namespace render

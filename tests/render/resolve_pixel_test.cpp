// How sums of splats become light.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "render/model/footprint.h"
#include "render/reference/cpu_splatter.h"
#include "render/splat/depth_order.h"
#include "tests/support/scenes.h"
#include "tests/support/splat_world.h"

namespace render {
namespace {

using namespace render::splat_world;

TEST(Resolve, ManyThinSplatsShowTheOpacityOfTheirSum) {
    // Opacity 1e-7 a unit, W = 1e8: 1 - (1 - 1e-7)^1e8.
    Accumulator<double> sums({1, 1}, {Channels::Weight});
    sums.planes[0][0] = 1e8;
    const std::vector<Layer> layers = {{{}, {Constant{glm::dvec3(0.2, 0.5, 1)}, 1e-7}}};
    const Resolved r = resolvePixel(sums, layers, 0, 0);
    const double expected = -std::expm1(1e8 * std::log1p(-1e-7));
    EXPECT_NEAR(r.alpha, expected, 1e-12);
    EXPECT_NEAR(r.rgb.g, 0.5 * expected, 1e-12);
}

TEST(Resolve, NothingShowsNothingAndFullOpacityStaysFinite) {
    Accumulator<double> sums({1, 1}, {Channels::Weight});
    const std::vector<Layer> layers = {{{}, {Constant{glm::dvec3(1)}, 1}}};
    EXPECT_EQ(resolvePixel(sums, layers, 0, 0).alpha, 0);
    EXPECT_EQ(resolvePixel(sums, layers, 0, 0).rgb, glm::dvec3(0));
    sums.planes[0][0] = 1;
    EXPECT_NEAR(resolvePixel(sums, layers, 0, 0).alpha, 1, 2e-7);
}

TEST(Resolve, TwoColoursMixByTheirOpticalDepths) {
    Accumulator<double> sums({1, 1}, {Channels::Weight, Channels::Weight});
    sums.planes[0][0] = 3;
    sums.planes[1][0] = 1;
    const std::vector<Layer> layers = {{{}, {Constant{{1, 0, 0}}, 0.5}},
                                       {{}, {Constant{{0, 0, 1}}, 0.75}}};
    // Optical depths 3 ln 2 and ln 4 = 2 ln 2: three fifths red of opacity 1 - 2^-5.
    const Resolved r = resolvePixel(sums, layers, 0, 0);
    EXPECT_NEAR(r.alpha, 1 - 1.0 / 32, 1e-12);
    EXPECT_NEAR(r.rgb.r, 0.6 * r.alpha, 1e-12);
    EXPECT_NEAR(r.rgb.b, 0.4 * r.alpha, 1e-12);
}

}  // namespace
}  // namespace render

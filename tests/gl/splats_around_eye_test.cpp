// Splats around the eye, against the truth: the same model in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "render/model/footprint.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/gl_planes.h"

namespace render {
namespace {

using tests::lookFrom;
using timeseries::RangeSet;

class SplatsAroundTheEye : public tests::GlTest {
 protected:
    // relative L2 of a plane drawn on GL, the truth being drawn in the same order.
    double drawn(const Scene& scene, const View& view, Channels channels) {
        return compareScalars(plane(scene, view, channels), truth(scene, view, channels))
            .relativeL2;
    }
    // And summed on the processor.
    static double summed(const Scene& scene, const View& view, Channels channels) {
        const auto plane = sumTiles(scene, order(scene, tests::kMidEye), view, channels, 0, {});
        return compareScalars(plane, truth(scene, view, channels)).relativeL2;
    }

 private:
    static std::vector<double> truth(const Scene& scene, const View& view, Channels channels) {
        Accumulator<double> sums(view.size, {channels});
        splat(scene, order(scene, tests::kMidEye), view, {}, sums);
        return sums.planes[0];
    }
};

// Centres stand beside the eye, far outside of the picture that their splats fill.
TEST_F(SplatsAroundTheEye, AreTheTruthsWhereverTheirCentresLie) {
    const std::array even{tests::axis(7), tests::axis(7), tests::axis(7)};
    const std::array uneven{tests::axis(7), tests::axis(6, 0, 1.3), tests::axis(5, 0, 0.7)};
    const std::array slim{tests::axis(7), tests::axis(6), tests::axis(4, 0, 5)};
    for (const auto& axes : {even, uneven, slim}) {
        const auto step = tests::noise(std::make_shared<timeseries::Grid>(axes));
        const PlacedPoints placed(step.grid());
        Scene scene{.step = step,
                    .placed = placed,
                    .layers = {{step.select(RangeSet::everything()), {ByValue{{}, 0, 1}, 0.3}}},
                    .footprint = {Kernel::Quartic, 4},
                    .order = Order::None,
                    .clip = {}};
        int farOff = 0;
        for (const glm::dvec3 eye : {glm::dvec3(0.05, 0.1, 0.03), glm::dvec3(-0.3, 0.02, 0.2),
                                     glm::dvec3(0.11, -0.2, -0.1)}) {
            const View view = lookFrom(eye, {64, 48});
            const PointsView seen(placed, view);
            for (std::uint64_t i = 0; i < step.size(); ++i) {
                const auto s = splatAt<double>(seen, i, scene.footprint);
                farOff += s.visible && std::isinf(s.hi.x) &&
                          std::max(std::abs(s.centre.x), std::abs(s.centre.y)) > 4 * (64 + 48);
            }
            scene.order = Order::None;
            EXPECT_LE(drawn(scene, view, Channels::Weight), 1e-5) << eye.x;
            EXPECT_LE(summed(scene, view, Channels::Weight), 1e-5) << eye.x;
            EXPECT_LE(drawn(scene, view, Channels::Count), 1e-3) << eye.x;
            EXPECT_LE(summed(scene, view, Channels::Count), 1e-3) << eye.x;
            scene.order = Order::BackToFront;
            EXPECT_LE(drawn(scene, view, Channels::Over), 1e-5) << eye.x;
            EXPECT_LE(summed(scene, view, Channels::Over), 1e-5) << eye.x;
        }
        EXPECT_GT(farOff, 0) << "or nothing was tested";
    }
}

// How far the ray goes, from inside the box to where it leaves it, in units of l.
double wayOut(const PlacedPoints& placed, const glm::dvec3& eye, const glm::dvec3& along) {
    const auto [lo, hi] = placed.domain();
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a)
        least = std::min(least, ((along[a] > 0 ? hi[a] : lo[a]) - eye[a]) / along[a]);
    return least * glm::length(along) / placed.unitLength();
}

// Their whole lines stand for those whose centres lie behind the eye, which are not drawn; the
// light that this takes from a medium all around it is what render/README.md says.
TEST_F(SplatsAroundTheEye, LeaveAMediumAsManyPercentTooFaintAsIsSaid) {
    const auto step = tests::noise(tests::cube(24));
    const PlacedPoints placed(step.grid());
    for (const auto& [size, said] : {std::pair(1.0, -0.017), std::pair(4.0, -0.032)}) {
        const Scene scene{.step = step,
                          .placed = placed,
                          .layers = {{step.select(RangeSet::everything()), {Constant{}, 0.3}}},
                          .footprint = {Kernel::Quartic, size},
                          .order = Order::None,
                          .clip = {}};
        double drawn = 0, exact = 0;
        for (const glm::dvec3 eye : {glm::dvec3(0.01, 0.02, 0.03), glm::dvec3(-0.1, 0.02, 0.15),
                                     glm::dvec3(0.11, -0.2, -0.1)}) {
            const View view = lookFrom(eye, {32, 24});
            const PixelRays rays = pixelRays(view);
            const std::vector<float> depth = sumTiles(scene, Runs{}, view, Channels::Weight, 0, {});
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x) {
                    const glm::dvec2 offset = glm::dvec2(x, y) + 0.5 - rays.centre;
                    drawn += depth[static_cast<std::size_t>(y * view.size.x + x)];
                    exact += wayOut(placed, rays.eye, rays.along(offset));
                }
        }
        EXPECT_NEAR(drawn / exact - 1, said, 0.5 * std::abs(said)) << size;
    }
}

}  // namespace
}  // namespace render

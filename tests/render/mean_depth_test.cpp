#include "render/frame/mean_depth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/reference/cpu_splatter.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::SortedStep;

// The truth: all splats, in double, in the whole picture.
double trueMean(const Scene& scene, const View& view) {
    Accumulator<double> sums(view.size, channelsFor(scene));
    splat<double>(scene, Runs{}, view, {}, sums);
    double sum = 0;
    int covered = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const double depth = resolvePixel(sums, scene.layers, x, y).opticalDepth;
            if (depth < kCoveredDepth) continue;
            sum += depth;
            ++covered;
        }
    return covered == 0 ? 0 : sum / covered;
}

constexpr int kEdge = 48;

// Distances in cells from the middle of the cube.
glm::dvec3 at(std::size_t i) {
    return glm::dvec3(i % kEdge, i / kEdge % kEdge, i / kEdge / kEdge) - 0.5 * (kEdge - 1);
}
double ball(std::size_t i) { return -glm::length(at(i)); }
double sheet(std::size_t i) { return -std::abs(at(i).y + 3 * std::sin(0.2 * at(i).x)); }
double thread(std::size_t i) {
    const glm::dvec3 p = at(i);
    return -std::hypot(p.x - 12 * std::cos(0.2 * p.z), p.y - 12 * std::sin(0.2 * p.z));
}
double scattered(std::size_t i) {
    std::mt19937 random(static_cast<unsigned>(i));
    return static_cast<double>(random() % 100000);
}

struct Case {
    const char* name;
    double (*value)(std::size_t);
    std::uint64_t selected;  // the greatest values
    double opacity;
    Kernel kernel;
    double off;  // the estimate may be, as a factor
};
class MeanDepth : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Scenes, MeanDepth,
                         testing::Values(Case{"few", ball, 4000, 0.1, Kernel::Quartic, 1.02},
                                         Case{"ball", ball, 40000, 0.05, Kernel::Quartic, 1.08},
                                         Case{"all", ball, 110592, 0.02, Kernel::Quartic, 1.08},
                                         Case{"sheet", sheet, 12000, 0.2, Kernel::Quartic, 1.05},
                                         Case{"thread", thread, 8500, 0.2, Kernel::Quartic, 1.05},
                                         Case{"scattered", scattered, 20000, 0.05, Kernel::Quartic,
                                              1.3},
                                         Case{"points", ball, 40000, 0.05, Kernel::Point, 1.05},
                                         Case{"few points", ball, 2000, 0.3, Kernel::Point, 1.1}),
                         [](const auto& of) {
                             std::string name = of.param.name;
                             std::erase(name, ' ');
                             return name;
                         });

TEST_P(MeanDepth, IsTheTruthsToTheFactorThatIsAllowed) {
    const Case& c = GetParam();
    const SortedStep step = tests::stepOf(tests::cube(kEdge), c.value);
    const PlacedPoints placed(step.grid());
    Scene scene{.step = step, .placed = placed, .layers = {}, .footprint = {}, .clip = {}};
    scene.layers = {{{{step.size() - c.selected, c.selected}}, {Constant{}, c.opacity}}};
    scene.footprint = {.kernel = c.kernel, .size = c.kernel == Kernel::Point ? 3.0 : 1.0};
    for (const glm::dvec3 from : {glm::dvec3(0, -3, 0), glm::dvec3(1.5, -2.5, 1)}) {
        const View view = tests::lookFrom(from, {360, 300});
        const double truth = trueMean(scene, view), estimate = meanOpticalDepth(scene, view);
        ASSERT_GT(truth, 0.02);
        EXPECT_LT(std::max(estimate / truth, truth / estimate), c.off);
    }
}

}  // namespace
}  // namespace render

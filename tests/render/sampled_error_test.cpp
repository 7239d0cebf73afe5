// The error that a picture states, against the one that all its pixels have.
#include "render/reference/sampled_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/reference/cells_on_rays.h"
#include "render/reference/image_compare.h"
#include "render/reference/interval_truth.h"
#include "tests/support/sampled_errors.h"

namespace render {
namespace {

using tests::CellWorld;
using tests::SampledError;
using tests::sampledError;

const View kView = tests::lookFrom({1.2, -2.5, 1}, {160, 120});

timeseries::SortedStep waves() {
    const auto grid = tests::cube(24);
    return tests::stepOf(grid, [&](std::size_t i) {
        const glm::dvec3 p(grid->indices(i));
        return std::sin(0.45 * p.x) + std::cos(0.35 * p.y + 0.15 * p.x) * std::sin(0.4 * p.z);
    });
}

std::vector<float> depthOf(const CellWorld& world) {
    std::vector<float> depth(std::size_t(kView.size.x) * std::size_t(kView.size.y));
    for (std::size_t k = 0; k < world.scene.layers.size(); ++k) {
        const std::vector<float> weight = tests::drawn(world.scene, kView, Channels::Weight, k);
        const double perWeight = opticalDepthPerWeight(world.scene.layers[k].style.opacity);
        for (std::size_t i = 0; i < depth.size(); ++i)
            depth[i] += static_cast<float>(perWeight * weight[i]);
    }
    return depth;
}
double errorOfAll(const CellWorld& world, const std::vector<float>& depth) {
    const IntervalTruth truth(world.scene, world.scene.cells->field(), 3);
    std::vector<double> expected(depth.size());
    for (std::size_t k = 0; k < world.scene.layers.size(); ++k) {
        const std::vector<double> weight = truth.weight(kView, k);
        const double perWeight = opticalDepthPerWeight(world.scene.layers[k].style.opacity);
        for (std::size_t i = 0; i < depth.size(); ++i) expected[i] += perWeight * weight[i];
    }
    return compareScalars(std::span<const float>(depth), expected).relativeL2;
}
SampledError sampled(const CellWorld& world, const std::vector<float>& depth, std::size_t pixels,
                     unsigned threads = 2) {
    return sampledError(world, kView, depthFrom(depth, kView.size),
                        {.pixels = pixels, .raysAcross = 3, .threads = threads});
}

// What cells leave out, and pictures that are worse: a tenth too bright, and another range's.
TEST(SampledError, OfAThousandPixelsIsThatOfAll) {
    const CellWorld other(waves(), {"0.3:1.2", "-0.8:-0.6"});
    for (const char* first : {"0.2:1.2", "0.2:0.5", "0.2:0.21"}) {
        const CellWorld world(waves(), {first, "-0.8:-0.6"}, 0.3);
        const std::vector<float> right = depthOf(world);
        std::vector<float> bright = right;
        for (float& d : bright) d *= 1.1f;
        for (const std::vector<float>& depth : {right, bright, depthOf(other)}) {
            const double all = errorOfAll(world, depth);
            ASSERT_GT(all, 0);
            const SampledError some = sampled(world, depth, 1024);
            EXPECT_EQ(some.pixels, 1024u);
            EXPECT_LT(std::max(some.relativeL2 / all, all / some.relativeL2), 1.25)
                << first << ": " << some.relativeL2 << " of " << all;
        }
    }
}

TEST(SampledError, OfEveryPixelIsExact) {
    const CellWorld world(waves(), {"0.2:0.5"});
    const std::vector<float> depth = depthOf(world);
    EXPECT_NEAR(sampled(world, depth, 1 << 20).relativeL2, errorOfAll(world, depth), 1e-12);
}

// Also where the pixels that show something are not known before, and are few.
TEST(SampledError, OfCellsThatAreAskedPixelByPixelIsThatOfThePicture) {
    for (const char* range : {"0.2:0.5", "1.7:1.8"}) {
        const CellWorld world(waves(), {range, "1.85:1.86"}, 0.3);
        const DepthAt asked = [&](std::span<const glm::ivec2> pixels) {
            return cellDepthAt(world.scene, kView, pixels, 1, 2);
        };
        const double all = errorOfAll(world, depthOf(world));
        const SampledError some = sampledError(
            world, kView, asked, {.pixels = 512, .asked = 100, .raysAcross = 3, .threads = 2});
        EXPECT_LE(some.pixels, 512u);
        EXPECT_LT(std::max(some.relativeL2 / all, all / some.relativeL2), 1.25)
            << range << ": " << some.relativeL2 << " of " << all;
    }
}

// Where the picture shows nothing the truth may have something.
TEST(SampledError, NothingForSomethingIsAllWrong) {
    const CellWorld world(waves(), {"0.2:0.5"});
    const std::vector<float> nothing(std::size_t(kView.size.x) * std::size_t(kView.size.y));
    EXPECT_EQ(sampled(world, nothing, 512).relativeL2, 1);
    const CellWorld empty(waves(), {"5:6"});
    EXPECT_EQ(sampled(empty, nothing, 512).relativeL2, 0);
    EXPECT_EQ(sampled(empty, depthOf(world), 512).relativeL2,
              std::numeric_limits<double>::infinity());
}

using Rays = SampledTruth::Rays;

TEST(SampledError, OfAllRaysIsTheirMean) {
    const CellWorld world(waves(), {"0.2:0.21"}, 0.3);
    SampledTruth truth(world.scene, kView, depthFrom(depthOf(world), kView.size), {.pixels = 300});
    truth.add(world.scene.cells->field(), Rays::Quarter);
    EXPECT_TRUE(truth.wantsRest(1e-9));
    truth.add(world.scene.cells->field(), Rays::Rest);
    EXPECT_FALSE(truth.wantsRest(1e-9));
    const std::vector<double> mean = IntervalTruth(world.scene, world.scene.cells->field(), 8)
                                         .weight(kView, 0, truth.pixels(), placesOfRays(8));
    for (std::size_t i = 0; i < mean.size(); ++i)
        ASSERT_NEAR(truth.depth()[i], opticalDepthPerWeight(0.3) * mean[i], 1e-12) << i;
}

// Of pictures that are right, nearly and not, a range thinner than a pixel among them. The rest may
// move it by a fiftieth, give or take; of what hardly any ray meets, three times that.
TEST(SampledError, IsToldByAQuarterOfTheRaysWhereTheRestWouldNotChangeIt) {
    const DepthAt wrong = depthFrom(depthOf(CellWorld(waves(), {"0.3:1.2"})), kView.size);
    std::size_t enough = 0, tooFew = 0;
    for (const char* range : {"0.2:1.2", "0.2:0.5", "0.2:0.21", "0.2:0.2001"}) {
        const CellWorld world(waves(), {range}, 0.3);
        const DepthAt right = depthFrom(depthOf(world), kView.size);
        SampledTruth quarter(world.scene, kView, right), all = quarter;
        quarter.add(world.scene.cells->field(), Rays::Quarter);
        for (const Rays each : {Rays::Quarter, Rays::Rest})
            all.add(world.scene.cells->field(), each);
        for (const DepthAt& picture : {right, wrong}) {
            const std::vector<double> depth = picture(all.pixels());
            const double told = quarter.apart(depth, quarter.depth());
            if (quarter.wantsRest(told)) {
                ++tooFew;
                continue;
            }
            ++enough;
            const double error = all.apart(depth, all.depth());
            EXPECT_NEAR(told, error, 0.06 * error) << range;
        }
    }
    EXPECT_GE(enough, 3u);
    EXPECT_GE(tooFew, 2u);
}

TEST(SampledError, AsksForAllRaysWhereAQuarterMeetsNothing) {
    const CellWorld empty(waves(), {"5:6"});
    SampledTruth truth(empty.scene, kView, depthFrom(depthOf(empty), kView.size));
    truth.add(empty.scene.cells->field(), Rays::Quarter);
    EXPECT_TRUE(truth.wantsRest(std::numeric_limits<double>::infinity()));
}

TEST(SampledError, DoesNotDependOnThreads) {
    const CellWorld world(waves(), {"0.2:0.5"});
    const std::vector<float> depth = depthOf(world);
    EXPECT_EQ(sampled(world, depth, 700, 1).relativeL2, sampled(world, depth, 700, 5).relativeL2);
}

}  // namespace
}  // namespace render

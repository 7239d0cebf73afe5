// Blocks of points on the GPU: what is drawn of them, and what is uploaded.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "tests/support/gl_planes.h"

namespace render {
namespace {

using RunOfPoints = timeseries::Run;  // testing::Test has a Run of its own

constexpr std::uint64_t kBlock = GlStep::kBlock;

class GlSteps : public tests::GlTest {
 protected:
    Scene sceneOf(std::vector<std::vector<RunOfPoints>> layers) const {
        Scene scene{.step = step_,
                    .placed = placed_,
                    .layers = {},
                    .footprint = {.kernel = Kernel::Point},
                    .order = Order::None,
                    .clip = {}};
        for (auto& runs : layers)
            scene.layers.push_back({std::move(runs), {Constant{glm::dvec3(1)}, 0.5}});
        return scene;
    }

    // Of single pixels, none outside the picture: as many as points that were drawn.
    double drawn(const Scene& scene) {
        const auto counts = plane(scene, tests::lookFrom({1, -4, 1}, {128, 128}), Channels::Count);
        return std::accumulate(counts.begin(), counts.end(), 0.0);
    }

    const timeseries::SortedStep step_ = tests::noise(tests::cube(47));  // 3.2 blocks
    const PlacedPoints placed_{step_.grid()};
};

TEST_F(GlSteps, RunsAreDrawnToTheirEndsAndNoFarther) {
    const std::uint64_t n = step_.size();
    std::vector<RunOfPoints> runs = {
        {0, 1},           {n - 1, 1},           {0, n},
        {kBlock - 1, 1},  {kBlock, 1},          {kBlock - 1, 2},
        {kBlock, kBlock}, {kBlock - 1, kBlock}, {3 * kBlock, n - 3 * kBlock}};
    std::mt19937_64 random(3);
    for (int i = 0; i < 20; ++i) {
        const std::uint64_t first = random() % n;
        runs.push_back({first, 1 + random() % (n - first)});
    }
    for (const RunOfPoints& run : runs)
        EXPECT_EQ(drawn(sceneOf({{run}})), static_cast<double>(run.count))
            << run.first << " + " << run.count;
}

TEST_F(GlSteps, RunsThatShareABlockAreDrawnOnceEach) {
    EXPECT_EQ(drawn(sceneOf({{{5, 10}, {20, 30}, {kBlock - 3, 7}}})), 47);
    EXPECT_EQ(drawn(sceneOf({{{5, 10}}, {{8, 100}, {2 * kBlock - 1, 2}}})), 112);
    EXPECT_EQ(drawn(sceneOf({{}})), 0);
}

TEST_F(GlSteps, ASubsetsRunsAreDrawnToTheirEndsAndNoFarther) {
    const std::uint64_t n = step_.size();
    for (const std::uint32_t stride : {2u, 8u, kMaxStride})
        for (const RunOfPoints run : {RunOfPoints{0, n}, RunOfPoints{kBlock - 700, 1400},
                                      RunOfPoints{2 * kBlock, n - 2 * kBlock}}) {
            Scene scene = sceneOf({{run}});
            scene.stride = stride;
            EXPECT_EQ(drawn(scene), static_cast<double>(subsetCount(run, stride)))
                << run.first << " + " << run.count << " / " << stride;
        }
}

TEST_F(GlSteps, SpritesAndQuadsDrawTheRunsOwnPoints) {
    // Which points, not only how many: the truth reads the sorted step.
    Scene scene = sceneOf({{{kBlock - 4000, 9000}, {3 * kBlock - 10, 500}}});
    scene.footprint = {.size = 0.5};
    for (const std::uint32_t stride : {1u, 2u, 8u, kMaxStride}) {
        scene.stride = stride;
        for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0), glm::dvec3(0.2, 0.1, 0.3)}) {
            const View view = tests::lookFrom(eye, {200, 200});
            Accumulator<double> sums(view.size, {Channels::Weight});
            splat(scene, Runs{}, view, {}, sums);
            EXPECT_LE(
                compareScalars(plane(scene, view, Channels::Weight), sums.planes[0]).relativeL2,
                1e-5)
                << stride;
        }
    }
}

// What the buffers hold of a block's points.
struct OnGpu {
    std::vector<std::uint32_t> gridIndex;
    std::vector<std::uint16_t> place;
    std::vector<float> value;
    OnGpu(const GlStep& step, std::uint64_t block, std::size_t points)
        : gridIndex(points), place(points), value(points) {
        const auto read = [&](const gl::Buffer& from, auto& into) {
            constexpr std::size_t kEach = sizeof into[0];
            glGetNamedBufferSubData(from.id(),
                                    static_cast<GLintptr>(step.placeOf(block * kBlock) * kEach),
                                    static_cast<GLsizeiptr>(points * kEach), into.data());
        };
        read(step.gridIndex(), gridIndex);
        read(step.placeInBlock(), place);
        read(*step.values(), value);
        gl::throwOnError();
    }
};

class GpuStepsByValue : public GlSteps {
 protected:
    Scene byValue(std::vector<RunOfPoints> runs) const {
        Scene scene = sceneOf({std::move(runs)});
        scene.layers[0].style.color = ByValue{{}, 0.2, 0.4};
        return scene;
    }
    void expectPoints(const GlStep& onGpu, std::uint64_t block, const ValueScale& scale) const {
        const std::uint64_t first = block * kBlock, count = std::min(kBlock, step_.size() - first);
        const OnGpu held(onGpu, block, count);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t p = first + held.place[i];
            ASSERT_EQ(held.gridIndex[i], step_.gridIndex()[p]);
            ASSERT_EQ(held.value[i], scale(timeseries::toDouble(step_.value(p))));
        }
    }
    std::uint64_t lastBlock_ = step_.size() - 3 * kBlock;  // points of the fourth
};

TEST_F(GpuStepsByValue, BlocksComeOneByOneAndOnlyThoseThatAreAskedFor) {
    const Scene scene = byValue({{5, 10}, {kBlock - 1, 1}, {3 * kBlock + 2, 3}});  // 0 and 3
    const auto scale = neededScale(scene);
    GlStep onGpu(step_, placed_);
    const std::uint64_t all = (kBlock + lastBlock_) * 10;
    EXPECT_EQ(GlStep::neededBytes(scene, scale), all);
    EXPECT_EQ(onGpu.missingBytes(scene, scale), all);
    EXPECT_FALSE(onGpu.ready(scene));
    onGpu.upload(scene, scale, 1);
    EXPECT_EQ(onGpu.missingBytes(scene, scale), lastBlock_ * 10);
    EXPECT_FALSE(onGpu.ready(scene));
    EXPECT_EQ(onGpu.values(), nullptr);
    onGpu.upload(scene, scale, 1);
    EXPECT_EQ(onGpu.missingBytes(scene, scale), 0u);
    EXPECT_TRUE(onGpu.ready(scene));
    for (const std::uint64_t block : {0, 3}) expectPoints(onGpu, block, *scale);
    // What was not asked for is not there; one colour needs 6 bytes a point.
    const Scene other = sceneOf({{{kBlock - 1, 2}}});
    EXPECT_FALSE(onGpu.ready(other));
    EXPECT_EQ(onGpu.missingBytes(other, {}), kBlock * 6);
    EXPECT_EQ(onGpu.missingBytes(byValue({{kBlock - 1, 2}}), scale), kBlock * 10);
}

TEST_F(GpuStepsByValue, OneCallSendsAsManyBlocksAsReachTheBytes) {
    const Scene scene = byValue({{0, step_.size()}});
    const auto scale = neededScale(scene);
    GlStep onGpu(step_, placed_);
    onGpu.upload(scene, scale, kBlock * 10 + 1);
    EXPECT_EQ(onGpu.missingBytes(scene, scale), (step_.size() - 2 * kBlock) * 10);
    onGpu.upload(scene, scale);
    EXPECT_TRUE(onGpu.ready(scene));
    for (std::uint64_t block = 0; block < 4; ++block) expectPoints(onGpu, block, *scale);
    EXPECT_GE(onGpu.bytes(), step_.size() * 10);
    EXPECT_LE(onGpu.bytes(), 4 * kBlock * 10 + 3 * 47 * 8) << "positions along three axes";
}

TEST_F(GpuStepsByValue, AnOrderedSceneNeedsTheSame) {
    const Scene scene = byValue({{0, step_.size()}});
    Scene ordered = scene;
    ordered.order = Order::BackToFront;
    GlStep onGpu(step_, placed_);
    EXPECT_FALSE(onGpu.ready(ordered));
    EXPECT_EQ(onGpu.missingBytes(ordered, neededScale(ordered)), step_.size() * 10);
    onGpu.upload(ordered, neededScale(ordered));
    EXPECT_TRUE(onGpu.ready(scene));
    EXPECT_TRUE(onGpu.ready(ordered));
}

TEST_F(GpuStepsByValue, ValuesOnAnotherScaleTakeOverWhenAllAreThere) {
    const Scene scene = byValue({{0, 2 * kBlock}});
    const ValueScale narrow = *neededScale(scene), wider{-3, 4};
    GlStep onGpu(step_, placed_);
    onGpu.upload(scene, {});  // points alone
    EXPECT_FALSE(onGpu.ready(scene));
    EXPECT_EQ(onGpu.missingBytes(scene, narrow), 2 * kBlock * 4);
    onGpu.upload(scene, narrow);
    const std::uint64_t before = onGpu.bytes();
    onGpu.upload(scene, wider, 1);
    EXPECT_TRUE(onGpu.ready(scene)) << "with the values before";
    EXPECT_EQ(onGpu.valueScale(), narrow);
    EXPECT_EQ(onGpu.missingBytes(scene, wider), kBlock * 4);
    expectPoints(onGpu, 0, narrow);
    onGpu.upload(scene, wider, 1);
    EXPECT_EQ(onGpu.valueScale(), wider);
    for (const std::uint64_t block : {0, 1}) expectPoints(onGpu, block, wider);
    EXPECT_EQ(onGpu.bytes(), before);
}

TEST_F(GpuStepsByValue, RoomIsTakenForBlocksThatAreNeededAndGrowsWhileTheyStay) {
    const std::uint64_t axes = 3 * 47 * 8;
    const auto scale = neededScale(byValue({}));
    const ValueScale wider{-3, 4};
    GlStep onGpu(step_, placed_);
    onGpu.upload(byValue({}), scale);
    EXPECT_EQ(onGpu.bytes(), axes) << "no block, no room";
    const Scene last = byValue({{3 * kBlock + 7, 1}});
    onGpu.upload(last, scale);
    EXPECT_EQ(onGpu.bytes(), kBlock * 10 + axes);
    onGpu.upload(byValue({{2 * kBlock, 2}}), scale);
    EXPECT_EQ(onGpu.bytes(), 2 * kBlock * 10 + axes);
    // One half of what is coming is there when room for the rest is made.
    const Scene both = byValue({{2 * kBlock, kBlock + 1}});
    onGpu.upload(both, wider, 1);
    EXPECT_EQ(onGpu.valueScale(), *scale);
    const Scene all = byValue({{0, step_.size()}});
    onGpu.upload(all, wider, 1);
    EXPECT_EQ(onGpu.bytes(), 4 * kBlock * 14 + axes);
    for (const std::uint64_t block : {2, 3}) expectPoints(onGpu, block, *scale);
    EXPECT_TRUE(onGpu.ready(both)) << "what was drawn still can be";
    onGpu.upload(all, wider);
    for (std::uint64_t block = 0; block < 4; ++block) expectPoints(onGpu, block, wider);
}

TEST_F(GlSteps, BlocksAreDrawnWhereverTheyLie) {
    GlStep onGpu(step_, placed_);
    for (const std::uint64_t block : {3, 0, 2, 1})
        onGpu.upload(sceneOf({{{block * kBlock, 1}}}), {});
    for (const std::uint64_t block : {0, 1, 3})
        EXPECT_NE(onGpu.placeOf(block * kBlock + 5), block * kBlock + 5);
    const View view = tests::lookFrom({1, -4, 1}, {128, 128});
    for (const RunOfPoints run : {RunOfPoints{0, step_.size()}, RunOfPoints{kBlock - 9, 2000},
                                  RunOfPoints{5, 3 * kBlock}, RunOfPoints{3 * kBlock + 1, 50}})
        for (const std::uint32_t stride : {1u, 8u}) {
            Scene scene = sceneOf({{run}});
            scene.footprint = {.size = 0.5};
            scene.stride = stride;
            Accumulator<double> sums(view.size, {Channels::Weight});
            splat(scene, Runs{}, view, {}, sums);
            EXPECT_LE(compareScalars(plane(scene, onGpu, view, Channels::Weight), sums.planes[0])
                          .relativeL2,
                      1e-5)
                << run.first << " + " << run.count << " / " << stride;
        }
}

TEST_F(GpuStepsByValue, AScaleThatServesIsKept) {
    const Scene scene = byValue({{0, 2 * kBlock}});
    const ValueScale first{0.2, 0.1}, near{0.21, 0.12}, far{0.2, 1e-9};
    ASSERT_TRUE(first.serves(near));
    ASSERT_FALSE(first.serves(far));
    GlStep onGpu(step_, placed_);
    EXPECT_EQ(onGpu.serving(near), near);
    onGpu.upload(scene, first, 1);  // coming
    EXPECT_EQ(onGpu.serving(near), first);
    EXPECT_EQ(onGpu.serving(far), far);
    onGpu.upload(scene, first);  // there
    EXPECT_EQ(onGpu.serving(near), first);
}

}  // namespace
}  // namespace render

// What rays have in one slab of a field after another is what they have in all of it.
#include <gtest/gtest.h>

#include <cmath>

#include "render/reference/parts_on_rays.h"
#include "tests/support/true_world.h"
#include "timeseries/index/field_slabs.h"

namespace render {
namespace {

using namespace true_world;

// Waves on uneven axes, the last of which descends; every seventh value is missing.
Field waves() {
    timeseries::Axis y = axis(6), z = axis(9);
    y.coordinates = {0, 1, 1.5, 3, 4, 6};
    z.coordinates = {9, 7, 6, 5, 3, 2, 0, -1, -4};
    const auto grid = std::make_shared<const Grid>(std::array{axis(8), y, z});
    return fieldOn(grid, [](const glm::uvec3& p) {
        if ((p.x + 3 * p.y + 5 * p.z) % 7 == 0) return kNan;
        return std::sin(0.9 * p.x) + std::cos(0.7 * p.y) * std::sin(0.8 * p.z);
    });
}

// From outside on both sides, along the last axis and across it, and from within.
std::vector<View> views() {
    std::vector<View> all;
    for (const glm::dvec3& from : {glm::dvec3(0.4, 0.3, 3), glm::dvec3(0.4, 0.3, -3),
                                   glm::dvec3(3, 0, 0), glm::dvec3(0.05, 0.1, 0.02)})
        all.push_back(tests::lookFrom(from, kSize));
    return all;
}

template <typename Use>
void forEachSlabOf(const TrueWorld& world, std::size_t planes, const Use& use) {
    const auto held = timeseries::SortedStep::buildWithField(world.field);
    const auto all = [&](const timeseries::FieldSlab& slab) {
        use(slab);
        return true;
    };
    timeseries::forEachSlab(held, all, planes * 8 * 6 * sizeof(double));
}

TEST(TruthBySlabs, HasTheLengthsAndCrossingsOfAll) {
    for (const OpacityPer per : {OpacityPer::Length, OpacityPer::Crossing}) {
        TrueWorld world(waves(), {{{0.2, 0.9}}, {{-0.3, -0.29}, {1.1, kInfinity}}});
        world.scene.opacityPer = per;
        world.scene.cells = std::make_shared<const timeseries::CellIndex>(world.field);
        for (const View& view : views())
            for (std::size_t layer = 0; layer < 2; ++layer) {
                const std::vector<double> all = world.weight(view, layer);
                ASSERT_GT(std::ranges::max(all), 0);
                for (const std::size_t planes : {1, 2, 4, 9}) {
                    std::vector<double> sum(all.size());
                    forEachSlabOf(world, planes, [&](const timeseries::FieldSlab& slab) {
                        const IntervalTruth truth(world.scene, slab, 1, 2,
                                                  IntervalCells::Look::WhenAsked);
                        const std::vector<double> part = truth.weight(view, layer);
                        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
                    });
                    for (std::size_t i = 0; i < all.size(); ++i)
                        ASSERT_NEAR(sum[i], all[i], 1e-9) << i << ", " << planes << " planes";
                }
            }
    }
}

TEST(TruthBySlabs, MeetsTheSamePartsAlongARay) {
    const TrueWorld world(waves(), {{{0.2, 0.9}}, {{-0.3, -0.1}}});
    const std::vector<glm::ivec2> pixels{{3, 4}, {10, 8}, {12, 5}};
    for (const View& view : views()) {
        std::vector<std::vector<PartInLayer>> all(pixels.size()), some(pixels.size());
        addPartsOnRays(world.scene, world.field, view, pixels, 2, all);
        forEachSlabOf(world, 2, [&](const timeseries::FieldSlab& slab) {
            addPartsOnRays(world.scene, slab, view, pixels, 2, some);
        });
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            orderAlongRay(all[i]);
            orderAlongRay(some[i]);
            ASSERT_EQ(some[i].size(), all[i].size());
            for (std::size_t k = 0; k < all[i].size(); ++k) {
                EXPECT_EQ(some[i][k].cell, all[i][k].cell);
                EXPECT_EQ(some[i][k].layer, all[i][k].layer);
                EXPECT_NEAR(some[i][k].opticalDepth, all[i][k].opticalDepth, 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace render

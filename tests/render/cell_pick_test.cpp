// What is seen under the cursor between points, of a field whose every place is known.
#include "render/reference/cell_pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/cell_worlds.h"

namespace render {
namespace {

// The field is x, 0 to 8, on 9^3 points; the eye looks back along it, and the middle of the picture
// at the line through the points y = z = 4.
struct Ramp : tests::CellWorld {
    explicit Ramp(
        const std::vector<std::string>& layers, double opacity,
        double (*field)(const glm::uvec3&) = [](const glm::uvec3& at) { return double(at.x); })
        : CellWorld(
              tests::stepOf(tests::cube(9),
                            [&](std::size_t i) {
                                return field(timeseries::indicesOf(unsigned(i), glm::uvec3(9)));
                            }),
              layers, opacity) {
        scene.order = Order::BackToFront;
    }
    std::optional<Picked> seen(const glm::dvec2& window = {10.5, 10.5}) const {
        return pickCell(scene, view, window);
    }
    std::uint64_t indexOf(unsigned x, unsigned y, unsigned z) const { return x + 9 * (y + 9 * z); }
    // Where the field has this value on the line.
    double depthOf(double value) const {
        return 3 -
               (placed.position(indexOf(0, 4, 4)).x +
                value / 8 *
                    (placed.position(indexOf(8, 4, 4)).x - placed.position(indexOf(0, 4, 4)).x));
    }
    View view = tests::lookFrom({3, 0, 0}, {21, 21});
};

// Of a range seen from its upper end: one unit of the field is one of length.
double halfWayIn(double lo, double hi, double opacity) {
    const double perUnit = opticalDepthPerWeight(opacity);
    return hi + std::log((1 + std::exp(-perUnit * (hi - lo))) / 2) / perUnit;
}

TEST(PickCell, AThinLayersMiddleIsSeenAndItsNearestPointTold) {
    const Ramp ramp({"4.2:4.6"}, 0.01);
    const auto seen = ramp.seen();
    ASSERT_TRUE(seen);
    ASSERT_TRUE(seen->between);
    EXPECT_NEAR(*seen->between, 4.4, 1e-3) << "the middle, as nothing hides anything";
    EXPECT_NEAR(*seen->between, halfWayIn(4.2, 4.6, 0.01), 1e-6);
    EXPECT_NEAR(seen->depth, ramp.depthOf(*seen->between), 1e-6);
    EXPECT_EQ(seen->gridIndex, ramp.indexOf(4, 4, 4));
    EXPECT_EQ(seen->value, timeseries::Number(4.0));
    EXPECT_EQ(seen->world, ramp.placed.position(seen->gridIndex));
    EXPECT_NEAR(*Ramp({"4.6:4.9"}, 0.01).seen()->between, 4.75, 1e-3);
    EXPECT_EQ(Ramp({"4.6:4.9"}, 0.01).seen()->gridIndex, ramp.indexOf(5, 4, 4));
}

// Of several cells, too.
TEST(PickCell, OfAnOpaqueRangeTheFrontIsSeen) {
    const Ramp ramp({"1.2:6.8"}, 1);
    EXPECT_NEAR(*ramp.seen()->between, halfWayIn(1.2, 6.8, 1), 1e-6);
    EXPECT_EQ(ramp.seen()->gridIndex, ramp.indexOf(7, 4, 4)) << "not the middle of a cell";
    for (const double opacity : {0.001, 0.1, 0.5, 0.9})
        EXPECT_NEAR(*Ramp({"1:7"}, opacity).seen()->between, halfWayIn(1, 7, opacity), 1e-6);
}

TEST(PickCell, WhatACrossingIsWorthCountsAsInThePicture) {
    Ramp ramp({"2:3", "6.5~0.001"}, 0.5);
    EXPECT_EQ(ramp.seen()->layer, 0u);
    ramp.scene.opacityPer = OpacityPer::Crossing;
    EXPECT_EQ(ramp.seen()->layer, 1u);
    EXPECT_NEAR(*ramp.seen()->between, 6.5, 0.001);
}

TEST(PickCell, APointThatIsMissingIsNotTold) {
    const Ramp ramp({"3.55:3.95"}, 0.01, [](const glm::uvec3& at) {
        return at == glm::uvec3(4, 4, 4) ? std::numeric_limits<double>::quiet_NaN() : double(at.x);
    });
    EXPECT_FALSE(ramp.seen()) << "what is nearest to it is nowhere";
    const auto beside =
        ramp.seen(project(ramp.view, ramp.placed.position(ramp.indexOf(4, 5, 4))).window);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->gridIndex, ramp.indexOf(4, 5, 4));
}

TEST(PickCell, NothingIsSeenWhereNothingIs) {
    EXPECT_FALSE(Ramp({"20:30"}, 0.5).seen());
    EXPECT_FALSE(Ramp({"4:5"}, 0).seen());
    EXPECT_FALSE(Ramp({"4:5"}, 0.5).seen({0.5, 0.5})) << "beside the grid";
    Ramp clipped({"4:5"}, 0.5);
    clipped.scene.clip.hi.x = 2;
    EXPECT_FALSE(clipped.seen());
}

}  // namespace
}  // namespace render

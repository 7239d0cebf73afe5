// What order costs of light, where the light of both orders is known.
#include "render/reference/order_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/reference/interval_truth.h"
#include "render/reference/parts_on_rays.h"
#include "tests/support/cell_worlds.h"

namespace render {
namespace {

using tests::CellWorld;

double orderError(const Scene& scene, const timeseries::Field& field, const View& view,
                  std::span<const glm::ivec2> pixels, std::span<const double> weights) {
    OrderError of(scene, view, pixels, weights, 2);
    of.add(field);
    return of.error();
}

// The field is x, 0 to 8, on 9^3 points; the eye looks back along it, so that high values stand in
// front, and a unit of the field is one of length.
struct Ramp : CellWorld {
    explicit Ramp(const std::vector<std::string>& layers, double opacity = 0.5)
        : CellWorld(tests::stepOf(tests::cube(9),
                                  [](std::size_t i) { return static_cast<double>(i % 9); }),
                    layers, opacity) {}
    double error() const {
        const std::vector<glm::ivec2> middle{{10, 10}};
        const std::vector<double> once{1};
        return orderError(scene, scene.cells->field(), view, middle, once);
    }
    glm::dvec3 color(std::size_t layer) const { return colorOf(scene.layers[layer].style, 0); }
    View view = tests::lookFrom({3, 0, 0}, {21, 21});
};

glm::dvec3 inFront(const glm::dvec3& front, double a, const glm::dvec3& behind, double b) {
    return front * -std::expm1(-a) + std::exp(-a) * -std::expm1(-b) * behind;
}
double relative(const glm::dvec3& drawn, const glm::dvec3& exact) {
    return glm::distance(drawn, exact) / glm::length(exact);
}

TEST(OrderError, OfMixedColoursIsTheDifferenceOfTheClosedForms) {
    const Ramp ramp({"1:3", "5:6"});
    const double perLength = opticalDepthPerWeight(0.5), behind = 2 * perLength, front = perLength;
    const glm::dvec3 exact = inFront(ramp.color(1), front, ramp.color(0), behind);
    const glm::dvec3 mixed = (front * ramp.color(1) + behind * ramp.color(0)) *
                             (-std::expm1(-front - behind) / (front + behind));
    ASSERT_GT(relative(mixed, exact), 0.1);
    EXPECT_NEAR(ramp.error(), relative(mixed, exact), 1e-6);
}

// A range of a hundredth is as opaque then as one of a unit.
TEST(OrderError, IsOfThePicturesOwnOpacity) {
    Ramp thin({"1.2:1.21", "5.3:5.31"});
    const double byLength = thin.error();
    thin.scene.opacityPer = OpacityPer::Crossing;
    const double each = opticalDepthPerWeight(0.5);
    const glm::dvec3 exact = inFront(thin.color(1), each, thin.color(0), each);
    const glm::dvec3 mixed =
        each * (thin.color(0) + thin.color(1)) * (-std::expm1(-2 * each) / (2 * each));
    EXPECT_NEAR(thin.error(), relative(mixed, exact), 1e-6);
    EXPECT_LT(10 * byLength, thin.error());
}

TEST(OrderError, IsNoneOfOneColourAndOfPointsInOrder) {
    Ramp one({"1:3", "5:6"});
    one.scene.layers[1].style = one.scene.layers[0].style;
    EXPECT_EQ(one.error(), 0);
    Ramp points({"1:3", "5:6"});
    const auto field = points.scene.cells;
    points.scene.cells.reset();
    points.scene.order = Order::BackToFront;
    const std::vector<glm::ivec2> middle{{10, 10}};
    const std::vector<double> once{1};
    EXPECT_EQ(orderError(points.scene, field->field(), points.view, middle, once), 0);
    points.scene.order = Order::None;
    EXPECT_GT(orderError(points.scene, field->field(), points.view, middle, once), 0.1)
        << "points mix what the field would";
}

// Cells come one after the other, layers of one cell as they are numbered: right or wrong.
TEST(OrderError, OfCellsInOrderIsThatOfLayersWithinACell) {
    Ramp apart({"1:3", "5:6"});
    apart.scene.order = Order::BackToFront;
    EXPECT_LT(apart.error(), 1e-12);
    Ramp right({"4.6:4.9", "4.1:4.4"}, 0.9), wrong({"4.1:4.4", "4.6:4.9"}, 0.9);
    right.scene.order = wrong.scene.order = Order::BackToFront;
    EXPECT_LT(right.error(), 1e-12);
    const double each = 0.3 * opticalDepthPerWeight(0.9);
    EXPECT_NEAR(wrong.error(),
                relative(inFront(wrong.color(0), each, wrong.color(1), each),
                         inFront(wrong.color(1), each, wrong.color(0), each)),
                1e-6);
    EXPECT_GT(wrong.error(), 0.1);
}

// In every way that a ray can pass cells, by several layers that lie over each other.
TEST(OrderError, HoldsAgainstTheLightOfTheTruth) {
    const auto grid = tests::cube(12);
    CellWorld world(tests::stepOf(grid,
                                  [&](std::size_t i) {
                                      const glm::dvec3 p(grid->indices(i));
                                      return std::sin(0.9 * p.x) + std::cos(0.7 * p.y) * p.z / 12;
                                  }),
                    {"0.2:0.9", "-0.5:0.4", "0.3:0.35,0.8:1.2"}, 0.4);
    const View view = tests::lookFrom({1.2, -2.5, 1}, {24, 18});
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
    const timeseries::Field& field = world.scene.cells->field();
    const auto truth = IntervalTruth(world.scene, field, 1).light(view);
    std::vector<std::vector<PartInLayer>> rays(pixels.size());
    addPartsOnRays(world.scene, field, view, pixels, 3, rays);
    LightOfParts light(world.scene.layers);
    double most = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        orderAlongRay(rays[i]);
        const glm::dvec4 seen = light.inOrder(rays[i]);
        // A colour along a part goes evenly, of the field as nearly.
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(seen[c], truth[i][c], 1e-9) << i;
        most = std::max(most, seen.a);
    }
    EXPECT_GT(most, 0.5);
}

TEST(OrderError, CountsPixelsAsOftenAsTheyStandFor) {
    const Ramp ramp({"1:3", "5:6"});
    const std::vector<glm::ivec2> two{{10, 10}, {12, 11}}, one{{10, 10}};
    const auto error = [&](std::span<const glm::ivec2> pixels, std::vector<double> weights) {
        return orderError(ramp.scene, ramp.scene.cells->field(), ramp.view, pixels, weights);
    };
    ASSERT_GT(error(two, {0, 1}), 0);
    EXPECT_NEAR(error(two, {1, 0}), error(one, {1}), 1e-15);
    EXPECT_NEAR(error(two, {3, 5}), error(two, {0.6, 1}), 1e-15);
}

}  // namespace
}  // namespace render

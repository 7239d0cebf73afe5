// A picture that nobody has chosen the view of leaves its legend's corner free.
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <random>
#include <vector>

#include "app/choices/camera.h"
#include "app/choices/view_edits.h"

namespace app {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

// A box whose farthest corners are 1 away, and points all over its faces.
glm::dmat3 box(const dvec3& sides) {
    const dvec3 half = sides / glm::length(sides);
    return {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
}
std::vector<dvec3> onFaces(const glm::dmat3& halfEdges) {
    std::vector<dvec3> points;
    constexpr int kSteps = 24;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = -1; side <= 1; side += 2)
            for (int i = 0; i <= kSteps; ++i)
                for (int j = 0; j <= kSteps; ++j) {
                    dvec3 at(side);
                    at[(axis + 1) % 3] = 2.0 * i / kSteps - 1;
                    at[(axis + 2) % 3] = 2.0 * j / kSteps - 1;
                    points.push_back(halfEdges * at);
                }
    return points;
}

// Whether some of it lies in the upper left corner.
bool isCovered(const render::View& eye, const std::vector<dvec3>& points, const dvec2& legend) {
    constexpr double kRounding = 1e-3;  // pixels; orthographic is within 1e-4 of it
    return std::ranges::any_of(points, [&](const dvec3& point) {
        const dvec2 at = project(eye, point).window;
        return at.x < legend.x - kRounding - 0.1 && eye.size.y - at.y < legend.y - kRounding - 0.1;
    });
}

dvec2 widest(const render::View& eye, const std::vector<dvec3>& points) {
    dvec2 most(0);
    for (const dvec3& point : points)
        most = glm::max(most, glm::abs(2.0 * project(eye, point).window / dvec2(eye.size) - 1.0));
    return most;
}

TEST(FitBesideLegend, TheLegendCoversNothingOrThePictureIsAsWithoutIt) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> turn(-180, 180), tilt(-90, 90), side(0.1, 1);
    int moved = 0, left = 0;
    for (int i = 0; i < 400; ++i) {
        const ivec2 size(300 + static_cast<int>(random() % 1500),
                         300 + static_cast<int>(random() % 800));
        const dvec2 legend = dvec2(size) * dvec2(0.5 * side(random), 0.4 * side(random));
        ViewChoice view{turn(random), tilt(random), {}};
        if (i % 3 == 0) view.projection = Projection::Orthographic;
        const glm::dmat3 half = box({side(random), side(random), side(random)});
        const std::vector<dvec3> points = onFaces(half);
        const Stand without = standOf(view, half, size), beside = standOf(view, half, size, legend);
        const render::View eye = eyes(view, {}, half, size, legend)[0];
        const bool isMoved = beside.shift != dvec2(0);
        if (!isMoved) {
            EXPECT_EQ(beside.distance, without.distance) << i;
            EXPECT_EQ(beside.target, without.target) << i;
        }
        const bool wasCovered = isCovered(eyes(view, {}, half, size)[0], points, legend);
        if (isMoved || !wasCovered) {
            EXPECT_FALSE(isCovered(eye, points, legend)) << i;
        }
        EXPECT_GE(beside.distance, without.distance);
        EXPECT_LE(beside.distance, kFarther * without.distance);
        // No nearer to the picture's sides than without.
        const dvec2 most = widest(eye, points), free = kBoxShare * freeAreaOf(size);
        EXPECT_LE(most.x, free.x + 2e-4) << i;
        EXPECT_LE(most.y, free.y + 2e-4) << i;
        moved += isMoved;
        left += !isMoved && wasCovered;
    }
    EXPECT_GT(moved, 40) << "the test says something";
    EXPECT_GT(left, 0) << "too narrow ones stay as they are";
}

// What is clear of the legend already stands in the middle.
TEST(FitBesideLegend, OnlyWhatWouldBeCoveredIsMoved) {
    const glm::dmat3 cube = box({1, 1, 1});
    const ivec2 wide(1600, 900);
    const dvec2 small(200, 150), large(700, 400);
    EXPECT_EQ(standOf({}, cube, wide, small).shift, dvec2(0));
    const Stand aside = standOf({}, cube, wide, large);
    EXPECT_GT(aside.shift.x, 0) << "to the right";
    EXPECT_EQ(aside.distance, standOf({}, cube, wide).distance) << "there is room for all of it";
}

// As a lens is shifted: the same picture of the box, elsewhere.
TEST(FitBesideLegend, APictureThatIsShiftedIsTheSameElsewhere) {
    const glm::dmat3 half = box({1, 0.7, 0.4});
    ViewChoice shifted{40, 25, 3.0}, centred = shifted;
    shifted.shift = dvec2(0.25, -0.1);
    const ivec2 size(640, 480);
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        shifted.projection = centred.projection = projection;
        const auto a = eyes(shifted, {Stereo::SideBySide, 0.2, {}}, half, size),
                   b = eyes(centred, {Stereo::SideBySide, 0.2, {}}, half, size);
        for (const dvec3& point : onFaces(half))
            for (std::size_t eye = 0; eye < 2; ++eye) {
                const dvec2 by = project(a[eye], point).window - project(b[eye], point).window;
                EXPECT_NEAR(by.x, 0.25 * size.x / 2, 1e-6);
                EXPECT_NEAR(by.y, -0.1 * size.y / 2, 1e-6);
            }
    }
}

TEST(FitBesideLegend, AViewThatSomebodyChoseStandsWhereItStood) {
    const glm::dmat3 cube = box({1, 1, 1});
    const ivec2 size(1200, 900);
    const dvec2 legend(500, 300);
    ViewChoice far{30, 20, 5.0}, asked{30, 20, {}}, elsewhere;
    asked.shift = dvec2(0);
    elsewhere.target = {0.1, 0, 0};
    for (const ViewChoice& view : {far, asked, elsewhere})
        EXPECT_EQ(eyes(view, {}, cube, size, legend), eyes(view, {}, cube, size));
    EXPECT_NE(eyes(ViewChoice{}, {}, cube, size, legend), eyes(ViewChoice{}, {}, cube, size));
}

// The hand takes over what is there.
TEST(FitBesideLegend, TurningByHandGoesOnFromWhereTheBoxStands) {
    const Looking at{box({1, 1, 0.5}), {1200, 900}, {500, 300}};
    const Stand first = standOf({}, at.outline, at.size, at.legend);
    ASSERT_NE(first.shift, dvec2(0));
    ViewChoice view = orbited({}, {0, 0}, at);
    EXPECT_EQ(eyes(view, {}, at.outline, at.size, at.legend),
              eyes(ViewChoice{}, {}, at.outline, at.size, at.legend));
    const dvec2 place = 0.5 * dvec2(at.size) * (1.0 + first.shift);
    for (int i = 0; i < 20; ++i) {
        view = orbited(view, {37, 11}, at);
        const render::View eye = eyes(view, {}, at.outline, at.size, at.legend)[0];
        EXPECT_LT(glm::distance(project(eye, first.target).window, place), 1e-6);
    }
    EXPECT_EQ(fitted(view).shift, std::nullopt);
}

TEST(FitBesideLegend, AZoomKeepsWhatIsUnderTheCursor) {
    const Looking at{box({1, 1, 0.5}), {1200, 900}, {500, 300}};
    const dvec2 cursor(900, 250);
    const ViewChoice before = orbited({}, {0, 0}, at), after = zoomed({}, 0.5, cursor, at);
    const dvec2 up(cursor.x, at.size.y - cursor.y);
    const auto rays = render::pixelRays(eyes(before, {}, at.outline, at.size)[0]);
    const dvec3 ray = rays.along(up - rays.centre);
    const dvec3 seen = rays.eye + *before.distance / glm::dot(ray, rays.axis) * ray;
    const auto eye = eyes(after, {}, at.outline, at.size)[0];
    EXPECT_LT(glm::distance(project(eye, seen).window, up), 1e-6);
    EXPECT_EQ(after.shift, before.shift);
}

TEST(FitBesideLegend, APictureWithoutALegendHasTheBoxInTheMiddle) {
    Explorer e;
    e.layers.resize(1);
    e.layers[0].color = MapChoice{};
    const dvec2 bar = legendOf(e);
    EXPECT_GT(bar.x, 0);
    e.layers.push_back(e.layers[0]);
    EXPECT_GT(legendOf(e).y, bar.y) << "another layer";
    e.layers[1].visible = false;
    EXPECT_EQ(legendOf(e), bar) << "a hidden layer";
    e.legend = false;
    EXPECT_EQ(legendOf(e), dvec2(0));
    EXPECT_EQ(eyes(e, box({1, 1, 1})), eyes(e.view, {}, box({1, 1, 1}), e.size));
}

}  // namespace
}  // namespace app

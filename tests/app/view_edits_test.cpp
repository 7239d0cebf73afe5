#include "app/choices/view_edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"

namespace app {
namespace {

using glm::dvec2;
using glm::dvec3;

// The half edges of a box whose sides are along x, y and z.
glm::dmat3 upright(const dvec3& half) { return {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}}; }

class ViewEdits : public testing::Test {
 protected:
    double uniform(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random_);
    }
    Looking randomLooking() {
        const dvec3 half(uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1));
        return {upright(half / glm::length(half)),
                {static_cast<int>(uniform(100, 900)), static_cast<int>(uniform(100, 900))}};
    }
    ViewChoice randomView() {
        ViewChoice view{uniform(-400, 400), uniform(-90, 90), {}};
        if (random_() % 4 != 0) view.distance = std::pow(10, uniform(-2, 2));
        if (random_() % 4 != 0) view.target = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        if (random_() % 2 == 0) view.projection = Projection::Orthographic;
        return view;
    }
    dvec2 randomCursor(const Looking& at) {
        return dvec2(uniform(0, 1), uniform(0, 1)) * dvec2(at.size);
    }
    std::mt19937 random_{11};
};

// Window positions with y down, as the edits have them.
dvec2 windowOf(const ViewChoice& view, const Looking& at, const dvec3& world) {
    const dvec2 up = render::project(eyes(view, {}, at.outline, at.size)[0], world).window;
    return {up.x, at.size.y - up.y};
}

// The point of the target's plane that a pixel shows: where its ray meets the plane.
dvec3 worldUnder(const ViewChoice& view, const Looking& at, dvec2 cursor) {
    const auto rays = render::pixelRays(eyes(view, {}, at.outline, at.size)[0]);
    const dvec2 offset = dvec2(cursor.x, at.size.y - cursor.y) - rays.centre;
    const dvec3 ray = rays.along(offset);
    const double along = glm::dot(view.target - rays.eye, rays.axis) / glm::dot(ray, rays.axis);
    return rays.eye + along * ray;
}

// An orthographic picture is within 1e-4 of one; of at most 900 pixels to either side.
double tolerance(const ViewChoice& view, double pixels) {
    return view.projection == Projection::Orthographic ? 3 * pixels / kFarEye : 1e-7;
}

TEST_F(ViewEdits, PanningKeepsThePointUnderTheCursor) {
    for (int i = 0; i < 1000; ++i) {
        const Looking at = randomLooking();
        const ViewChoice view = randomView();
        const dvec2 cursor = randomCursor(at), by(uniform(-300, 300), uniform(-300, 300));
        const dvec3 held = worldUnder(view, at, cursor);
        const ViewChoice next = panned(view, by, at);
        const dvec2 now = windowOf(next, at, held);
        EXPECT_LE(glm::distance(now, cursor + by), tolerance(view, 2000)) << "case " << i;
        EXPECT_EQ(next.azimuthDegrees, view.azimuthDegrees);
        EXPECT_EQ(next.elevationDegrees, view.elevationDegrees);
        EXPECT_EQ(*next.distance, standOf(view, at.outline, at.size).distance);
    }
}

TEST_F(ViewEdits, ZoomingKeepsThePointUnderTheCursor) {
    for (int i = 0; i < 1000; ++i) {
        const Looking at = randomLooking();
        const ViewChoice view = randomView();
        const dvec2 cursor = randomCursor(at);
        const double factor = std::pow(10, uniform(-0.5, 0.5));
        const dvec3 held = worldUnder(view, at, cursor);
        const ViewChoice next = zoomed(view, factor, cursor, at);
        EXPECT_LE(glm::distance(windowOf(next, at, held), cursor), tolerance(view, 2000))
            << "case " << i;
        const double before = standOf(view, at.outline, at.size).distance;
        EXPECT_NEAR(*next.distance, before * factor, 1e-12 * before * factor);
    }
}

TEST_F(ViewEdits, ZoomingStaysWithinWhatADistanceMayBe) {
    const Looking at = randomLooking();
    for (const double factor : {0.1, 10.0, 0.0, 1e300}) {
        ViewChoice view = randomView();
        for (int i = 0; i < 50; ++i) view = zoomed(view, factor, randomCursor(at), at);
        EXPECT_GE(*view.distance, kNearest);
        EXPECT_LE(*view.distance, kFarthest);
        for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(view.target[a]), kFarthest);
    }
}

TEST_F(ViewEdits, TheBoxFollowsTheHandThatTurnsIt) {
    // What is nearest to the eye moves the way of the hand; half the shorter side is a right angle.
    const Looking at{glm::dmat3(1 / std::sqrt(3.0)), {800, 600}};
    const ViewChoice view{20, 10, 5.0};
    const dvec3 nearest = standOf(view, at.outline, at.size).axes[2];
    const dvec2 before = windowOf(view, at, nearest);
    EXPECT_GT(windowOf(orbited(view, {10, 0}, at), at, nearest).x, before.x + 5);
    EXPECT_LT(windowOf(orbited(view, {-10, 0}, at), at, nearest).x, before.x - 5);
    EXPECT_GT(windowOf(orbited(view, {0, 10}, at), at, nearest).y, before.y + 5);
    EXPECT_LT(windowOf(orbited(view, {0, -10}, at), at, nearest).y, before.y - 5);
    EXPECT_NEAR(orbited(view, {300, 0}, at).azimuthDegrees, 20 - 90, 1e-12);
    EXPECT_NEAR(orbited(view, {0, 150}, at).elevationDegrees, 10 + 45, 1e-12);
}

TEST_F(ViewEdits, TurningKeepsAnglesInBoundsAndTheDistance) {
    for (int i = 0; i < 500; ++i) {
        const Looking at = randomLooking();
        const ViewChoice view = randomView();
        const dvec2 by(uniform(-3000, 3000), uniform(-900, 900));
        const ViewChoice next = orbited(view, by, at);
        EXPECT_LE(std::abs(next.elevationDegrees), 90);
        EXPECT_GT(next.azimuthDegrees, -180);
        EXPECT_LE(next.azimuthDegrees, 180);
        // The same direction as without whole turns.
        const double turns = (view.azimuthDegrees - 180 * by.x / std::min(at.size.x, at.size.y) -
                              next.azimuthDegrees) /
                             360;
        EXPECT_NEAR(turns, std::round(turns), 1e-9);
        EXPECT_EQ(*next.distance, standOf(view, at.outline, at.size).distance);
        EXPECT_EQ(next.target, standOf(view, at.outline, at.size).target);
    }
}

TEST_F(ViewEdits, FittingShowsAllAndKeepsWhereItIsLookedAtFrom) {
    for (int i = 0; i < 100; ++i) {
        const ViewChoice view = randomView(), next = fitted(view);
        EXPECT_FALSE(next.distance);
        EXPECT_EQ(next.target, dvec3(0));
        EXPECT_EQ(next.azimuthDegrees, view.azimuthDegrees);
        EXPECT_EQ(next.elevationDegrees, view.elevationDegrees);
        EXPECT_EQ(next.projection, view.projection);
    }
}

TEST_F(ViewEdits, SidesAreWhereTheyAreSaidToBe) {
    const std::pair<Side, dvec3> from[] = {{Side::Front, {0, -1, 0}}, {Side::Back, {0, 1, 0}},
                                           {Side::Left, {-1, 0, 0}},  {Side::Right, {1, 0, 0}},
                                           {Side::Top, {0, 0, 1}},    {Side::Bottom, {0, 0, -1}}};
    for (const auto& [side, towardsEye] : from) {
        const ViewChoice view = lookedFrom(randomView(), side);
        const dvec3 back = standOf(view, glm::dmat3(1), {100, 100}).axes[2];
        EXPECT_LE(glm::distance(back, towardsEye), 1e-15);
    }
}

}  // namespace
}  // namespace app

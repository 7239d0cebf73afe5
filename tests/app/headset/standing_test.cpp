// Where things stand before the user, by distances and directions that a user would measure.
#include "app/headset/standing.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "render/points/view.h"

namespace app::headset {
namespace {

constexpr glm::dvec3 kUp(0, 1, 0);

xr::Pose headAt(const glm::dvec3& at, double yaw, double pitch = 0) {
    return {glm::angleAxis(yaw, kUp) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0)), at};
}
glm::dvec3 ahead(double yaw) { return glm::angleAxis(yaw, kUp) * glm::dvec3(0, 0, -1); }
glm::dvec3 inStage(const xr::Placement& p, const glm::dvec3& world) {
    return glm::dvec3(xr::stageFromWorld(p) * glm::dvec4(world, 1));
}

const glm::dmat3 kBox(glm::dvec3(0.8, 0, 0), glm::dvec3(0, 0.4, 0), glm::dvec3(0, 0, 0.2));

TEST(Standing, TheVolumeFloatsBeforeTheHeadUprightWithItsFrontToTheUser) {
    for (const double yaw : {0.0, 1.0, -2.5, 3.1})
        for (const double pitch : {0.0, -0.6, 0.4}) {
            const xr::Pose head = headAt({1, 1.6, -2}, yaw, pitch);
            const xr::Placement p = volumeBefore(head, kBox);
            const glm::dvec3 middle = inStage(p, {0, 0, 0}) - head.position;
            EXPECT_NEAR(middle.y, -kVolumeBelowEye, 1e-12);
            EXPECT_NEAR(glm::dot(middle, ahead(yaw)), kVolumeAhead, 1e-12);
            EXPECT_NEAR(glm::length(middle), std::hypot(kVolumeBelowEye, kVolumeAhead), 1e-12);
            // World z is up; +y is away, so that azimuth 0 looks at the front.
            const glm::dvec3 up = inStage(p, {0, 0, 1}) - inStage(p, {0, 0, 0});
            const glm::dvec3 away = inStage(p, {0, 1, 0}) - inStage(p, {0, 0, 0});
            EXPECT_LT(glm::distance(glm::normalize(up), kUp), 1e-12);
            EXPECT_LT(glm::distance(glm::normalize(away), ahead(yaw)), 1e-12);
            EXPECT_NEAR(glm::distance(inStage(p, kBox[0]), inStage(p, -kBox[0])), kVolumeWide,
                        1e-12);
        }
}

TEST(Standing, AHeadThatLooksStraightUpOrDownKeepsItsHeading) {
    for (const double pitch : {-1.6, -1.57, 1.57, 1.6}) {
        const xr::Placement p = volumeBefore(headAt({0, 1.6, 0}, 0.7, pitch), kBox);
        const glm::dvec3 middle = inStage(p, {0, 0, 0});
        EXPECT_NEAR(glm::dot(middle - glm::dvec3(0, middle.y, 0), ahead(0.7)), kVolumeAhead, 1e-6);
    }
}

TEST(Standing, APointHasARoomToo) {
    const xr::Placement p = volumeBefore(headAt({0, 1.6, 0}, 0), glm::dmat3(0.0));
    EXPECT_TRUE(std::isfinite(p.metresPerUnit));
    EXPECT_GT(p.metresPerUnit, 0);
}

TEST(Standing, ThePanelFacesTheHeadLeftOfTheVolume) {
    const xr::Pose head = headAt({1, 1.2, -2}, 0.8, -0.3);
    const Plate panel = panelBefore(head);
    const glm::dvec3 at = panel.stageFromPlate.position - head.position;
    EXPECT_GT(glm::length(at), 0.7) << "not nearer than an arm";
    EXPECT_LT(glm::length(at), 2);
    EXPECT_LT(at.y, 0) << "below the eye";
    EXPECT_GT(glm::dot(at, glm::cross(kUp, ahead(0.8))), 0.3) << "left";
    const glm::dvec3 face = panel.stageFromPlate.orientation * glm::dvec3(0, 0, 1);
    EXPECT_LT(glm::distance(face, glm::normalize(-at)), 1e-12);
    const glm::dvec3 right = panel.stageFromPlate.orientation * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(right.y, 0, 1e-12) << "not tilted sideways";
}

TEST(Standing, ARayHitsThePlateWhereItPointsAt) {
    std::mt19937 random(3);
    const auto number = [&](double lo, double hi) {
        return std::uniform_real_distribution(lo, hi)(random);
    };
    for (int i = 0; i < 200; ++i) {
        const Plate plate{
            headAt({number(-1, 1), number(-1, 1), number(-1, 1)}, number(-3, 3), number(-1, 1)),
            {number(0.1, 1), number(0.1, 1)}};
        const glm::dvec2 at(number(-0.1, 1.1), number(-0.1, 1.1));
        // The target by the corners of the plate.
        const glm::dmat4 stage = xr::matrix(plate.stageFromPlate);
        const auto corner = [&](double x, double y) {
            return glm::dvec3(stage * glm::dvec4(plate.half * glm::dvec2(x, y), 0, 1));
        };
        const glm::dvec3 upperLeft = corner(-1, 1);
        const glm::dvec3 target =
            upperLeft + at.x * (corner(1, 1) - upperLeft) + at.y * (corner(-1, -1) - upperLeft);
        const double side = i % 2 == 0 ? 1 : -1;
        const glm::dvec3 from =
            glm::dvec3(stage * glm::dvec4(number(-1, 1), number(-1, 1), side * number(0.1, 2), 1));
        const xr::Pose ray{glm::quatLookAt(glm::normalize(target - from), kUp), from};
        const auto hit = hitOf(ray, plate);
        const bool inside = at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1 && side > 0;
        ASSERT_EQ(hit.has_value(), inside) << i;
        if (!hit) continue;
        EXPECT_LT(glm::distance(hit->at, at), 1e-9);
        EXPECT_NEAR(hit->distance, glm::distance(from, target), 1e-9);
    }
    const Plate plate;
    EXPECT_FALSE(hitOf({glm::angleAxis(3.0, kUp), {0, 0, 1}}, plate)) << "points away";
}

TEST(Standing, ThePlacardIsThePlateInTheVolumesWorld) {
    const xr::Placement placement{headAt({0.3, 1, -1}, 1, 0.5), 0.4};
    const Plate plate{headAt({1, 1, 1}, -1, 0.2), {0.3, 0.2}};
    const glm::dmat4 made = xr::stageFromWorld(placement) * worldFromPlacard(plate, placement);
    const glm::dvec3 corner(made * glm::dvec4(1, -1, 0, 1));
    const glm::dvec3 expected(xr::matrix(plate.stageFromPlate) * glm::dvec4(0.3, -0.2, 0, 1));
    EXPECT_LT(glm::distance(corner, expected), 1e-12);
}

TEST(Standing, ARayMeetsTheBoxOrNot) {
    const xr::Placement p = volumeBefore(headAt({0, 1.6, 0}, 0), kBox);
    const glm::dvec3 middle = inStage(p, {0, 0, 0});
    const auto meets = [&](const glm::dvec3& from, const glm::dvec3& towards) {
        return meetsBox(
            {glm::quatLookAt(glm::normalize(towards - from), glm::dvec3(0, 0.6, 0.8)), from}, p,
            kBox);
    };
    EXPECT_TRUE(meets({0, 1.6, 0}, middle));
    EXPECT_TRUE(meets(middle, middle + glm::dvec3(1, 0, 0))) << "from inside";
    EXPECT_FALSE(meets({0, 1.6, 0}, -middle));
    // Just inside and just outside of an edge of the box, seen from far along the view axis.
    for (const double beyond : {0.999, 1.001}) {
        const glm::dvec3 edge = inStage(p, beyond * (kBox[0] + kBox[2]));
        EXPECT_EQ(meets(edge + glm::dvec3(0, 0, 5), edge), beyond < 1);
    }
}

}  // namespace
}  // namespace app::headset

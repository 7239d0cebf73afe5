// Hands and volume as rigid bodies: what must hold of any motion, over random ones.
#include "xr/grab.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

namespace xr {
namespace {

using Holding = std::array<std::optional<Pose>, 2>;

class GrabOfRandomHands : public testing::Test {
 protected:
    double number(double least, double most) {
        return std::uniform_real_distribution(least, most)(random_);
    }
    glm::dvec3 point() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
    Pose pose() {
        return {
            glm::normalize(glm::dquat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1))),
            point()};
    }
    // Two hands as far apart as arms can hold them; `metres`: between them.
    Holding pair(double metres) {
        const Pose left = pose();
        Pose right = pose();
        right.position = left.position + metres * (right.orientation * glm::dvec3(1, 0, 0));
        return {left, right};
    }
    Placement placement() { return {pose(), number(0.1, 2)}; }

    // Where a point of the volume is, and which point of it is there.
    static glm::dvec3 place(const Placement& p, const glm::dvec3& inWorld) {
        return glm::dvec3(stageFromWorld(p) * glm::dvec4(inWorld, 1));
    }
    static glm::dvec3 pointAt(const Placement& p, const glm::dvec3& inStage) {
        return glm::dvec3(glm::inverse(stageFromWorld(p)) * glm::dvec4(inStage, 1));
    }
    static void expectSame(const Placement& a, const Placement& b, double within = 1e-12) {
        for (const glm::dvec3& corner : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {0, 0, 0}})
            EXPECT_LT(glm::distance(place(a, corner), place(b, corner)), within);
    }

    std::mt19937 random_{7};
};

TEST_F(GrabOfRandomHands, TheVolumeKeepsItsPoseInOneHand) {
    for (const std::size_t side : {0u, 1u})
        for (int i = 0; i < 100; ++i) {
            Grab grab;
            Holding holding;
            holding[side] = pose();
            const Placement began = placement();
            const Pose inHand = inverse(*holding[side]) * began.stageFromVolume;
            Placement now = grab.update(began, holding);
            for (int frame = 0; frame < 10; ++frame) {
                holding[side] = pose();
                now = grab.update(now, holding);
                expectSame({inverse(*holding[side]) * now.stageFromVolume, now.metresPerUnit},
                           {inHand, began.metresPerUnit});
            }
        }
}

TEST_F(GrabOfRandomHands, TwoHandsKeepTheirPointsOfTheVolume) {
    for (int i = 0; i < 100; ++i) {
        Grab grab;
        Holding holding = pair(number(0.2, 1));
        Placement now = grab.update(placement(), holding);
        const glm::dvec3 left = pointAt(now, holding[0]->position);
        const glm::dvec3 right = pointAt(now, holding[1]->position);
        const double metres = now.metresPerUnit,
                     distance = glm::distance(holding[0]->position, holding[1]->position);
        for (int frame = 0; frame < 10; ++frame) {
            holding = pair(number(0.2, 1));
            now = grab.update(now, holding);
            EXPECT_LT(glm::distance(place(now, left), holding[0]->position), 1e-9);
            EXPECT_LT(glm::distance(place(now, right), holding[1]->position), 1e-9);
            EXPECT_NEAR(now.metresPerUnit / metres,
                        glm::distance(holding[0]->position, holding[1]->position) / distance, 1e-9);
        }
    }
}

TEST_F(GrabOfRandomHands, TwoHandsThatMoveTogetherOnlyCarry) {
    const Holding holding{pose(), pose()};
    Grab grab;
    const Placement began = grab.update(placement(), holding);
    const glm::dvec3 by = point();
    Holding moved = holding;
    for (auto& hand : moved) hand->position += by;
    const Placement now = grab.update(began, moved);
    for (const glm::dvec3& corner : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}})
        EXPECT_LT(glm::distance(place(now, corner), place(began, corner) + by), 1e-12);
}

TEST_F(GrabOfRandomHands, AHalfTurnOfTheLineIsATurnToo) {
    Holding holding{Pose{{1, 0, 0, 0}, {-0.2, 1, 0}}, Pose{{1, 0, 0, 0}, {0.2, 1, 0}}};
    Grab grab;
    const Placement began = grab.update(placement(), holding);
    const glm::dvec3 left = pointAt(began, holding[0]->position);
    std::swap(holding[0], holding[1]);
    const Placement now = grab.update(began, holding);
    EXPECT_LT(glm::distance(place(now, left), holding[0]->position), 1e-12);
    EXPECT_NEAR(now.metresPerUnit, began.metresPerUnit, 1e-12);
}

TEST_F(GrabOfRandomHands, TheScaleStaysWithinItsBoundsAndTheMiddleFollows) {
    for (const double factor : {0.002, 500.0}) {
        const glm::dvec3 middle = point(), half(0, factor < 1 ? 5 : 0.01, 0);
        const auto apart = [&](double times) {
            return Holding{Pose{{1, 0, 0, 0}, middle - times * half},
                           Pose{{1, 0, 0, 0}, middle + times * half}};
        };
        Grab grab;
        const Placement began = grab.update(placement(), apart(1));
        const glm::dvec3 held = pointAt(began, middle);
        const Placement now = grab.update(began, apart(factor));
        EXPECT_EQ(now.metresPerUnit, factor < 1 ? kSmallestMetres : kLargestMetres);
        EXPECT_LT(glm::distance(place(now, held), middle), 1e-9);
    }
}

TEST_F(GrabOfRandomHands, AChangeOfHandsNeverMovesTheVolume) {
    for (int i = 0; i < 300; ++i) {
        Grab grab;
        Holding holding;
        Placement now = placement();
        for (int frame = 0; frame < 20; ++frame) {
            Holding next = holding;
            const auto side = static_cast<std::size_t>(random_() % 2);
            next[side] = next[side] ? std::nullopt : std::optional(pose());
            const Placement after = grab.update(now, next);
            expectSame(after, now, 1e-15);
            now = after;
            holding = next;
        }
    }
}

TEST_F(GrabOfRandomHands, HandsThatMeetOnlyCarry) {
    const glm::dvec3 middle = point();
    const auto apart = [&](double metres) {
        return Holding{Pose{{1, 0, 0, 0}, middle},
                       Pose{{1, 0, 0, 0}, middle + glm::dvec3(metres, 0, 0)}};
    };
    Grab grab;
    const Placement began = grab.update(placement(), apart(0.3));
    Placement now = began;
    for (const double metres : {0.009, 0.0, 0.005, -0.008, 0.3})
        now = grab.update(now, apart(metres));
    expectSame(now, began, 1e-12);
}

}  // namespace
}  // namespace xr

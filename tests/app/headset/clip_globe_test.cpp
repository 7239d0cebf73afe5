// The faces of a clip box on a globe in the hand: meridians, parallels and spheres.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "app/headset/clip_hand.h"
#include "app/headset/clip_space.h"
#include "app/headset/standing.h"
#include "tests/support/geographic.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

struct HandOnAGlobe {
    tests::ScriptedExploration world;
    Exploration& e = world.exploration;
    render::PlacedPoints placed{e.shown()->sorted->grid(), {}, render::Map::Globe};
    Drawn drawn{&placed, e.shown()->sorted, e.shown()->step};
    xr::Placement placement{
        {glm::normalize(glm::dquat(0.8, 0.1, -0.5, 0.3)), glm::dvec3(0.2, 1.3, -0.9)}, 0.5};
    ClipHand clip;

    explicit HandOnAGlobe(std::shared_ptr<const timeseries::Grid> grid) : world(worldOf(grid)) {
        EXPECT_TRUE(placed.globe());
    }
    static tests::World worldOf(const std::shared_ptr<const timeseries::Grid>& grid) {
        tests::World made;
        made.grid = grid;
        return made;
    }
    glm::dvec3 inStage(const glm::dvec3& place) const {
        return glm::dvec3(stageFromAxes(placement, placed) *
                          glm::dvec4(placed.axesFromGlobe(placed.globe()->at(place)), 1));
    }
    std::optional<Hold> holdAt(const xr::Pose& aim) const {
        return ClipHand::holdAt(aim, drawn, placement, e);
    }
    static xr::Pose at(const glm::dvec3& stage) { return {{1, 0, 0, 0}, stage}; }
    static xr::Pose looking(const glm::dvec3& from, const glm::dvec3& to) {
        return {glm::quatLookAt(glm::normalize(to - from), glm::dvec3(0, 1, 0)), from};
    }
    Face take(const xr::Pose& aim) {
        const auto hold = holdAt(aim);
        EXPECT_TRUE(hold);
        if (!hold) return {-1, 0};
        clip.take(0, *hold, aim, drawn, placement, e);
        return hold->face;
    }
    void move(const xr::Pose& aim) { clip.move(e, {aim, std::nullopt}, drawn, placement); }
    void letGo() { clip.letGo(0, e); }
    const std::optional<ClipBox>& box() const { return e.explorer().clip; }
    // A length in the room, of a degree of the surface there.
    double degree(const glm::dvec3& place) const {
        return glm::distance(inStage(place), inStage(place + glm::dvec3(0, 1, 0)));
    }
};

std::shared_ptr<const timeseries::Grid> region() {
    return tests::gridOf(tests::east(-30, 30, 4), tests::north(30, 66, 4),
                         tests::measuredAxis("height", "km", 0, 30, 4));
}

TEST(ClipByHandOnAGlobe, AFaceGoesWithTheHandAlongItsCoordinateAlone) {
    HandOnAGlobe hand(region());
    struct Case {
        Face face;
        glm::dvec3 at, by;
    };
    for (const auto& [face, at, by] :
         {Case{{0, 1}, {29, 48, 15}, {-20, 3, 5}}, Case{{1, -1}, {0, 31, 15}, {4, 9, 5}},
          Case{{2, 1}, {0, 48, 29}, {2, 1, -11}}}) {
        ASSERT_EQ(hand.take(hand.at(hand.inStage(at))), face);
        hand.move(hand.at(hand.inStage(at + by)));
        ASSERT_TRUE(hand.box());
        // As far from the face as it was, but for a millimetre.
        const double expected = 30 + by[face.axis];  // each of the three faces is at 30
        const double found = (face.side < 0 ? hand.box()->lo : hand.box()->hi)[face.axis];
        const double unit =
            face.axis == 2 ? glm::distance(hand.inStage(at), hand.inStage(at + glm::dvec3(0, 0, 1)))
                           : hand.degree(at) * (face.axis == 0 ? std::cos(glm::radians(51.0)) : 1);
        EXPECT_NEAR(found, expected, 0.001 / unit) << face.axis;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_TRUE((axis == face.axis && face.side < 0) || hand.box()->lo[axis] == -kNoEnd);
            EXPECT_TRUE((axis == face.axis && face.side > 0) || hand.box()->hi[axis] == kNoEnd);
        }
        // Back to where the field ends, and beyond.
        hand.move(hand.at(hand.inStage(at - 0.2 * by)));
        EXPECT_FALSE(hand.box()) << face.axis;
        hand.letGo();
    }
}

TEST(ClipByHandOnAGlobe, TheRayTakesTheFirstFaceThatItMeetsBeforeTheEarth) {
    HandOnAGlobe hand(region());
    const glm::dvec3 above = hand.inStage({5, 50, 9000}), top = hand.inStage({5, 50, 30});
    const auto hold = hand.holdAt(hand.looking(above, top));
    ASSERT_TRUE(hold);
    EXPECT_EQ(hold->face, (Face{2, 1}));
    EXPECT_LT(glm::distance(hold->at, top), 1e-6);
    // Along the ground from the east.
    const glm::dvec3 east = hand.inStage({30, 50, 15});
    const auto beside =
        hand.holdAt(hand.looking(east + 40.0 * (east - hand.inStage({29, 50, 15})), east));
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->face, (Face{0, 1}));
    EXPECT_LT(glm::distance(beside->at, east), 1e-6);
    // From the other side of the Earth.
    const glm::dvec3 below = hand.inStage({180 + 5, -50, 9000});
    EXPECT_FALSE(hand.holdAt(hand.looking(below, top)));
    EXPECT_FALSE(hand.holdAt(hand.looking(above, 2.0 * above - top)));
}

// One that is thinner than a hand is steady, in height, is met as any other.
TEST(ClipByHandOnAGlobe, TheRayMeetsAThinBox) {
    HandOnAGlobe hand(region());
    Explorer next = hand.e.explorer();
    next.clip = ClipBox{{-kNoEnd, -kNoEnd, 20}, {kNoEnd, kNoEnd, 20.001}};
    hand.e.edit(next);
    const glm::dvec3 above = hand.inStage({5, 50, 9000});
    for (const double latitude : {35.0, 42.3, 50.0, 61.7}) {
        const glm::dvec3 top = hand.inStage({5, latitude, 20.001});
        const auto hold = hand.holdAt(hand.looking(above, top));
        ASSERT_TRUE(hold) << latitude;
        EXPECT_EQ(hold->face, (Face{2, 1})) << latitude;
        EXPECT_LT(glm::distance(hold->at, top), 1e-6) << latitude;
    }
}

TEST(ClipByHandOnAGlobe, AFaceHeldByTheRayGoesWithTheHand) {
    HandOnAGlobe hand(region());
    const glm::dvec3 top = hand.inStage({5, 50, 30}), above = hand.inStage({5, 50, 9000}),
                     deep = hand.inStage({5, 50, 20});
    xr::Pose aim = hand.looking(above, top);
    ASSERT_EQ(hand.take(aim), (Face{2, 1}));
    aim.position += deep - top;
    hand.move(aim);
    ASSERT_TRUE(hand.box());
    EXPECT_NEAR(hand.box()->hi.z, 20, 0.001 / (glm::distance(deep, top) / 10));
}

// Beyond the last meridian it is not the first one's other side.
TEST(ClipByHandOnAGlobe, AFaceDoesNotComeRound) {
    HandOnAGlobe hand(tests::gridOf(tests::east(0, 350, 36), tests::north(-80, 80, 17),
                                    tests::measuredAxis("height", "km", 0, 30, 4)));
    ASSERT_EQ(hand.take(hand.at(hand.inStage({349, 20, 15}))), (Face{0, 1}));
    hand.move(hand.at(hand.inStage({330, 20, 15})));
    EXPECT_NEAR(hand.box()->hi.x, 331, 0.5);
    for (const double to : {340.0, 348.0, 356.0, 364.0, 380.0}) {
        hand.move(hand.at(hand.inStage({to, 20, 15})));
        if (to < 349)
            EXPECT_NEAR(hand.box()->hi.x, to + 1, 0.5);
        else
            EXPECT_FALSE(hand.box()) << to;
    }
}

TEST(ClipByHandOnAGlobe, EdgesLieAlongMeridiansAndParallels) {
    HandOnAGlobe hand(region());
    Explorer next = hand.e.explorer();
    next.clip = ClipBox{{-15, -kNoEnd, -kNoEnd}, {kNoEnd, 60, 20}};
    hand.e.edit(next);
    const glm::dvec3 lo(-15, 30, 0), hi(30, 60, 20);
    const auto edges = hand.clip.edges({Hold{{0, -1}, {}}, std::nullopt}, hand.drawn, hand.e);
    int lit = 0;
    double length = 0;
    for (const ClipHand::Edge& edge : edges) {
        int onFirst = 0;
        for (const glm::dvec3& world : {edge.from, edge.to}) {
            const glm::dvec3 at = hand.placed.globe()->placeOf(hand.placed.gridFromAxes(world));
            int on = 0;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_TRUE(at[axis] > lo[axis] - 1e-6 && at[axis] < hi[axis] + 1e-6);
                on += std::abs(at[axis] - lo[axis]) < 1e-6 || std::abs(at[axis] - hi[axis]) < 1e-6;
            }
            EXPECT_GE(on, 2);
            onFirst += std::abs(at.x - lo.x) < 1e-6;
        }
        EXPECT_EQ(edge.lit, onFirst == 2);
        lit += edge.lit;
        length += glm::distance(edge.from, edge.to);
    }
    EXPECT_GT(lit, 4) << "meridians are bent";
    // Two parallels and two meridians on each of two spheres, and four ways up.
    const auto& globe = *hand.placed.globe();
    double expected = 0;
    for (const double z : {lo.z, hi.z}) {
        const auto arc = [&](double degrees) { return globe.radius(z) * glm::radians(degrees); };
        expected += 2 * arc(hi.y - lo.y) + arc(hi.x - lo.x) * (std::cos(glm::radians(lo.y)) +
                                                               std::cos(glm::radians(hi.y)));
    }
    expected += 4 * (globe.radius(hi.z) - globe.radius(lo.z));
    EXPECT_NEAR(length / (hand.placed.scale().x * expected), 1, 0.002);
}

// Of axes that are another pole's no place of the hand tells the coordinates.
TEST(ClipByHandOnAGlobe, OtherAxesHaveNoFacesThere) {
    const timeseries::Grid axes({tests::measuredAxis("rlon", "degrees", 0, 3, 4),
                                 tests::measuredAxis("rlat", "degrees", 0, 3, 4),
                                 tests::measuredAxis("height", "km", 0, 30, 4)});
    std::vector<glm::dvec2> columns;
    for (int n = 0; n < 16; ++n) columns.emplace_back(10 + n % 4, 50 + n / 4 + 0.2 * (n % 4));
    HandOnAGlobe hand(std::make_shared<const timeseries::Grid>(
        axes.withEarth(std::make_shared<const timeseries::EarthPlaces>(columns))));
    EXPECT_FALSE(hand.holdAt(hand.at(hand.inStage({10, 50, 30}))));
    EXPECT_TRUE(hand.clip.edges({}, hand.drawn, hand.e).empty());
}

}  // namespace
}  // namespace app::headset

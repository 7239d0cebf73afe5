// Which mode to choose of those that were measured.
#include "app/measure/best_modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/measure/report.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Measured mode(double frame, double error, double mass = 1,
              render::Order order = render::Order::None) {
    Measured m{.mode = {{Model::Points}, order}, .frame = frame};
    m.depthError = error;
    m.mass = mass;
    return m;
}

std::vector<std::pair<double, int>> plain(const std::vector<BestMode>& best) {
    std::vector<std::pair<double, int>> all;
    for (const auto& [limit, of] : best) all.emplace_back(limit, of ? static_cast<int>(*of) : -1);
    return all;
}

auto at(double limit, int mode) {
    return testing::Pair(testing::DoubleNear(limit, 1e-9 * limit), mode);
}

// Whose error of depth is that of the others, at a time of its own.
TEST(BestModes, LitOnesAreNoChoice) {
    std::vector modes = {mode(0.008, 0.4), mode(0.003, 0.1, 1, render::Order::BackToFront)};
    modes[1].mode.light = render::Light::Soft;
    EXPECT_THAT(plain(mostAccurateWithin(modes)), ElementsAre(at(0.01, 0)));
}

TEST(BestModes, AreTheMostAccurateOfATimeAndTheSoonestOfAnError) {
    const std::vector modes = {mode(0.003, 0.3), mode(0.008, 0.4), mode(0.015, 0.03)};
    EXPECT_THAT(plain(mostAccurateWithin(modes)),
                ElementsAre(at(0.005, 0), at(0.01, 0), at(0.02, 2)));
    EXPECT_THAT(plain(soonestWithin(modes)),
                ElementsAre(at(0.05, 2), at(0.1, 2), at(0.2, 2), at(0.5, 0)));
}

TEST(BestModes, AreNoneWhoseMassIsOffOrWhoseColoursAreMixed) {
    constexpr auto kOrdered = render::Order::BackToFront;
    const std::vector modes = {mode(0.001, 0.01, 0.9, kOrdered), mode(0.002, 0.02),
                               mode(0.004, 0.05, 1, kOrdered),
                               mode(0.003, std::nan(""), 1, kOrdered)};
    EXPECT_THAT(plain(mostAccurateWithin(modes)), ElementsAre(at(0.005, 2)));
    EXPECT_THAT(plain(soonestWithin(modes)), ElementsAre(at(0.05, 2)));
}

// Nothing is drawn and nothing is there: no error has a logarithm.
TEST(BestModes, AreToldOfWhereErrorsAreNothing) {
    const std::vector modes = {mode(0.003, 0)};
    EXPECT_THAT(plain(mostAccurateWithin(modes)), ElementsAre(at(0.005, 0)));
    EXPECT_TRUE(soonestWithin(modes).empty());
    EXPECT_TRUE(mostAccurateWithin({}).empty());
}

TEST(BestModes, AreToldToPeopleAndPrograms) {
    const std::vector modes = {mode(0.003, 0.3), mode(0.015, 0.03)};
    EXPECT_THAT(bestTable(modes), HasSubstr("within a time a frame:\n  5 ms     points"));
    EXPECT_THAT(bestTable(modes),
                HasSubstr("within an error:\n  0.05     points                15 ms"));
    EXPECT_EQ(bestJson(modes)["soonest"][0]["mode"], "points");
    EXPECT_EQ(bestJson(modes)["mostAccurate"][0]["frame"], 0.005);
}

}  // namespace
}  // namespace app

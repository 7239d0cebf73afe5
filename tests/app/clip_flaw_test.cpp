#include "app/choices/clip_flaw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/choices/choice_text.h"
#include "tests/support/meshes.h"

namespace app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// x 0 to 3 m, y 10 down to -10, z of one point at 5.
const timeseries::Grid& grid() {
    static const timeseries::Grid of({timeseries::Axis{"lon", "m", {0, 1, 2, 3}},
                                      timeseries::Axis{"lat", "", {10, 0, -10}},
                                      timeseries::Axis{"level", "Pa", {5}}});
    return of;
}

std::string flaw(const char* clip) { return clipFlaw(parseClip(clip), grid()); }

TEST(ClipFlaw, IsNoneWhereAPointLiesInTheBox) {
    for (const char* clip : {"min:max,min:max,min:max", "0:0,-10:-10,5:5", "-9:0.5,9:99,min:5",
                             "2.5:max,-0.5:0.5,5:max"})
        EXPECT_EQ(flaw(clip), "") << clip;
}

TEST(ClipFlaw, NamesTheAxisThatHasNoneAndWhereItRuns) {
    EXPECT_THAT(flaw("4:9,min:max,min:max"),
                AllOf(HasSubstr("'4:9,min:max,min:max'"), HasSubstr("lon, from 0 to 3 m"),
                      HasSubstr("from 4 to 9")));
    EXPECT_THAT(flaw("min:max,11:max,min:max"),
                AllOf(HasSubstr("lat, from -10 to 10,"), HasSubstr("11 to inf")));
    EXPECT_THAT(flaw("min:max,min:max,6:7"), HasSubstr("level, from 5 to 5 Pa"));
    // Inside the box, but between two points.
    EXPECT_THAT(flaw("0.2:0.8,min:max,min:max"), HasSubstr("lon"));
}

TEST(ClipFlaw, OfAMeshIsOnlyBesideIt) {
    const auto mesh = tests::curvilinear(
        {4, 3, 3}, [](double i, double j, double k) { return glm::dvec3(i + j, 2 * j, k); });
    const auto flawOf = [&](const char* clip) { return clipFlaw(parseClip(clip), *mesh); };
    EXPECT_EQ(flawOf("2.1:2.2,min:max,0.5:9"), "") << "points may lie anywhere between the ends";
    EXPECT_THAT(flawOf("5.5:9,min:max,min:max"), HasSubstr("x, from 0 to 5 m, has none"));
    EXPECT_THAT(flawOf("min:max,min:max,-2:-1"), HasSubstr("z, from 0 to 2"));
}

// Cells have nothing in a plane; a mesh that is flat lies in one.
TEST(ClipFlaw, OfAMeshIsToBeAPlane) {
    const auto meshOf = [](std::size_t layers) {
        return tests::curvilinear({4, 3, layers}, [](double i, double j, double k) {
            return glm::dvec3(i + j, 2 * j, k);
        });
    };
    EXPECT_THAT(clipFlaw(parseClip("min:max,2,min:max"), *meshOf(3)),
                HasSubstr("is a plane along y, and the points of this grid lie in no plane"));
    EXPECT_EQ(clipFlaw(parseClip("min:max,min:max,0:0"), *meshOf(1)), "");
}

// It is in the box of another step, and has points where it is.
TEST(ClipFlaw, OfAMeshThatMovesIsBesideItsPlace) {
    const auto at = [](double x) {
        return tests::curvilinear(
            {4, 3, 3}, [x](double i, double j, double k) { return glm::dvec3(x + i, j, k); });
    };
    const auto moved = gridOfStep(at(0), at(10));
    const auto flawOf = [&](const char* clip) { return clipFlaw(parseClip(clip), *moved); };
    EXPECT_EQ(flawOf("11.5:12.5,min:max,min:max"), "");
    EXPECT_THAT(flawOf("1.5:2.5,min:max,min:max"), HasSubstr("x, from 10 to 13 m, has none"));
    EXPECT_THAT(flawOf("14:15,min:max,min:max"), HasSubstr("x, from 10 to 13 m, has none"));
}

}  // namespace
}  // namespace app

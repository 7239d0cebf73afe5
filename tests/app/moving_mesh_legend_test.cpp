// What a picture says of a step whose points have moved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/picture/picture.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using timeseries::SortedStep;

// All steps are drawn in the box of the first.
TEST(LegendOfAMeshThatMoves, SaysWhereItHasLeftTheBox) {
    const auto at = [](double x) {
        return tests::curvilinear(
            {4, 3, 3}, [x](double i, double j, double k) { return glm::dvec3(x + i, j, k); });
    };
    timeseries::Variable variable;
    variable.time = std::make_shared<const timeseries::TimeAxis>(
        timeseries::TimeAxis{"time", "s", "", std::vector(2, timeseries::TimePoint{})});
    const auto notesOf = [&](const std::shared_ptr<const timeseries::Grid>& grid) {
        const SortedStep step =
            tests::stepOf(grid, [&](std::size_t i) { return static_cast<double>(i); });
        Explorer e;
        e.layers.push_back({RangeSet::parse("2:5"), glm::dvec3(1, 0, 0), 0.5});
        e.model = Model::Points;
        return makeLegend(e, variable, 1, makeScene(e, step, render::PlacedPoints(*grid))).notes;
    };
    const auto first = at(0);
    EXPECT_THAT(notesOf(gridOfStep(first, at(10))),
                testing::Contains("beyond the box that all steps are drawn in: x, 10 to 13 m"));
    for (const auto& within :
         {first, gridOfStep(first, tests::curvilinear({4, 3, 3}, [](double i, double j, double k) {
                                return glm::dvec3(0.5 * i, 0.5 * j, 0.5 * k);
                            }))})
        EXPECT_THAT(notesOf(within), testing::Each(testing::Not(HasSubstr("box"))));
}

}  // namespace
}  // namespace app

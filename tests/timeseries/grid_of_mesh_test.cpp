// Grids whose points a mesh places.
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {
namespace {

TEST(Grid, OfAMeshHasItsPlacesAndBounds) {
    const auto grid = tests::curvilinear(
        {3, 4, 5}, [](double i, double j, double k) { return glm::dvec3(i + j, 2 * j, -k); });
    EXPECT_EQ(grid->size(), (std::array<std::size_t, 3>{3, 4, 5}));
    EXPECT_EQ(grid->count(), 60u);
    EXPECT_EQ(grid->position(1 + 3 * (2 + 4 * 3)), glm::dvec3(3, 4, -3));
    EXPECT_EQ(grid->axes()[0].coordinates, (std::vector<double>{0, 5}));
    EXPECT_EQ(grid->axes()[2].coordinates, (std::vector<double>{-4, 0}));
    EXPECT_FALSE(grid->uniform());
    EXPECT_EQ(*grid, *tests::curvilinear({3, 4, 5}, [](double i, double j, double k) {
        return glm::dvec3(i + j, 2 * j, -k);
    }));
    EXPECT_NE(*grid, *tests::curvilinear({3, 4, 5}, [](double i, double j, double k) {
        return glm::dvec3(i + j, 2 * j + (i == 1 && j == 1 ? 0.25 : 0), -k);
    }));
}

// A mesh that moves: within the first step's box, and its memory counted with the step's.
TEST(Grid, OfAStepLiesInTheBoxOfTheSeries) {
    const auto at = [](double t) {
        return tests::curvilinear({3, 4, 5}, [t](double i, double j, double k) {
            return glm::dvec3(i + t, j, k + 0.1 * t * i);
        });
    };
    const auto series = at(0), same = at(0), later = at(2);
    EXPECT_EQ(gridOfStep(series, same), series);
    const auto moved = gridOfStep(series, later);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->axes(), series->axes());
    EXPECT_EQ(moved->position(7), later->position(7));
    const auto other = tests::curvilinear(
        {4, 4, 5}, [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    EXPECT_FALSE(gridOfStep(series, other)) << "of another size";
    const auto upright = std::make_shared<const Grid>(std::array{
        Axis{"x", "m", {0, 1, 2}}, Axis{"y", "m", {0, 1, 2, 3}}, Axis{"z", "m", {0, 1, 2, 3, 4}}});
    EXPECT_FALSE(gridOfStep(series, upright));
    EXPECT_FALSE(gridOfStep(upright, series));

    const auto bytes = [](std::shared_ptr<const Grid> grid) {
        return SortedStep::build({std::move(grid), std::vector<float>(60, 1), {}}).bytes();
    };
    EXPECT_EQ(bytes(moved), bytes(series) + later->mesh()->bytes());
}

}  // namespace
}  // namespace timeseries

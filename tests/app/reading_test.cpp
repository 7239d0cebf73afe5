#include "app/exploration/reading.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/shown_steps.h"
#include "tests/support/sorted.h"
#include "tests/support/unstructured.h"

namespace app {
namespace {

// A value as the step of its own type has it.
template <typename T>
std::string textOf(T value, const std::string& units) {
    tests::ShownSteps world(2);
    world.dataset.variable.units = units;
    world.steps[0] = std::make_shared<const timeseries::SortedStep>(
        tests::sorted({tests::cube(2), std::vector<T>(8, value), {}}));
    Reading reading;
    reading.value = world.steps[0]->value(0);
    return valueText(reading, world.shown());
}

TEST(ReadingText, AValueHasTheDigitsOfItsOwnType) {
    // The nearest float to 0.1 is not 0.1; of a float it is written so all the same.
    EXPECT_EQ(textOf(0.1f, "K"), "0.1 K");
    EXPECT_EQ(textOf(0.1, "K"), "0.1 K");
    EXPECT_EQ(textOf(0.1 + 0.2, ""), "0.30000000000000004");
    EXPECT_EQ(textOf(std::numeric_limits<std::uint64_t>::max(), ""), "18446744073709551615");
}

TEST(ReadingText, APlaceHasItsIndexAndItsUnitWhereThatIsOne) {
    const tests::ShownSteps world(3);
    Reading reading;
    reading.index = {0, 2, 1};
    reading.position = {0, 2, 0.125};
    EXPECT_EQ(positionText(reading, world.shown(), 1), "2 m   [2]");
    EXPECT_EQ(positionText(reading, world.shown(), 2), "0.125 m   [1]");
    EXPECT_EQ(withUnit("7", "index"), "7");
    EXPECT_EQ(withUnit("7", ""), "7");
}

// Of cells that name their corners there is but a number.
TEST(ReadingText, APlaceWithoutNeighboursHasOneIndex) {
    tests::ShownSteps world(3);
    const auto grid = tests::gridOf(tests::atCells(
        tests::bricks({3, 2, 2}, tests::Cut::Hexahedra,
                      [](double i, double j, double k) { return glm::dvec3(i, j, k); })));
    world.steps[0] = std::make_shared<const timeseries::SortedStep>(
        tests::sorted({grid, std::vector<float>{5, 6}, {}}));
    Reading reading;
    reading.index = {1, 0, 0};
    reading.position = {1.5, 0.5, 0.25};
    EXPECT_EQ(positionText(reading, world.shown(), 0), "1.5 m   [1]");
    EXPECT_EQ(positionText(reading, world.shown(), 1), "0.5 m");
    EXPECT_EQ(positionText(reading, world.shown(), 2), "0.25 m");
}

// As 2 x 2 x 2 points whose columns stand elsewhere.
TEST(ReadingText, APlaceBesideOtherAxesHasItsLongitudeAndLatitudeToo) {
    tests::ShownSteps world(2);
    Reading reading;
    reading.index = {1, 0, 1};
    reading.position = {1, 0, 1};
    EXPECT_EQ(placeLines(reading, world.shown()).size(), 3u);
    EXPECT_FALSE(onEarth(reading, world.steps[0]->grid()));
    const auto earth = std::make_shared<const timeseries::EarthPlaces>(
        std::vector<glm::dvec2>{{10, 50}, {-20.25, 40.5}, {30, 60}, {1e20, 0}});
    const auto grid = std::make_shared<const timeseries::Grid>(tests::cube(2)->withEarth(earth));
    world.steps[0] = std::make_shared<const timeseries::SortedStep>(
        tests::sorted({grid, std::vector<float>(8, 1.0f), {}}));
    const auto lines = placeLines(reading, world.shown());
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_EQ(lines[2].text, positionText(reading, world.shown(), 2));
    EXPECT_EQ(lines[3].name + " " + lines[3].text, "longitude -20.25 \u00b0E");
    EXPECT_EQ(lines[4].name + " " + lines[4].text, "latitude 40.5 \u00b0N");
    EXPECT_EQ(onEarth(reading, *grid), glm::dvec2(-20.25, 40.5));
    reading.index = {1, 1, 0};
    EXPECT_EQ(placeLines(reading, world.shown()).size(), 3u) << "no place";
}

// Lengths along axes that are turned are no coordinates of space, which are told after them.
TEST(ReadingText, APlaceAlongTurnedAxesIsToldInSpaceToo) {
    using timeseries::Axis;
    tests::ShownSteps world(2);
    // i runs along y, j against x.
    const timeseries::CoordinateFrame frame{
        .directions = {0, 1, 0, -1, 0, 0, 0, 0, 1}, .origin = {5, 6, 7}, .names = {"R", "A", "S"}};
    const auto grid = std::make_shared<const timeseries::Grid>(
        std::array{Axis{"i", "mm", {0, 2}}, Axis{"j", "mm", {0, 3}}, Axis{"k", "mm", {0, 4}}},
        frame);
    world.steps[0] = std::make_shared<const timeseries::SortedStep>(
        tests::sorted({grid, std::vector<float>(8, 1.0f), {}}));
    Reading reading;
    reading.index = {1, 1, 0};
    reading.position = grid->position(3);
    std::vector<std::string> lines;
    for (const auto& [name, text] : placeLines(reading, world.shown()))
        lines.push_back(name + " " + text);
    EXPECT_EQ(lines, (std::vector<std::string>{"i 2 mm   [1]", "j 3 mm   [1]", "k 0 mm   [0]",
                                               "R 2 mm", "A 8 mm", "S 7 mm"}));
    EXPECT_EQ(alongAxes(reading, *grid), glm::dvec3(2, 3, 0));
}

TEST(ReadingText, ACellHasItsNumberInTheFileAndItsKind) {
    const auto at = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    timeseries::UnstructuredGrid cells = tests::bricks({3, 2, 2}, tests::Cut::Hexahedra, at);
    EXPECT_EQ(cellText(*tests::gridOf(tests::atCells(cells)), {1, 0, 0}), "1, hexahedron");
    tests::addCell(cells, 13, {0, 1, 3, 6, 7, 9});
    const auto mixed = tests::gridOf(tests::atCells(cells));
    EXPECT_EQ(cellText(*mixed, {1, 0, 0}), "1, hexahedron");
    EXPECT_EQ(cellText(*mixed, {2, 0, 0}), "2, wedge");
    // Corners are of several cells, and points of a lattice of none that has a number.
    EXPECT_EQ(cellText(*tests::gridOf(tests::atPoints(cells)), {1, 0, 0}), "");
    EXPECT_EQ(cellText(*tests::cube(3), {1, 0, 0}), "");
    timeseries::UnstructuredGrid flat = tests::bricks({3, 3, 1}, tests::Cut::Hexahedra, at);
    tests::addCell(flat, 5, {0, 1, 3});
    const auto columns =
        tests::gridOf(meshOfCells(flat, timeseries::UnstructuredShapes(flat), {0, 10, 30}));
    EXPECT_EQ(cellText(*columns, {0, 0, 2}), "0, triangle, level 2");
}

}  // namespace
}  // namespace app

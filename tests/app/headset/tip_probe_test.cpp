#include "app/headset/tip_probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "app/headset/standing.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"
#include "tests/support/unstructured.h"

namespace app::headset {
namespace {

using timeseries::SortedStep;

std::shared_ptr<const SortedStep> shared(SortedStep step) {
    return std::make_shared<const SortedStep>(std::move(step));
}

// Unevenly spaced, one axis descending, one drawn downwards.
std::shared_ptr<const timeseries::Grid> uneven() {
    auto x = tests::axis(5), y = tests::axis(4), z = tests::axis(6);
    x.coordinates = {0, 1, 1.5, 4, 9};
    y.coordinates = {3, 2, 0, -5};
    z.down = true;
    return std::make_shared<timeseries::Grid>(std::array{x, y, z});
}

std::uint64_t nearestOf(const render::PlacedPoints& placed, std::uint64_t count,
                        const glm::dvec3& place) {
    std::uint64_t nearest = 0;
    for (std::uint64_t p = 1; p < count; ++p)
        if (glm::distance(placed.position(p), place) <
            glm::distance(placed.position(nearest), place))
            nearest = p;
    return nearest;
}

TEST(PointAt, IsTheNearestOfAllPoints) {
    const auto grid = uneven();
    const render::PlacedPoints placed(*grid);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> side(-1, 1);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 place =
            placed.boxHalf() * glm::dvec3(side(random), side(random), side(random));
        const std::uint64_t nearest = nearestOf(placed, grid->count(), place);
        const auto at = pointAt(placed, place);
        ASSERT_TRUE(at);
        EXPECT_EQ((*at)[0] + 5 * ((*at)[1] + 4 * (*at)[2]), nearest) << i;
    }
}

// Cells that have no neighbours: looked for among all.
TEST(PointAt, IsTheNearestOfCellsThatNameTheirCorners) {
    const auto grid = tests::gridOf(tests::atCells(
        tests::bricks({9, 7, 5}, tests::Cut::Tetrahedra,
                      [](double i, double j, double k) { return glm::dvec3(i, j + 0.1 * i, k); })));
    const render::PlacedPoints placed(*grid);
    std::mt19937 random(13);
    std::uniform_real_distribution<double> side(-0.9, 0.9);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 place =
            placed.boxHalf() * glm::dvec3(side(random), side(random), side(random));
        const std::uint64_t nearest = nearestOf(placed, grid->count(), place);
        const auto at = pointAt(placed, place);
        if (glm::distance(placed.position(nearest), place) > placed.widest()) continue;
        ASSERT_TRUE(at);
        EXPECT_EQ(*at, (std::array<std::size_t, 3>{nearest, 0, 0})) << i;
    }
}

// Bent, with a hole: the steps from point to point find the way.
TEST(PointAt, IsTheNearestOfAMesh) {
    const auto grid = tests::curvilinear({30, 20, 12}, [](double i, double j, double k) {
        if (i == 12 && j == 9 && k == 5) return glm::dvec3(std::nan(""));
        const double r = 10 + 0.5 * j, angle = 0.1 * i;
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), k * (1 + 0.03 * k));
    });
    const render::PlacedPoints placed(*grid);
    std::mt19937 random(12);
    std::uniform_real_distribution<double> side(-1, 1);
    int found = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 place =
            placed.boxHalf() * glm::dvec3(side(random), side(random), side(random));
        double nearest = 1e9;
        for (std::uint64_t p = 0; p < grid->count(); ++p)
            nearest = std::fmin(nearest, glm::distance(placed.position(p), place));
        const auto at = pointAt(placed, place);
        EXPECT_EQ(at.has_value(), nearest <= placed.widest()) << i;
        if (!at) continue;
        ++found;
        EXPECT_EQ(glm::distance(placed.position((*at)[0] + 30 * ((*at)[1] + 20 * (*at)[2])), place),
                  nearest)
            << i;
    }
    EXPECT_GT(found, 50);
    EXPECT_LT(found, 300) << "in the ring's middle there is none";
}

TEST(PointAt, IsInTheBoxOnly) {
    const render::PlacedPoints placed(*uneven());
    for (int a = 0; a < 3; ++a)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 place(0);
            place[a] = side * placed.boxHalf()[a];
            EXPECT_TRUE(pointAt(placed, 0.999 * place));
            EXPECT_FALSE(pointAt(placed, 1.001 * place));
        }
}

TEST(PointAt, ASheetIsAsThickAsItsCells) {
    const render::PlacedPoints placed(
        timeseries::Grid(std::array{tests::axis(5), tests::axis(5), tests::axis(1)}));
    const double half = 0.5 * placed.widths()[2][0];
    EXPECT_EQ(pointAt(placed, {0, 0, 0.9 * half}), (std::array<std::size_t, 3>{2, 2, 0}));
    EXPECT_FALSE(pointAt(placed, {0, 0, 1.1 * half}));
}

TEST(PointSearch, FindsEachPointInSlicesOfAnySize) {
    const auto grid = tests::cube(7);
    const auto step = shared(tests::noise(grid));
    PointSearch search;
    for (const std::uint64_t slice : {1u, 10u, 1000u})
        for (std::uint64_t i = 0; i < grid->count(); i += 19) {
            std::uint64_t slices = 0;
            do {
                search.look(step, i, slice);
                ++slices;
            } while (!search.ended());
            ASSERT_TRUE(search.found());
            EXPECT_EQ(step->gridIndex()[*search.found()], i);
            EXPECT_EQ(slices, *search.found() / slice + 1) << "and no more than needed";
        }
}

TEST(PointSearch, EndsWhereThereIsNoValue) {
    const auto grid = tests::cube(3);
    const auto step =
        shared(tests::sorted({grid, std::vector<float>{std::vector<float>(27, 5)}, {}},
                             timeseries::RangeSet::parse("0:1")));
    PointSearch search;
    EXPECT_TRUE(search.ended()) << "nothing is looked for";
    search.look(step, 3, 10);
    EXPECT_TRUE(search.ended());
    EXPECT_FALSE(search.found()) << "not kept";
}

TEST(PointSearch, BeginsAnewForAnotherStep) {
    const auto grid = tests::cube(3);
    const auto up = shared(tests::stepOf(grid, [](std::size_t i) { return i; }));
    const auto down = shared(tests::stepOf(grid, [](std::size_t i) { return 26 - i; }));
    PointSearch search;
    search.look(up, 4, 100);
    EXPECT_EQ(search.found(), 4u);
    search.look(down, 4, 10);
    EXPECT_FALSE(search.ended());
    search.look(down, 4, 100);
    EXPECT_EQ(search.found(), 22u);
}

class ProbeOfTips : public testing::Test {
 protected:
    std::shared_ptr<const timeseries::Grid> grid_ = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(4), tests::axis(4), tests::axis(4)},
        timeseries::CoordinateFrame{
            .directions = tests::leaning({1, 0.2, 0}, {-0.3, 1, 0.1}, {0.4, 0, 1}),
            .origin = {},
            .names = {}});
    render::PlacedPoints placed_{*grid_};
    std::optional<Drawn> drawn_ = Drawn{&placed_, shared(tests::noise(grid_)), 7};
    xr::Placement placement_{
        {glm::normalize(glm::dquat(0.8, 0.1, -0.5, 0.3)), glm::dvec3(0.2, 1.3, -0.9)}, 0.4};
    TipProbe probe_;

    glm::dvec3 inStage(std::uint64_t point) const {
        return glm::dvec3(xr::stageFromWorld(placement_) * glm::dvec4(placed_.position(point), 1));
    }
};

TEST_F(ProbeOfTips, ReadsEachPointOfAnObliqueGridWhereItStands) {
    for (std::uint64_t i = 0; i < grid_->count(); ++i) {
        // A little towards the middle: the outermost stand on the box.
        const glm::dvec3 tip = glm::mix(inStage(i), placement_.stageFromVolume.position, 0.01);
        const auto reading = readingAt(*drawn_, placement_, tip);
        ASSERT_TRUE(reading) << i;
        EXPECT_EQ(reading->index[0] + 4 * (reading->index[1] + 4 * reading->index[2]), i);
        EXPECT_EQ(reading->position, grid_->position(i));
        EXPECT_EQ(reading->step, 7u);
        const auto& order = drawn_->sorted->gridIndex();
        const auto at = std::find(order.begin(), order.end(), i) - order.begin();
        EXPECT_EQ(reading->value, drawn_->sorted->value(static_cast<std::uint64_t>(at)));
    }
}

TEST_F(ProbeOfTips, TellsTheCellOfAMesh) {
    auto cells = tests::bricks({4, 3, 3}, tests::Cut::Hexahedra,
                               [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    cells.types[7] = 11;  // a voxel of the same corners, whose order tells another shape
    grid_ = tests::gridOf(tests::atCells(cells));
    placed_ = render::PlacedPoints(*grid_);
    drawn_ = Drawn{&placed_, shared(tests::noise(grid_)), 7};
    for (std::uint64_t i = 0; i < grid_->count(); ++i) {
        const glm::dvec3 tip = glm::mix(inStage(i), placement_.stageFromVolume.position, 0.01);
        const auto reading = readingAt(*drawn_, placement_, tip);
        ASSERT_TRUE(reading) << i;
        EXPECT_EQ(reading->cell, fmt::format("{}, {}", i, i == 7 ? "voxel" : "hexahedron"));
    }
}

TEST_F(ProbeOfTips, TheHandThatWasFirstGoesOnUntilItLeaves) {
    const glm::dvec3 inside = placement_.stageFromVolume.position;
    const glm::dvec3 outside = inside + glm::dvec3(0, 2, 0);
    probe_.update(drawn_, placement_, {inside, outside});
    ASSERT_TRUE(probe_.at());
    EXPECT_EQ(probe_.at()->hand, 0u);
    probe_.update(drawn_, placement_, {inside, inside});
    EXPECT_EQ(probe_.at()->hand, 0u);
    probe_.update(drawn_, placement_, {std::nullopt, inside});
    EXPECT_EQ(probe_.at()->hand, 1u);
    probe_.update(drawn_, placement_, {outside, std::nullopt});
    EXPECT_FALSE(probe_.at());
    probe_.update(std::nullopt, placement_, {inside, inside});
    EXPECT_FALSE(probe_.at());
}

}  // namespace
}  // namespace app::headset

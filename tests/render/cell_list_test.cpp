// Which cells are drawn, and in which order.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "render/splat/cell_pieces.h"
#include "tests/support/cell_worlds.h"

namespace render {
namespace {

using tests::CellWorld;

using Listed = std::vector<std::pair<std::uint32_t, std::size_t>>;  // cell, layer

Listed listed(CellList list, std::uint64_t slice) {
    while (!list.done()) list.goOn(slice);
    Listed all;
    for (const CellOfLayer& of : list.cells()) all.emplace_back(of.cell, of.layer);
    return all;
}

// As candidates lie in the layers.
Listed candidatesOf(const CellWorld& world) {
    Listed all;
    for (std::size_t k = 0; k < world.scene.layers.size(); ++k)
        for (const timeseries::Run& run : world.scene.layers[k].cells.candidates)
            for (std::uint64_t i = run.first; i < run.first + run.count; ++i)
                all.emplace_back(world.scene.cells->cell(i), k);
    return all;
}

void expectInOrder(const CellWorld& world, std::uint64_t slice) {
    const Listed expected = candidatesOf(world);
    const CellRank rank(world.scene, tests::lookFrom({1.2, -2.5, 1}, {40, 30}));
    Listed nearestFirst = expected;
    std::ranges::stable_sort(nearestFirst, {}, [&](const auto& of) { return rank(of.first); });
    for (const unsigned threads : {1u, 2u, 3u})
        for (const std::uint64_t some : {tests::kAllCells, slice}) {
            EXPECT_EQ(listed({world.scene, Channels::Over, 0, nullptr, threads}, some), expected);
            EXPECT_EQ(listed({world.scene, Channels::Over, 0, &rank, threads}, some), nearestFirst);
        }
}

// More than one thread lists, of two layers that have some cells in common and one that has none.
TEST(CellList, HasCandidatesAsTheyLieOrTheNearestFirst) {
    const CellWorld world(tests::noise(tests::cube(45)), {"0.4:0.41,0.8:0.9", "7:8", "0.3:0.405"});
    Listed expected = candidatesOf(world);
    ASSERT_GT(expected.size(), 100'000u);
    expectInOrder(world, 70'001);
    std::erase_if(expected, [&](const auto& of) { return of.second != 2; });
    EXPECT_EQ(listed({world.scene, Channels::Weight, 2}, tests::kAllCells), expected);
}

// Which are put in order without a table of ranks.
TEST(CellList, HasFewTheNearestFirst) {
    const CellWorld world(tests::noise(tests::cube(12)), {"0.4:0.5", "0.3:0.405"});
    ASSERT_LT(candidatesOf(world).size(), 1u << 14);
    expectInOrder(world, 501);
}

}  // namespace
}  // namespace render

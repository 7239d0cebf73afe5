// Boxes of cells against cells one by one.
#include "timeseries/grid/index_boxes.h"

#include <gtest/gtest.h>

#include <random>

#include "timeseries/grid/lattice_levels.h"

namespace timeseries::index_boxes {
namespace {

IndexBox randomBox(std::mt19937& random, std::int64_t least, std::int64_t most) {
    std::uniform_int_distribution<std::int64_t> place(least, most);
    IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
        std::tie(box.first[a], box.last[a]) = std::minmax({place(random), place(random)});
    return box;
}

bool holds(const IndexBox& box, std::int64_t i, std::int64_t j, std::int64_t k) {
    return i >= box.first[0] && i <= box.last[0] && j >= box.first[1] && j <= box.last[1] &&
           k >= box.first[2] && k <= box.last[2];
}

TEST(IndexBoxes, CoverIsWhatIsInBoth) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        const IndexBox box = randomBox(random, -4, 4), by = randomBox(random, -5, 6);
        std::vector<bool> covered, expected;
        cover(covered, box, by);
        for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
            for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j)
                for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i)
                    expected.push_back(holds(by, i, j, k));
        EXPECT_EQ(expected.size(), box.count());
        if (std::ranges::find(expected, true) == expected.end()) expected.clear();
        EXPECT_EQ(covered, expected);
        EXPECT_EQ(common(box, by).isEmpty(), expected.empty());
    }
}

TEST(IndexBoxes, ThoseThatMeetABoxAreFoundOnce) {
    std::mt19937 random(2);
    for (const std::size_t count : {0u, 1u, 8u, 9u, 200u}) {
        std::vector<IndexBox> boxes;
        for (std::size_t i = 0; i < count; ++i) boxes.push_back(randomBox(random, -30, 30));
        const IndexBoxes tree(boxes);
        for (int round = 0; round < 50; ++round) {
            const IndexBox box = randomBox(random, -40, 40);
            std::vector<std::size_t> found, expected;
            tree.forEachMeeting(box, [&](std::size_t which) {
                found.push_back(which);
                return true;
            });
            for (std::size_t i = 0; i < count; ++i)
                if (!common(boxes[i], box).isEmpty()) expected.push_back(i);
            std::ranges::sort(found);
            EXPECT_EQ(found, expected);
            std::size_t asked = 0;
            tree.forEachMeeting(box, [&](std::size_t) { return ++asked < 2; });
            EXPECT_EQ(asked, std::min<std::size_t>(2, expected.size()));
        }
    }
}

TEST(IndexBoxes, CountsStayNumbers) {
    constexpr std::int64_t kFar = std::int64_t{1} << 30;
    EXPECT_EQ((IndexBox{{-kFar, 0, 0}, {kFar - 1, 9, 0}}.count()), 10u * (std::uint64_t{1} << 31));
    EXPECT_EQ((IndexBox{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}.count()),
              std::uint64_t{1} << 62);
}

// Of cells twice as fine along x, three times along y, alike along z, where indices are negative.
TEST(IndexBoxes, LevelsCoverWholeCellsOfThoseBefore) {
    std::vector<LatticeLevel> levels{{{{-3, -2, 0}, {4, 3, 1}}, {{{-3, -2, 0}, {4, 3, 1}}}},
                                     {{{-6, -6, 0}, {9, 11, 1}}, {{{-4, -3, 1}, {-1, 5, 1}}}}};
    EXPECT_EQ(flawOf(levels), "");
    const auto covered = coveredCells(levels);
    std::size_t cell = 0;
    for (std::int64_t k = 0; k <= 1; ++k)
        for (std::int64_t j = -2; j <= 3; ++j)
            for (std::int64_t i = -3; i <= 4; ++i)
                EXPECT_EQ(covered[0][0][cell++],
                          holds(levels[1].boxes[0], 2 * i, 3 * j, k) &&
                              holds(levels[1].boxes[0], 2 * i + 1, 3 * j + 2, k));
    EXPECT_TRUE(covered[1][0].empty());
    levels[1].boxes[0].first[0] = -3;
    EXPECT_EQ(flawOf(levels), "box 0 of level 1 covers parts of cells of level 0");
    levels[1].boxes[0].first[0] = -8;
    EXPECT_EQ(flawOf(levels), "box 0 of level 1 leaves the domain");
    levels[1].boxes = {{{-4, -3, 1}, {1, 5, 1}}, {{0, 3, 0}, {1, 5, 1}}};
    EXPECT_EQ(flawOf(levels), "boxes 0 and 1 of level 1 have cells in common");
    levels[1].boxes.pop_back();
    levels[0].boxes = {{{-3, -2, 0}, {-1, 3, 1}}};
    EXPECT_EQ(flawOf(levels), "box 0 of level 1 lies where level 0 has no cells");
    levels[1].domain.last[1] = 12;
    EXPECT_EQ(flawOf(levels), "the domain of level 1 does not refine that of level 0");
}

}  // namespace
}  // namespace timeseries::index_boxes

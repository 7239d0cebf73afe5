// The ladder of a picture that moves.
#include "app/choices/rung.h"

#include <gtest/gtest.h>

#include <set>

namespace app {
namespace {

TEST(Ladder, DescendsAndHasEveryWayOnce) {
    for (const bool cells : {true, false})
        for (const bool coarse : {true, false})
            for (const bool points : {true, false}) {
                const std::vector<Rung> rungs =
                    ladder({.cells = cells, .points = points, .coarse = coarse, .mostStride = 64});
                const std::size_t sizes = coarse ? 2 : 1;
                EXPECT_EQ(rungs.size(), sizes * ((cells ? 1 : 0) + (points ? 7 : 0)));
                for (std::size_t i = 1; i < rungs.size(); ++i) {
                    EXPECT_FALSE(drawsLess(rungs[i - 1], rungs[i])) << i;
                    EXPECT_NE(rungs[i - 1], rungs[i]);
                    // Of one kind of pixels each draws less than the one before.
                    for (std::size_t k = 0; k < i; ++k)
                        EXPECT_TRUE(rungs[k].across != rungs[i].across ||
                                    drawsLess(rungs[i], rungs[k]));
                }
                EXPECT_TRUE(rungs.empty() || rungs.front().isWhole());
            }
}

TEST(Ladder, OfSquaresHasCoarseCellsAlone) {
    for (const Rung& rung : ladder({.coarsePoints = false}))
        EXPECT_TRUE(rung.across == 1 || rung.model == Model::Cells);
    EXPECT_EQ(ladder({.coarsePoints = false})[1], (Rung{Model::Cells, 1, kCoarse}));
}

TEST(Ladder, FromARungOnDrawsNoMore) {
    const std::vector<Rung> all = ladder({});
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(from(all[i], all), std::vector<Rung>(all.begin() + std::ptrdiff_t(i), all.end()));
    // Where it has none such, of coarse pixels, or of points that are not there yet.
    const std::vector<Rung> fine = ladder({.coarse = false});
    EXPECT_EQ(from({Model::Points, 2, kCoarse}, fine).front(), (Rung{Model::Points, 4}));
    const std::vector<Rung> cells = ladder({.points = false});
    EXPECT_EQ(from({Model::Points, 4}, cells), std::vector{cells.back()});
    EXPECT_TRUE(from({Model::Points, 4}, {}).empty());
}

}  // namespace
}  // namespace app

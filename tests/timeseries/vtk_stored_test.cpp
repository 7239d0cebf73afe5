// Steps on disk whose points lie elsewhere than the series' first ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// 2 x 2 x 2 points, the last one of which is pulled out to `corner`.
fs::path structured(const char* name, double corner) {
    std::string text =
        "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\n"
        "POINTS 8 double\n";
    for (int i = 0; i < 7; ++i) text += fmt::format("{} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    text +=
        fmt::format("{0} {0} {0}\nPOINT_DATA 8\nSCALARS T float\nLOOKUP_TABLE default\n", corner);
    for (int i = 0; i < 8; ++i) text += fmt::format("{}\n", i + 10 * corner);
    const fs::path path = tests::testFolder() / name;
    tests::writeBytes(path, text);
    return path;
}

TEST(StoredVtk, AStepThatLiesElsewhereInASeriesKeepsItsPlaces) {
    const auto store =
        std::make_shared<StepStore>(tests::freshFolder() / "steps", StoreKind::Cache,
                                    StepStore::kNoBudget, std::chrono::milliseconds(0));
    const std::vector<fs::path> both{structured("s1.vtk", 1), structured("s2.vtk", 2)};
    const auto maker = [&](std::vector<fs::path> paths) {
        return std::make_unique<StepMaker>(openReader(paths), 0, RangeSet::everything(),
                                           StepStores{{store}, store, 1});
    };
    // Each by itself is kept; in the series the second one's points have moved.
    for (const fs::path& path : both) EXPECT_EQ(maker({path})->keep(0), StepMaker::Kept::Written);
    const auto series = maker(both);
    EXPECT_EQ(series->keep(0), StepMaker::Kept::Before);
    EXPECT_EQ(series->keep(1), StepMaker::Kept::Moves);
    const auto moved = series->make(1);
    EXPECT_FALSE(moved->file());
    EXPECT_EQ(moved->grid().position(7), glm::dvec3(2));
    EXPECT_EQ(toDouble(moved->value(7)), 27);
}

}  // namespace
}  // namespace timeseries

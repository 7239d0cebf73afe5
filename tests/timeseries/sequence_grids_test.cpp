// How the grids of a series' files are to the first's, which is found out where it is asked for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/xdmf_text.h"
#include "timeseries/readers/sequence_reader.h"

namespace timeseries::sequence_grids {
namespace {

using Are = StepGrids::Are;
using Path = std::filesystem::path;
using namespace tests::xdmf;

const std::string kFour = "0 0 0 1 0 0 0 1 0 0 0 1", kFourElsewhere = "0 0 0 2 0 0 0 1 0 0 0 1",
                  kFive = kFour + " 1 1 1";

// Tetrahedra of these corners, with a value at each point.
std::string tets(const std::string& places, const std::string& corners, const std::string& time) {
    const auto count = [](const std::string& numbers) {
        return 1 + std::ranges::count(numbers, ' ');
    };
    const std::string points = fmt::format("{}", count(places) / 3),
                      cells = fmt::format("{}", count(corners) / 4);
    return grid("<Time Value=\"" + time + "\"/>\n" +
                "<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"" + cells + "\">" +
                item(cells + " 4", corners) + "</Topology>\n<Geometry>" +
                item(points + " 3", places) + "</Geometry>\n" +
                attribute("p", "Node", item(points, numbersTo(std::stoi(points)))));
}
std::string step(int time, const std::string& places = kFour,
                 const std::string& corners = "0 1 2 3") {
    return tets(places, corners, fmt::format("{}", time));
}

struct Told {
    StepGrids grids;
    int opened;  // for the question
};
Told gridsOf(const std::vector<std::string>& files) {
    std::vector<Path> paths;
    for (const std::string& text : files) {
        paths.push_back(tests::testFolder() / fmt::format("f{}.xdmf", paths.size()));
        std::filesystem::rename(tests::xdmf::written(inTime(text)), paths.back());
    }
    int opened = 0;
    const auto reader = openSequence(paths, [&](const Path& path) {
        ++opened;
        return openReader(std::span(&path, 1));
    });
    EXPECT_EQ(opened, static_cast<int>(paths.size()));
    const StepGrids grids = reader->stepGrids(0);
    return {grids, opened - static_cast<int>(paths.size())};
}

TEST(SequenceGrids, OfAsManyPointsTheMiddleAndTheLastFileTell) {
    const Told same = gridsOf({step(0), step(1), step(2)});
    EXPECT_EQ(same.grids.are, Are::One);
    EXPECT_EQ(same.opened, 2);
    EXPECT_EQ(gridsOf({step(0), step(1), step(2, kFourElsewhere)}).grids.are, Are::Moved);
    EXPECT_EQ(gridsOf({step(0), step(1, kFourElsewhere), step(2)}).grids.are, Are::Moved);
    const Told joined = gridsOf({step(0), step(1), step(2, kFour, "0 1 2 3 0 1 2 3")});
    EXPECT_EQ(joined.grids.are, Are::Own);
    EXPECT_EQ(joined.grids.least, 4u);
    EXPECT_EQ(joined.grids.most, 4u);
}

TEST(SequenceGrids, OtherNumbersOfPointsAreTheirOwnAndNoFileIsOpened) {
    const Told told = gridsOf({step(0), step(1, kFive, "0 1 2 3 1 2 3 4"), step(2)});
    EXPECT_EQ(told.grids.are, Are::Own);
    EXPECT_EQ(told.grids.least, 4u);
    EXPECT_EQ(told.grids.most, 5u);
    EXPECT_EQ(told.opened, 0);
}

TEST(SequenceGrids, StepsOfOneFileMayMoveToo) {
    EXPECT_EQ(gridsOf({step(0), step(1) + step(2)}).grids.are, Are::One);
    EXPECT_EQ(gridsOf({step(0), step(1) + step(2, kFourElsewhere)}).grids.are, Are::Moved);
    const Told own = gridsOf({step(0), step(1) + step(2, kFive, "0 1 2 3 1 2 3 4")});
    EXPECT_EQ(own.grids.are, Are::Own);
    EXPECT_EQ(own.grids.most, 0u) << "not known of all";
}

}  // namespace
}  // namespace timeseries::sequence_grids

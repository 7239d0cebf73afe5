// A series of VTK files, whose files are opened one by one, by one that is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/files/dataset.h"
#include "tests/support/vtk_files.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

OpenDataset openVtkNamed(const fs::path& named) { return openDataset(std::span(&named, 1), ""); }

fs::path imageNumbered(const fs::path& folder, int number, const std::string& array) {
    const fs::path path = folder / fmt::format("a_{}.vti", number);
    tests::writeBytes(path, tests::imageText({.points = tests::dataArray(
                                                  "Int32", array, std::vector<int>(12, number))}));
    return path;
}

TEST(VtkDataset, AFileThatIsNamedIsLookedAtWithItsSeries) {
    const auto folder = tests::freshFolder();
    imageNumbered(folder, 1, "p");
    const fs::path misfit = imageNumbered(folder, 2, "q"), fits = imageNumbered(folder, 3, "p");
    // One that fits opens the series, of which the other's step is refused.
    const OpenDataset series = openVtkNamed(fits);
    EXPECT_EQ(series.stepCount(), 3u);
    EXPECT_EQ(series.defaultStep, 2u);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(series.reader->read(0, 2).values)[0], 3);
    EXPECT_THROW(series.reader->read(0, 1), timeseries::FileError);
    EXPECT_THAT(series.series.notes, IsEmpty());
    EXPECT_EQ(openVtkNamed(folder).stepCount(), 3u);
    // One that does not is opened alone.
    const OpenDataset alone = openVtkNamed(misfit);
    EXPECT_EQ(alone.variable.name, "q");
    EXPECT_EQ(alone.stepCount(), 1u);
    EXPECT_THAT(alone.series.notes, ElementsAre(HasSubstr("only this file is opened, not the")));
    // One that is damaged says so itself.
    tests::writeBytes(misfit, "<VTKFile type=\"ImageData\"><ImageData");
    EXPECT_EQ(openVtkNamed(fits).stepCount(), 3u);
    try {
        openVtkNamed(misfit);
        ADD_FAILURE();
    } catch (const timeseries::FileError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith(misfit.string() + ": line 1"));
    }
}

}  // namespace
}  // namespace app

// What is looked into, and what is opened.
#include "app/files/folder_listing.h"

#include <gtest/gtest.h>

#include "tests/support/files.h"

namespace app {
namespace {

TEST(FolderListing, AFolderThatIsADataSetIsNoneToLookInto) {
    const std::filesystem::path folder = tests::freshFolder(), store = folder / "store.zarr";
    std::filesystem::create_directories(store);
    EXPECT_TRUE(isFolder(store));
    EXPECT_FALSE(opens(store));
    tests::writeBytes(store / ".zgroup", "{}");
    EXPECT_FALSE(isFolder(store));
    EXPECT_TRUE(opens(store));
    EXPECT_TRUE(isFolder(folder));
    EXPECT_FALSE(isFolder(store / ".zgroup"));
}

TEST(FolderListing, APlotfileOfAmrexIsADataSet) {
    const std::filesystem::path folder = tests::freshFolder(), plotfile = folder / "plt00000";
    std::filesystem::create_directories(plotfile / "Level_0");
    EXPECT_TRUE(isFolder(plotfile));
    tests::writeBytes(plotfile / "Header", "HyperCLaw-V1.1\n");
    EXPECT_FALSE(isFolder(plotfile));
    EXPECT_TRUE(opens(plotfile));
    EXPECT_TRUE(opens(plotfile / "Header"));
    EXPECT_TRUE(isFolder(plotfile / "Level_0"));
    EXPECT_TRUE(isFolder(folder));
}

}  // namespace
}  // namespace app

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

TEST(FolderListing, ACaseOfOpenFoamIsADataSet) {
    const std::filesystem::path folder = tests::freshFolder(), simulation = folder / "cavity";
    std::filesystem::create_directories(simulation / "system");
    std::filesystem::create_directories(simulation / "0");
    EXPECT_TRUE(isFolder(simulation));
    tests::writeBytes(simulation / "system/controlDict", "");
    tests::writeBytes(simulation / "cavity.foam", "");
    EXPECT_FALSE(isFolder(simulation));
    for (const char* name : {"", "system/controlDict", "cavity.foam"})
        EXPECT_TRUE(opens(simulation / name)) << name;
    EXPECT_TRUE(isFolder(simulation / "0"));
    EXPECT_TRUE(isFolder(folder));
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

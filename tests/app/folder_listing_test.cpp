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

}  // namespace
}  // namespace app

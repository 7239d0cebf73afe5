// What the menu says of files that were open before.
#include "app/panels/header.h"

#include <gtest/gtest.h>

namespace app::panels {
namespace {

TEST(Header, TellsFilesOfOneNameApartByTheirFolders) {
    const std::vector<Named> recent = {{"/a/run.nc"}, {"/b/run.nc"}, {"/b/other.nc"}};
    EXPECT_EQ(recentNotes(recent), (std::vector<std::string>{"/a", "/b", "recent"}));
}

}  // namespace
}  // namespace app::panels

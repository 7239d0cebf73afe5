// What is asked before files are written over.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/files.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

class ExportFiles : public testing::Test {
 protected:
    ExportFiles() {
        std::filesystem::current_path(folder_);
        desk_.emplace(tests::World{.steps = 3});
        desk_->interface.obey(desk_->exploration, Command::Export);
        desk_->frames(3);
    }
    // Enter in the field of the path; where to export is asked for then.
    std::optional<std::filesystem::path> enter() {
        bool& down = ImGui::GetIO().KeysDown[static_cast<int>(Key::Enter)];
        down = true;
        desk_->frame(KeyPress{.key = Key::Enter});
        const auto asked = desk_->asked.exportTo;
        down = false;
        desk_->frames(4);
        return asked;
    }

    const std::filesystem::path folder_ = tests::freshFolder();
    std::optional<tests::PanelsDesk> desk_;
};

// As the window suggests, into world.png: world_0.png, world_1.png and world_2.png.
TEST_F(ExportFiles, AreWrittenWhereThereAreNone) {
    tests::writeBytes(folder_ / "world.png", "not one of them");
    EXPECT_EQ(enter(), folder_ / "world.png");
}

TEST_F(ExportFiles, AreAskedAboutWhereTheyExist) {
    tests::writeBytes(folder_ / "world_1.png", "");
    EXPECT_EQ(enter(), std::nullopt);
    EXPECT_EQ(enter(), folder_ / "world.png") << "asked for again";
}

}  // namespace
}  // namespace app::panels

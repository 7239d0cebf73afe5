// What is said of a path that is typed: nothing is there, or files would be written over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/choices/sweep_edits.h"
#include "app/panels/field_text.h"
#include "app/panels/file_panel.h"
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
    void press() {
        bool& down = ImGui::GetIO().KeysDown[static_cast<int>(Key::Enter)];
        down = true;
        desk_->frame(KeyPress{.key = Key::Enter});
        pressed_ = desk_->asked;
        down = false;
        desk_->frames(4);
    }
    // Enter in the field of the path; where to export is asked for then.
    std::optional<std::filesystem::path> enter() {
        press();
        if (!pressed_.exportTo) return std::nullopt;
        return pressed_.exportTo->output;
    }

    const std::filesystem::path folder_ = tests::freshFolder();
    std::optional<tests::PanelsDesk> desk_;
    Requests pressed_;
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

// The panel stays, with what was typed, and is right at the next try.
TEST_F(ExportFiles, AreNotWrittenWhereNoFolderIs) {
    desk_->type((folder_ / "later/world.png").string());
    EXPECT_EQ(enter(), std::nullopt);
    EXPECT_EQ(enter(), std::nullopt);
    std::filesystem::create_directory(folder_ / "later");
    EXPECT_EQ(enter(), folder_ / "later/world.png");
}

// Whoever may write anywhere cannot there, either.
TEST_F(ExportFiles, AreAskedForAnewWhereNothingCanBeWritten) {
    desk_->type("/proc/world.png");
    EXPECT_EQ(enter(), std::nullopt);
    EXPECT_EQ(enter(), std::nullopt);
    desk_->type((folder_ / "world.png").string());
    EXPECT_EQ(enter(), folder_ / "world.png");
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "what was tried is gone";
}

TEST_F(ExportFiles, AreAskedAboutWhereTheyAreVeryMany) {
    Explorer e = desk_->exploration.explorer();
    setSweep(e, timeseries::SweepSettings{.animation = timeseries::RangeSet::parse("0:1"),
                                          .timerSteps = 100'000'000});
    e.play.timeMoves = e.play.sweepMoves = true;
    desk_->exploration.edit(e);
    desk_->frames(3);
    EXPECT_EQ(enter(), std::nullopt);
    EXPECT_EQ(enter(), folder_ / "world.png") << "asked for again";
}

TEST_F(ExportFiles, EndAsPicturesDo) {
    desk_->type("world.jpg");
    EXPECT_EQ(enter(), std::nullopt);
    desk_->type("world.exr");
    EXPECT_EQ(enter(), folder_ / "world.exr");
}

// As the window's picture, unless another size is typed below the list.
TEST_F(ExportFiles, HaveTheSizeThatIsAskedFor) {
    const glm::ivec2 shown = desk_->exploration.explorer().size;
    ASSERT_TRUE(enter());
    EXPECT_EQ(pressed_.exportTo->size, shown);
    const auto typeSize = [&](const char* size) {
        desk_->interface.obey(desk_->exploration, Command::Export);
        desk_->frames(3);
        const Rect window = desk_->layout().window;  // the panel is 640 x 520 in its middle
        desk_->click(window.centre() + glm::vec2(-320 + 20 + 112, 260 - 104 + 23));
        desk_->type(size);
    };
    typeSize("641x480");
    ASSERT_TRUE(enter()) << "in the field of the size, too";
    EXPECT_EQ(pressed_.exportTo->size, glm::ivec2(641, 480));
    EXPECT_EQ(desk_->exploration.explorer().size, shown) << "the window's stays";
    typeSize("641");
    EXPECT_FALSE(enter());
    EXPECT_FALSE(enter()) << "asking again does not help";
}

TEST(ExportedText, SaysWhereStepsPlayOtherwiseThanTheyAreExported) {
    const FrameFiles one("a.png", {}, {4}, 10), several("a.png", {}, {4, 5, 6}, 10);
    timeseries::CursorSettings play;
    EXPECT_EQ(exportedText(one, play), "a.png");
    EXPECT_EQ(exportedText(several, play), "3 pictures: a_4.png to a_6.png");
    play.direction = timeseries::Direction::Backward;
    EXPECT_EQ(exportedText(one, play), "a.png");
    EXPECT_EQ(exportedText(several, play), "3 pictures, forwards once: a_4.png to a_6.png");
    play.direction = timeseries::Direction::Forward;
    play.ending = timeseries::Ending::PingPong;
    EXPECT_EQ(exportedText(several, play), "3 pictures, forwards once: a_4.png to a_6.png");
}

TEST_F(ExportFiles, OfAFolderMadeWhileItIsAskedAreAskedAbout) {
    desk_->type((folder_ / "later/world.png").string());
    EXPECT_EQ(enter(), std::nullopt);
    std::filesystem::create_directory(folder_ / "later");
    tests::writeBytes(folder_ / "later/world_2.png", "");
    EXPECT_EQ(enter(), std::nullopt);
    EXPECT_EQ(enter(), folder_ / "later/world.png");
}

// How many corners of what was drawn last are red, as what is to be known before pressing is.
int redCorners() {
    ImGui::Render();
    const ImDrawData& drawn = *ImGui::GetDrawData();
    int count = 0;
    for (int list = 0; list < drawn.CmdListsCount; ++list)
        for (const ImDrawVert& corner : drawn.CmdLists[list]->VtxBuffer)
            if (corner.col == kError) ++count;
    return count;
}

TEST_F(ExportFiles, TellBesideTheButtonWhichStepsTheyLeaveOut) {
    const auto redWith = [&](std::int64_t ticks) {
        Explorer e = desk_->exploration.explorer();
        setSweep(e, timeseries::SweepSettings{.animation = timeseries::RangeSet::parse("0:1"),
                                              .timerSteps = ticks});
        e.play.timeMoves = e.play.sweepMoves = true;
        desk_->exploration.edit(e);
        desk_->frames(3);
        return redCorners();
    };
    const int none = redWith(3);
    EXPECT_GT(redWith(2), none + 4 * 20) << "letters of a sentence";
}

// Dear ImGui's fields hold neither of these as it is.
TEST_F(ExportFiles, HaveNamesOfAnyCharacters) {
    const auto typeAnew = [&](std::u32string_view text) {
        desk_->type("x");  // in place of all that stood there
        for (const char32_t typed : text) {
            for (const char32_t c : fieldCharacters(typed)) ImGui::GetIO().AddInputCharacter(c);
            desk_->frame(KeyPress{.key = key('Z')});
        }
    };
    typeAnew(U"é日本😀.png");
    EXPECT_EQ(enter(), folder_ / "xé日本😀.png");
}

class FileToOpen : public ExportFiles {
 protected:
    FileToOpen() {
        desk_.emplace();
        desk_->interface.obey(desk_->exploration, Command::Open);
        desk_->frames(3);
    }
};

TEST_F(FileToOpen, IsAskedForUntilItIsThere) {
    desk_->type((folder_ / "field.nc").string());
    press();
    EXPECT_THAT(pressed_.open, testing::IsEmpty());
    tests::writeBytes(folder_ / "field.nc", "");
    press();
    EXPECT_THAT(pressed_.open, testing::ElementsAre(folder_ / "field.nc"));
}

TEST_F(FileToOpen, MayBeAPatternOfNames) {
    desk_->type((folder_ / "field_*.nc").string());
    press();
    EXPECT_THAT(pressed_.open, testing::ElementsAre(folder_ / "field_*.nc"));
}

}  // namespace
}  // namespace app::panels

// Exports that do not come to their end.
#include <csignal>
#include <set>

#include "tests/ui/desk_test.h"
#include "tests/ui/waiting.h"

namespace ui {
namespace {

class DeskExports : public DeskTest {
 protected:
    // Its animation has more pictures than anyone waits for.
    void SetUp() override {
        DeskTest::SetUp();
        if (IsSkipped()) return;
        std::filesystem::create_directory(temporary());
        desk_.emplace(
            screen(), folder(),
            std::vector<std::string>{demo().string(), "--sweep=300:1600", "--delta=50",
                                     "--timer-steps=10000", "--step=2:14:6"},
            std::map<std::string, std::optional<std::string>>{{"TMPDIR", temporary().string()}});
        desk_->waitForTitle("pool_fire_T.nc · T");
        desk_->resize({900, 600});
        at_ = placesOf({900, 600});
        told_ = app::panels::exportPlace(at_.window.picture, 1);
        quiet_ = desk_->settled();
    }

    // Starts it, and returns its process once a few pictures are there.
    pid_t startExport() {
        desk_->press("ctrl+e");
        desk_->press("ctrl+a");
        desk_->type("movie.png");
        desk_->press("Return");
        desk_->waitFor("pictures are there", [&] { return pictures().size() > 3; });
        const std::vector<pid_t> children = childrenOf(desk_->process().id());
        return children.size() == 1 ? children.front() : throw std::runtime_error("no one child");
    }
    std::set<std::filesystem::path> pictures() const {
        std::set<std::filesystem::path> files;
        for (const auto& each : std::filesystem::directory_iterator(folder()))
            if (each.path().filename().string().starts_with("movie")) files.insert(each.path());
        return files;
    }
    // Nothing of an export is left but whole pictures, each the window's and under its number.
    void expectWholePictures() const {
        const std::set<std::filesystem::path> files = pictures();
        EXPECT_GT(files.size(), 2u);  // of those waited for, one may have been half
        std::size_t number = 0;
        for (const auto& file : files) {
            EXPECT_EQ(file.filename(), fmt::format("movie_{:04}.png", number++));
            EXPECT_EQ(readShot(file).size, glm::ivec2(at_.window.picture.size())) << file;
        }
        EXPECT_TRUE(std::filesystem::is_empty(temporary()));
    }
    std::filesystem::path temporary() const { return folder() / "temporary"; }
    Shot told() { return desk_->shot(told_); }

    std::optional<Driver> desk_;
    Places at_;
    app::panels::Rect told_;  // where it is told how far an export is
    Shot quiet_;              // before
};

TEST_F(DeskExports, TellsHowFarItIsAndIsCancelled) {
    const pid_t child = startExport();
    const Shot early = told();
    ASSERT_GT(differing(early, part(quiet_, told_)), 1000u);
    desk_->waitFor("its progress changes", [&] { return told() != early; });
    // Nothing of it lies over the legend.
    app::panels::Rect legend = at_.window.picture;
    legend.max.y = told_.min.y - 200;
    EXPECT_EQ(differing(desk_->shot(legend), part(quiet_, legend)), 0u);
    // The button lies at the right end of what is told.
    desk_->click({told_.max.x - 42, told_.centre().y});
    waitUntil("the export ends", [&] { return !isRunning(child); });
    desk_->waitFor("its end is told", [&] {
        return differing(desk_->shot(at_.messages), part(quiet_, at_.messages)) > 1000;
    });
    waitUntil("it is cleared away", [&] { return std::filesystem::is_empty(temporary()); });
    expectWholePictures();
}

TEST_F(DeskExports, EndsWithTheWindow) {
    const pid_t child = startExport();
    desk_->close();
    EXPECT_EQ(desk_->process().exitCode(), 0);
    EXPECT_FALSE(isRunning(child));
    expectWholePictures();
    std::size_t told = 0;
    const std::string errors = desk_->process().errors();
    ASSERT_EQ(std::sscanf(errors.c_str(), "isochron: Export cancelled after %zu of", &told), 1)
        << errors;
    EXPECT_LE(told, pictures().size());
    EXPECT_GE(told + 2, pictures().size());  // the child may have been ahead of what it told
    EXPECT_EQ(std::ranges::count(errors, '\n'), 1) << errors;
}

TEST_F(DeskExports, EndsWithAProgramThatIsTerminated) {
    const pid_t child = startExport();
    desk_->process().signal(SIGTERM);
    EXPECT_EQ(desk_->process().exitCode(), 0);
    EXPECT_FALSE(isRunning(child));
    expectWholePictures();
}

// Nobody is left to end it: it finds out with its next picture.
TEST_F(DeskExports, EndsAfterAProgramThatIsKilled) {
    const pid_t child = startExport();
    desk_->process().signal(SIGKILL);
    waitUntil("the export ends", [&] { return !isRunning(child); });
    for (const auto& file : pictures()) EXPECT_EQ(file.extension(), ".png");
}

}  // namespace
}  // namespace ui

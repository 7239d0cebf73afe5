// What panels ask for, done.
#include "app/desktop/file_actions.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/choices/session.h"
#include "app/choices/user_files.h"
#include "render/gl/headless_context.h"
#include "tests/support/built_paths.h"
#include "tests/support/files.h"
#include "tests/support/variable.h"

namespace app::desktop {
namespace {

// For the window and for the headset's panel: one function serves both.
TEST(FileActions, DiscardTheSessionThatWasLeft) {
    const auto home = tests::freshFolder();
    const tests::Variable state("XDG_STATE_HOME", home), config("XDG_CONFIG_HOME", home);
    const pid_t child = fork();
    if (child == 0) {
        Explorer left;
        left.files = {home / "gone.nc"};
        Autosave(stateFolder()).save(left, {});
        _exit(0);
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);

    const render::gl::HeadlessContext context;
    Canvas canvas;
    Exploration exploration({});
    panels::Interface interface([] {});
    std::optional<ExportJob> exporting;
    FileActions fileActions(exploration, canvas, exporting, [](const std::string&) {});
    const auto file = fileActions.offers().autosave;
    ASSERT_TRUE(std::filesystem::exists(file));
    panels::Requests requests;
    requests.discardLeft = true;
    fileActions.serve(requests, interface);
    EXPECT_TRUE(fileActions.offers().autosave.empty());
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(FileActions, ASavedSessionTellsTheErrorAndIsReadWithoutIt) {
    const auto home = tests::freshFolder();
    const tests::Variable state("XDG_STATE_HOME", home), config("XDG_CONFIG_HOME", home);
    const render::gl::HeadlessContext context;
    Canvas canvas;
    Exploration exploration({});
    std::optional<ExportJob> exporting;
    FileActions fileActions(exploration, canvas, exporting, [](const std::string&) {});
    for (const std::optional<double> error :
         {std::optional<double>(), std::optional(0.03125), std::optional(kInfinity)}) {
        const auto file = home / "s.json";
        fileActions.save(file, error);
        const auto session = nlohmann::json::parse(std::ifstream(file));
        EXPECT_EQ(session.contains("opticalDepthError"), error.has_value());
        if (error) {
            EXPECT_EQ(session["opticalDepthError"],
                      *error == kInfinity ? nlohmann::json("inf") : nlohmann::json(*error));
        }
        EXPECT_EQ(readSession(file), exploration.explorer());
    }
}

// Who opens them anew has other data than the window shows.
TEST(FileActions, NothingIsExportedOfFilesThatAreOthersNow) {
    const auto home = tests::freshFolder();
    const tests::Variable state("XDG_STATE_HOME", home), config("XDG_CONFIG_HOME", home);
    const auto data = home / "fire.nc";
    std::filesystem::copy_file(tests::demo(), data);
    const render::gl::HeadlessContext context;
    Canvas canvas;
    Exploration exploration({});
    exploration.open({data});
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!exploration.shown() && std::chrono::steady_clock::now() < end)
        exploration.advance(std::chrono::milliseconds(1));
    ASSERT_TRUE(exploration.shown());
    std::optional<ExportJob> exporting;
    FileActions fileActions(exploration, canvas, exporting, [](const std::string&) {});
    const auto lastTold = [&] { return exploration.messages().back().text; };
    fileActions.save(home / "before.json");
    EXPECT_EQ(lastTold(), "Saved " + (home / "before.json").string());
    std::filesystem::remove(data);
    std::filesystem::copy_file(tests::demo(), data);
    const std::string changed =
        data.string() + ": it has changed since it was opened: open it again";
    fileActions.exportTo(home / "a.png", {64, 48});
    EXPECT_FALSE(exporting);
    EXPECT_EQ(lastTold(), changed);
    exploration.forgetMessage(exploration.messages().back().number);
    fileActions.save(home / "after.json");
    EXPECT_EQ(lastTold(), changed);
    EXPECT_TRUE(std::filesystem::exists(home / "after.json"));
}

}  // namespace
}  // namespace app::desktop

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
    for (const std::optional<double> error : {std::optional<double>(), std::optional(0.03125)}) {
        const auto file = home / "s.json";
        fileActions.save(file, error);
        const auto session = nlohmann::json::parse(std::ifstream(file));
        EXPECT_EQ(session.contains("opticalDepthError"), error.has_value());
        if (error) {
            EXPECT_EQ(session["opticalDepthError"], *error);
        }
        EXPECT_EQ(readSession(file), exploration.explorer());
    }
}

}  // namespace
}  // namespace app::desktop

// What panels ask for, done.
#include "app/desktop/file_actions.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <optional>

#include "app/choices/user_files.h"
#include "render/gl/headless_context.h"
#include "tests/support/files.h"

namespace app::desktop {
namespace {

// For the window and for the headset's panel: one function serves both.
TEST(FileActions, DiscardTheSessionThatWasLeft) {
    const auto home = tests::freshFolder();
    setenv("XDG_STATE_HOME", home.c_str(), 1);
    setenv("XDG_CONFIG_HOME", home.c_str(), 1);
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

}  // namespace
}  // namespace app::desktop

#include "app/panels/keys.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "tests/support/built_paths.h"

namespace app::panels {
namespace {

TEST(Keys, NoTwoCommandsShareAKey) {
    std::set<std::tuple<int, bool, bool>> seen;
    for (const Binding& b : bindings())
        EXPECT_TRUE(seen.insert({static_cast<int>(b.key), b.ctrl, b.shift}).second)
            << static_cast<int>(b.key);
}

TEST(Keys, EveryBindingIsObeyed) {
    for (const Binding& b : bindings()) EXPECT_EQ(commandOf({b.key, b.ctrl, b.shift}), b.command);
    EXPECT_EQ(commandOf({Key::Space, true}), std::nullopt);
}

TEST(Keys, HeldDownStepAndUndoButDoNotToggle) {
    EXPECT_EQ(commandOf({.key = Key::Right, .repeated = true}), Command::StepForward);
    EXPECT_EQ(commandOf({.key = key('Z'), .ctrl = true, .repeated = true}), Command::Undo);
    EXPECT_EQ(commandOf({.key = Key::Space, .repeated = true}), std::nullopt);
    EXPECT_EQ(commandOf({.key = Key::F12, .repeated = true}), std::nullopt);
}

TEST(Keys, TheReadmeHasTheTableThatTheHelpShows) {
    std::ifstream file(tests::sourceFolder() / "README.md");
    std::stringstream readme;
    readme << file.rdbuf();
    for (const HelpLine& line : helpLines()) {
        const std::string row =
            "| " + std::string(line.keys) + " | " + std::string(line.does) + " |";
        EXPECT_NE(readme.str().find(row), std::string::npos) << row;
    }
}

}  // namespace
}  // namespace app::panels

#include "app/headset/help_text.h"

#include <gmock/gmock.h>

namespace app::headset {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(HelpText, PromisesNoStickToAControllerWithoutOne) {
    const std::string text =
        helpText("Monado", {.text = "Grab the volume: Select", .sticks = false, .oneButton = true});
    EXPECT_THAT(text, testing::StartsWith("In Monado\nGrab the volume: Select\n"));
    for (const char* other : {"tick", "trigger"}) EXPECT_THAT(text, Not(HasSubstr(other)));
    EXPECT_THAT(text, HasSubstr("on this panel"));
    EXPECT_THAT(text, HasSubstr("a tap keeps it"));
}

TEST(HelpText, TellsOfSticksAndTheTriggerWhereTheyAre) {
    const std::string text =
        helpText("SteamVR", {.text = "Grab: Grip", .sticks = true, .oneButton = false});
    for (const char* part : {"Right stick: values", "left stick: time", "the trigger keeps it"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST(HelpText, BeforeThereAreControllersPromisesNothing) {
    EXPECT_EQ(helpText("Monado", {}), "In Monado\nNo controllers yet");
}

}  // namespace
}  // namespace app::headset

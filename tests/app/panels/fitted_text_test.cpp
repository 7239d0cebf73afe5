// Texts as panels draw them.
#include "app/panels/fitted_text.h"

#include <gtest/gtest.h>

#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

// As names of old files are: Dear ImGui takes the bytes behind one of Latin-1 for its rest.
TEST(FittedText, OfNoUtf8LosesNoCharacter) {
    tests::PanelsDesk desk;
    ImFont& font = *desk.theme().text;
    const float whole = widthOf(font, "t\uFFFDl\uFFFDphone.csv");
    EXPECT_EQ(widthOf(font, "t\xe9l\xe9phone.csv"), whole);
    EXPECT_GT(whole, widthOf(font, "tlphone.csv"));
    EXPECT_EQ(fitting(font, "t\xe9l\xe9phone.csv", whole), "t\xe9l\xe9phone.csv");
}

}  // namespace
}  // namespace app::panels

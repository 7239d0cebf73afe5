// The card beside a pointer that rests.
#include "app/panels/hover_tip.h"

#include <gtest/gtest.h>

#include <array>

#include "app/panels/widgets.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

TEST(HoverTip, HasRoomForTheNamesOfAxes) {
    const tests::PanelsDesk desk;
    ImFont& font = *ImGui::GetIO().Fonts->Fonts[0];
    const std::array<std::string, 3> names{"longitude", "lat", "pressure_level"};
    const float column = nameColumn(font, names, 1);
    for (const std::string& name : names) EXPECT_EQ(fitting(font, name, column), name);
    EXPECT_LT(column, widthOf(font, names[2]) + 1) << "no wider than the longest";
    const std::array<std::string, 1> endless{std::string(300, 'm')};
    EXPECT_LT(nameColumn(font, endless, 1), 200) << "the numbers beside it keep their place";
}

}  // namespace
}  // namespace app::panels

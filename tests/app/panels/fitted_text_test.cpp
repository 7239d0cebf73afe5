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

TEST(FittedText, KeepsAsMuchOfABeginningAsFits) {
    tests::PanelsDesk desk;
    ImFont& font = *desk.theme().text;
    const std::string text = "−1.25e-12 µmol m⁻² s⁻¹ of carbon";
    EXPECT_EQ(beginning(font, text, widthOf(font, text)), text);
    for (float width = widthOf(font, text) - 1; width > widthOf(font, "−1…"); width -= 3) {
        const std::string cut = beginning(font, text, width);
        ASSERT_TRUE(cut.ends_with("…"));
        const std::string kept = cut.substr(0, cut.size() - std::string("…").size());
        EXPECT_TRUE(text.starts_with(kept)) << cut;
        EXPECT_LE(widthOf(font, cut), width);
        // The next character does not fit.
        std::size_t next = kept.size() + 1;
        while ((static_cast<unsigned char>(text[next]) & 0xC0) == 0x80) ++next;
        EXPECT_GT(widthOf(font, text.substr(0, next) + "…"), width);
    }
    EXPECT_EQ(beginning(font, text, 0), "…");
}

}  // namespace
}  // namespace app::panels

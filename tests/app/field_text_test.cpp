#include "app/panels/field_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "render/annotate/utf8.h"

namespace app::panels {
namespace {

bool fitsAField(const std::string& field) {
    return std::ranges::all_of(render::codePoints(field),
                               [](char32_t c) { return c < 0x10000 && c != 0xFFFD; });
}

TEST(FieldText, IsTheTextItselfWhereAFieldHoldsIt) {
    for (const char* text : {"", "600:1600", "é ≤ 日本 \uE000"}) {
        EXPECT_EQ(fieldText(text), text);
        EXPECT_EQ(meantText(text), text);
    }
}

TEST(FieldText, HoldsWhatNoFieldHolds) {
    // Beyond 16 bits, no UTF-8 (Latin-1, cut short, a surrogate, too long), and what stands in.
    for (const std::string text :
         {"a😀b", "\U00010000\U0010FFFF", "caf\xE9", "\xF0\x9F\x98", "\xED\xA0\x80", "\xC0\xAF",
          "\xF4\x90\x80\x80", "\uFDD0\uFFFE\uFFFF", "\xFF\xFE"}) {
        const std::string field = fieldText(text);
        EXPECT_TRUE(fitsAField(field)) << text;
        EXPECT_EQ(meantText(field), text);
    }
}

TEST(FieldText, GivesBackAnyBytes) {
    std::mt19937 random(11);
    for (int i = 0; i < 20'000; ++i) {
        std::string text(random() % 12, '\0');
        // Mostly bytes of which UTF-8 is made.
        for (char& c : text)
            c = static_cast<char>(random() % 4 == 0 ? random() : 0x80 + random() % 128);
        std::ranges::replace(text, '\0', 'a');
        ASSERT_EQ(meantText(fieldText(text)), text) << "case " << i;
        ASSERT_TRUE(fitsAField(fieldText(text))) << "case " << i;
    }
}

TEST(FieldText, OfACharacterThatWasTypedIsAsOfAText) {
    for (const char32_t c : {U'a', U'é', U'日', U'😀', U'\U0010FFFF'}) {
        const std::u32string held = fieldCharacters(c);
        const std::string utf8 = c == U'a'    ? "a"
                                 : c == U'é'  ? "é"
                                 : c == U'日' ? "日"
                                 : c == U'😀'  ? "😀"
                                              : "\U0010FFFF";
        EXPECT_EQ(render::codePoints(fieldText(utf8)), held);
    }
}

// As a backspace leaves it: its neighbours stay.
TEST(FieldText, LosesACharacterThatIsCutApart) {
    const std::u32string smile = fieldCharacters(U'😀');
    const std::string whole = fieldText("😀"), bytes = fieldText("\xE9");
    ASSERT_EQ(whole.size(), 3 * smile.size());
    for (std::size_t cut = 0; cut < whole.size(); cut += 3) {
        std::string broken = whole;
        broken.erase(cut, 3);
        EXPECT_EQ(meantText("a" + broken + fieldText("😎") + "b"), "a😎b") << cut;
    }
    for (std::size_t cut = 0; cut < bytes.size(); cut += 3) {
        std::string broken = bytes;
        broken.erase(cut, 3);
        EXPECT_EQ(meantText(broken + "b"), "b");
    }
}

}  // namespace
}  // namespace app::panels

#include "render/annotate/fitted_text.h"

#include <gtest/gtest.h>

#include "tests/support/flat_text.h"

namespace render {
namespace {

class FittedText : public testing::Test {
 protected:
    const FontStyle style_ = labelStyle({800, 600});
    const Font& font_ = tests::fontFor({800, 600});
    float width(const std::string& text) const { return font_.measure(text, style_).x; }
};

TEST_F(FittedText, IsTheLongestBeginningWithAnEllipsis) {
    const std::string text = "größte Höhe über Grund";
    EXPECT_EQ(shortened(font_, style_, text, width(text)), text);
    EXPECT_EQ(shortened(font_, style_, text, width("grö…")), "grö…");
    EXPECT_EQ(shortened(font_, style_, text, width("grö…") - 1), "gr…");
    EXPECT_EQ(shortened(font_, style_, text, 1), "");
}

TEST_F(FittedText, IsBrokenBetweenWords) {
    const std::string text = "level is a level, not a height: used as it is";
    EXPECT_EQ(wrapped(font_, style_, text, width(text), 3), std::vector{text});
    const float narrow = width("a height: used ");
    const auto lines = wrapped(font_, style_, text, narrow, 9);
    EXPECT_GT(lines.size(), 2u);
    std::string joined;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_LE(width(lines[i]), narrow);
        joined += (i ? " " : "") + lines[i];
        // As many words as fit.
        if (i > 0) {
            EXPECT_GT(width(lines[i - 1] + " " + lines[i].substr(0, lines[i].find(' '))), narrow);
        }
    }
    EXPECT_EQ(joined, text);
}

TEST_F(FittedText, EndsWithAnEllipsisWhereThereIsMoreThanItsLines) {
    const std::string text = "one two three\nfour five six seven";
    const float narrow = width("three four");
    EXPECT_EQ(wrapped(font_, style_, text, narrow, 2),
              (std::vector<std::string>{
                  "one two", shortened(font_, style_, "three four five six seven", narrow)}));
    EXPECT_TRUE(wrapped(font_, style_, text, narrow, 0).empty());
    // A word that no line holds.
    EXPECT_EQ(wrapped(font_, style_, "a_very_long_name is", width("a_very…"), 3),
              (std::vector<std::string>{"a_very…", "is"}));
    EXPECT_TRUE(wrapped(font_, style_, "", narrow, 3).empty());
}

}  // namespace
}  // namespace render

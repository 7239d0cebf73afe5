#include "render/annotate/fitted_text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

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

// Against each beginning in turn, of characters of one byte to four, and spaces.
TEST_F(FittedText, NoLongerBeginningFits) {
    std::mt19937 random(3);
    const char* const kCharacters[] = {"i", "W", " ", "é", "世", "\U0001F300"};
    for (int i = 0; i < 100; ++i) {
        std::vector<std::string> beginnings{""};
        for (std::size_t n = 1 + random() % 12; n > 0; --n)
            beginnings.push_back(beginnings.back() + kCharacters[random() % 6]);
        const std::string text = beginnings.back();
        const float room = width(text) * static_cast<float>(random() % 100) / 100;
        std::string expected;
        for (std::string beginning : beginnings) {
            while (beginning.ends_with(' ')) beginning.pop_back();
            if (!beginning.empty() && width(beginning + "…") <= room) expected = beginning + "…";
        }
        EXPECT_EQ(shortened(font_, style_, text, room), width(text) <= room ? text : expected)
            << "'" << text << "' in " << room;
    }
}

// Of 64,000 characters 17 beginnings are measured to find it, not each.
TEST_F(FittedText, IsFoundOfALongTextInTheTimeOfAFewMeasurements) {
    using Clock = std::chrono::steady_clock;
    std::string text;
    for (int i = 0; i < 16'000; ++i) text += "abc ";
    const auto start = Clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_GT(width(text), 1000);
    const auto measured = Clock::now() - start;
    EXPECT_FALSE(shortened(font_, style_, text, 100).empty());
    EXPECT_EQ(wrapped(font_, style_, text, 100, 3).size(), 3u);
    EXPECT_LT(Clock::now() - start - measured, 100 * measured);
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

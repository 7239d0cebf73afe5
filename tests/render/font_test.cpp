#include "render/annotate/font.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "render/annotate/utf8.h"

namespace render {
namespace {

constexpr FontStyle kLabel{FontWeight::Regular, 20};
constexpr FontStyle kTitle{FontWeight::SemiBold, 36};

const Font& font() {
    static const Font shared(std::vector{kLabel, kTitle});
    return shared;
}

std::vector<GlyphQuad> quadsOf(std::string_view text, FontStyle style = kLabel) {
    return font().layout(text, style, {0, 0});
}

bool samePicture(const GlyphQuad& a, const GlyphQuad& b) {
    return a.texel == b.texel && a.size == b.size;
}

TEST(Font, HasTheCharactersOfUnitsAndRanges) {
    const GlyphQuad unknown = quadsOf("?")[0];
    const std::string wanted =
        "AZaz09°µ·×±²³¹⁰¹⁴⁵⁶⁷⁸⁹⁻⁺₀₁₂–—…‰−≤≥≈≠∞√∂∆~→←↑↓αβγδεθλμπρσφωΓΔΘΛΣΦΨΩäéñß“”‘’";
    for (const char32_t point : codePoints(wanted)) {
        std::string text;
        for (std::size_t i = 0; i < wanted.size();) {  // the bytes of this code point
            const auto lead = static_cast<unsigned char>(wanted[i]);
            const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : 3;
            if (codePoints(wanted.substr(i, length))[0] == point) text = wanted.substr(i, length);
            i += length;
        }
        for (const auto style : {kLabel, kTitle}) {
            const auto quads = quadsOf(text, style);
            ASSERT_EQ(quads.size(), 1u) << text;
            if (style == kLabel) {
                EXPECT_FALSE(samePicture(quads[0], unknown)) << text;
            }
        }
    }
}

TEST(Font, UnknownCharactersAndMalformedBytesAreQuestionMarks) {
    const GlyphQuad question = quadsOf("?")[0];
    for (const std::string text : {"漢", "😀", "\xFF", "\xC3"}) {
        const auto quads = quadsOf(text);
        ASSERT_EQ(quads.size(), 1u) << text;
        EXPECT_TRUE(samePicture(quads[0], question)) << text;
        EXPECT_EQ(font().measure(text, kLabel), font().measure("?", kLabel)) << text;
    }
}

TEST(Font, MeasureIsTheSumOfAdvances) {
    const std::string text = "Pressure 12.5 kPa";
    float sum = 0;
    for (const char c : text) sum += font().measure(std::string(1, c), kLabel).x;
    EXPECT_NEAR(font().measure(text, kLabel).x, sum, 1e-3);
    EXPECT_EQ(font().measure(text, kLabel).y, 20);
    EXPECT_EQ(font().measure("", kLabel), glm::vec2(0, 20));
}

TEST(Font, LinesStackAndTheWidestCounts) {
    const auto wide = font().measure("wide line", kTitle);
    EXPECT_EQ(font().measure("x\nwide line\ny", kTitle), glm::vec2(wide.x, 3 * 36));
    const auto one = quadsOf("A"), second = quadsOf("B\nA");
    EXPECT_EQ(second[1].topLeft, one[0].topLeft + glm::ivec2(0, 20));
}

TEST(Font, DigitsHaveEqualAdvances) {
    for (const auto style : {kLabel, kTitle}) {
        for (const char* digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
            EXPECT_EQ(font().measure(digit, style), font().measure("0", style)) << digit;
        }
    }
}

TEST(Font, GlyphsLieInTheAtlasAndDoNotOverlapThere) {
    std::string every;
    for (char c = '!'; c <= '~'; ++c) every += c;
    for (const auto style : {kLabel, kTitle}) {
        auto quads = quadsOf(every, style);
        ASSERT_EQ(quads.size(), every.size());
        for (std::size_t i = 0; i < quads.size(); ++i) {
            const auto& a = quads[i];
            EXPECT_GE(a.texel.x, 0);
            EXPECT_GE(a.texel.y, 0);
            EXPECT_LE(a.texel.x + a.size.x, font().atlasSize().x);
            EXPECT_LE(a.texel.y + a.size.y, font().atlasSize().y);
            for (std::size_t j = 0; j < i; ++j) {
                const auto& b = quads[j];
                const bool apart =
                    a.texel.x + a.size.x <= b.texel.x || b.texel.x + b.size.x <= a.texel.x ||
                    a.texel.y + a.size.y <= b.texel.y || b.texel.y + b.size.y <= a.texel.y;
                EXPECT_TRUE(apart) << every[i] << every[j];
            }
        }
    }
    EXPECT_EQ(font().atlas().size(), static_cast<std::size_t>(font().atlasSize().x) *
                                         static_cast<std::size_t>(font().atlasSize().y));
}

TEST(Font, GlyphsStayWithinTheirLineAndNearTheirAdvance) {
    for (const auto style : {kLabel, kTitle}) {
        const std::string text = "Hxgj(|)[Å]Ωµ⁻¹";
        for (const auto& quad : quadsOf(text, style)) {
            EXPECT_GE(quad.topLeft.y, -1);  // antialiasing may touch the next pixel
            EXPECT_LE(quad.topLeft.y + quad.size.y, style.linePixels + 1);
        }
        const auto quads = quadsOf(text, style);
        const GlyphQuad last = quads.back();
        EXPECT_NEAR(static_cast<float>(last.topLeft.x + last.size.x), font().measure(text, style).x,
                    static_cast<float>(style.linePixels) / 8);
    }
}

TEST(Font, PositionsSnapToWholePixels) {
    const auto at = [](glm::vec2 topLeft) { return font().layout("Hello", kLabel, topLeft); };
    const auto exact = at({10, 20}), off = at({10.4f, 19.6f});
    ASSERT_EQ(exact.size(), off.size());
    for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_EQ(exact[i].topLeft, off[i].topLeft);
}

TEST(Font, AStemIsSharp) {
    // An H has two stems and a bar: between its stems and off the bar nothing may be covered, and
    // each stem of the title, 3 pixels wide or more, holds a fully covered column.
    const auto quad = quadsOf("H", kTitle).at(0);
    const auto covered = [&](int x, int y) {
        return static_cast<int>(font().atlas()[static_cast<std::size_t>(
            (quad.texel.y + y) * font().atlasSize().x + quad.texel.x + x)]);
    };
    const int quarter = quad.size.y / 4, middle = quad.size.x / 2;
    EXPECT_EQ(covered(middle, quarter), 0);
    EXPECT_EQ(covered(middle, quad.size.y / 2), 255);
    int left = 0, right = 0;
    for (int x = 0; x < quad.size.x; ++x) {
        int& best = x < middle ? left : right;
        best = std::max(best, covered(x, quarter));
    }
    EXPECT_EQ(left, 255);
    EXPECT_EQ(right, 255);
}

TEST(Font, LayoutDependsOnNothingButItsArguments) {
    const Font again(std::vector{kLabel, kTitle});
    EXPECT_TRUE(std::ranges::equal(again.atlas(), font().atlas()));
}

TEST(TextCoverage, WhiteIsLinearAndDarkerTextIsFilledMore) {
    for (int i = 0; i <= 10; ++i) {
        const float value = static_cast<float>(i) / 10;
        EXPECT_FLOAT_EQ(textCoverage(value, 1), value);
        EXPECT_GE(textCoverage(value, 0), textCoverage(value, 0.5f));
        EXPECT_GE(textCoverage(value, 0.5f), value);
    }
    for (const float luminance : {0.0f, 0.3f, 1.0f}) {
        EXPECT_EQ(textCoverage(0, luminance), 0);
        EXPECT_EQ(textCoverage(1, luminance), 1);
    }
}

TEST(DrawText, BlendsPremultipliedOverThePicture) {
    const glm::vec4 ground(0.2f, 0.4f, 0.6f, 1), paint(0.5f, 0.5f, 0.5f, 0.5f);  // half white
    Image image({40, 40}, ground);
    const auto quads = font().layout("H", kTitle, {2, 0});
    draw(image, font(), quads, paint);
    const auto& quad = quads.at(0);
    const glm::ivec2 bar = quad.topLeft + quad.size / 2;  // fully covered, see AStemIsSharp
    EXPECT_EQ(image.at(bar.x, bar.y), paint + ground * 0.5f);
    EXPECT_EQ(image.at(39, 39), ground);
}

TEST(DrawText, IsCutAtTheEdges) {
    const std::string text = "Hqg\nWide";
    Image whole({300, 200}), part({30, 20});
    draw(whole, font(), font().layout(text, kTitle, {100, 100}), glm::vec4(1));
    draw(part, font(), font().layout(text, kTitle, {-10, -10}), glm::vec4(1));
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 30; ++x) EXPECT_EQ(part.at(x, y), whole.at(x + 110, y + 110));
    }
    draw(part, font(), font().layout(text, kTitle, {-1000, 5000}), glm::vec4(1));
}

}  // namespace
}  // namespace render

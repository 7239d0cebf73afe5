#include "render/annotate/utf8.h"

#include <gtest/gtest.h>

#include <random>

namespace render {
namespace {

std::string encode(char32_t point) {  // RFC 3629, section 3
    const auto tail = [&](int shift) { return static_cast<char>(0x80 | (point >> shift & 0x3F)); };
    if (point < 0x80) return {static_cast<char>(point)};
    if (point < 0x800) return {static_cast<char>(0xC0 | point >> 6), tail(0)};
    if (point < 0x10000) return {static_cast<char>(0xE0 | point >> 12), tail(6), tail(0)};
    return {static_cast<char>(0xF0 | point >> 18), tail(12), tail(6), tail(0)};
}

TEST(Utf8, EveryCodePointComesBack) {
    for (char32_t point = 0; point <= 0x10FFFF; ++point) {
        if (point >= 0xD800 && point <= 0xDFFF) continue;
        ASSERT_EQ(codePoints(encode(point)), std::u32string(1, point))
            << static_cast<unsigned>(point);
    }
    EXPECT_EQ(codePoints("aµ→😀"), U"aµ→😀");
}

TEST(Utf8, EachMalformedByteIsReplaced) {
    EXPECT_EQ(codePoints("a\x80z"), U"a\uFFFDz");                            // stray continuation
    EXPECT_EQ(codePoints("a\xFFz"), U"a\uFFFDz");                            // never a lead
    EXPECT_EQ(codePoints("a\xC3"), U"a\uFFFD");                              // cut short
    EXPECT_EQ(codePoints("\xE2\x86"), U"\uFFFD\uFFFD");                      // cut short
    EXPECT_EQ(codePoints("\xC3(z"), U"\uFFFD(z");                            // no continuation
    EXPECT_EQ(codePoints("\xC0\xAF"), U"\uFFFD\uFFFD");                      // overlong '/'
    EXPECT_EQ(codePoints("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");            // surrogate
    EXPECT_EQ(codePoints("\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD");  // beyond U+10FFFF
}

TEST(Utf8, WellFormedTextStaysAndOtherBecomesWellFormed) {
    EXPECT_EQ(wellFormed(""), "");
    EXPECT_EQ(wellFormed("aµ→😀\uFFFD"), "aµ→😀\uFFFD");
    EXPECT_EQ(wellFormed("\xB0"
                         "C"),
              "\uFFFD"
              "C");  // a degree sign in Latin-1
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes(random() % 12, '\0');
        for (char& byte : bytes) byte = static_cast<char>(random() % 4 == 0 ? 'a' : random() % 256);
        const std::string text = wellFormed(bytes);
        EXPECT_EQ(codePoints(text), codePoints(bytes));
        std::string again;
        for (const char32_t point : codePoints(bytes)) again += encode(point);
        EXPECT_EQ(text, again);
    }
}

}  // namespace
}  // namespace render

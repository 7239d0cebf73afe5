#include "render/annotate/ticks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace render {
namespace {

TEST(NiceTicks, AreRoundMultiplesInsideForAnyRange) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> decade(-300, 300), factor(1, 10), shift(-3, 3);
    for (int i = 0; i < 4000; ++i) {
        const double span = factor(random) * std::pow(10, decade(random));
        const double lo = shift(random) * span, hi = lo + span;
        const int wanted = 1 + i % 12;
        const std::string which = fmt::format("{} to {}, {} wanted", lo, hi, wanted);
        const auto ticks = niceTicks(lo, hi, wanted);
        ASSERT_FALSE(ticks.empty()) << which;
        // Steps grow by at most 2.5, and a range holds its span's worth of steps give or take one.
        EXPECT_LE(static_cast<double>(ticks.size()), 2.5 * wanted + 1) << which;
        EXPECT_GE(static_cast<double>(ticks.size()), wanted / 2.5 - 1) << which;
        for (std::size_t t = 0; t < ticks.size(); ++t) {
            EXPECT_GE(ticks[t], lo) << which;
            EXPECT_LE(ticks[t], hi) << which;
            EXPECT_TRUE(t == 0 || ticks[t] > ticks[t - 1]) << which;
        }
        if (ticks.size() < 3) continue;
        const double step = (ticks.back() - ticks.front()) / static_cast<double>(ticks.size() - 1);
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
        EXPECT_LT(
            std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}),
            1e-9)
            << which;
        for (const double tick : ticks) {
            const double n = tick / step;
            EXPECT_NEAR(n, std::round(n), 1e-9 * std::max(1.0, std::abs(n))) << which;
            // As written by hand: a few digits tell it exactly.
            EXPECT_EQ(std::stod(fmt::format("{:.3e}", tick)), tick) << which;
        }
    }
}

TEST(NiceTicks, OfTenthsAreTheLiteralsOnePrints) {
    EXPECT_EQ(niceTicks(0, 1, 11),
              (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
    EXPECT_EQ(niceTicks(-0.35, 0.35, 3), (std::vector<double>{-0.2, 0, 0.2}));
}

TEST(NiceTicks, SurviveTheEndsOfDouble) {
    constexpr double kMost = std::numeric_limits<double>::max();
    for (int wanted = 1; wanted < 10; ++wanted)
        EXPECT_LE(niceTicks(-kMost, kMost, wanted).size(), 2.5 * wanted + 1) << wanted;
    EXPECT_EQ(niceTicks(3.7, 3.7, 5), std::vector<double>{3.7});
    EXPECT_EQ(niceTicks(0, 0, 1), std::vector<double>{0});
    EXPECT_EQ(niceTicks(-1.5e308, 1.5e308, 3), (std::vector<double>{-1e308, 0, 1e308}));
    EXPECT_EQ(niceTicks(0, 2e-300, 3), (std::vector<double>{0, 1e-300, 2e-300}));
    const double next = std::nextafter(1.0, 2.0);
    for (const double tick : niceTicks(1, next, 5)) EXPECT_TRUE(tick == 1 || tick == next);
    EXPECT_EQ(
        niceTicks(1e7, 1e7 + 0.004, 5),
        (std::vector<double>{10000000, 10000000.001, 10000000.002, 10000000.003, 10000000.004}));
}

using Texts = std::vector<std::string>;

TEST(TickTexts, ShareTheirDecimals) {
    EXPECT_EQ(tickTexts(std::array{0.0, 0.5, 1.0}), (Texts{"0.0", "0.5", "1.0"}));
    EXPECT_EQ(tickTexts(std::array{-30.0, 0.0, 30.0}), (Texts{"−30", "0", "30"}));
    EXPECT_EQ(tickTexts(std::array{5000.0, 10000.0}), (Texts{"5000", "10000"}));
    EXPECT_EQ(tickTexts(std::array{5412000.0, 5413000.0}), (Texts{"5412000", "5413000"}));
    EXPECT_EQ(tickTexts(std::array{10000000.001, 10000000.002}),
              (Texts{"10000000.001", "10000000.002"}));
    EXPECT_EQ(tickTexts(std::vector<double>{}), Texts{});
    EXPECT_EQ(tickTexts(std::array{0.0, 0.0}), (Texts{"0", "0"}));
}

TEST(TickTexts, UsePowersOfTenWhereDigitsWouldBeLong) {
    EXPECT_EQ(tickTexts(std::array{0.0, 5e-10, 1e-9, 1.5e-9}),
              (Texts{"0", "0.5×10⁻⁹", "1.0×10⁻⁹", "1.5×10⁻⁹"}));
    EXPECT_EQ(tickTexts(std::array{-2e300, 2e300}), (Texts{"−2×10³⁰⁰", "2×10³⁰⁰"}));
    EXPECT_EQ(tickTexts(std::array{2e-320}), (Texts{"2×10⁻³²⁰"}));
}

// What the text says, read back by other means than it was written.
double valueOf(std::string text) {
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at; (at = text.find(from)) != std::string::npos;)
            text.replace(at, from.size(), to);
    };
    replace("−", "-");
    replace("×10", "e");
    replace("⁻", "-");
    const Texts digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    for (std::size_t d = 0; d < digits.size(); ++d) replace(digits[d], std::to_string(d));
    return std::stod(text);
}

TEST(TickTexts, SayTheTicksExactlyAndDifferently) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> decade(-300, 300), factor(-9, 9), offset(0, 7);
    for (int i = 0; i < 2000; ++i) {
        const double span = std::pow(10, decade(random));
        const double lo = factor(random) * span * std::pow(10, offset(random));
        const auto ticks = niceTicks(lo, lo + span, 6);
        const auto texts = tickTexts(ticks);
        for (std::size_t t = 0; t < ticks.size(); ++t)
            EXPECT_EQ(valueOf(texts[t]), ticks[t]) << texts[t];
        EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), ticks.size());
    }
}

TEST(ShownUnit, IsWhatAPersonWouldWrite) {
    EXPECT_EQ(shownUnit("degrees_east"), "°E");
    EXPECT_EQ(shownUnit("degree_north"), "°N");
    EXPECT_EQ(shownUnit("degC"), "°C");
    EXPECT_EQ(shownUnit("m s-1"), "m s⁻¹");
    EXPECT_EQ(shownUnit("W m-2 K-1"), "W m⁻² K⁻¹");
    EXPECT_EQ(shownUnit("m2/s"), "m²/s");
    for (const char* asItStands : {"", "K", "index", "ppm CO2", "1e-3", "10 m", "µm", "mm Hg"})
        EXPECT_EQ(shownUnit(asItStands), asItStands);
}

TEST(ShownUnit, OneIsNoUnit) { EXPECT_EQ(shownUnit("1"), ""); }

// So many characters at the most.
auto within(std::size_t most) {
    return [most](const std::string& text) {
        return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) {
                   return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
               })) <= most;
    };
}

TEST(WithoutCommonStart, LeavesOutNoMoreThanItMustAndNothingThatDiffers) {
    const Texts large{"1152921504606846500", "1152921504606847000"};
    EXPECT_EQ(withoutCommonStart(large, within(19)), large);
    EXPECT_EQ(withoutCommonStart(large, within(8)), (Texts{"…6846500", "…6847000"}));
    EXPECT_EQ(withoutCommonStart(large, within(3)), (Texts{"…6500", "…7000"}));
    EXPECT_EQ(withoutCommonStart({"−1000001", "−1000002"}, within(5)), (Texts{"−…001", "−…002"}));
    EXPECT_EQ(withoutCommonStart({"−1.25", "1.25"}, within(3)), (Texts{"−1.25", "1.25"}));
    EXPECT_EQ(withoutCommonStart({"10000000.001", "10000000.002"}, within(6)),
              (Texts{"…0.001", "…0.002"}));
    EXPECT_EQ(withoutCommonStart({"123456"}, within(4)), (Texts{"…456"}));
    EXPECT_EQ(withoutCommonStart({}, within(4)), Texts{});
}

TEST(FittingTicks, LoseDigitsBeforeTheyLoseLabels) {
    const auto texts = [](double lo, double hi, std::size_t most) {
        return fittingTicks(lo, hi, 6, within(most)).texts;
    };
    EXPECT_EQ(texts(-1.2e11, 1.2e11, 8), (Texts{"−1×10¹¹", "0", "1×10¹¹"}));
    EXPECT_EQ(texts(-1.2e11, 1.2e11, 20), tickTexts(niceTicks(-1.2e11, 1.2e11, 6)));
    EXPECT_EQ(texts(-1.2e11, 1.2e11, 6), (Texts{"", "0", "1×10¹¹"}));
}

// A label is its tick's whole number, or its end behind "…"; else there is none.
TEST(FittingTicks, NeverCutANumber) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> decade(-300, 300), factor(-9, 9), offset(0, 7);
    for (int i = 0; i < 2000; ++i) {
        const double span = std::pow(10, decade(random));
        const double lo = factor(random) * span * std::pow(10, offset(random));
        const std::size_t most = 3 + random() % 9;
        const LabelledTicks labels = fittingTicks(lo, lo + span, 6, within(most));
        const Texts whole = tickTexts(labels.ticks);
        ASSERT_EQ(labels.texts.size(), whole.size());
        for (std::size_t t = 0; t < whole.size(); ++t) {
            const std::string& text = labels.texts[t];
            EXPECT_TRUE(within(most)(text)) << text;
            const std::size_t cut = text.find("…");
            if (cut != text.npos)
                EXPECT_TRUE(whole[t].ends_with(text.substr(cut + 3)) && cut <= 3) << text;
            else
                EXPECT_TRUE(text.empty() || text == whole[t]) << text;
        }
    }
}

}  // namespace
}  // namespace render

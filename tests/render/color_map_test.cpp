#include "render/model/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "render/image/color.h"

namespace render {
namespace {

std::string hex(glm::vec3 linear) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", srgb8FromLinear(linear.r),
                  srgb8FromLinear(linear.g), srgb8FromLinear(linear.b));
    return text;
}

// CIELAB for D65 (CIE 15:2004), from Rec. 709 primaries.
glm::dvec3 lab(glm::dvec3 rgb) {
    const auto root = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const double x = root((0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b) / 0.9505);
    const double y = root(0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b);
    const double z = root((0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double lightness(glm::dvec3 rgb) { return lab(rgb)[0]; }

ColorMap named(std::string_view name) { return colorMapNamed(name).value(); }

TEST(ColorMap, EndsAreThePublishedColors) {
    const auto ends = [](std::string_view name) {
        return hex(named(name).at(0)) + " " + hex(named(name).at(1));
    };
    EXPECT_EQ(ends("viridis"), "#440154 #fde725");
    EXPECT_EQ(ends("cividis"), "#00224e #fee838");
    EXPECT_EQ(ends("inferno"), "#000004 #fcffa4");
    EXPECT_EQ(ends("cool-warm"), "#3b4cc0 #b40426");
}

TEST(ColorMap, NamesAreThoseThatCanBeAskedFor) {
    for (const auto name : colorMapNames()) EXPECT_EQ(named(name).name(), name);
    EXPECT_FALSE(colorMapNamed("rainbow").has_value());
    EXPECT_FALSE(colorMapNamed("").has_value());
    EXPECT_EQ(ColorMap(), named(colorMapNames().front()));
    EXPECT_NE(named("viridis"), named("inferno"));
}

TEST(ColorMap, ReversedItIsTheOtherWayRound) {
    for (const auto name : colorMapNames()) {
        const ColorMap map = named(name), back = map.reversed();
        EXPECT_EQ(back.name(), name);
        EXPECT_NE(back, map);
        EXPECT_EQ(back.reversed(), map);
        for (const double t : {0.0, 0.25, 0.3, 0.5, 1.0})
            EXPECT_LT(glm::length(back.at(t) - map.at(1 - t)), 1e-6) << name << " " << t;
    }
}

TEST(ColorMap, EntriesLieEvenlyAndColorsBetweenThemMixInLinearLight) {
    for (const auto name : colorMapNames()) {
        const ColorMap map = named(name);
        const auto entries = map.entries();
        const double steps = static_cast<double>(entries.size() - 1);
        for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
            const glm::vec3 middle = map.at((static_cast<double>(i) + 0.5) / steps);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(map.at(static_cast<double>(i) / steps)[c], entries[i][c], 1e-6);
                EXPECT_NEAR(middle[c], (entries[i][c] + entries[i + 1][c]) / 2, 1e-6);
            }
        }
    }
}

TEST(ColorMap, ArgumentsOutsideTheUnitIntervalGetTheEnds) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const ColorMap map;
    for (const double low : {-kInf, -1.0, -1e-300, std::nan("")}) EXPECT_EQ(map.at(low), map.at(0));
    for (const double high : {1 + 1e-15, 2.0, kInf}) EXPECT_EQ(map.at(high), map.at(1));
    for (int c = 0; c < 3; ++c) {  // the last interval ends at the last entry
        EXPECT_NEAR(map.at(std::nextafter(1.0, 0.0))[c], map.at(1)[c], 1e-6);
    }
}

TEST(ColorMap, SequentialMapsRiseInLightness) {
    for (const auto name : {"viridis", "cividis", "inferno"}) {
        const auto entries = named(name).entries();
        for (std::size_t i = 1; i < entries.size(); ++i) {
            EXPECT_GT(lightness(entries[i]), lightness(entries[i - 1])) << name << " " << i;
        }
    }
}

TEST(ColorMap, NeighboursDifferByLessThanIsNoticed) {
    // A Euclidean distance of 2.3 in CIELAB is just noticeable (Mahy et al. 1994).
    for (const auto name : colorMapNames()) {
        const auto entries = named(name).entries();
        for (std::size_t i = 1; i < entries.size(); ++i) {
            const auto step = lab(entries[i]) - lab(entries[i - 1]);
            EXPECT_LT(std::hypot(step.x, step.y, step.z), 2.3) << name << " " << i;
        }
    }
}

TEST(ColorMap, CividisStaysOrderedForDeuteranopes) {
    // Viénot, Brettel, Mollon 1999, in linear RGB: red and green merge.
    const auto deuteranope = [](glm::dvec3 c) {
        const double yellow = 0.29275 * c.r + 0.70725 * c.g;
        return glm::dvec3(yellow, yellow, -0.02234 * c.r + 0.02234 * c.g + c.b);
    };
    const auto entries = named("cividis").entries();
    for (std::size_t i = 1; i < entries.size(); ++i) {
        EXPECT_GT(lightness(deuteranope(entries[i])), lightness(deuteranope(entries[i - 1]))) << i;
    }
}

TEST(ColorMap, CoolWarmFollowsThePublishedTable) {
    // K. Moreland's 33-colour table of the map, every second colour; t = 0, 1/16, ..., 1.
    const int published[17][3] = {
        {59, 76, 192},   {77, 104, 215},  {98, 130, 234},  {119, 154, 247}, {141, 176, 254},
        {163, 194, 255}, {184, 208, 249}, {204, 217, 238}, {221, 221, 221}, {236, 211, 197},
        {245, 196, 173}, {247, 177, 148}, {244, 154, 123}, {236, 127, 99},  {222, 96, 77},
        {203, 62, 56},   {180, 4, 38}};
    for (int i = 0; i <= 16; ++i) {
        const glm::vec3 color = named("cool-warm").at(i / 16.0);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(255 * srgbFromLinear(color[c]), published[i][c], 1) << i << " " << c;
        }
    }
}

TEST(ColorMap, CoolWarmIsSymmetricAboutANeutralCentre) {
    const ColorMap map = named("cool-warm");
    const auto entries = map.entries();
    ASSERT_EQ(entries.size() % 2, 1u);
    const std::size_t centre = entries.size() / 2;
    EXPECT_EQ(map.at(0.5), entries[centre]);
    EXPECT_NEAR(lab(entries[centre])[1], 0, 0.05);
    EXPECT_NEAR(lab(entries[centre])[2], 0, 0.05);
    for (std::size_t i = 1; i <= centre; ++i) {
        const double cool = lightness(entries[centre - i]), warm = lightness(entries[centre + i]);
        // The ends are given in 8 bits, which leaves their lightness apart by up to half a unit.
        EXPECT_NEAR(cool, warm, 0.5) << i;
        EXPECT_LT(cool, lightness(entries[centre - i + 1])) << i;
        EXPECT_LT(warm, lightness(entries[centre + i - 1])) << i;
    }
}

}  // namespace
}  // namespace render

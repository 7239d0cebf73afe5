#include "render/annotate/legend.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "render/annotate/axes.h"
#include "tests/support/flat_text.h"

namespace render {
namespace {

using tests::fontFor;
using tests::Rect;
using tests::shapes;

RangeStyle constant(double opacity = 0.5) { return {Constant{{0.8, 0.4, 0.1}}, opacity}; }
RangeStyle byValue(double lo, double hi) { return {ByValue{ColorMap(), lo, hi}, 0.5}; }

Legend fire() {
    return {"T, gas temperature (K)",
            "1.10 s, step 13 of 31",
            {{constant(), "600:1600 K", "13,402 points, 6.2 %"},
             {byValue(300, 1843.7), "1600:inf K", "1,204 points, 0.56 %"}},
            {"drawn in index space"}};
}
std::optional<Rect> find(const FlatMesh& mesh, glm::ivec2 size, const std::string& text) {
    return tests::find(mesh, fontFor(size), labelStyle(size), text);
}
bool titled(const FlatMesh& mesh, glm::ivec2 size, const std::string& text) {
    return tests::find(mesh, fontFor(size), titleStyle(size), text).has_value();
}

TEST(Legend, CoversWhatItsGroundDoes) {
    for (const glm::ivec2 size : {glm::ivec2(1024, 1024), {480, 360}, {4096, 2048}}) {
        const FlatMesh mesh = legendMesh(fire(), fontFor(size), size);
        const auto covered = coveredByLegend(mesh, size);
        ASSERT_GE(covered.size(), 2u);  // the column, and the notes
        std::vector<PixelRect> drawn(covered.size(), {glm::dvec2(1e9), glm::dvec2(-1e9)});
        const FlatMesh ground = legendGround(mesh, size, glm::dvec3(0));
        for (const FlatVertex& corner : ground.triangles()) {
            const glm::dvec2 at(corner.at);
            const auto in = std::ranges::find_if(covered, [&](const PixelRect& rect) {
                const PixelRect rounded = rect.grown(1e-3);
                return at.x >= rounded.lo.x && at.y >= rounded.lo.y && at.x <= rounded.hi.x &&
                       at.y <= rounded.hi.y;
            });
            ASSERT_TRUE(in != covered.end()) << at.x << ' ' << at.y;
            PixelRect& here = drawn[static_cast<std::size_t>(in - covered.begin())];
            here = {glm::min(here.lo, at), glm::max(here.hi, at)};
        }
        for (std::size_t i = 0; i < covered.size(); ++i) {
            EXPECT_LT(glm::distance(covered[i].lo, drawn[i].lo), 1e-3);
            EXPECT_LT(glm::distance(covered[i].hi, drawn[i].hi), 1e-3);
        }
    }
    EXPECT_TRUE(coveredByLegend({}, {800, 600}).empty());
}

// Numbers that change from step to step do not move a picture that is placed by it.
TEST(Legend, ItsCornerHoldsThePlateOfWhatLayersSay) {
    const LegendLayer bar{byValue(300, 1843.7), "\u2265 1600 K", "1,204 points, 0.56 %"},
        swatch{constant(), "600 to 1600 K", "13,402 points, 6.2 %"};
    for (const glm::ivec2 size : {glm::ivec2(1200, 900), {1920, 1080}, {800, 600}, {640, 480}})
        for (const std::size_t bars : {0u, 1u, 2u})
            for (const std::size_t swatches : {0u, 1u, 3u}) {
                Legend legend{"T (K)", "1.10 s, step 13", {}, {}};
                legend.layers.assign(bars, bar);
                legend.layers.insert(legend.layers.end(), swatches, swatch);
                glm::dvec2 reach(0);
                for (const PixelRect& plate :
                     coveredByLegend(legendMesh(legend, fontFor(size), size), size))
                    reach = glm::max(reach, plate.hi);
                const glm::dvec2 corner = legendCorner(bars, swatches, size);
                EXPECT_LE(reach.x, corner.x + 1) << size.x << ' ' << bars << swatches;
                EXPECT_LE(reach.y, corner.y + 1) << size.x << ' ' << bars << swatches;
                EXPECT_GE(reach.y, 0.85 * corner.y) << size.x << ' ' << bars << swatches;
            }
}

TEST(Legend, SaysEverythingInAnOrdinaryPicture) {
    for (const glm::ivec2 size : {glm::ivec2(1024, 1024), {1920, 1080}, {480, 360}, {400, 1200}}) {
        const FlatMesh mesh = legendMesh(fire(), fontFor(size), size);
        EXPECT_TRUE(titled(mesh, size, "T, gas temperature (K)"));
        for (const char* text :
             {"1.10 s, step 13 of 31", "600:1600 K", "13,402 points, 6.2 %", "1600:inf K",
              "1,204 points, 0.56 %", "300", "1000", "1843.7", "drawn in index space"})
            EXPECT_TRUE(find(mesh, size, text)) << text << " at " << size.x << " x " << size.y;
    }
}

TEST(Legend, AColourBarRunsThroughItsMapBetweenItsEnds) {
    const glm::ivec2 size(1024, 1024);
    const FlatMesh mesh = legendMesh({"", "", {{byValue(-5, 6), "", ""}}, {}}, fontFor(size), size);
    const auto entries = ColorMap().entries();
    float left = 1e9f, right = -1e9f;
    for (const auto& v : mesh.triangles()) {
        if (glm::vec3(v.color) == entries.front()) left = std::min(left, v.at.x);
        if (glm::vec3(v.color) == entries.back()) right = std::max(right, v.at.x);
    }
    const auto lo = find(mesh, size, "−5"), zero = find(mesh, size, "0"),
               hi = find(mesh, size, "6");
    ASSERT_TRUE(lo && zero && hi);
    EXPECT_NEAR(lo->lo.x, left, 3);
    EXPECT_NEAR(0.5f * (zero->lo.x + zero->hi.x), left + 5 / 11.0f * (right - left), 2);
    EXPECT_NEAR(hi->hi.x, right, 3);
}

TEST(Legend, ABarTooShortForTheDigitsOfBothEndsTellsThemApart) {
    const glm::ivec2 size(800, 640);
    const auto shown = [&](double lo, double hi) {
        return legendMesh({"", "", {{byValue(lo, hi), "", ""}}, {}}, fontFor(size), size);
    };
    // As many of the last digits as there is room for, four at least: those in which they differ.
    const auto ends = [&](const FlatMesh& mesh, const std::string& sign,
                          const std::string& digits) {
        for (std::size_t left = 1; left + 4 <= digits.size(); ++left)
            if (find(mesh, size, sign + "\u2026" + digits.substr(left))) return true;
        return false;
    };
    const FlatMesh above = shown(9007199254740992, 9007199254741004);
    EXPECT_TRUE(find(above, size, "9007199254740992"));
    EXPECT_TRUE(ends(above, "", "9007199254741004"));
    const FlatMesh below = shown(-9007199254741004, -9007199254740992);
    EXPECT_TRUE(find(below, size, "\u22129007199254741004"));
    EXPECT_TRUE(ends(below, "\u2212", "9007199254740992"));
}

// What lies beyond has the colour of the end.
TEST(Legend, EndsOfARangeWithoutAnEndSayThatTheyStandForMore) {
    const glm::ivec2 size(1024, 1024);
    Legend legend{"", "", {{byValue(-5, 6), "", ""}}, {}};
    for (const bool below : {false, true})
        for (const bool above : {false, true}) {
            legend.layers[0].openBelow = below;
            legend.layers[0].openAbove = above;
            const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
            EXPECT_EQ(find(mesh, size, "\u2264 \u22125").has_value(), below);
            EXPECT_EQ(find(mesh, size, "\u2265 6").has_value(), above);
            EXPECT_TRUE(find(mesh, size, "\u22125") && find(mesh, size, "6"));
        }
}

// Values lie along all of it evenly, and where a layer shows none, there is none.
TEST(Legend, ABarHasAGapWhereItsLayerHasOne) {
    const glm::ivec2 size(1024, 1024);
    LegendLayer layer{byValue(0, 20), "", ""};
    layer.shown = {{0, 4}, {12, 20}};
    const FlatMesh mesh = legendMesh({"", "", {layer}, {}}, fontFor(size), size);
    const auto colorAt = [&](double value) {
        return glm::vec3(ColorMap().at(mapPosition({ColorMap(), 0, 20}, value)));
    };
    const auto find4 = find(mesh, size, "4"), find12 = find(mesh, size, "12"),
               lo = find(mesh, size, "0"), hi = find(mesh, size, "20");
    ASSERT_TRUE(find4 && find12 && lo && hi);
    const float left = lo->lo.x, width = hi->hi.x - lo->lo.x;
    std::vector<std::pair<float, glm::vec3>> colors;
    for (const auto& v : mesh.triangles()) colors.emplace_back(v.at.x, glm::vec3(v.color));
    for (const double value : {0.0, 4.0, 12.0, 20.0}) {
        const float at = left + width * static_cast<float>(value / 20);
        EXPECT_TRUE(std::ranges::any_of(colors, [&](const auto& color) {
            return std::abs(color.first - at) <= 3 && color.second == colorAt(value);
        })) << value;
    }
    EXPECT_NEAR(0.5f * (find4->lo.x + find4->hi.x), left + 0.2f * width, 3);
    EXPECT_NEAR(0.5f * (find12->lo.x + find12->hi.x), left + 0.6f * width, 3);
    EXPECT_FALSE(find(mesh, size, "10")) << "a round value in the gap";
    for (const auto& [at, color] : colors)
        EXPECT_FALSE(at > left + 0.25f * width && at < left + 0.5f * width) << at;
}

TEST(Legend, NumbersOfManyGapsDoNotTouch) {
    const glm::ivec2 size(900, 700);
    LegendLayer layer{byValue(0, 100), "", ""};
    for (int i = 0; i < 30; ++i) layer.shown.emplace_back(3.4 * i, 3.4 * i + (i % 3));
    const FlatMesh mesh = legendMesh({"", "", {layer}, {}}, fontFor(size), size);
    // Glyphs of one number follow each other closely; between numbers there is half a line or more.
    const auto first = find(mesh, size, "0");
    ASSERT_TRUE(first);
    const auto line = static_cast<float>(labelStyle(size).linePixels);
    std::vector<Rect> glyphs;
    for (const auto& shape : shapes(mesh))
        if (shape.glyph && shape.covers.lo.y > first->lo.y - 0.2f * line)
            glyphs.push_back(shape.covers);
    std::ranges::sort(glyphs, {}, [](const Rect& rect) { return rect.lo.x; });
    std::size_t numbers = 1;
    for (std::size_t i = 1; i < glyphs.size(); ++i) {
        const float apart = glyphs[i].lo.x - glyphs[i - 1].hi.x;
        EXPECT_GT(apart, -0.1f * line) << i;
        EXPECT_TRUE(apart < 0.2f * line || apart > 0.5f * line) << i << ": " << apart;
        numbers += apart > 0.5f * line;
    }
    EXPECT_GT(numbers, 4u);
}

TEST(Legend, ABarOfDenormalNumbersHasThemAtItsEnds) {
    const glm::ivec2 size(1024, 1024);
    const FlatMesh mesh =
        legendMesh({"", "", {{byValue(1e-310, 3e-310), "", ""}}, {}}, fontFor(size), size);
    EXPECT_TRUE(find(mesh, size, "1×10⁻³¹⁰"));
    EXPECT_TRUE(find(mesh, size, "3×10⁻³¹⁰"));
}

TEST(Legend, RangesAreToldWholeWhereThePictureIsWideEnough) {
    const glm::ivec2 size(1200, 900);
    Legend legend = fire();
    const std::string all =
        "\u22120.004 to \u22120.003, \u22120.002 to \u22120.001, 0.001 to 0.002, 0.003 to 0.004 m";
    legend.layers[0].range = all;
    EXPECT_TRUE(find(legendMesh(legend, fontFor(size), size), size, all));
}

TEST(Legend, SaysThatItsLayersHaveNoRoom) {
    Legend legend = fire();
    while (legend.layers.size() < 8) legend.layers.push_back(legend.layers[0]);
    for (int height = 600; height >= 120; --height) {
        const glm::ivec2 size(500, height);
        const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
        EXPECT_NE(find(mesh, size, "600:1600 K").has_value(),
                  find(mesh, size, "8 layers: no room for the legend").has_value())
            << height;
    }
}

TEST(Legend, AMapOfOneValueShowsItsMiddle) {
    const glm::ivec2 size(1024, 1024);
    const FlatMesh mesh = legendMesh({"", "", {{byValue(7, 7), "", ""}}, {}}, fontFor(size), size);
    EXPECT_TRUE(find(mesh, size, "7"));
    EXPECT_TRUE(std::any_of(mesh.triangles().begin(), mesh.triangles().end(), [](const auto& v) {
        return v.texel.x < 0 && glm::vec3(v.color) == ColorMap().at(0.5);
    }));
}

TEST(Legend, ABarOfOneValueSaysWhatLiesBeyondItOrTheWordsThatStandForIt) {
    const glm::ivec2 size(1024, 1024);
    const auto told = [&](LegendLayer layer, const char* text) {
        return find(legendMesh({"", "", {std::move(layer)}, {}}, fontFor(size), size), size, text)
            .has_value();
    };
    using Values = std::vector<std::pair<double, double>>;
    EXPECT_TRUE(told({byValue(0, 7), "", "", Values{{7, 7}}, false, true}, "\u2265 7"));
    EXPECT_TRUE(told({byValue(7, 9), "", "", Values{{7, 7}}, true, false}, "\u2264 7"));
    EXPECT_TRUE(told({byValue(7, 7), "", "", {}, true, true, "all 7"}, "all 7"));
}

// The colour that dense parts of a picture have, however much it takes to make one.
TEST(Legend, ASwatchIsFullOfItsLayersColour) {
    const glm::ivec2 size(1024, 1024);
    for (const double opacity : {0.0, 0.002, 0.25, 1.0}) {
        const FlatMesh mesh =
            legendMesh({"", "", {{constant(opacity), "", ""}}, {}}, fontFor(size), size);
        const glm::vec4 full(0.8f, 0.4f, 0.1f, 1);
        const auto corners = std::ranges::count(mesh.triangles(), full, &FlatVertex::color);
        // Four bars of an outline, and the inside: of two triangles each.
        EXPECT_EQ(corners, opacity > 0 ? 30 : 24) << opacity;
        EXPECT_EQ(std::ssize(mesh.triangles()), corners) << "and nothing else";
    }
}

TEST(Legend, LongTextsAreShortenedWithAnEllipsis) {
    const glm::ivec2 size(480, 360);
    Legend legend = fire();
    legend.title = "größte ";
    for (int i = 0; i < 20; ++i) legend.title += "Geschwindigkeit über alles\n";
    const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
    EXPECT_TRUE(titled(mesh, size, "…"));
    EXPECT_TRUE(titled(mesh, size, "größte Geschwindigkeit"));
    EXPECT_FALSE(titled(mesh, size, legend.title));
}

TEST(Legend, SaysThatAStepIsEmptyUnderItsTime) {
    const glm::ivec2 size(500, 600);
    for (const char* time : {"1.10 s, step 13 of 31", ""}) {
        Legend legend = fire();
        legend.time = time;
        legend.emptiness = "all 8 points of this step are missing";
        const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
        const auto said = find(mesh, size, legend.emptiness);
        ASSERT_TRUE(said);
        EXPECT_TRUE(titled(mesh, size, legend.title));
        EXPECT_TRUE(find(mesh, size, "600:1600 K"));
    }
}

TEST(Legend, GivesUpNotesThenAmountsThenLayersThenTimeAsPicturesShrink) {
    // 0: nothing but the title; +1 time, +1 ranges, +1 amounts, +1 notes.
    int last = 4;
    for (int height = 600; height >= 24; --height) {
        const glm::ivec2 size(500, height);
        Legend legend = fire();
        for (int i = 0; i < 4; ++i) legend.layers.push_back(legend.layers[i % 2]);
        for (int i = 0; i < 10; ++i) legend.notes.push_back("drawn in index space");
        const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
        EXPECT_TRUE(height < 40 || titled(mesh, size, legend.title));
        const std::array said = {find(mesh, size, "1.10 s, step 13 of 31").has_value(),
                                 find(mesh, size, "600:1600 K").has_value(),
                                 find(mesh, size, "13,402 points, 6.2 %").has_value()};
        for (std::size_t i = 1; i < said.size(); ++i) EXPECT_LE(said[i], said[i - 1]) << height;
        const int level = said[0] + said[1] + said[2];
        EXPECT_LE(level, last) << height;
        last = level;
    }
    EXPECT_LE(last, 1);
}

TEST(Legend, NotesGoFirst) {
    bool gone = false;
    for (int height = 600; height >= 300 && !gone; --height) {
        const glm::ivec2 size(500, height);
        Legend legend = fire();
        for (int i = 0; i < 20; ++i) legend.notes.push_back("drawn in index space");
        const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
        gone = !find(mesh, size, "drawn in index space");
        EXPECT_TRUE(find(mesh, size, "13,402 points, 6.2 %") && find(mesh, size, "1843.7"))
            << height;
    }
    EXPECT_TRUE(gone);
}

TEST(Legend, LiesInThePictureWithItsPartsApartAtAnySize) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> logSize(std::log(64.0), std::log(4096.0)),
        decade(-300, 300), sign(-1, 1);
    const auto number = [&] { return sign(random) * std::pow(10, decade(random)); };
    for (int i = 0; i < 400; ++i) {
        const glm::ivec2 size(std::exp(logSize(random)), std::exp(logSize(random)));
        Legend legend;
        const auto words = [&](int most) {
            std::string text;
            const int count = static_cast<int>(random() % static_cast<unsigned>(most));
            for (int w = 0; w < count; ++w) text += (w ? " wind" : "Ωind");
            return text;
        };
        legend.title = words(30);
        legend.time = words(12);
        const int layers = static_cast<int>(random() % 9);
        for (int l = 0; l < layers; ++l) {
            const double a = number(), b = random() % 4 == 0 ? a : number();
            legend.layers.push_back(
                {random() % 2 ? constant() : byValue(std::min(a, b), std::max(a, b)), words(12),
                 words(8)});
        }
        for (auto n = random() % 5; n > 0; --n) legend.notes.push_back(words(40));
        const FlatMesh mesh = legendMesh(legend, fontFor(size), size);
        const auto all = shapes(mesh);
        const std::string which = fmt::format("{}: {} x {}", i, size.x, size.y);
        for (const auto& shape : all)
            EXPECT_TRUE(shape.covers.lo.x >= 0 && shape.covers.lo.y >= 0 &&
                        shape.covers.hi.x <= static_cast<float>(size.x) &&
                        shape.covers.hi.y <= static_cast<float>(size.y))
                << which;
        std::size_t overlaps = 0;
        for (std::size_t a = 0; a < all.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                // Soft edges of neighbouring letters may share two columns of pixels.
                if (all[a].glyph || all[b].glyph)
                    overlaps += tests::overlap(all[a].covers, all[b].covers, 2.01f);
        EXPECT_EQ(overlaps, 0u) << which;
    }
}

}  // namespace
}  // namespace render

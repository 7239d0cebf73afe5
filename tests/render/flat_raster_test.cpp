// Flat shapes on the processor: what a pixel gets follows from geometry alone.
#include "render/annotate/flat_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/flat_text.h"

namespace render {
namespace {

constexpr glm::ivec2 kPicture{64, 48};

// A picture of one mesh over `ground`, in bands of so many rows; row 0 at the bottom.
std::vector<glm::vec4> drawn(const FlatMesh& mesh, int rows = kPicture.y,
                             const glm::vec4& ground = {0, 0, 0, 1}) {
    const FlatRaster raster(mesh, tests::fontFor(kPicture), kPicture);
    std::vector<glm::vec4> light(std::size_t(kPicture.x) * kPicture.y, ground);
    for (int first = 0; first < kPicture.y; first += rows)
        raster.draw({kPicture, first, std::min(rows, kPicture.y - first),
                     &light[std::size_t(first) * kPicture.x].x});
    return light;
}

const glm::vec4& at(const std::vector<glm::vec4>& light, int x, int yDown) {
    return light[std::size_t(kPicture.y - 1 - yDown) * kPicture.x + x];
}

TEST(FlatRaster, ARectangleIsEveryPixelWhoseMiddleItHoldsOnce) {
    FlatMesh mesh;
    const glm::dvec2 lo(10.3, 7.5), hi(40.5, 20.7);
    mesh.rect(glm::vec2(lo), glm::vec2(hi), glm::vec4(0.5f));
    const auto light = drawn(mesh);
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x) {
            const glm::dvec2 middle(x + 0.5, y + 0.5);
            // Of middles that lie on a side, those are inside that the rectangle has to its right
            // or above it: each belongs to one of two neighbours.
            const bool inside =
                middle.x >= lo.x && middle.x < hi.x && middle.y > lo.y && middle.y <= hi.y;
            EXPECT_EQ(at(light, x, y).r, inside ? 0.5f : 0.0f) << x << ' ' << y;
        }
}

// Triangles around a point: where two met twice, or neither came, light would not be even.
TEST(FlatRaster, TrianglesThatShareSidesLeaveNoGapAndDoNotOverlap) {
    FlatMesh mesh;
    mesh.plate({{20.13, 15.77}, {39.9, 30.02}}, 7.3f, glm::vec4(0.5f));
    mesh.line({2, 3, 0}, {60.3f, 44.1f, 0}, 40, glm::vec4(0.25f));
    const auto light = drawn(mesh);
    float most = 0;
    for (const glm::vec4& pixel : light) most = std::max(most, pixel.r);
    EXPECT_LE(most, 0.25f + 0.75f * 0.5f + 1e-6f) << "drawn twice";
    EXPECT_NEAR(at(light, 30, 22).r, 0.25f + 0.75f * 0.5f, 1e-6f) << "on the line and on the plate";
    FlatMesh line;
    line.line({2, 3, 0}, {60.3f, 44.1f, 0}, 40, glm::vec4(0.25f));
    const auto alone = drawn(line);
    for (int t = 6; t < 58; ++t) {
        const int y = static_cast<int>(3 + (t + 0.5 - 2) * (44.1 - 3) / (60.3 - 2));
        EXPECT_EQ(at(alone, t, y).r, 0.25f) << "along the diagonal of its two triangles";
    }
}

// Antialiased: a pixel takes width / 2 + 1 / 2 less its distance, so a line's light is its area.
TEST(FlatRaster, ALinesLightIsItsDistance) {
    FlatMesh mesh;
    const glm::dvec2 a(9, 11), b(50, 33);
    const double width = 3;
    mesh.line(glm::vec3(a, 0), glm::vec3(b, 0), static_cast<float>(width), {1, 0.5f, 0.25f, 1});
    const auto light = drawn(mesh);
    const glm::dvec2 along = glm::normalize(b - a);
    double sum = 0;
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x) {
            const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) - a;
            const double off = std::abs(p.x * along.y - p.y * along.x), on = glm::dot(p, along);
            sum += static_cast<double>(at(light, x, y).r);
            if (on < 1 || on > glm::length(b - a) - 1) continue;
            const double covered = std::clamp(width / 2 + 0.5 - off, 0.0, 1.0);
            EXPECT_NEAR(at(light, x, y).r, covered, 1e-5) << x << ' ' << y;
            EXPECT_NEAR(at(light, x, y).b, 0.25 * covered, 1e-5);
        }
    EXPECT_NEAR(sum, width * glm::length(b - a), 2 * width);
}

// As a line's; its sides are straight, which takes a 32nd of a pixel at most.
TEST(FlatRaster, ADiscsLightIsItsDistance) {
    for (const double radius : {0.75, 3.0, 7.5, 12.0, 20.0}) {
        FlatMesh mesh;
        const glm::dvec2 middle(30.3, 23.9);
        mesh.disc(glm::vec2(middle), static_cast<float>(radius), {1, 0.5f, 0.25f, 1});
        const auto light = drawn(mesh);
        double sum = 0;
        for (int y = 0; y < kPicture.y; ++y)
            for (int x = 0; x < kPicture.x; ++x) {
                const double off = glm::length(glm::dvec2(x + 0.5, y + 0.5) - middle);
                const double covered = std::clamp(radius + 0.5 - off, 0.0, 1.0);
                EXPECT_NEAR(at(light, x, y).r, covered, 1.0 / 32 + 1e-4) << x << ' ' << y;
                EXPECT_NEAR(at(light, x, y).b, 0.25f * at(light, x, y).r, 1e-6f);
                sum += static_cast<double>(at(light, x, y).r);
            }
        const double area = std::numbers::pi * radius * radius;
        EXPECT_NEAR(sum, area, 0.03 * area + 0.3) << radius;
    }
}

TEST(FlatRaster, ADiscsTrianglesMeetWithoutGapOrOverlap) {
    FlatMesh mesh;
    mesh.disc({31.2f, 24.5f}, 18, glm::vec4(0.5f));
    const auto light = drawn(mesh);
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x) {
            const float off = glm::length(glm::vec2(x, y) + 0.5f - glm::vec2(31.2f, 24.5f));
            if (off < 17.4f) {
                EXPECT_EQ(at(light, x, y).r, 0.5f) << x << ' ' << y;
            }
            if (off > 18.6f) {
                EXPECT_EQ(at(light, x, y).r, 0.0f) << x << ' ' << y;
            }
        }
}

TEST(FlatRaster, TextIsItsGlyphsAsPicturesHaveThem) {
    const Font& font = tests::fontFor(kPicture);
    for (const glm::vec3 color : {glm::vec3(1), glm::vec3(0.02f, 0.05f, 0.01f)}) {
        FlatMesh mesh;
        mesh.text(font, labelStyle(kPicture), "Ag 42", {3.4f, 9}, color);
        Image expected(kPicture, {0.3f, 0.3f, 0.3f, 1});
        draw(expected, font, font.layout("Ag 42", labelStyle(kPicture), {3.4f, 9}),
             glm::vec4(color, 1));
        const auto light = drawn(mesh, kPicture.y, {0.3f, 0.3f, 0.3f, 1});
        double differs = 0;
        for (int y = 0; y < kPicture.y; ++y)
            for (int x = 0; x < kPicture.x; ++x) {
                EXPECT_NEAR(at(light, x, y).r, expected.at(x, y).r, 1e-6f) << x << ' ' << y;
                differs += std::abs(at(light, x, y).r - 0.3f);
            }
        EXPECT_GT(differs, 10) << "or nothing was compared";
    }
}

FlatMesh everything() {
    FlatMesh mesh;
    mesh.gradient({5, 5}, {55, 12}, std::array{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1)});
    mesh.plate({{20, 15}, {40, 30}}, 5, glm::vec4(0.4f));
    mesh.line({-300, 20, 0.2f}, {400, 31, 0.9f}, 2, {0, 1, 0, 1});
    mesh.text(tests::fontFor(kPicture), labelStyle(kPicture), "cut off", {-7, 40}, glm::vec3(1));
    return mesh;
}

TEST(FlatRaster, BandsOfRowsAreThePictureBitForBit) {
    const auto whole = drawn(everything());
    for (const int rows : {1, 5, 47}) EXPECT_EQ(drawn(everything(), rows), whole) << rows;
}

TEST(FlatRaster, NothingChangesButWhatItTouches) {
    constexpr glm::ivec2 kWide{300, 5};
    FlatMesh mesh;
    mesh.rect({70, 1}, {75, 2}, glm::vec4(0.5f));
    mesh.line({150, 0, 0}, {290, 5, 0}, 1, glm::vec4(0.5f));
    std::vector<glm::vec4> light(std::size_t(kWide.x) * kWide.y);
    TouchedPixels touched;
    touched.begin(kWide.x, kWide.y);
    FlatRaster(mesh, tests::fontFor(kWide), kWide).draw({kWide, 0, kWide.y, &light[0].x}, &touched);
    int changed = 0, runs = 0, aside = 0;
    for (int row = 0; row < kWide.y; ++row) {
        int end = 0;
        touched.forEachRun(row, [&](int first, int last, bool isTouched) {
            EXPECT_EQ(first, end) << "each of a row once";
            end = last;
            ++runs;
            for (int x = first; x < last; ++x) {
                const bool is = light[std::size_t(row) * kWide.x + std::size_t(x)].a > 0;
                changed += is;
                aside += !isTouched;
                EXPECT_TRUE(isTouched || !is) << x << ' ' << row;
            }
        });
        EXPECT_EQ(end, kWide.x);
    }
    EXPECT_GT(changed, 100);
    EXPECT_GT(aside, 5 * 300 / 2) << "or too much is looked at";
    EXPECT_GT(runs, kWide.y);
}

TEST(FlatRaster, AGradientPassesThroughItsStops) {
    FlatMesh mesh;
    mesh.gradient({4, 4}, {52, 20}, std::array{glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)});
    const auto light = drawn(mesh);
    for (int x = 4; x < 52; ++x) {
        const float share = (static_cast<float>(x) + 0.5f - 4) / 48;
        EXPECT_NEAR(at(light, x, 10).r, share, 1e-6f);
        EXPECT_NEAR(at(light, x, 10).g, 1 - share, 1e-6f);
    }
}

TEST(FlatRaster, DepthIsTheNearestLinesWhereItCoversMoreThanHalf) {
    FlatMesh mesh;
    mesh.line({0, 10, 0.2f}, {64, 10, 0.8f}, 3, glm::vec4(1));  // rows 8.5 to 11.5
    mesh.line({20, 0, 0.4f}, {20, 48, 0.4f}, 4, glm::vec4(1));
    const FlatRaster raster(mesh, tests::fontFor(kPicture), kPicture);
    std::vector<float> depth(std::size_t(kPicture.x) * kPicture.y, 1.0f);
    raster.drawDepth({kPicture, 0, kPicture.y, depth.data()});
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x) {
            // A pixel's middle half a pixel from the side is covered by half, which is not more.
            double expected = 1;
            if (std::abs(y + 0.5 - 10) < 1.5) expected = 0.2 + 0.6 * (x + 0.5) / 64;
            if (std::abs(x + 0.5 - 20) < 2) expected = std::min(expected, 0.4);
            EXPECT_NEAR(depth[std::size_t(kPicture.y - 1 - y) * kPicture.x + x], expected, 1e-6)
                << x << ' ' << y;
        }
}

TEST(FlatRaster, WhatHasNoAreaOrLiesOutsideIsNotDrawn) {
    FlatMesh mesh;
    mesh.rect({10, 10}, {10, 30}, glm::vec4(1));
    mesh.rect({-50, -50}, {-1, -1}, glm::vec4(1));
    mesh.rect({100, 100}, {1e9f, 1e9f}, glm::vec4(1));
    for (const glm::vec4& pixel : drawn(mesh)) EXPECT_EQ(pixel, glm::vec4(0, 0, 0, 1));
    EXPECT_TRUE(FlatRaster(FlatMesh(), tests::fontFor(kPicture), kPicture).empty());
}

}  // namespace
}  // namespace render

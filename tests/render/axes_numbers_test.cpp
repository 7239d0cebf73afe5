// What the axes of a box say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "render/annotate/legend.h"
#include "tests/support/drawn_axes.h"

namespace render {
namespace {

using namespace drawn_axes;
using tests::shapes;
using timeseries::Axis;

TEST(LabelStyle, GrowsWithThePictureWithinLimits) {
    EXPECT_EQ(labelStyle({64, 4096}).linePixels, 13);
    EXPECT_EQ(labelStyle({920, 2000}).linePixels, 20);
    EXPECT_EQ(labelStyle({8192, 8192}).linePixels, 40);
    EXPECT_GT(titleStyle({920, 920}).linePixels, 20);
    EXPECT_EQ(titleStyle({920, 920}).weight, FontWeight::SemiBold);
}

TEST(Axes, NumbersOfAShearedGridStandBesideTheirPlaces) {
    const Grid grid = sheared();
    const Drawn d(grid, eyeAt(-60, 25, 3.5), {1024, 1024});
    const double line = labelStyle({1024, 1024}).linePixels;
    const auto label = d.label("0.2");  // of the z axis, which takes its place first
    ASSERT_TRUE(label);
    const glm::dvec2 middle(0.5f * (label->lo + label->hi));
    double nearest = 1e9;
    for (int sides = 0; sides < 4; ++sides) {
        glm::dvec3 along(sides & 1 ? 1 : -1, sides & 2 ? 1 : -1, 0);
        along.z = d.placed.axesFromGrid({0, 0, 0.2}).z / d.placed.boxHalf().z;
        const glm::dvec3 place = seen(d.view, d.placed.boxHalfEdges() * along);
        nearest = std::min(nearest, glm::distance(glm::dvec2(place), middle));
    }
    EXPECT_LT(nearest, 2.5 * line);
}

TEST(Axes, ADownAxisShowsItsOwnNumbersGrowingDownward) {
    for (const double elevation : {25.0, -25.0}) {
        const Drawn d(ocean(), eyeAt(-70, elevation, 3), {1024, 1024});
        const auto top = d.label("0"), bottom = d.label("1000"), title = d.label("depth (m)");
        ASSERT_TRUE(top && bottom && title);
        EXPECT_LT(top->hi.y, bottom->lo.y);
        EXPECT_TRUE(d.label("lon (°E)") && d.label("lat (°N)"));
    }
}

TEST(Axes, WhatIsSeenOfAnEdgeIsNumbered) {
    // Close to the top of the left edge, which is the sea's surface.
    const PlacedPoints placed(ocean());
    const glm::ivec2 size(1024, 1024);
    const glm::dvec3 corner = placed.boxHalf() * glm::dvec3(-1, -1, 1);
    const glm::dvec3 eye = corner + glm::dvec3(0.15, -0.6, 0.1);
    View view = lookFrom(eye, size);
    view.viewFromWorld = glm::lookAt(eye, corner, glm::dvec3(0, 0, 1));
    const auto meshes = axesMeshes(ocean(), placed, view, {eye}, fontFor(size));
    const auto shown = [&](const char* text) {
        return tests::find(meshes.labels, fontFor(size), labelStyle(size), text).has_value();
    };
    EXPECT_TRUE(shown("depth (m)"));
    EXPECT_TRUE(shown("100") || shown("200"));
    EXPECT_FALSE(shown("900") || shown("1000"));
}

TEST(Axes, AShortAxisHasMoreThanOneNumberWhereTheyFit) {
    // In steps of 0.2 there are five numbers, in steps of 0.5 only 10.
    const Grid grid({tests::measuredAxis("x", "m", 0, 0.9, 60),
                     tests::measuredAxis("y", "m", 9.55, 10.45, 60),
                     tests::measuredAxis("z", "m", 0, 0.9, 60)});
    for (const double azimuth : {-65.0, -60.0, -55.0, -50.0, -45.0}) {
        const Drawn d(grid, eyeAt(azimuth, 22, 3.4), {1200, 900});
        EXPECT_TRUE(d.label("10.2") || d.label("9.8")) << azimuth;
    }
}

// Seen face on, the box reaches so near to the picture's sides that "100000" has no room there.
TEST(Axes, NumbersStandOnTheBoxWhereThereIsNoRoomBesideIt) {
    const Grid grid({tests::measuredAxis("lon", "degrees_east", 20.5, 378.5, 180),
                     tests::measuredAxis("lat", "degrees_north", -89.5, 89.5, 90),
                     tests::measuredAxis("lev", "Pa", 100000, 1000, 17, true)});
    const glm::ivec2 size(400, 580);
    for (double distance = 3.2; distance < 4.4; distance += 0.05) {
        const Drawn d(grid, eyeAt(0, -12, distance), size, 0.4);
        EXPECT_TRUE(d.label("lev (Pa)")) << distance;
        int count = 0;
        for (const char* number : {"20000", "40000", "50000", "60000", "80000", "100000"})
            count += d.label(number).has_value();
        EXPECT_GE(count, 2) << distance;
    }
}

TEST(Axes, NumbersStandBesideTheirPlaces) {
    const Drawn d(fire(), eyeAt(-60, 25, 3.2), {1024, 1024});
    const float line = static_cast<float>(labelStyle({1024, 1024}).linePixels);
    // Seen from the lower left front: x runs along the front, z up the left.
    const double half = d.placed.boxHalf().x;
    const auto world = [&](double v) { return (v - 0.5) * d.placed.scale().x; };
    const auto z = d.label("0.2"), x = d.label("x (m)");
    ASSERT_TRUE(z && x);
    const glm::dvec3 place = seen(d.view, {-half, -half, world(0.2)});
    EXPECT_LT(z->hi.x, place.x);
    EXPECT_GT(z->hi.x, place.x - line);
    EXPECT_NEAR(0.5 * (z->lo.y + z->hi.y), place.y, 0.3 * line);
    EXPECT_GT(x->lo.y, seen(d.view, {0, -half, -half}).y);
}

double cross(glm::dvec2 o, glm::dvec2 a, glm::dvec2 b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}
// Whether a convex polygon, the hull of points, and a rectangle are apart: some side of either
// separates them.
bool apart(const std::vector<glm::dvec2>& points, const Rect& r) {
    std::vector<glm::dvec2> corners = {r.lo, {r.hi.x, r.lo.y}, r.hi, {r.lo.x, r.hi.y}};
    const auto separated = [](const auto& from, const auto& a, const auto& b) {
        for (const auto& p : from)
            for (const auto& q : from) {
                if (glm::distance(p, q) < 1e-6) continue;
                bool all = true;
                for (const auto& s : a) all = all && cross(p, q, s) <= 1e-6;
                for (const auto& s : b) all = all && cross(p, q, s) >= -1e-6;
                if (all) return true;
            }
        return false;
    };
    return separated(points, points, corners) || separated(corners, corners, points);
}

// Labels as glyphs that follow each other on a line.
std::vector<Rect> labels(const FlatMesh& mesh, float line) {
    std::vector<Rect> found;
    const tests::Shape* last = nullptr;
    const auto all = shapes(mesh);
    for (const auto& shape : all) {
        const bool follows = last != nullptr &&
                             shape.covers.lo.x - last->covers.hi.x < 0.42f * line &&
                             shape.covers.lo.x > last->covers.lo.x - 2 &&
                             std::abs(shape.covers.hi.y - last->covers.hi.y) < 0.7f * line;
        if (follows) {
            found.back() = tests::around(found.back(), shape.covers);
        } else {
            found.push_back(shape.covers);
        }
        last = &shape;
    }
    return found;
}

// Labels stand on the box where there is no room beside it: in narrow pictures, seen from near.
TEST(Axes, LabelsLieInThePictureApartAndAlmostAllOutsideTheBox) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-89.9, 89.9),
        distance(1.2, 6), tangent(0.1, 1.2);
    const std::vector<glm::ivec2> sizes = {{1024, 1024}, {1920, 1080}, {480, 360},  {200, 150},
                                           {64, 64},     {360, 1200},  {3000, 400}, {4096, 4096}};
    const auto grids = worlds();
    std::size_t labelCount = 0, onBox = 0;
    for (int i = 0; i < 1200; ++i) {
        glm::dvec3 eye = eyeAt(azimuth(random), elevation(random), distance(random));
        if (i % 5 == 0) eye = eyeAt(90.0 * (i % 4), 1e-9 * (i % 3), 3);  // face on
        const glm::ivec2 size = sizes[static_cast<std::size_t>(i) % sizes.size()];
        const Grid& grid = grids[static_cast<std::size_t>(i / 8) % grids.size()];
        const Drawn d(grid, eye, size, tangent(random));
        const std::string which =
            fmt::format("{}: {} x {}, eye {} {} {}", i, size.x, size.y, eye.x, eye.y, eye.z);
        std::vector<glm::dvec2> corners;
        for (int c = 0; c < 8; ++c) {
            const glm::dvec3 signs(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
            corners.emplace_back(seen(d.view, d.placed.boxHalfEdges() * signs));
        }
        const auto found = labels(d.meshes.labels, static_cast<float>(labelStyle(size).linePixels));
        labelCount += found.size();
        for (std::size_t a = 0; a < found.size(); ++a) {
            EXPECT_TRUE(found[a].lo.x >= 0 && found[a].lo.y >= 0 &&
                        found[a].hi.x <= static_cast<float>(size.x) &&
                        found[a].hi.y <= static_cast<float>(size.y))
                << which;
            if (!apart(corners, found[a])) ++onBox;
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_FALSE(tests::overlap(found[a], found[b])) << which;
        }
    }
    EXPECT_GT(labelCount, 6000u);
    EXPECT_LT(onBox, labelCount / 20);
}

TEST(Axes, AllThreeAreNamedFromEveryCornerView) {
    for (const double azimuth : {-150.0, -120.0, -60.0, -30.0, 30.0, 60.0, 120.0, 150.0}) {
        for (const double elevation : {-50.0, -20.0, 20.0, 50.0}) {
            const Drawn d(fire(), eyeAt(azimuth, elevation, 3.4), {800, 600});
            for (const char* title : {"x (m)", "y (m)", "z (m)"})
                EXPECT_TRUE(d.label(title)) << title << ' ' << azimuth << ' ' << elevation;
        }
    }
}

TEST(Axes, TitlesKeepTheLegendsMarginWhereThereIsRoom) {
    // A long title beside wide numbers. As the picture grows narrower, the place beyond the numbers
    // comes to its edge; then the title is to stand between two of them.
    const Grid grid({tests::measuredAxis("x", "m", 0, 1, 5), tests::measuredAxis("y", "m", 0, 1, 5),
                     tests::measuredAxis("pressure of the level", "Pa", 0, 100000, 9, true)});
    std::size_t beyond = 0, between = 0;
    for (int width = 1400; width >= 600; width -= 4) {
        const glm::ivec2 size(width, 600);
        const double line = labelStyle(size).linePixels, margin = 0.9 * line;
        const Drawn d(grid, eyeAt(-60, 25, 3.2), size);
        const auto title = d.label("pressure of the level (Pa)");
        if (!title) continue;
        // Where the middle of the labelled edge is seen.
        const glm::dvec3 half = d.placed.boxHalf();
        const double edge = seen(d.view, {-half.x, -half.y, 0}).x;
        const double length = static_cast<double>(title->hi.x - title->lo.x);
        if (edge - length - 2 * line < margin) continue;  // no room either way
        EXPECT_GE(title->lo.x, margin - 1) << width;
        ++(static_cast<double>(title->hi.x) < edge - 3 * line ? beyond : between);
    }
    EXPECT_GT(beyond, 0u);
    EXPECT_GT(between, 0u);
}

TEST(Axes, DegreesOfManyCirclesAreNumberedSparsely) {
    for (const double step : {500.0, 1e12, 1e300}) {
        Axis lon = tests::axis(6, 0, step);
        lon.units = "degrees_east";
        const Grid grid({lon, tests::axis(5), tests::axis(4)});
        const glm::ivec2 size(800, 600);
        const glm::dvec3 eye(0.5, -4, 1);
        const AxesMeshes meshes =
            axesMeshes(grid, PlacedPoints(grid), lookFrom(eye, size), {eye}, fontFor(size));
        EXPECT_LT(meshes.before.triangles().size(), 6u * 60) << step;
    }
}

TEST(Axes, LabelsKeepOffTheLegend) {
    const glm::ivec2 size(800, 600);
    const glm::dvec3 eye = eyeAt(-60, 25, 3.4);
    const Drawn alone(fire(), eye, size);
    const auto where = alone.label("z (m)");
    ASSERT_TRUE(where);
    FlatMesh legend;
    const float reach = 6;
    legend.rect(where->lo - reach, where->hi + reach, glm::vec4(1));
    const auto meshes = axesMeshes(fire(), alone.placed, alone.view, {eye}, alone.font, legend);
    for (const auto& shape : shapes(meshes.labels))
        EXPECT_FALSE(tests::overlap(shape.covers, {where->lo - reach, where->hi + reach}));
    EXPECT_TRUE(tests::find(meshes.labels, alone.font, labelStyle(size), "z (m)"));
}

// What is dark or soft under a legend is no place for a part of a label.
TEST(Axes, LabelsKeepOffTheLegendsGround) {
    const glm::ivec2 size(800, 600);
    const glm::dvec3 eye = eyeAt(-60, 25, 3.4);
    const Drawn alone(fire(), eye, size);
    const auto where = alone.label("z (m)");
    ASSERT_TRUE(where);
    FlatMesh legend;  // beside the name, nearer than its ground reaches
    legend.rect({where->lo.x - 10, where->lo.y}, {where->lo.x - 3, where->hi.y}, glm::vec4(1));
    const auto meshes = axesMeshes(fire(), alone.placed, alone.view, {eye}, alone.font, legend);
    for (const auto& shape : shapes(meshes.labels))
        for (const auto& dark : shapes(legendGround(legend, size, glm::dvec3(0))))
            EXPECT_FALSE(tests::overlap(shape.covers, dark.covers));
    EXPECT_TRUE(tests::find(meshes.labels, alone.font, labelStyle(size), "z (m)"));
}

// From above, depth is four lines in the corners, under the sea's surface.
TEST(Axes, OneSeenEndOnHasNoNameAndTheOthersHaveAll) {
    const Grid nameless(
        {ocean().axes()[0], ocean().axes()[1], tests::measuredAxis("", "", 0, 1000, 19, true)});
    for (const double distance : {2.2, 2.6, 3.0, 4.0})
        for (const glm::ivec2 size : {glm::ivec2(640, 480), {400, 300}, {1200, 900}}) {
            const glm::dvec3 eye = eyeAt(-90, 90 - 1e-6, distance);
            const Drawn d(ocean(), eye, size), other(nameless, eye, size);
            EXPECT_FALSE(d.label("depth (m)") || d.label("depth")) << distance;
            EXPECT_TRUE(d.label("lon") && d.label("lat")) << distance;
            EXPECT_EQ(d.meshes.labels.covers(), other.meshes.labels.covers()) << distance;
        }
}

// A number alone would be all that is said of it.
TEST(Axes, OneShorterThanALineOfTextIsNotLabelled) {
    const auto flat = [](double height) {
        return Grid({tests::measuredAxis("x", "m", 0, 1, 5), tests::measuredAxis("y", "m", 0, 1, 5),
                     tests::measuredAxis("z", "m", 70, 70 + height, 5)});
    };
    const glm::ivec2 size(900, 600);
    const Drawn high(flat(0.3), eyeAt(-60, 25, 3.2), size);
    EXPECT_TRUE(high.label("z (m)") && high.label("70.2"));
    const Drawn low(flat(1e-3), eyeAt(-60, 25, 3.2), size);
    EXPECT_FALSE(low.label("z (m)"));
    for (const char* number : {"70", "70.0", "70.000", "70.001", "70.0005"})
        EXPECT_FALSE(low.label(number)) << number;
    EXPECT_TRUE(low.label("x (m)") && low.label("y (m)"));
}

// Three letters of "depth" say less than the unit beside the numbers does.
TEST(Axes, ShortNamesAreToldWholeOrNotAtAll) {
    std::size_t whole = 0;
    for (int width = 300; width < 900; width += 10)
        for (const double azimuth : {-80.0, -60.0, -30.0}) {
            const Drawn d(ocean(), eyeAt(azimuth, 25, 3.4), {width, 300});
            whole += d.label("depth (m)").has_value();
            for (const char* cut : {"d\u2026 (m)", "de\u2026 (m)", "dep\u2026 (m)"})
                EXPECT_FALSE(d.label(cut)) << cut << ' ' << width << ' ' << azimuth;
        }
    EXPECT_GT(whole, 0u);
}

// A unit that is a sentence is cut, and the name stays.
TEST(Axes, NamesStayBesideUnitsThatAreTooWide) {
    const std::string unit = "kilometres above the reference geoid";
    const Grid grid({tests::measuredAxis("x", "m", 0, 1, 5), tests::measuredAxis("y", "m", 0, 1, 5),
                     tests::measuredAxis("height", unit, 0, 1, 5)});
    std::size_t whole = 0, cut = 0;
    for (int width = 1800; width >= 700; width -= 20) {
        const Drawn d(grid, eyeAt(-60, 25, 3.2), {width, 600});
        whole += d.label("height (" + unit + ")").has_value();
        for (std::size_t n = 1; n < unit.size(); ++n)
            cut += d.label("height (" + unit.substr(0, n) + "\u2026)").has_value();
    }
    EXPECT_GT(whole, 0u);
    EXPECT_GT(cut, 0u);
}

// On a cube whose names are too wide for the margin beside it, they are cut, not moved.
TEST(Axes, NamesThatAreTooWideAreShortenedBesideTheirEdge) {
    const std::string name = "height above the reference ellipsoid";
    const Grid grid({tests::measuredAxis("x", "m", 0, 1, 5), tests::measuredAxis("y", "m", 0, 1, 5),
                     tests::measuredAxis(name, "m", 0, 1, 5)});
    std::size_t whole = 0, cut = 0;
    for (int width = 1400; width >= 500; width -= 10) {
        const Drawn d(grid, eyeAt(-60, 25, 3.2), {width, 600});
        const bool isWhole = d.label(name + " (m)").has_value();
        bool isCut = false;
        for (std::size_t n = 1; n < name.size(); ++n)
            isCut = isCut || d.label(name.substr(0, n) + "\u2026 (m)");
        whole += isWhole;
        cut += isCut;
        EXPECT_TRUE(isWhole || isCut || !d.label("height")) << "no name without its unit";
    }
    EXPECT_GT(whole, 0u);
    EXPECT_GT(cut, 0u);
}

TEST(Axes, BothEyesLabelTheSameEdgesAndTicks) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-80, 80);
    const glm::ivec2 size(900, 900);
    const Grid grid = ocean();
    const PlacedPoints placed(grid);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 mid = eyeAt(azimuth(random), elevation(random), 3.0);
        const View view = lookFrom(mid, size, 0.6);
        std::array<std::size_t, 2> tickCount{};
        for (const int side : {0, 1}) {
            View eye = view;
            const double apart = side == 0 ? -0.06 : 0.06;
            eye.viewFromWorld[3].x -= apart;
            // The eyes' frusta lean outward, as a headset's do.
            eye.clipFromView[2][0] = side == 0 ? -0.1 : 0.1;
            const auto meshes = axesMeshes(grid, placed, eye, {mid}, fontFor(size));
            tickCount[static_cast<std::size_t>(side)] = meshes.before.triangles().size();
        }
        EXPECT_EQ(tickCount[0], tickCount[1]) << i;
    }
}

}  // namespace
}  // namespace render

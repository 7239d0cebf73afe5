// All text over pictures, as rectangles: legend, notes, axes' names and numbers, and the lines of
// the box, in the windows that users have and from all around.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "app/choices/camera.h"
#include "app/panels/layout.h"
#include "render/annotate/axes.h"
#include "render/annotate/axis_labels.h"
#include "render/annotate/legend.h"
#include "render/annotate/ticks.h"
#include "render/frame/frame.h"
#include "tests/support/measured_axis.h"
#include "tests/support/rounds.h"
#include "tests/support/text_page.h"

namespace app {
namespace {

using render::FlatMesh;
using render::PixelRect;
using timeseries::Axis;
using timeseries::Grid;
using namespace tests::text_page;

// Like the files that are at hand: a cube, an ocean, a sheet, a hurricane, air by pressure, a
// channel, a turned grid, and one whose names and numbers are long.
std::vector<Grid> grids() {
    const auto cube = tests::measuredAxis("x", "m", 1 / 120.0, 119 / 120.0, 60);
    const auto lon = tests::measuredAxis("lon", "degrees_east", 20.5, 378.5, 180),
               lat = tests::measuredAxis("lat", "degrees_north", -89.5, 89.5, 90);
    return {
        Grid({cube, tests::measuredAxis("y", "m", 0, 1, 60),
              tests::measuredAxis("z", "m", 0, 1, 60)}),
        Grid({lon, lat, tests::measuredAxis("depth", "m", 0, 1000, 19, true)}),
        Grid({lon, lat, tests::measuredAxis("z", "index", 0, 0, 1)}),
        Grid({tests::measuredAxis("x", "", 0, 498, 125), tests::measuredAxis("y", "", 0, 498, 125),
              tests::measuredAxis("z", "", 0, 72, 25)}),
        Grid({lon, lat, tests::measuredAxis("lev", "Pa", 100000, 1000, 17, true)}),
        Grid({tests::measuredAxis("x", "m", 0, 512, 129), tests::measuredAxis("y", "m", 0, 32, 9),
              tests::measuredAxis("z", "m", 0, 4, 3)}),
        Grid({cube, tests::measuredAxis("y", "m", 0, 2, 60),
              tests::measuredAxis("z", "m", 0, 1, 60)},
             {glm::dmat3({0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0.2, 0.1, std::sqrt(0.95)})}),
        Grid({tests::measuredAxis("projection_x_coordinate_of_the_rotated_pole", "meters", 412000,
                                  418000, 7),
              tests::measuredAxis("grid_latitude", "degrees", -3.1415, 2.7182, 70),
              tests::measuredAxis("model_level_number_above_the_ground\n(hybrid)", "kg m-2 s-1",
                                  -2e-9, 1e7, 10)})};
}

render::Legend legend(std::size_t layers, bool wordy) {
    render::Legend made{
        "Temperature (\u00b0C)", "0000-07-16 20:54:36, step 6 of 0\u201311", {}, {}};
    if (wordy) made.title = "temperature of the air at the levels of the model, instantaneous (K)";
    for (std::size_t i = 0; i < layers; ++i) {
        const render::RangeStyle constant{render::Constant{{0.8, 0.4, 0.1}}, 0.5},
            byValue{render::ByValue{render::ColorMap(), 21.1849, 31.6504}, 0.5};
        made.layers.push_back(
            {i % 2 ? constant : byValue, "\u2265 23.6 \u00b0C", "18,817 points, 10.1 %"});
    }
    made.notes = {"5.59 m depth drawn as 1\u00b0 lon"};
    if (wordy)
        made.notes.push_back(
            "model_level_number is a level, not a height: used as it is, level_height has formula "
            "terms a: level_height b: sigma orog: surface_altitude, and the data are drawn in "
            "index "
            "space because the 2-D coordinates grid_latitude and grid_longitude differ from it");
    return made;
}

std::vector<std::pair<glm::dvec2, glm::dvec2>> lines(const render::AxesMeshes& axes) {
    std::vector<std::pair<glm::dvec2, glm::dvec2>> found;
    for (const FlatMesh* mesh : {&axes.behind, &axes.before}) {
        const auto& v = mesh->triangles();  // a, b, b' | a, b', a' around the line
        for (std::size_t i = 0; i < v.size(); i += 6)
            found.emplace_back(0.5 * (glm::dvec2(v[i].at) + glm::dvec2(v[i + 5].at)),
                               0.5 * (glm::dvec2(v[i + 1].at) + glm::dvec2(v[i + 2].at)));
    }
    return found;
}

void expectApart(const Page& page, const std::string& which) {
    const auto texts = page.texts();
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_TRUE(texts[i].lo.x >= 0 && texts[i].lo.y >= 0 && texts[i].hi.x <= page.size.x &&
                    texts[i].hi.y <= page.size.y)
            << which << ": text " << i;
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(render::overlap(texts[i], texts[j])) << which << ": " << i << ", " << j;
    }
    // Half of a label in a plate would be a ghost.
    for (const PixelRect& label : page.axes.labels.covers())
        for (const PixelRect& plate : page.plates())
            EXPECT_FALSE(render::overlap(label, plate)) << which;
    for (const auto& [from, to] : lines(page.axes))
        for (std::size_t i = 0; i < texts.size(); ++i)
            EXPECT_FALSE(render::partInside(from, to, texts[i])) << which << ": a line, text " << i;
}

// Whoever reads a name takes the nearest axis for its own.
void expectNamesBesideTheirOwnEdge(const Page& page, const std::vector<SeenEdge>& all,
                                   const std::string& which) {
    for (const render::AxisLabels& axis : page.labels) {
        if (!axis.name) continue;
        const PixelRect name = page.seen(*axis.name);
        const auto farFrom = [&](const SeenEdge& shown) {
            return render::distance(name, shown.from, shown.to);
        };
        const auto own = std::ranges::find_if(
            all, [&](const SeenEdge& shown) { return isLabelled(shown, axis); });
        ASSERT_TRUE(own != all.end()) << which;
        for (const render::AxisLabels& other : page.labels) {
            if (other.edge.axis == axis.edge.axis) continue;
            for (const SeenEdge& shown : all)
                EXPECT_TRUE(!isLabelled(shown, other) || farFrom(*own) < farFrom(shown))
                    << which << ": " << axis.name->text;
            for (const auto& number : other.numbers)
                EXPECT_FALSE(number &&
                             render::overlap(name.grown(0.99 * page.line()), page.seen(*number)))
                    << which << ": " << axis.name->text << ", " << number->text;
        }
    }
}

// Whether nothing is in the way of a name in the middle of its edge, however far out, as wide as
// the widest number, it stands.
bool hasRoomForName(const Page& page, const std::vector<SeenEdge>& all, const SeenEdge& own,
                    const render::AxisLabels& axis, const glm::dvec2& name,
                    const glm::dvec2& widest) {
    const glm::dvec2 middle = 0.5 * (own.from + own.to), out = axis.outward;
    const bool onBox = glm::dot(out, middle - page.sights.pixel(0, glm::dvec3(0))) <= 0;
    if (!own.outline || onBox || glm::distance(own.from, own.to) <= page.line()) return false;
    const auto across = [&](const glm::dvec2& size) { return glm::dot(size, glm::abs(out)); };
    const double nearest = 0.7 * page.line() + across(0.5 * name),
                 farthest = nearest + 0.6 * page.line() + across(widest) + 2;
    const auto at = [&](double away) {
        return PixelRect{middle + away * out - 0.5 * name, middle + away * out + 0.5 * name};
    };
    const PixelRect swept = render::around(at(nearest), at(farthest)).grown(0.5 * page.line());
    if (!(swept.lo.x >= 0 && swept.lo.y >= 0 && swept.hi.x <= page.size.x &&
          swept.hi.y <= page.size.y))
        return false;
    const auto isTaken = [&](const PixelRect& other) { return render::overlap(swept, other); };
    if (std::ranges::any_of(page.plates(), isTaken)) return false;
    for (const render::AxisLabels& other : page.labels) {
        if (other.edge.axis == axis.edge.axis) continue;
        for (const auto& number : other.numbers)
            if (number && isTaken(page.seen(*number).grown(page.line()))) return false;
        if (other.name && isTaken(page.seen(*other.name))) return false;
    }
    return std::ranges::none_of(all, [&](const SeenEdge& other) {
        return other.edge.axis != axis.edge.axis &&
               render::distance(swept, other.from, other.to) < farthest + page.line();
    });
}

std::string titleOf(const Axis& axis) {
    const std::string unit = render::shownUnit(axis.units);
    std::string title = unit.empty() ? axis.name : fmt::format("{} ({})", axis.name, unit);
    std::ranges::replace(title, '\n', ' ');
    return title;
}

// How often the rule below asked for a name, and for numbers.
std::pair<std::size_t, std::size_t> counted;

// The rule of axis_labels.h, from the lengths of edges and labels alone.
void expectNamedAndNumbered(const Page& page, const Grid& grid, const std::vector<SeenEdge>& all,
                            const std::string& which) {
    const auto font = [&](const std::string& text) {
        return glm::dvec2(tests::fontFor(page.size).measure(text, render::labelStyle(page.size)));
    };
    for (int axis = 0; axis < 3; ++axis) {
        const Axis& about = grid.axes()[static_cast<std::size_t>(axis)];
        const auto [lo, hi] = std::ranges::minmax(about.coordinates);
        glm::dvec2 widest(0);
        for (const std::string& text : render::tickTexts(render::niceTicks(lo, hi, 9)))
            widest = glm::max(widest, font(text));
        bool numbered = false;
        for (const auto& [edge, from, to, outline] : all) {
            if (edge.axis != axis) continue;
            // Room for numbers on either side, the edges of nothing else among it.
            PixelRect around{glm::min(from, to), glm::max(from, to)};
            around = {around.lo - widest - 1.5 * page.line(),
                      around.hi + widest + 1.5 * page.line()};
            const bool free = around.lo.x >= 0 && around.lo.y >= 0 && around.hi.x <= page.size.x &&
                              around.hi.y <= page.size.y &&
                              std::ranges::none_of(page.plates(), [&](const PixelRect& other) {
                                  return render::overlap(around, other);
                              });
            // Two pixels: roundings.
            const glm::dvec2 needs = (widest + 0.5 * page.line() + 2.0) / glm::abs(to - from);
            numbered = numbered || (outline && free && 5 * std::min(needs.x, needs.y) <= 1);
        }
        const auto shown = std::ranges::find_if(page.labels, [&](const render::AxisLabels& labels) {
            return labels.edge.axis == axis;
        });
        const bool isThere = shown != page.labels.end();
        const std::string title = titleOf(about);
        const bool named = std::ranges::any_of(all, [&](const SeenEdge& edge) {
            return isThere && isLabelled(edge, *shown) &&
                   hasRoomForName(page, all, edge, *shown, font(title), widest);
        });
        EXPECT_TRUE(!named || (shown->name && shown->name->text == title))
            << which << ", axis " << axis;
        EXPECT_TRUE(!numbered || (isThere && std::ranges::count_if(
                                                 shown->numbers,
                                                 [](const auto& n) { return n.has_value(); }) >= 2))
            << which << ", axis " << axis;
        counted.first += named;
        counted.second += numbered;
    }
}

const std::vector<std::pair<glm::vec2, float>> kWindows = {
    {{800, 640}, 1}, {{1600, 1000}, 1}, {{2560, 1440}, 1}, {{1600, 1000}, 2}, {{2560, 1440}, 2}};

TEST(PictureText, IsApartFromOtherTextAndFromLinesInEveryWindowFromAllAround) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-90, 90), shift(-1, 1);
    const auto worlds = grids();
    for (int i = 0; i < tests::rounds(1500); ++i) {
        const auto& [window, scale] = kWindows[random() % kWindows.size()];
        const glm::ivec2 size(panels::layoutOf(window, scale).picture.size());
        const Grid& grid = worlds[random() % worlds.size()];
        const render::PlacedPoints placed(grid);
        ViewChoice view;
        view.azimuthDegrees =
            random() % 4 == 0 ? 90.0 * static_cast<double>(random() % 4) : azimuth(random);
        view.elevationDegrees = random() % 6 == 0 ? 0 : elevation(random);
        if (random() % 3 == 0) view.projection = Projection::Orthographic;
        if (random() % 3 == 0) view.shift = glm::dvec2(shift(random), shift(random));
        const bool fitted = random() % 3 != 0;
        if (!fitted) view.distance = 1.2 + 0.001 * static_cast<double>(random() % 4000);
        const auto views = eyes(view, {}, placed.boxHalfEdges(), size);
        const glm::dvec3 eye = render::pixelRays(views[0]).eye;
        const Page page(grid, placed, views[0], render::middleOf(views),
                        legend(std::array{0, 1, 2, 8}[random() % 4], random() % 2 == 0));
        const std::string which = fmt::format(
            "{}: {}, {} x {}, from {:.1f} {:.1f} {}", i, grid.axes()[2].name, size.x, size.y,
            view.azimuthDegrees, view.elevationDegrees, page.legend.covers().size());
        expectApart(page, which);
        const std::vector<SeenEdge> all = edgesIn(page, placed, eye);
        expectNamesBesideTheirOwnEdge(page, all, which);
        expectNamedAndNumbered(page, grid, all, which);
    }
    EXPECT_GT(counted.first, std::size_t{tests::rounds(1000)});
    EXPECT_GT(counted.second, std::size_t{tests::rounds(1200)});
}

// Names take what room numbers leave: however long they are, the same numbers are there.
TEST(PictureText, HasTheSameNumbersWhateverTheAxesAreCalled) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-90, 90);
    const auto worlds = grids();
    const std::vector<glm::ivec2> sizes = {{400, 300}, {640, 480}, {800, 600}, {1200, 900}};
    std::size_t count = 0, differ = 0;
    for (int i = 0; i < 300; ++i) {
        const Grid& grid = worlds[random() % worlds.size()];
        auto axes = grid.axes();
        for (Axis& axis : axes) axis.name += " of the atmosphere hybrid sigma pressure coordinate";
        const Grid wordy(axes, grid.frame());
        const ViewChoice view{.azimuthDegrees = azimuth(random),
                              .elevationDegrees = elevation(random),
                              .distance = {},
                              .target = {},
                              .projection = Projection::Perspective};
        const render::PlacedPoints placed(grid), placedWordy(wordy);
        const auto views = eyes(view, {}, placed.boxHalfEdges(), sizes[random() % sizes.size()]);
        const render::Middle middle = render::middleOf(views);
        const Page page(grid, placed, views[0], middle, legend(1, i % 2 == 0)),
            other(wordy, placedWordy, views[0], middle, legend(1, i % 2 == 0));
        ASSERT_EQ(page.labels.size(), other.labels.size()) << i;
        for (std::size_t axis = 0; axis < page.labels.size(); ++axis) {
            const auto &shown = page.labels[axis], &wordyOne = other.labels[axis];
            EXPECT_EQ(page.numbers(shown), other.numbers(wordyOne)) << i;
            count += page.numbers(shown).size();
            differ += shown.name.has_value() && wordyOne.name.has_value() &&
                      shown.name->text != wordyOne.name->text;
        }
    }
    EXPECT_GT(count, 3000u);
    EXPECT_GT(differ, 400u);
}

TEST(PictureText, IsTheSameForBothEyes) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-80, 80), shift(-1, 1);
    const auto worlds = grids();
    std::size_t count = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::ivec2 size(
            panels::layoutOf(kWindows[random() % kWindows.size()].first, 1).picture.size() /
            glm::vec2(2, 1));
        const Grid& grid = worlds[random() % worlds.size()];
        const render::PlacedPoints placed(grid);
        ViewChoice view{.azimuthDegrees = azimuth(random),
                        .elevationDegrees = elevation(random),
                        .distance = {},
                        .target = {},
                        .projection = i % 3 ? Projection::Perspective : Projection::Orthographic};
        if (i % 2 == 0) view.shift = glm::dvec2(shift(random), shift(random));
        const auto views = eyes(view, {Stereo::SideBySide, {}, {}}, placed.boxHalfEdges(), size);
        ASSERT_EQ(views.size(), 2u);
        const render::Middle middle = render::middleOf(views);
        const Page left(grid, placed, views[0], middle, legend(2, true)),
            right(grid, placed, views[1], middle, legend(2, true));
        const std::string which = fmt::format("{}: {} x {}", i, size.x, size.y);
        EXPECT_EQ(left.words(), right.words()) << which;
        EXPECT_EQ(left.axes.labels.covers().size(), right.axes.labels.covers().size()) << which;
        expectApart(left, which + ", left");
        expectApart(right, which + ", right");
        count += left.axes.labels.covers().size();
    }
    EXPECT_GT(count, 400u * 6);
}

// A shift is a larger picture, cut: in one with as much room around the box the same labels stand.
TEST(PictureText, IsTheSameHoweverThePictureIsShifted) {
    const glm::ivec2 size(700, 600);
    auto worlds = grids();
    worlds.pop_back();  // so long a name takes all the room that there is
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        for (const Grid& grid : worlds) {
            const render::PlacedPoints placed(grid);
            std::vector<std::string> first;
            for (const glm::dvec2& shift :
                 {glm::dvec2(0), glm::dvec2(0.2, 0), glm::dvec2(-0.1, 0.2), glm::dvec2(0, -0.2)}) {
                const ViewChoice view{.azimuthDegrees = 30,
                                      .elevationDegrees = 20,
                                      .distance = 6,
                                      .target = {},
                                      .projection = projection,
                                      .shift = shift};
                const auto views = eyes(view, {}, placed.boxHalfEdges(), size);
                const Page page(grid, placed, views[0], render::middleOf(views), {});
                EXPECT_EQ(page.sights.count(), 1u);
                if (first.empty()) first = page.words();
                EXPECT_EQ(page.words(), first) << shift.x << ", " << shift.y;
            }
        }
    }
}

// Of the labels before and after the smallest drag that shows, most are the same.
TEST(PictureText, StaysWhileTheViewTurnsALittle) {
    const glm::ivec2 size(1200, 940);
    for (const Grid& grid : grids()) {
        const render::PlacedPoints placed(grid);
        std::multiset<std::string> before;
        std::size_t kept = 0, all = 0;
        for (double azimuth = -180; azimuth < 180; azimuth += 1) {
            const ViewChoice view{.azimuthDegrees = azimuth,
                                  .elevationDegrees = 20,
                                  .distance = {},
                                  .target = {},
                                  .projection = Projection::Perspective};
            const auto views = eyes(view, {}, placed.boxHalfEdges(), size);
            const Page page(grid, placed, views[0], render::middleOf(views), legend(1, false));
            const auto words = page.words();
            const std::multiset<std::string> now(words.begin(), words.end());
            std::vector<std::string> same;
            std::ranges::set_intersection(before, now, std::back_inserter(same));
            kept += same.size();
            all += before.size();
            before = now;
        }
        EXPECT_GT(static_cast<double>(kept), 0.97 * static_cast<double>(all))
            << grid.axes()[2].name << ": " << kept << " of " << all;
    }
}

}  // namespace
}  // namespace app

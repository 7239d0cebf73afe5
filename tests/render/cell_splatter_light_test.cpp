// Interval volumes drawn cell by cell: how opaque a passage is, what hides what, and light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/model/cell_splat.h"
#include "render/model/light.h"
#include "render/reference/interval_truth.h"
#include "render/splat/cell_view.h"
#include "tests/support/lit_sphere.h"
#include "tests/support/meshes.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using namespace tests::cells;
using tests::axis;
using tests::CellWorld;
using tests::drawn;
using timeseries::Grid;

// Of a passage through all of a range that is thinner than a cell, a contour keeps W = 1; a range
// that is so wide that its length says more has its length. Also of one value alone.
TEST(CellSplatter, PerCrossingAThinRangeOfALinearFieldStaysVisible) {
    const auto grid = tests::cube(9);
    // The last ones end in two cells each, or lie at a face between them.
    for (const std::string range : {"3.3:6.3", "4.25:4.35", "4.2999:4.3001", "4.3", "4.3:max",
                                    "3.95:4.05", "3.99:4.03", "4:4.1", "3.9999:4", "4"}) {
        CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
            {range});
        const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
        const std::vector<float> length = drawn(world.scene, view);
        world.scene.opacityPer = OpacityPer::Crossing;
        const std::vector<float> w = drawn(world.scene, view);
        const bool isWide = range == "3.3:6.3" || range == "4.3:max";
        for (std::size_t i = 0; i < w.size(); ++i)
            ASSERT_NEAR(w[i], isWide ? length[i] : 1, isWide ? 1e-6 * length[i] : 5e-3)
                << range << " at " << i;
        if (isWide) continue;
        // Of pixels that are wider than the range, and of those at its rim, it is no more.
        const View oblique = tests::lookFrom({0.9, -3, 1.1}, {32, 32});
        EXPECT_LT(std::ranges::max(drawn(world.scene, oblique)), 1.1) << range;
    }
}

// What only the values of points are: a sheet and a rod of a mask that are one point thick. A pixel
// has of a sheet what it sees on both sides; rays beside a rod have less.
TEST(CellSplatter, PerCrossingWhatPointsAloneHaveIsSeen) {
    const auto grid = tests::cube(9);
    const auto maskOf = [&](auto isIn) {
        return CellWorld(tests::stepOf(grid,
                                       [&](std::size_t i) {
                                           return isIn(glm::ivec3(grid->indices(i))) ? 1.0f : 0.0f;
                                       }),
                         {"1"});
    };
    const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
    CellWorld sheet = maskOf([](const glm::ivec3& p) { return p.x == 4; });
    sheet.scene.opacityPer = OpacityPer::Crossing;
    for (const float w : drawn(sheet.scene, view)) ASSERT_NEAR(w, 1, 5e-3);
    CellWorld rod = maskOf([](const glm::ivec3& p) { return p.x == 4 && p.y == 4; });
    rod.scene.opacityPer = OpacityPer::Crossing;
    EXPECT_GT(std::ranges::max(drawn(rod.scene, tests::lookFrom({3, -0.4, 0.3}, {64, 64}))), 0.02);
    // They have no length.
    sheet.scene.opacityPer = OpacityPer::Length;
    EXPECT_EQ(std::ranges::max(drawn(sheet.scene, view)), 0);
}

// As a headset's views are scaled: how thin a range is, is asked of the world.
TEST(CellSplatter, PerCrossingAViewsScaleChangesNothing) {
    const auto grid = tests::cube(9);
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"4.25:4.35"});
    world.scene.opacityPer = OpacityPer::Crossing;
    const View view = tests::lookFrom({3, -0.4, 0.3}, {32, 32}, 0.05);
    const std::vector<float> w = drawn(world.scene, view);
    for (const double scale : {0.02, 50.0}) {
        View scaled = view;
        scaled.viewFromWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * view.viewFromWorld;
        EXPECT_THAT(drawn(world.scene, scaled), testing::Pointwise(testing::FloatNear(1e-3f), w))
            << scale;
    }
}

// The light of what absorbs evenly comes from the mean of s e^(-x s) over e^(-x s).
TEST(CellSplatter, LightComesFromTheFrontOfWhatHidesItsBack) {
    for (const double x : {1e-3, 0.1, 1.0, 3.0, 7.0, 16.0, 1e3}) {
        const double wanted = 1 / x - 1 / std::expm1(x);
        EXPECT_NEAR(shareFromFront(x), wanted, 0.025) << x;
    }
    EXPECT_DOUBLE_EQ(shareFromFront(0.0), 0.5);
}

// A ball about the eye's surroundings, of few cells, each of which hides most of what is behind it:
// its surface turns within a cell, so that the light of a cell's middle is another.
TEST(CellSplatter, AndWhatLightFallsOnIsThatFront) {
    const auto place = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    const glm::dvec3 centre(6, 5.8, 5.5);
    for (const auto& grid : {tests::cube(13), tests::curvilinear({13, 13, 13}, place)}) {
        CellWorld world(
            tests::stepOfPlaces(grid, [&](const auto& p) { return glm::distance(p, centre); }),
            {"0.2:4.5"}, 0.97);
        world.scene.order = Order::BackToFront;
        const View view = tests::lookFrom(
            world.placed.axesFromGrid(centre + glm::dvec3(0.9, -0.7, 0.3)), {48, 48});
        const auto dark = drawn(world.scene, view, Channels::Over);
        world.scene.light = Light::Soft;
        const auto lit = drawn(world.scene, view, Channels::Over);
        const auto truth = IntervalTruth(world.scene, world.scene.cells->field(), 1).light(view);
        double off = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            ASSERT_GT(dark[4 * i + 3], 0.9f);
            const double each = (double(lit[4 * i]) - truth[i].r) / double(dark[4 * i]);
            EXPECT_LT(std::abs(each), 0.025);  // 0.109 of the middle's, of tetrahedra 0.034
            off += each / double(truth.size());
        }
        EXPECT_LT(std::abs(off), 0.007);  // 0.043, of tetrahedra 0.012
    }
}

// Of a shell that is thinner than what a pixel sees of the field, a pixel sees all values,
// whichever cells its rays have of it: its colour is the map's mean, not that of the mean value.
TEST(CellSplatter, AThinShellHasTheMeanOfItsColorsEverywhere) {
    const auto grid = tests::cube(9);
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"4.29:4.31"}, 0.02);
    RangeStyle& style = world.scene.layers[0].style;
    style.color = ByValue{ColorMap(), 4.29, 4.31};
    world.scene.opacityPer = OpacityPer::Crossing;
    constexpr int kSamples = 1000;
    glm::dvec3 mean(0);
    for (int i = 0; i < kSamples; ++i)
        mean += colorOf(style, 4.29 + 0.02 * (i + 0.5) / kSamples) / double(kSamples);
    ASSERT_GT(glm::distance(mean, colorOf(style, 4.3)), 0.1) << "or nothing is told apart";
    const View view = tests::lookFrom({0.9, -3, 1.1}, {64, 64});
    for (const Channels channels : {Channels::Over, Channels::WeightedColor}) {
        world.scene.order = channels == Channels::Over ? Order::BackToFront : Order::None;
        const std::vector<float> pixels = drawn(world.scene, view, channels);
        int seen = 0;
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            if (pixels[i + 3] < (channels == Channels::Over ? 0.002f : 0.1f)) continue;
            ++seen;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(pixels[i + std::size_t(c)] / pixels[i + 3], mean[c], 0.02)
                    << "pixel " << i / 4;
        }
        EXPECT_GT(seen, 100);
    }
}

// Against samples of dW = max(ds / l, |df| / (hi - lo)).
TEST(CellSplatter, PerCrossingEachPieceOfTheWayCountsForItsLengthOrItsChange) {
    const auto grid = tests::cube(8);
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 p = grid->position(i);
        values[i] = static_cast<float>(std::sin(0.9 * p.x + 0.3) * std::cos(0.8 * p.y) +
                                       0.3 * p.z * std::sin(0.6 * p.y));
    }
    constexpr int kSamples = tests::rounds(4000);
    // Thin ranges need many.
    const std::vector<double> halves =
        tests::kSanitized ? std::vector{0.25} : std::vector{0.25, 0.05};
    for (const double half : halves) {
        CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                        {"0.3~" + std::to_string(half)});
        world.scene.opacityPer = OpacityPer::Crossing;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {12, 10}, 0.002);
            std::vector<double> wanted;
            for (int pixel = 0; pixel < 120; ++pixel) {
                const Ray ray = rayOf(world, view, {pixel % 12 + 0.5, pixel / 12 + 0.5});
                const auto [begin, end] = inside(ray, world.placed.domain());
                const double step = (end - begin) / kSamples;
                const auto at = [&, begin = begin](int i) {
                    return fieldAt(world, values, ray.from + (begin + step * i) * ray.along);
                };
                double sum = 0, last = at(0);
                for (int i = 1; i <= kSamples && step > 0; ++i) {
                    const double now = at(i), middle = (last + now) / 2;
                    if (std::abs(middle - 0.3) <= half)
                        sum += std::max(step * ray.length / world.placed.unitLength(),
                                        std::abs(now - last) / (2 * half));
                    last = now;
                }
                wanted.push_back(sum);
            }
            EXPECT_LT(relativeL2(drawn(world.scene, view), wanted), 0.02) << half << ' ' << from.x;
        }
    }
}

// Each pixel's fragments of all cells, sorted by where its ray enters them, nearest first.
double redByDepth(const CellWorld& world, const View& view, int x, int y) {
    const CellsView seen(world.placed, view);
    const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
    const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) - seen.rays.centre;
    struct Part {
        double depth, weight;
        std::size_t layer;
    };
    std::vector<Part> parts;
    const timeseries::CellIndex& cells = *world.scene.cells;
    for (std::uint32_t c = 0; c < cells.size().x * cells.size().y * cells.size().z; ++c) {
        const glm::uvec3 index = timeseries::indicesOf(c, cells.size());
        ValuedCell cell{};
        cell.corners = cells.cornersOf().values(index);
        PlacedPoints::Box box{};
        for (int a = 0; a < 3; ++a) {
            const auto& p = world.placed.positions()[std::size_t(a)];
            const auto domain = world.placed.domain();
            const bool down = p.front() > p.back();
            cell.from[a] = index[a] > 0 ? p[index[a] - 1] : (down ? domain.hi : domain.lo)[a];
            cell.to[a] = index[a] < p.size() ? p[index[a]] : (down ? domain.lo : domain.hi)[a];
            box.lo[a] = std::min(cell.from[a], cell.to[a]);
            box.hi[a] = std::max(cell.from[a], cell.to[a]);
        }
        for (std::size_t k = 0; k < world.scene.layers.size(); ++k)
            for (const auto& range : world.scene.layers[k].cells.ranges) {
                cell.lo = range.lo;
                cell.hi = range.hi;
                const auto s = cellSplatAt<double>(seen, cell);
                if (!s.visible) continue;
                const auto f = fragmentOn<double>(seen, s, at - s.centre, 1e9);
                if (f.weight > 0) parts.push_back({inside(ray, box).first, f.weight, k});
            }
    }
    std::ranges::stable_sort(parts, {}, &Part::depth);
    double through = 1, red = 0;
    for (const Part& part : parts) {
        const RangeStyle& style = world.scene.layers[part.layer].style;
        const double alpha = -std::expm1(-opticalDepthPerWeight(style.opacity) * part.weight);
        red += through * alpha * colorOf(style, 0).r;
        through *= 1 - alpha;
    }
    return red;
}

TEST(CellSplatter, CellsHideWhatIsBehindThem) {
    CellWorld world(tests::noise(unevenGrid()), {"0:0.5", "0.5:1"}, 0.9);
    world.scene.order = Order::BackToFront;
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.3);
        const std::vector<float> over = drawn(world.scene, view, Channels::Over);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x)
                ASSERT_NEAR(over[4 * (std::size_t(y) * 24 + std::size_t(x))],
                            redByDepth(world, view, x, y), 1e-4)
                    << x << ' ' << y << " from " << from.x;
    }
}

// A ramp has one gradient everywhere: how bright it is depends on the ray alone. Of one
// colour and one layer, light multiplies what is drawn without.
TEST(CellSplatter, LightIsThatOfARampsOneGradient) {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    const std::array axes{axis(6), axis(5, 0, 0.7), axis(4)};
    const auto grid = std::make_shared<const Grid>(axes, timeseries::CoordinateFrame{lean});
    const glm::dvec3 perIndex(1, 0.6, -0.3);
    CellWorld world(
        tests::stepOf(
            grid, [&](std::size_t i) { return glm::dot(perIndex, glm::dvec3(grid->indices(i))); }),
        {"2.6:3.9"});  // none of the domain's corners, which are plateaus
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});
    const std::vector<float> dark = drawn(world.scene, view, Channels::Over);
    const glm::dmat3& m = world.placed.worldFromAxes();
    glm::dvec3 alongAxes;
    for (int a = 0; a < 3; ++a) {
        const std::vector<double>& places = world.placed.positions()[static_cast<std::size_t>(a)];
        alongAxes[a] = perIndex[a] / (places[1] - places[0]);
    }
    // Whose product with a way in the world is that of these with the way along the axes.
    const glm::dvec3 gradient = glm::inverse(glm::transpose(m)) * alongAxes;
    const glm::dvec3 normal = glm::normalize(gradient);
    const double perLength = glm::length(gradient);
    const double steep = world.scene.cells->halfRange(world.scene.layers[0].cells.candidates, 0.9);
    const double certainty = perLength / (perLength + 0.2 * steep / world.placed.unitLength());
    int lit = 0;
    for (const Light light : {Light::Soft, Light::Full}) {
        world.scene.light = light;
        const std::vector<float> is = drawn(world.scene, view, Channels::Over);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const std::size_t at = 4 * (std::size_t(y) * 40 + std::size_t(x));
                ASSERT_NEAR(is[at + 3], dark[at + 3], 1e-6);
                if (dark[at + 3] < 0.01f) continue;
                ++lit;
                const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                const double facing = std::abs(glm::dot(glm::normalize(m * ray.along), normal));
                const double diffuse = certainty * (0.25 + 0.75 * facing) + (1 - certainty) * 0.625;
                const double specular =
                    light == Light::Full ? certainty * 0.35 * std::pow(facing, 30) : 0;
                ASSERT_NEAR(is[at], double(dark[at]) * diffuse + double(dark[at + 3]) * specular,
                            2e-4)
                    << x << ' ' << y;
            }
    }
    EXPECT_GT(lit, 200);
}

// A sphere of a few cells, whose own gradients have edges between them, looks like one.
TEST(CellSplatter, ASphereIsLitAsItsNormalsSay) {
    const auto grid =
        std::make_shared<const Grid>(std::array{axis(13), axis(13, 0, 0.9), axis(12)});
    const glm::dvec3 centre(6, 5.4, 5.5);  // in the grid's units
    CellWorld world(tests::stepOf(grid,
                                  [&](std::size_t i) {
                                      return glm::distance(glm::dvec3(grid->position(i)), centre);
                                  }),
                    {"3.7~0.1"}, 0.999);
    world.scene.opacityPer = OpacityPer::Crossing;
    world.scene.order = Order::BackToFront;
    for (const Lamp& lamp : {Lamp(), Lamp(glm::normalize(glm::dvec3(1, -1, 2)))}) {
        const auto error = tests::lightErrorOfSphere(world, centre, 3.7, lamp);
        ASSERT_GT(error.pixels, 200);
        EXPECT_LT(error.rms, 0.01);
        EXPECT_LT(error.most, 0.04);
    }
}

TEST(CellSplatter, APlateauIsLitEvenly) {
    CellWorld world(tests::stepOf(tests::cube(4), [](std::size_t) { return 7.0; }), {"min:max"});
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});
    const std::vector<float> dark = drawn(world.scene, view, Channels::Over);
    world.scene.light = Light::Full;
    const std::vector<float> is = drawn(world.scene, view, Channels::Over);
    for (std::size_t i = 0; i < is.size(); i += 4) ASSERT_NEAR(is[i], 0.625f * dark[i], 1e-5);
}

// Opaque things cut rays where they stand.
TEST(CellSplatter, RaysEndAtWhatIsOpaque) {
    const CellWorld world(tests::noise(tests::cube(5)), {"min:max"});
    const View view = tests::lookFrom({0.7, -3, 1.1}, {40, 30});
    constexpr double kWall = 3.2;  // view depth: through the volume
    const std::vector<float> opaque(40 * 30, static_cast<float>(windowDepth(view, kWall)));
    const auto w = drawn(world.scene, view, Channels::Weight, 0, 2, kAll, opaque);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
            const auto [from, to] = inside(ray, world.placed.domain());
            const double wanted =
                std::max(std::min(to, kWall) - from, 0.0) * ray.length / world.placed.unitLength();
            ASSERT_NEAR(w[std::size_t(y) * 40 + std::size_t(x)], wanted, 2e-3 * (1 + wanted));
        }
}

// However cells and a ray's pieces part a layer, be it thick or thin for a pixel: in a linear field
// all pixels see the same of it, its colours as each hides those behind.
TEST(CellSplatter, ALayerOfALinearFieldHasOneColor) {
    constexpr double kOpacity = 0.9;
    const auto draw = [](bool placedOneByOne, double half) {
        const std::shared_ptr<const timeseries::Grid> grid =
            placedOneByOne
                ? tests::curvilinear(
                      {9, 9, 9}, [](double i, double j, double k) { return glm::dvec3(i, j, k); })
                : tests::cube(9);
        const auto risesTowardsTheEye = [&](std::size_t i) {
            const auto at = grid->indices(i);
            return double(at.z) + 0.37 * double(at.y) + 0.21 * double(at.x);
        };
        CellWorld world(tests::stepOf(grid, risesTowardsTheEye), {"6.25~" + std::to_string(half)},
                        kOpacity);
        RangeStyle& style = world.scene.layers[0].style;
        style.color = ByValue{ColorMap(), 6.25 - half, 6.25 + half};
        world.scene.opacityPer = OpacityPer::Crossing;
        world.scene.order = Order::BackToFront;
        const View view = tests::lookFrom({0.9, -1.4, 2.2}, {160, 120});
        const std::vector<float> pixels = drawn(world.scene, view, Channels::Over);
        std::vector<double> greens;
        for (std::size_t i = 0; i < pixels.size(); i += 4)
            if (std::abs(pixels[i + 3] - kOpacity) < 0.01)
                greens.push_back(double(pixels[i + 1] / pixels[i + 3]));
        constexpr int kSamples = 1000;
        const double depth = -std::log1p(-kOpacity);
        double wanted = 0;
        for (int k = 0; k < kSamples; ++k) {
            const double way = (k + 0.5) / kSamples;
            wanted += colorOf(style, 6.25 + half * (1 - 2 * way)).g * depth / kSamples *
                      std::exp(-depth * way) / kOpacity;
        }
        return std::pair(greens, wanted);
    };
    for (const bool placedOneByOne : {false, true})
        for (const double half : {0.05, 0.001}) {
            const auto [greens, wanted] = draw(placedOneByOne, half);
            ASSERT_GT(greens.size(), 1000u);
            for (const double green : greens)  // of it, shareFromFront() has 0.025
                ASSERT_NEAR(green, wanted, 0.06) << placedOneByOne << ' ' << half;
        }
}

}  // namespace
}  // namespace render

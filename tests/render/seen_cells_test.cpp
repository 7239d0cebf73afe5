// Cells as a view sees them, a vector at a time, beside cellSplatAt() in double.
#include "render/splat/seen_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/cell_worlds.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace {

using namespace render;

constexpr glm::ivec2 kSize{300, 200};

struct World {
    timeseries::SortedStep step = tests::noise(tests::cube(8));
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{{}, {Constant{{1, 0.5, 0.1}}, 0.3}}},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
    std::mt19937 random{5};

    double from(double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
    }
    // Somewhere in the world, of any shape, upside down or not; a range that it may reach into.
    ValuedCell cell(double side, OpacityPer per) {
        ValuedCell cell{};
        for (int a = 0; a < 3; ++a) {
            cell.from[a] = from(-0.6, 0.6);
            cell.to[a] = cell.from[a] + (random() % 2 ? 1 : -1) * side * from(0.2, 1);
        }
        for (double& v : cell.corners) v = from(-3, 5);
        if (random() % 8 == 0) cell.corners.fill(1.5);
        cell.lo = from(-5, 5);
        cell.hi = cell.lo + (random() % 4 == 0 ? 0 : from(0, random() % 2 ? 0.01 : 8));
        cell.per = per;
        return cell;
    }
};

// Its numbers as those of `is`; `pixels` is a little more than what its outline needs.
void expectSeen(const SeenCell& is, const CellSplat<double>& of, const CellView& view) {
    EXPECT_EQ(is.crossesLeast(), of.crossesLeast);
    EXPECT_EQ(is.crossesMost(), of.crossesMost);
    EXPECT_NEAR(is.base, of.base, 1e-6 * of.base);
    EXPECT_NEAR(is.perRange, of.perRange, 1e-4 * of.perRange);
    const auto expectEnd = [](float end, double expected) {
        EXPECT_NEAR(end, expected, 1e-5 * (1 + std::abs(expected)));
    };
    if (of.crossesLeast) expectEnd(is.least, of.least);
    if (of.crossesMost) expectEnd(is.most, of.most);
    for (std::size_t c = 0; c < 8; ++c) EXPECT_NEAR(is.f[c], of.f[c], 1e-6);
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        EXPECT_NEAR(is.at[axis], of.at[a], 1e-5 * (1 + std::abs(of.at[a])));
        EXPECT_NEAR(is.ray[axis], of.ray[a], 1e-6 * (std::abs(of.ray[a]) + glm::length(of.ray)));
        EXPECT_NEAR(is.perSize[axis], of.perSize[a], 1e-6 * std::abs(of.perSize[a]));
    }
    double step = 0;  // how much of the cell a pixel is
    for (std::size_t a = 0; a < 3; ++a)
        for (const float pixel : {view.perPixelX[a], view.perPixelY[a]})
            step = std::max(step, std::abs(of.base * pixel * of.perSize[static_cast<int>(a)]));
    if (std::abs(step - kOrdinaryStep) > 1e-3) {
        EXPECT_EQ(is.mayBeFlat(), step > kOrdinaryStep) << step;
    }
    const int first[] = {is.x, is.y}, count[] = {is.columns(), is.rows()};
    const float offset[] = {is.ox, is.oy};
    for (int k = 0; k < 2; ++k) {
        const double window = of.centre[k] + view.centre[static_cast<std::size_t>(k)];
        const double size = view.box.size[k];
        EXPECT_NEAR(offset[k], first[k] + 0.5 - window, 1e-4 * (1 + std::abs(window)));
        EXPECT_GE(first[k], 0);
        EXPECT_LE(first[k] + count[k], size);
        // Centres of pixels in its outline: of those before or behind, none; and few others.
        const double lo = std::clamp(window + of.lo[k] - 0.5, 0.0, size);
        const double hi = std::clamp(window + of.hi[k] - 0.5, 0.0, size);
        EXPECT_NEAR(first[k], std::ceil(lo), 1);
        EXPECT_LE(first[k], lo + 1);
        EXPECT_NEAR(first[k] + count[k], std::ceil(hi), 1);
        EXPECT_GE(first[k] + count[k], hi - 1e-3);
    }
}

// Whether it has a pixel's centre, its outline being so much wider.
bool hasPixels(const CellSplat<double>& s, const CellView& view, double wider) {
    const auto along = [&](int k) {
        const PixelSpan span =
            pixelSpan(s.centre[k] + view.centre[static_cast<std::size_t>(k)], s.lo[k] - wider,
                      s.hi[k] + wider, Kernel::Quartic, view.box.size[k]);
        return span.first < span.last;
    };
    return s.visible && along(0) && along(1);
}

struct Looked {
    std::size_t seen = 0, nearEye = 0, thin = 0, flat = 0, small = 0;
};

Looked look(const View& from, double side, OpacityPer per, int rays = 1) {
    World world;
    world.scene.opacityPer = per;
    const CellView view(world.scene, from, Channels::Weight, rays);
    Looked looked;
    for (int batch = 0; batch < 60; ++batch) {
        PieceBatch pieces;
        std::vector<CellSplat<double>> expected;
        const std::size_t count = 1 + world.random() % PieceBatch::kMost;
        while (pieces.count < count) {
            const ValuedCell cell = world.cell(side, per);
            const auto s = cellSplatAt<double>(view.seen, cell);
            const bool isSeen = hasPixels(s, view, -0.02);
            if (isSeen != hasPixels(s, view, 0.02)) continue;  // rounding may take or leave it
            pieces.add(cell, {}, kWholeCell);
            if (isSeen) expected.push_back(s);
        }
        timeseries::PageVector<SeenCell> seen;
        timeseries::PageVector<CellSlopes> slopes;
        std::vector<TileSpan> spans;
        seeCells(view, world.scene, nullptr, pieces, seen, slopes, spans);
        EXPECT_EQ(seen.size(), expected.size());
        EXPECT_EQ(spans.size(), expected.size());
        for (std::size_t i = 0; i < std::min(seen.size(), expected.size()); ++i) {
            const CellSplat<double>& s = expected[i];
            expectSeen(seen[i], s, view);
            ++looked.seen;
            looked.nearEye += s.base == 0;
            looked.thin += s.perRange > 0;
            looked.flat += s.extent == 0;
            looked.small += seen[i].mayBeFlat();
            const glm::ivec2 tile(static_cast<int>(spans[i].first) % view.tiles.x,
                                  static_cast<int>(spans[i].first) / view.tiles.x);
            const glm::ivec2 last(seen[i].x + seen[i].columns() - 1,
                                  seen[i].y + seen[i].rows() - 1);
            EXPECT_EQ(tile, glm::ivec2(seen[i].x, seen[i].y) / view.tile);
            EXPECT_EQ(tile + glm::ivec2(spans[i].columns, spans[i].rows) - 1, last / view.tile);
        }
    }
    return looked;
}

TEST(SeenCells, AreWhatOneByOneTheyAre) {
    const View from = tests::lookFrom({1.1, -2.4, 0.8}, kSize);
    EXPECT_GT(look(from, 0.1, OpacityPer::Length).seen, 300u);
    EXPECT_GT(look(from, 0.03, OpacityPer::Length).flat, 10u);
    EXPECT_GT(look(from, 0.03, OpacityPer::Length).small, 10u);
    EXPECT_EQ(look(from, 0.4, OpacityPer::Length).small, 0u);
    EXPECT_GT(look(from, 0.1, OpacityPer::Crossing).thin, 100u);
}

TEST(SeenCells, AroundTheEyeToo) {
    const View from = tests::lookFrom({0.1, -0.2, 0.1}, kSize);
    EXPECT_GT(look(from, 0.4, OpacityPer::Length).nearEye, 10u);
}

TEST(SeenCells, OfSeveralRaysAPixel) {
    const View from = tests::lookFrom({1.1, -2.4, 0.8}, kSize);
    EXPECT_GT(look(from, 0.01, OpacityPer::Crossing, 8).seen, 300u);
}

// Also of octants beside what is missing, and of cells beside those.
TEST(SeenCells, AreLitByThePointsSlopes) {
    timeseries::Field field{tests::cube(8), std::vector<float>(512), {}};
    auto& values = std::get<std::vector<float>>(field.values);
    std::mt19937 random(6);
    for (float& v : values) v = static_cast<float>(random() % 1000);
    for (const std::size_t i : {0u, 150u, 151u, 300u})
        values[i] = std::numeric_limits<float>::quiet_NaN();
    tests::CellWorld world(tests::sorted(field), {"min:max"});
    world.scene.order = Order::BackToFront;
    world.scene.light = Light::Soft;
    const CellView view(world.scene, tests::lookFrom({1.1, -2.4, 0.8}, kSize), Channels::Over, 1);
    const PointSlopes points(world.scene);
    const auto seenOf = [&](const PieceBatch& pieces) {
        timeseries::PageVector<SeenCell> seen;
        timeseries::PageVector<CellSlopes> slopes;
        std::vector<TileSpan> spans;
        seeCells(view, world.scene, &points, pieces, seen, slopes, spans);
        EXPECT_EQ(seen.size(), slopes.size());
        return slopes;
    };
    PieceBatch pieces;
    std::vector<CellSlopes> expected;
    std::size_t whole = 0, octants = 0;
    const auto look = [&] {
        const auto slopes = seenOf(pieces);
        ASSERT_EQ(slopes.size(), expected.size());
        for (std::size_t i = 0; i < slopes.size(); ++i)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t k = 0; k < 8; ++k)
                    ASSERT_NEAR(slopes[i][a][k], expected[i][a][k], 1e-5);
        pieces.count = 0;
        expected.clear();
    };
    PointSlopes::OfOctants last;
    for (const bool isClipped : {false, true})
        for (std::uint32_t cell = 0; cell < 9 * 9 * 9; ++cell) {
            if (isClipped) world.scene.clip = {{1, 0, 2}, {6, 7, 7}};
            forEachPiece(world.scene, cell, [&](ValuedCell piece, unsigned octant) {
                piece.lo = 0;
                piece.hi = 1000;
                PieceBatch alone;
                for (PieceBatch* batch : {&alone, &pieces})
                    batch->add(piece, {.cell = cell, .layer = 0}, octant);
                const auto [least, greatest] = std::ranges::minmax(piece.corners);
                if (!seenOf(alone).empty())
                    expected.push_back(points.in(cell, octant, piece.to - piece.from,
                                                 0.5 * greatest - 0.5 * least, last));
                (octant == kWholeCell ? whole : octants) += 1;
                if (pieces.isFull()) look();
            });
        }
    look();
    EXPECT_GT(whole, 400u);
    EXPECT_GT(octants, 50u);
}

// Rays along an axis divide by nothing, those beside it by what they are.
TEST(SeenCells, KnowWhichRaysGoAlongTheirFaces) {
    World world;
    const CellView view(world.scene, tests::lookFrom({0, -3, 0}, kSize), Channels::Weight, 1);
    const auto grazes = [&](const glm::dvec3& at) {
        ValuedCell cell{.from = at - 0.01, .to = at + 0.01, .corners = {}, .lo = -1, .hi = 1};
        PieceBatch pieces;
        pieces.add(cell, {}, kWholeCell);
        timeseries::PageVector<SeenCell> seen;
        timeseries::PageVector<CellSlopes> slopes;
        std::vector<TileSpan> spans;
        seeCells(view, world.scene, nullptr, pieces, seen, slopes, spans);
        EXPECT_EQ(seen.size(), 1u);
        return !seen.empty() && seen[0].grazes();
    };
    EXPECT_TRUE(grazes({0, 0, 0.5}));
    EXPECT_TRUE(grazes({0.5, 0, 0}));
    EXPECT_FALSE(grazes({0.5, 0, 0.5}));
}

}  // namespace

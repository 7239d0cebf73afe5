// Splats of a mesh as a view sees them, a vector at a time, beside splatAt() in double.
#include "render/splat/seen_splat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "render/splat/drawn_points.h"
#include "render/splat/tile_splatter.h"
#include "render/splat/tile_view.h"
#include "tests/support/meshes.h"
#include "tests/support/splat_world.h"
#include "tests/support/vector_targets.h"

namespace render {
namespace {

using namespace render::splat_world;

// Cells of many shapes, some far thinner than long, all leaning.
std::shared_ptr<const Grid> shaken(double thinnest) {
    std::mt19937 random(11);
    const auto from = [&](double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
    };
    return tests::curvilinear({7, 6, 5}, [&](double i, double j, double k) {
        return glm::dvec3(i + 0.4 * j + from(-0.2, 0.2), j - 0.3 * k + from(-0.2, 0.2),
                          0.3 * i + (thinnest + 0.2 * i * i) * k);
    });
}

struct Extent {
    double lo = 1e300, hi = -1e300;
    void take(double at) { lo = std::min(lo, at), hi = std::max(hi, at); }
};

// Where points all over the ellipsoid's surface are seen, from its centre; nothing where some lie
// behind the eye.
std::optional<std::array<Extent, 2>> outline(const PointsView& view, std::uint32_t index,
                                             const Splat<double>& s) {
    const auto rows =
        ellipsoidOf<double>(view, index, {}, s.depth * view.smallestRadius).factor.rows();
    const glm::dvec3 centre = view.placed.position(index);
    std::array<Extent, 2> extents;
    constexpr int kAround = 60, kDown = 30;
    for (int a = 0; a < kAround; ++a)
        for (int b = 0; b <= kDown; ++b) {
            const double phi = 2 * std::numbers::pi * a / kAround,
                         theta = std::numbers::pi * b / kDown;
            const glm::dvec3 u(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            const glm::dvec3 at = centre + glm::dvec3(glm::dot(rows[0], u), glm::dot(rows[1], u),
                                                      glm::dot(rows[2], u));
            const glm::dvec4 seen = view.viewFromWorld * glm::dvec4(at, 1);
            if (!(-seen.z > 0)) return std::nullopt;
            for (int k = 0; k < 2; ++k)
                extents[static_cast<std::size_t>(k)].take(seen[k] / -seen.z * view.rays.focal[k] -
                                                          s.centre[k]);
        }
    return extents;
}

// A box holds its outline's pixels and few others.
void expectBox(std::uint32_t span, double window, const Extent& of, int size) {
    const auto pixel = [&](double offset) {
        return std::clamp(std::ceil(window + offset - 0.5), 0.0, static_cast<double>(size));
    };
    // Of the end, between points 6 degrees apart both ways, 1 - cos(3 degrees) twice is missed.
    const double more = 0.02 + 4e-3 * (of.hi - of.lo);
    const auto first = static_cast<double>(span & 0xffff), last = static_cast<double>(span >> 16);
    EXPECT_LE(first, pixel(of.lo));
    EXPECT_GE(first, pixel(of.lo - more));
    EXPECT_GE(last, pixel(of.hi));
    EXPECT_LE(last, pixel(of.hi + more));
}

struct Looked {
    int seen = 0, grown = 0, aroundTheEye = 0;
};

// `error`: what floats leave of the forms, of cells as thin as these.
Looked look(const World& world, const View& from, double error) {
    const PointsView points(world.placed, from);
    const TileView view(world.scene, from, Channels::Weight, 0);
    std::vector<std::uint32_t> index(world.step.size());
    std::iota(index.begin(), index.end(), 0u);
    std::vector<SeenSplat> seen(index.size());
    std::vector<TileSpan> spans(index.size());
    DrawnPoints drawn;
    drawn.begin(world.placed.mesh(), index.size());
    seeSplats(world.scene, view, index, drawn.of(0, index), seen, spans);
    Looked looked;
    for (const std::uint32_t i : index) {
        SCOPED_TRACE(i);
        const auto s = splatAt<double>(points, i, {});
        const SeenSplat& is = seen[i];
        if (!s.visible) {
            EXPECT_EQ(spans[i].columns, 0);
            continue;
        }
        const std::array<double, 2> window{s.centre.x + view.centre[0],
                                           s.centre.y + view.centre[1]};
        bool somewhere = true;
        const auto extents = outline(points, i, s);
        const std::array<std::uint32_t, 2> span{is.columns, is.rows};
        for (int k = 0; k < 2; ++k) {
            const auto c = static_cast<std::size_t>(k);
            EXPECT_NEAR(is.pixel[c] + double(is.within[c]), window[c],
                        1e-6 * (1 + std::abs(s.centre[k])));
            const Extent all{-1e9, 1e9};
            expectBox(span[c], window[c], extents ? (*extents)[c] : all, view.box.size[k]);
            somewhere = somewhere && (span[c] & 0xffff) < span[c] >> 16;
        }
        EXPECT_EQ(spans[i].columns > 0 && spans[i].rows > 0, somewhere);
        if (!somewhere) continue;
        const glm::ivec2 first(is.columns & 0xffff, is.rows & 0xffff),
            last(is.columns >> 16, is.rows >> 16);
        const glm::ivec2 tile(static_cast<int>(spans[i].first) % view.tiles.x,
                              static_cast<int>(spans[i].first) / view.tiles.x);
        EXPECT_EQ(tile, first / view.tile);
        EXPECT_EQ(tile + glm::ivec2(spans[i].columns, spans[i].rows) - 1, (last - 1) / view.tile);
        const double n = s.n.x + s.n.z, d = s.d.x + s.d.z, l = glm::length(s.l);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(is.n[static_cast<std::size_t>(k)], s.n[k], error * n);
            EXPECT_NEAR(is.d[static_cast<std::size_t>(k)], s.d[k], error * d);
        }
        for (int k = 0; k < 2; ++k)
            EXPECT_NEAR(is.l[static_cast<std::size_t>(k)], s.l[k], error * (l + std::sqrt(d)));
        EXPECT_NEAR(is.weight, s.weight * points.rayLength, error * s.weight * points.rayLength);
        EXPECT_NEAR(is.depth, windowDepth(from, s.depth), 1e-6);
        ++looked.seen;
        looked.aroundTheEye += !extents;
        const auto cell = world.placed.meshCell(i).scaled(glm::dvec3(kQuarticRadius));
        looked.grown +=
            growthTo(s.depth * points.smallestRadius, std::abs(cell.determinant()),
                     glm::dot(cell.diagonal, cell.diagonal) + glm::dot(cell.below, cell.below)) > 0;
    }
    return looked;
}

TEST(SeenSplats, AreWhatDoublesHave) {
    tests::onEachVectorTarget([] {
        Looked sum;
        for (const auto& [grid, error] :
             {std::pair(shaken(1), 2e-6), {shaken(1e-2), 2e-5}, {tests::rings(3, 0.5), 4e-6}}) {
            const World world(tests::stepOf(grid, [](std::size_t i) { return i; }));
            for (const auto& from :
                 {glm::dvec3(1.5, -2, 1), {0.2, -0.3, 0.1}, {30, -40, 10}, {0, 0, 0}}) {
                const Looked one = look(world, tests::lookFrom(from, {150, 110}, 0.7), error);
                sum.seen += one.seen;
                sum.grown += one.grown;
                sum.aroundTheEye += one.aroundTheEye;
            }
        }
        EXPECT_GT(sum.seen, 800);
        EXPECT_GT(sum.grown, 200);
        EXPECT_LT(sum.grown, sum.seen - 100);
        EXPECT_GT(sum.aroundTheEye, 2);
    });
}

// Footprints on which d is nearly 1, and on which it is not: a series tells the former.
TEST(SeenSplats, OfEveryWidthAreTheTruths) {
    const World world(tests::stepOf(tests::twisted(), [](std::size_t i) { return i; }));
    for (double distance = 12; distance > 0.3; distance *= 0.8) {
        const View view = tests::lookFrom(distance * glm::dvec3(0.6, -0.7, 0.4), {100, 90}, 0.5);
        const auto truth = weights(world, view);
        const double most = *std::ranges::max_element(truth);
        const auto tiles = sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {});
        for (std::size_t i = 0; i < truth.size(); ++i)
            ASSERT_NEAR(tiles[i], truth[i], 1e-5 * most) << distance << ' ' << i;
    }
}

}  // namespace
}  // namespace render

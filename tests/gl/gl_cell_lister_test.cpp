// Cells listed by the GPU: what the processor sees of them, of every type of values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "render/splat/cell_pieces.h"
#include "render/splat/cell_view.h"
#include "render/splat/gl_cells.h"
#include "tests/support/gl_buffers.h"
#include "tests/support/gl_cell_planes.h"
#include "tests/support/sorted.h"

namespace render {
namespace {

using tests::CellWorld;
using timeseries::Field;

class GlCellListing : public tests::GlCellPlanes {
 protected:
    struct Pieces {
        std::vector<GlCell> cells;
        std::vector<CellSlopes> slopes;  // of each, where light falls on them
    };

    static Pieces listed(const Scene& scene, GlCellLister& lister,
                         std::uint64_t most = std::uint64_t{1} << 24) {
        const auto pieces = whole(scene, most, lister);
        std::uint32_t end = 0;
        for (std::size_t k = 0; k < scene.layers.size(); ++k) {
            const auto [first, last] = pieces->placesOf(Channels::Weight, k);
            EXPECT_EQ(first, end) << "layer by layer";
            end = last;
        }
        EXPECT_EQ(pieces->placesOf(Channels::Over, 0), std::pair(0u, end));
        EXPECT_EQ(pieces->slopes() != nullptr, scene.light != Light::Off);
        Pieces out{tests::contentsOf<GlCell>(pieces->pieces(), end), {}};
        if (pieces->slopes()) out.slopes = tests::contentsOf<CellSlopes>(*pieces->slopes(), end);
        return out;
    }

    // What the processor sees of each candidate, one by one.
    static Pieces expected(const Scene& scene) {
        Pieces all;
        for (std::size_t layer = 0; layer < scene.layers.size(); ++layer) {
            const Layer& of = scene.layers[layer];
            for (const timeseries::Run& run : of.cells.candidates)
                for (std::uint64_t i = 0; i < run.count; ++i)
                    see(scene, layer, scene.cells->cell(run.first + i), all);
        }
        return all;
    }
    static void see(const Scene& scene, std::size_t layer, std::uint32_t number, Pieces& all) {
        const PointSlopes points(scene);
        PointSlopes::OfOctants last;
        const RangeStyle& style = scene.layers[layer].style;
        forEachPiece(scene, number, [&](ValuedCell piece, unsigned octant) {
            for (const auto& range : scene.layers[layer].cells.ranges) {
                piece.lo = range.lo;
                piece.hi = range.hi;
                CellSplat<float> s;
                if (!cell::seeField(s, piece, scene.placed.unitLength())) continue;
                GlCell c{number,
                         octant | static_cast<std::uint32_t>(s.crossesLeast) << 4 |
                             static_cast<std::uint32_t>(s.crossesMost) << 5 |
                             static_cast<std::uint32_t>(layer) << 8,
                         s.least,
                         s.most,
                         s.perRange,
                         glMapPlaceOf(style, cell::coloredField(s, piece)),
                         steepnessIn(s.extent, steepnessOf(scene)),
                         {}};
                std::ranges::copy(s.f, c.f);
                all.cells.push_back(c);
                if (scene.light == Light::Off) continue;
                all.slopes.push_back(
                    points.in(number, octant, piece.to - piece.from, s.extent, last));
            }
        });
    }

    // The same ones in the same order, their numbers to float.
    static void expectAre(const Pieces& these, const Pieces& those) {
        const std::vector<GlCell>&is = these.cells, &expected = those.cells;
        const auto near = [&](float a, float b, float rounded = 2e-6f) {
            return std::abs(a - b) <= rounded * std::max(1.0f, std::abs(b));
        };
        ASSERT_EQ(is.size(), expected.size());
        ASSERT_GT(is.size(), 40u);
        ASSERT_EQ(these.slopes.size(), those.slopes.size());
        for (std::size_t i = 0; i < these.slopes.size(); ++i)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t k = 0; k < 8; ++k)
                    ASSERT_TRUE(near(these.slopes[i][a][k], those.slopes[i][a][k], 1e-5f))
                        << i << " along " << a << ": " << testing::PrintToString(these.slopes[i][a])
                        << " instead of " << testing::PrintToString(those.slopes[i][a]);
        for (std::size_t i = 0; i < is.size(); ++i) {
            const GlCell &a = is[i], &b = expected[i];
            ASSERT_EQ(a.cell, b.cell) << i;
            ASSERT_EQ(a.kind, b.kind) << i;
            ASSERT_TRUE(near(a.least, b.least) && near(a.most, b.most) &&
                        near(a.perRange, b.perRange, 2e-5f) && near(a.steep, b.steep))
                << i << ": " << a.least << ' ' << a.most << ' ' << a.perRange << ' ' << a.steep
                << " instead of " << b.least << ' ' << b.most << ' ' << b.perRange << ' '
                << b.steep;
            ASSERT_TRUE(near(a.map.at, b.map.at) && near(a.map.perValue, b.map.perValue)) << i;
            for (int k = 0; k < 8; ++k)
                ASSERT_TRUE(near(a.f[k], b.f[k]))
                    << i << ": " << testing::PrintToString(a.f) << " instead of "
                    << testing::PrintToString(b.f) << ", octant " << (a.kind & 15);
        }
    }
};

// Waves between two ends of T, some of which are missing.
template <typename T>
Field wavesOf(std::size_t n, double lo, double hi, double stretch = 1) {
    std::mt19937 random(11);
    Field field{tests::cube(n), std::vector<T>(n * n * n), std::vector<bool>(n * n * n)};
    auto& values = std::get<std::vector<T>>(field.values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at = glm::dvec3(field.grid->indices(i)) / stretch;
        const double wave =
            std::sin(0.9 * at.x) * std::cos(0.7 * at.y + 0.3 * at.x) + 0.3 * std::sin(0.8 * at.z);
        values[i] = static_cast<T>(lo + (hi - lo) * (0.5 + 0.35 * wave));
        field.missing[i] = random() % 16 == 0;
    }
    return field;
}

// A shell and a wide range in one layer, by value; a shell in another.
void select(CellWorld& world, double lo, double hi) {
    const auto at = [&](double share) { return lo + (hi - lo) * share; };
    const std::vector<std::vector<timeseries::Interval<double>>> ranges = {
        {{at(0.30), at(0.34)}, {at(0.6), at(0.8)}}, {{at(0.50), at(0.51)}}};
    for (std::size_t k = 0; k < ranges.size(); ++k) {
        Cells& cells = world.scene.layers[k].cells;
        cells.ranges = ranges[k];
        cells.candidates = world.scene.cells->select(cells.ranges);
    }
    world.scene.layers[0].style.color = ByValue{{}, at(0.2), at(0.9)};
    world.scene.light = Light::Soft;  // steepness counts
}

// Of whole numbers of 64 bits those that have cells: which doubles tell apart.
template <typename T>
struct Ends {
    static constexpr double kMost = sizeof(T) == 8 && std::is_integral_v<T> ? 0x1p52 : 1e308,
                            lo = std::max(static_cast<double>(std::numeric_limits<T>::lowest()) / 2,
                                          -kMost),
                            hi = std::min(static_cast<double>(std::numeric_limits<T>::max()) / 2,
                                          kMost);
};
template <typename T>
class GlCellListingOf : public GlCellListing {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(GlCellListingOf, Types);

TYPED_TEST(GlCellListingOf, IsTheProcessors) {
    using E = Ends<TypeParam>;
    CellWorld world(tests::sorted(wavesOf<TypeParam>(14, E::lo, E::hi)), {"min:max", "min:max"});
    select(world, E::lo, E::hi);
    for (const OpacityPer per : {OpacityPer::Length, OpacityPer::Crossing}) {
        world.scene.opacityPer = per;
        this->expectAre(this->listed(world.scene, this->lister_), this->expected(world.scene));
        EXPECT_TRUE(this->lister_.holdsField(world.scene)) << "or its values were not decoded";
    }
}

// The corners of the cells that are asked for, and each time as much of the field, until that is
// there.
TEST_F(GlCellListing, SendsTheFieldByAndBy) {
    CellWorld world(tests::sorted(wavesOf<std::int32_t>(40, 0, 1e6, 24)), {"min:max", "min:max"});
    Cells& cells = world.scene.layers[0].cells;
    cells.ranges = {{8.6e5, 8.65e5}};
    cells.candidates = world.scene.cells->select(cells.ranges);
    world.scene.layers.pop_back();
    const std::uint64_t field = world.scene.cells->field().bytes(),
                        once = 64 * cellCount(world.scene.layers[0]);
    ASSERT_LT(2 * once, field);
    const Pieces pieces = expected(world.scene);
    std::uint64_t calls = 1;
    for (; calls < 100; ++calls) {
        expectAre(listed(world.scene, lister_), pieces);
        if (lister_.holdsField(world.scene)) break;
    }
    EXPECT_LE(calls, field / once + 1);
    EXPECT_GE(calls, field / once);
    EXPECT_GE(calls, 2u);
    expectAre(listed(world.scene, lister_), pieces);
    // Of another step nothing is there.
    CellWorld other(tests::sorted(wavesOf<std::int32_t>(40, 0, 1.1e6, 24)), {"min:max", "min:max"});
    other.scene.layers.pop_back();
    other.scene.layers[0].cells = {cells.ranges, other.scene.cells->select(cells.ranges)};
    expectAre(listed(other.scene, lister_), expected(other.scene));
    EXPECT_FALSE(lister_.holdsField(other.scene));
}

// Nor is it ever sent where it is more than a scene may take.
TEST_F(GlCellListing, AFieldTooLargeStaysWhereItIs) {
    CellWorld world(tests::sorted(wavesOf<double>(30, 0, 1, 24)), {"min:max", "min:max"});
    select(world, 0, 1);
    world.scene.layers.erase(world.scene.layers.begin());
    const Pieces pieces = expected(world.scene);
    const std::uint64_t most = pieces.cells.size() * GlCells::bytesOfOne(world.scene);
    ASSERT_LT(most, world.scene.cells->field().bytes());
    for (int i = 0; i < 4; ++i) expectAre(listed(world.scene, lister_, most), pieces);
    EXPECT_EQ(lister_.bytes(), 0u);
}

TEST_F(GlCellListing, ValuesFarBeyondFloatsAreTheProcessors) {
    const auto grid = tests::cube(8);
    std::vector<double> huge(grid->count()), tiny(huge);
    std::vector<std::int64_t> whole(grid->count());
    for (std::size_t i = 0; i < huge.size(); ++i) {
        const auto at = glm::dvec3(grid->indices(i));
        const double wave = std::sin(0.9 * at.x) + std::cos(0.7 * at.y) * std::sin(0.8 * at.z);
        huge[i] = 1e300 * wave;
        tiny[i] = 1e-300 * wave;
        whole[i] = (std::int64_t{1} << 52) + static_cast<std::int64_t>(std::round(1e5 * wave));
    }
    for (const auto& [values, range] :
         {std::pair<timeseries::Values, const char*>(huge, "-5e299:5e299"),
          std::pair<timeseries::Values, const char*>(tiny, "-5e-301:5e-301"),
          std::pair<timeseries::Values, const char*>(whole, "4503599627330496:4503599627410496")}) {
        SCOPED_TRACE(range);
        const CellWorld world(tests::sorted({grid, values, {}}), {range});
        expectAre(listed(world.scene, lister_), expected(world.scene));
    }
}

TEST_F(GlCellListing, OctantsOfWhatIsMissingOrClippedAreTheProcessors) {
    CellWorld world(tests::sorted(wavesOf<float>(12, -3, 2)), {"min:max", "min:max"});
    select(world, -3, 2);
    auto parted = [](const GlCell& c) { return (c.kind & 15) != kWholeCell; };
    const auto pieces = expected(world.scene);
    EXPECT_GT(std::ranges::count_if(pieces.cells, parted), 100);
    expectAre(listed(world.scene, lister_), pieces);
    world.scene.clip = {{2, 0, 5}, {9, 7, 11}};
    const auto clipped = expected(world.scene);
    EXPECT_LT(clipped.cells.size(), pieces.cells.size());
    expectAre(listed(world.scene, lister_), clipped);
}

}  // namespace
}  // namespace render

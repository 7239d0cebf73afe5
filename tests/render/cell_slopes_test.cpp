// The gradients by which light falls on cells, of many at once, beside central differences in
// double.
#include "render/splat/cell_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "render/splat/cell_pieces.h"
#include "tests/support/cell_rays.h"
#include "tests/support/cell_worlds.h"

namespace {

using namespace render;
using tests::CellWorld;
using tests::cells::unevenGrid;
using timeseries::Field;

template <typename T>
std::vector<T> noiseOf(double lo, double hi) {
    std::mt19937 random(3);
    std::vector<T> values(unevenGrid()->count());
    for (T& v : values)
        v = static_cast<T>(lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0));
    return values;
}

// At corner c of a cell what f changes over its size along axis a; NaN where a value is none.
double expectedAt(const CellWorld& world, const glm::uvec3& cell, unsigned c, std::size_t a,
                  double size, double extent) {
    const Field& field = world.scene.cells->field();
    const glm::uvec3 points = world.placed.size();
    const glm::uvec3 corner = cell + glm::uvec3(c & 1, c >> 1 & 1, c >> 2);
    glm::uvec3 below = glm::clamp(corner, glm::uvec3(1), points) - 1u, above = below;
    const auto axis = static_cast<int>(a);
    below[axis] = std::max(below[axis], 1u) - 1;
    above[axis] = std::min(above[axis] + 1, points[axis] - 1);
    const auto valueAt = [&](const glm::uvec3& at) {
        const std::size_t i = at.x + points.x * (at.y + points.y * at.z);
        if (!field.missing.empty() && field.missing[i])
            return std::numeric_limits<double>::quiet_NaN();
        return std::visit([&](const auto& v) { return static_cast<double>(v[i]); }, field.values);
    };
    const std::vector<double>& places = world.placed.positions()[a];
    return (valueAt(above) / extent - valueAt(below) / extent) /
           (places[above[axis]] - places[below[axis]]) * size;
}

// All cells, as many at once as there is room for. Returns how many have a value that is none.
std::size_t expectSlopes(const CellWorld& world, double extent) {
    const PointSlopes points(world.scene);
    const glm::uvec3 cells = world.scene.cells->size();
    std::mt19937 random(4);
    SlopeBatch batch;
    std::vector<std::uint32_t> which;
    std::vector<glm::dvec3> sizes;
    std::size_t none = 0;
    const auto look = [&] {
        std::vector<CellSlopes> slopes(batch.count + 1);
        slopes.back()[0].fill(7);
        SlopeBatch::Row isNone;
        batch.take(slopes.data(), isNone);
        EXPECT_EQ(slopes.back()[0][0], 7) << "beyond the last";
        for (std::size_t i = 0; i < batch.count; ++i) {
            bool lacks = false;
            for (std::size_t a = 0; a < 3; ++a)
                for (unsigned c = 0; c < 8; ++c) {
                    const double expected =
                        expectedAt(world, timeseries::indicesOf(which[i], cells), c, a,
                                   sizes[i][static_cast<int>(a)], extent);
                    if (!std::isfinite(expected)) {
                        lacks = true;
                        continue;
                    }
                    // f at a corner: each coefficient times its signs there.
                    const std::array<float, 8>& f = slopes[i][a];
                    const double u = c & 1 ? 0.5 : -0.5, v = c & 2 ? 0.5 : -0.5,
                                 w = c & 4 ? 0.5 : -0.5;
                    const double is = f[0] + f[1] * u + f[2] * v + f[3] * w + f[4] * u * v +
                                      f[5] * u * w + f[6] * v * w + f[7] * u * v * w;
                    if (isNone[i] != 0) continue;
                    EXPECT_NEAR(is, expected, 1e-5) << which[i] << ' ' << c;
                }
            EXPECT_EQ(isNone[i] != 0, lacks) << which[i];
            none += lacks;
        }
        batch.count = 0;
        which.clear();
        sizes.clear();
    };
    std::size_t most = 1;  // of a batch: few, and as many as it has room for
    for (std::uint32_t cell = 0; cell < cells.x * cells.y * cells.z; ++cell) {
        which.push_back(cell);
        sizes.emplace_back(random() % 2 ? 1 : 3, random() % 2 ? -1 : -2, 0.5);
        points.add(cell, sizes.back(), extent, batch);
        if (batch.count < most) continue;
        look();
        most = std::min(3 * most, SlopeBatch::kMost);
    }
    look();
    return none;
}

template <typename T>
class CellSlopesOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(CellSlopesOf, Types);

TYPED_TEST(CellSlopesOf, AreCentralDifferences) {
    const CellWorld world(tests::sorted({unevenGrid(), noiseOf<TypeParam>(0, 100), {}}), {"0:50"});
    EXPECT_EQ(expectSlopes(world, 50), 0u);
}

TEST(CellSlopes, KnowWhatTheyLack) {
    auto values = noiseOf<float>(-1, 1);
    constexpr std::size_t kNone = 26;  // (1, 1, 1) of 5 x 4 x 3
    values[kNone] = std::numeric_limits<float>::quiet_NaN();
    const CellWorld withNone(tests::sorted({unevenGrid(), values, {}}), {"0:1"});
    const std::size_t some = expectSlopes(withNone, 1);
    EXPECT_GT(some, 8u);
    Field marked{unevenGrid(), noiseOf<std::int16_t>(-100, 100), {}};
    marked.missing.assign(marked.grid->count(), false);
    marked.missing[kNone] = true;
    const CellWorld withMarked(tests::sorted(marked), {"0:1"});
    EXPECT_EQ(expectSlopes(withMarked, 100), some);
}

TEST(CellSlopes, OfHugeAndTinyValues) {
    for (const double unit : {1e-300, 1e-30, 1e30, 8e307}) {
        const CellWorld world(tests::sorted({unevenGrid(), noiseOf<double>(-unit, unit), {}}),
                              {"min:max"});
        EXPECT_EQ(expectSlopes(world, unit), 0u) << unit;
    }
}

TEST(CellSlopes, HaveALimit) {
    const CellWorld world(tests::sorted({unevenGrid(), noiseOf<double>(-1, 1), {}}), {"min:max"});
    const PointSlopes points(world.scene);
    constexpr std::uint32_t cell = 2 + 6 * (2 + 5 * 2);  // of 6 x 5 x 4
    SlopeBatch batch;
    points.add(cell, glm::dvec3(1), 1e-308, batch);  // a plateau beside steep cells
    points.add(cell, glm::dvec3(1), 0, batch);
    std::array<CellSlopes, 2> slopes;
    SlopeBatch::Row isNone;
    batch.take(slopes.data(), isNone);
    EXPECT_EQ(isNone[0], 0);
    EXPECT_EQ(isNone[1], 0);
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t k = 0; k < 8; ++k) {
            EXPECT_LE(std::abs(slopes[0][a][k]), 8 * kMostSlope);
            EXPECT_EQ(slopes[1][a][k], 0) << "of a constant field";
        }
}

}  // namespace

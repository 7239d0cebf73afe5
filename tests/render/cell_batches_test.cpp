// Cells of an upright grid as pieces, many at once: beside those that are looked at one by one.
#include "render/splat/cell_batches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/support/cell_worlds.h"
#include "tests/support/sorted.h"

namespace render {
namespace {

using timeseries::Field;
using timeseries::Grid;

// Between uneven places, along axes that count up and down; one of a single point.
std::shared_ptr<const Grid> betweenUnevenPlaces(bool isFlat) {
    timeseries::Axis x{"x", "", {0, 1, 2.5, 3, 7}}, y{"y", "", {4, 3, 1}}, z{"z", "", {0, 2, 3, 9}};
    if (isFlat) z.coordinates = {5};
    return std::make_shared<Grid>(std::array{x, y, z});
}

template <typename T>
Field fieldWith(std::shared_ptr<const Grid> grid) {
    std::mt19937 random(3);
    std::vector<T> values(grid->count());
    for (T& v : values) v = static_cast<T>(random() % 100);
    Field field;
    field.grid = std::move(grid);
    field.values = std::move(values);
    return field;
}

// A layer of one range, and one of so many that do not touch.
tests::CellWorld worldOf(Field field, int ranges = 1) {
    std::string several;
    for (int k = 0; k < ranges; ++k) {
        const double from = 90.0 * k / ranges, to = from + 45.0 / ranges;
        several += (k > 0 ? "," : "") + std::to_string(from) + ":" + std::to_string(to);
    }
    return {tests::sorted(std::move(field)), {"20:60", several}};
}

// Every cell of both layers, anyhow.
std::vector<CellOfLayer> shuffledCells(const Scene& scene) {
    const glm::uvec3 n = scene.cells->size();
    std::vector<CellOfLayer> all;
    for (std::uint32_t cell = 0; cell < n.x * n.y * n.z; ++cell)
        for (const std::uint8_t layer : {std::uint8_t{0}, std::uint8_t{1}})
            all.push_back({cell, layer});
    std::shuffle(all.begin(), all.end(), std::mt19937(5));
    return all;
}

// Of a piece, all that is told.
using Told = std::vector<double>;

std::vector<Told> oneByOne(const Scene& scene) {
    std::vector<Told> all;
    forEachPiece(scene, shuffledCells(scene),
                 [&](const ValuedCell& piece, const CellOfLayer& of, unsigned) {
                     Told told{piece.lo, piece.hi, double(of.layer)};
                     for (int a = 0; a < 3; ++a)
                         told.insert(told.end(), {piece.from[a], piece.to[a]});
                     told.insert(told.end(), piece.corners.begin(), piece.corners.end());
                     all.push_back(told);
                 });
    return all;
}

std::vector<Told> manyAtOnce(const Scene& scene) {
    std::vector<Told> all;
    PieceBatch pieces;
    CellBatches(scene).forEach(shuffledCells(scene), pieces, [&] {
        for (std::size_t i = 0; i < pieces.count; ++i) {
            Told told{pieces.lo[i], pieces.hi[i], double(pieces.layer[i])};
            for (std::size_t a = 0; a < 3; ++a)
                told.insert(told.end(), {pieces.from[a][i], pieces.to[a][i]});
            for (const auto& corner : pieces.corners) told.push_back(corner[i]);
            all.push_back(told);
        }
        pieces.count = 0;
    });
    EXPECT_EQ(pieces.count, 0u);
    return all;
}

void expectSamePieces(const Scene& scene) {
    const auto expected = oneByOne(scene);
    ASSERT_GT(expected.size(), 30u);
    EXPECT_EQ(manyAtOnce(scene), expected);
}

TEST(CellBatches, OfEveryTypeAreThoseOfEachCell) {
    for (const bool isFlat : {false, true}) {
        expectSamePieces(worldOf(fieldWith<std::uint8_t>(betweenUnevenPlaces(isFlat))).scene);
        expectSamePieces(worldOf(fieldWith<std::int16_t>(betweenUnevenPlaces(isFlat))).scene);
        expectSamePieces(worldOf(fieldWith<std::int32_t>(betweenUnevenPlaces(isFlat))).scene);
        expectSamePieces(worldOf(fieldWith<float>(betweenUnevenPlaces(isFlat))).scene);
        expectSamePieces(worldOf(fieldWith<double>(betweenUnevenPlaces(isFlat))).scene);
    }
}

// As many as the batch has room for, and more.
TEST(CellBatches, HaveEveryRangeOfTheirLayer) {
    for (const int ranges : {2, 7, 8, 9, 100})
        expectSamePieces(worldOf(fieldWith<float>(betweenUnevenPlaces(false)), ranges).scene);
}

TEST(CellBatches, HaveOctantsWhereValuesLack) {
    const std::size_t points = betweenUnevenPlaces(false)->count();
    for (const float none :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        Field field = fieldWith<float>(betweenUnevenPlaces(false));
        auto& values = std::get<std::vector<float>>(field.values);
        for (const std::size_t i : {std::size_t{7}, std::size_t{31}, points - 1}) values[i] = none;
        expectSamePieces(worldOf(std::move(field)).scene);
    }
    Field field = fieldWith<std::uint8_t>(betweenUnevenPlaces(false));
    field.missing.assign(points, false);
    field.missing[20] = true;
    expectSamePieces(worldOf(std::move(field)).scene);
}

TEST(CellBatches, AreClipped) {
    tests::CellWorld world = worldOf(fieldWith<float>(betweenUnevenPlaces(false)));
    world.scene.clip.lo = {1, 0, 1};
    expectSamePieces(world.scene);
}

TEST(CellBatches, OfNoCellsAreNone) {
    const tests::CellWorld world = worldOf(fieldWith<float>(betweenUnevenPlaces(false)));
    PieceBatch pieces;
    int calls = 0;
    CellBatches(world.scene).forEach({}, pieces, [&] { ++calls; });
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(pieces.count, 0u);
}

}  // namespace
}  // namespace render

// Cells of fields that are hard to draw, beside the truth: turbulence in thin ranges, noise of
// bytes, labels, plateaus; and what interpolation itself leaves of a field that is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "datasets/analytic.h"
#include "render/model/rays_across.h"
#include "render/reference/interval_truth.h"
#include "tests/bench/turbulence.h"
#include "tests/support/cell_rays.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/sampled_errors.h"
#include "tests/support/sorted.h"

namespace {

using namespace render;
using tests::CellWorld;
using timeseries::Field;
using timeseries::SortedStep;

// The relative L2 of what is drawn of it in 600 x 600 pixels.
double errorOf(const CellWorld& world) {
    const View view = tests::lookFrom({1.2, -2.6, 0.9}, {600, 600}, 0.36);
    std::vector<double> drawn(std::size_t(view.size.x) * std::size_t(view.size.y));
    for (std::size_t k = 0; k < world.scene.layers.size(); ++k) {
        const double perWeight = opticalDepthPerWeight(world.scene.layers[k].style.opacity);
        const std::vector<float> plane =
            tests::drawn(world.scene, view, Channels::Weight, k, 2, tests::kAllCells, {},
                         raysAcross(world.scene, view));
        for (std::size_t i = 0; i < drawn.size(); ++i)
            drawn[i] += perWeight * static_cast<double>(plane[i]);
    }
    const DepthAt picture = [&](std::span<const glm::ivec2> at) {
        std::vector<double> depth;
        for (const glm::ivec2& pixel : at)
            depth.push_back(
                drawn[std::size_t(pixel.y) * std::size_t(view.size.x) + std::size_t(pixel.x)]);
        return depth;
    };
    return tests::sampledError(world, view, picture, {.pixels = 96, .asked = 1024, .raysAcross = 5})
        .relativeL2;
}

Field cube(std::size_t side, std::vector<float> values) {
    Field field;
    field.grid = tests::cube(side);
    field.values = std::move(values);
    return field;
}

// Widths in steps between neighbours, root mean square, and what an error may be there.
double boundOf(double steps) { return steps >= 1 ? 0.01 : steps >= 0.3 ? 0.03 : 0.12; }

TEST(CellsOfTurbulence, AreTrueHoweverThinTheRange) {
    for (const std::size_t side : {96, 192}) {
        const Field field = bench::turbulence<float>(side);
        const auto& values = std::get<std::vector<float>>(field.values);
        double sum = 0, squares = 0, steps = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto v = static_cast<double>(values[i]);
            sum += v;
            squares += v * v;
            if ((i + 1) % side != 0) steps += std::pow(static_cast<double>(values[i + 1]) - v, 2);
        }
        const auto count = static_cast<double>(values.size());
        const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
        const double between = std::sqrt(steps / count);
        for (const double share : {1.0, 0.3, 0.1, 0.03, 0.01}) {
            const double width = share * deviation;
            const CellWorld world(tests::sorted(Field(field)),
                                  {std::to_string(mean) + "~" + std::to_string(width / 2)});
            EXPECT_LT(errorOf(world), boundOf(width / between))
                << side << ", " << width / between << " steps";
        }
    }
}

TEST(CellsOfBytes, OfNoiseAreTrue) {
    std::mt19937 random(5);
    Field field;
    field.grid = tests::cube(48);
    std::vector<std::uint8_t> values(field.grid->count());
    for (auto& v : values) v = static_cast<std::uint8_t>(random() >> 24);
    field.values = values;
    // A step between neighbours is 255 / sqrt(6).
    for (const auto& [range, width] : {std::pair("20:200", 181), {"100:130", 31}, {"128", 1}}) {
        const CellWorld world(tests::sorted(Field(field)), {range});
        EXPECT_LT(errorOf(world), boundOf(width / 104.0)) << range;
    }
}

// Balls in balls, of 0, 1, 2 and 7: of a segmentation, whose values lie in steps.
TEST(CellsOfBytes, OfLabelsAreTrue) {
    constexpr std::size_t kSide = 64;
    Field field;
    field.grid = tests::cube(kSide);
    std::vector<std::uint8_t> values(field.grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double r = glm::length(glm::dvec3(field.grid->indices(i)) - 31.5);
        values[i] = r < 8 ? 7 : r < 17 ? 2 : r < 26 ? 1 : 0;
    }
    field.values = values;
    for (const char* range : {"1", "2", "7", "1:2"}) {
        const CellWorld world(tests::sorted(Field(field)), {range});
        EXPECT_LT(errorOf(world), 0.01) << range;
    }
}

// Of water below an oblique surface, 1, and air above it, 0: between points the surface lies in the
// middle, and what is water from a half on fills the cells below it whole.
TEST(CellsOfPlateaus, OfWaterAndAirAreTrue) {
    constexpr std::size_t kSide = 40;
    const auto grid = tests::cube(kSide);
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 p(grid->indices(i));
        values[i] = p.z < 20.2 + 0.3 * p.x - 0.2 * p.y ? 1 : 0;
    }
    for (const char* range : {"0.5:max", "min:0.5", "1", "0"}) {
        const CellWorld world(tests::sorted(cube(kSide, values)), {range});
        EXPECT_LT(errorOf(world), 0.01) << range;
    }
}

// Marschner and Lobb's signal, whose range is known on every ray: what is interpolated between its
// points tends to it as their spacing squared.
TEST(CellsOfAKnownField, TendToItAsTheirSpacingSquared) {
    const datasets::MarschnerLobb signal{.frequency = 1};
    constexpr double kLo = 0.45, kHi = 0.6;
    constexpr glm::ivec2 kSize(40, 40);
    const View view = tests::lookFrom({1.2, -2.6, 0.9}, kSize, 0.3);
    std::vector<double> errors;
    for (const std::size_t side : {33, 65}) {
        const auto grid = tests::cube(side);
        const double half = static_cast<double>(side - 1) / 2;
        const auto valueAt = [&](const glm::dvec3& index) { return signal(index / half - 1.0, 0); };
        std::vector<float> values(grid->count());
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(valueAt(glm::dvec3(grid->indices(i))));
        const CellWorld world(tests::sorted(cube(side, values)),
                              {std::to_string(kLo) + ":" + std::to_string(kHi)});
        const auto spacing = world.placed.positions()[0][1] - world.placed.positions()[0][0];
        const IntervalTruth truth(world.scene, world.scene.cells->field(), 1);
        const std::vector<double> told = truth.weight(view, 0);
        double apart = 0, all = 0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) {
                const tests::cells::Ray ray = tests::cells::rayOf(world, view, {x + 0.5, y + 0.5});
                const auto [from, to] = tests::cells::inside(ray, world.placed.domain());
                if (!(to > from)) continue;
                constexpr int kSamples = 4000;
                int in = 0;
                for (int i = 0; i < kSamples; ++i) {
                    const glm::dvec3 at =
                        ray.from + (from + (to - from) * (i + 0.5) / kSamples) * ray.along;
                    // Beyond the outermost points their values go on.
                    const double v = valueAt(glm::clamp(at / spacing + half, 0.0, 2 * half));
                    in += v >= kLo && v <= kHi ? 1 : 0;
                }
                const double wanted =
                    (to - from) * ray.length * in / kSamples / world.placed.unitLength();
                // In world lengths: units are the cells'.
                const double unit = world.placed.unitLength();
                apart += std::pow(unit * (told[std::size_t(y * kSize.x + x)] - wanted), 2);
                all += std::pow(unit * wanted, 2);
            }
        errors.push_back(std::sqrt(apart / all));
    }
    EXPECT_LT(errors[0], 0.05);
    EXPECT_LT(errors[1], errors[0] / 3);
}

}  // namespace

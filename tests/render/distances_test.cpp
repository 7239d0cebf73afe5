#include "render/splat/distances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "tests/support/scenes.h"
#include "tests/support/vector_targets.h"

namespace render {
namespace {

// Sizes that no vector divides, uneven, leaning, counting down: nothing can be mistaken.
std::shared_ptr<const timeseries::Grid> awkwardGrid() {
    timeseries::Axis uneven = tests::axis(7, 2, -1);
    for (double& x : uneven.coordinates) x = -std::exp(0.3 * x);
    return std::make_shared<timeseries::Grid>(
        std::array{tests::axis(11, 5, -0.3), uneven, tests::axis(13, 0, 1.7)},
        timeseries::CoordinateFrame{tests::leaning({1, 0.3, 0}, {0.5, -1, 0}, {0.4, 0.2, 1}), {}});
}

struct AwkwardWorld {
    timeseries::SortedStep step = tests::noise(awkwardGrid());
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}};
    std::vector<double> away(const glm::dvec3& from, std::span<const std::uint32_t> index) const {
        std::vector<double> found(index.size());
        Distances(scene, from).find(index, found);
        return found;
    }
};

TEST(Distances, AreThoseOfThePointsInTheWorldByAnyVectors) {
    const AwkwardWorld w;
    std::vector<std::uint32_t> all(w.step.size());
    std::iota(all.begin(), all.end(), 0u);
    tests::onEachVectorTarget([&] {
        for (const glm::dvec3& from :
             {glm::dvec3(0.1, 0.05, -0.2), glm::dvec3(0, -3, 0), glm::dvec3(1e6, -2e6, 7)}) {
            const auto found = w.away(from, all);
            for (const std::uint32_t i : all) {
                const double expected = glm::distance(w.placed.position(i), from);
                ASSERT_NEAR(found[i], expected, 1e-14 + 4e-16 * expected) << i;
            }
        }
    });
}

TEST(Distances, OfAnyNumberOfPoints) {
    const AwkwardWorld w;
    tests::onEachVectorTarget([&] {
        for (std::size_t count = 0; count < 20; ++count) {
            std::vector<std::uint32_t> some;
            for (std::size_t k = 0; k < count; ++k)
                some.push_back(static_cast<std::uint32_t>(1000 - 50 * k));
            const auto found = w.away({0, -3, 0}, some);
            for (std::size_t k = 0; k < count; ++k)
                ASSERT_NEAR(found[k], glm::distance(w.placed.position(some[k]), {0, -3, 0}), 1e-14);
        }
    });
}

TEST(Distances, AreNegativeOutsideOfTheClipBoxAlone) {
    AwkwardWorld w;
    std::vector<std::uint32_t> all(w.step.size());
    std::iota(all.begin(), all.end(), 0u);
    for (const IndexBox& clip :
         {IndexBox{{3, 0, 0}, {8, 6, 12}}, IndexBox{{0, 2, 0}, {10, 2, 12}},
          IndexBox{{0, 0, 0}, {10, 6, 11}}, IndexBox{{5, 5, 5}, {4, 6, 12}}, IndexBox{}}) {
        w.scene.clip = clip;
        tests::onEachVectorTarget([&] {
            const auto found = w.away({0, 0, 0}, all);
            for (const std::uint32_t i : all)
                ASSERT_EQ(found[i] < 0, !clip.holds(w.placed.indices(i))) << i;
        });
    }
}

}  // namespace
}  // namespace render

// Splats to draw: how many and how large, whatever the data.
#pragma once

#include "render/model/footprint.h"
#include "tests/support/scenes.h"

namespace bench {

// 256^3 points of noise, of which a thin slice of values holds `count`: splats scattered over the
// volume, each of the wanted diameter in the middle of the picture.
struct ScatteredSplats {
    ScatteredSplats(std::uint64_t count, double diameterPixels,
                    std::shared_ptr<const timeseries::Grid> grid = tests::cube(256),
                    glm::ivec2 size = kSize)
        : step(tests::noise(std::move(grid))), placed(step.grid()) {
        const double share = static_cast<double>(count) / static_cast<double>(step.size());
        const timeseries::RangeSet range(std::vector{timeseries::Range{{0.4}, {0.4 + share}}});
        scene.layers.push_back({step.select(range), {render::Constant{{1, 0.5, 0.1}}, 0.3}});
        const double focal = size.y / 2 / kTangent;
        const double cellPixels = diameterPixels / 2 / render::kQuarticRadius;
        view = tests::lookFrom({0, -focal * placed.unitLength() / cellPixels, 0}, size, kTangent);
    }
    // Refers to itself.
    ScatteredSplats(const ScatteredSplats&) = delete;
    ScatteredSplats& operator=(const ScatteredSplats&) = delete;

    static constexpr glm::ivec2 kSize{1024, 1024};
    static constexpr double kTangent = 0.25;  // of half the view's angle
    timeseries::SortedStep step;
    render::PlacedPoints placed;
    render::Scene scene{.step = step,
                        .placed = placed,
                        .layers = {},
                        .footprint = {},
                        .order = render::Order::None,
                        .clip = {}};
    render::View view;
};

// Of one colour, or by value, or by value and in order of depth.
namespace what {

enum What { OneColor, ByTheirValues, Ordered };

inline void colorAndOrder(render::Scene& scene, What what) {
    if (what != OneColor) scene.layers[0].style.color = render::ByValue{{}, 0.4, 0.41};
    if (what == Ordered) scene.order = render::Order::BackToFront;
}

}  // namespace what
}  // namespace bench

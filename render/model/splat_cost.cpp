#include "render/model/splat_cost.h"

#include <algorithm>
#include <cmath>

#include "render/model/footprint.h"
#include "render/model/rays_across.h"

namespace render {
namespace {

// Within the picture.
double pixelsOf(const Splat<double>& s, const PointsView& seen, glm::ivec2 size) {
    const glm::dvec2 window = seen.rays.centre + s.centre, most(size);
    const glm::dvec2 sides = glm::clamp(window + s.hi, glm::dvec2(0), most) -
                             glm::clamp(window + s.lo, glm::dvec2(0), most);
    return sides.x * sides.y;
}

// Of a cell, in the mean: what setting it up and one of its rays take, of an ordinary splat,
// which takes twice as long in order, while a cell does not (tests/bench/NOTES.md).
double cellCost(const Scene& scene, const View& view) {
    const double ordered = scene.order == Order::None ? 1 : 0.5;
    constexpr double kSetUp = 5, kPixel = 0.1;
    const auto most = static_cast<double>(view.size.x) * view.size.y;
    const double rays = std::pow(raysAcross(scene, view), 2);
    const double tetrahedra = scene.placed.isMesh() ? 4 : 1;
    return tetrahedra * ordered *
           (kSetUp + kPixel * rays * std::min(cellPixels(scene, view), most));
}

}  // namespace

double splatCost(const Scene& scene, std::size_t layer, const View& view) {
    if (scene.cells) return cellCost(scene, view);
    constexpr std::uint64_t kSamples = 32;
    const Layer& of = scene.layers[layer];
    const std::uint64_t points = pointCount(of), samples = std::min(points, kSamples);
    if (samples == 0) return 1;
    const PointsView seen(scene.placed, view);
    double pixels = 0;
    std::uint64_t passed = 0, k = 0;
    for (const timeseries::Run& run : of.runs) {
        // The k-th sample is the point in the middle of the k-th part of all.
        for (std::uint64_t at;
             k < samples && (at = (2 * k + 1) * points / (2 * samples)) < passed + run.count; ++k) {
            const std::uint32_t index = scene.step.gridIndex(run.first + (at - passed));
            const auto s = splatAt<double>(seen, index, scene.footprint);
            if (s.visible) pixels += pixelsOf(s, seen, view.size);
        }
        passed += run.count;
    }
    return std::max(1.0, pixels / static_cast<double>(samples) / kOrdinaryPixels);
}

double sceneCost(const Scene& scene, const View& view) {
    double sum = 0;
    for (std::size_t k = 0; k < scene.layers.size(); ++k)
        sum += splatCost(scene, k, view) * static_cast<double>(drawnCount(scene, scene.layers[k]));
    return sum;
}

}  // namespace render

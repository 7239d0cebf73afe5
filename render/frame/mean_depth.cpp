#include "render/frame/mean_depth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/model/footprint.h"
#include "render/reference/accumulator.h"
#include "render/reference/cpu_splatter.h"

namespace render {
namespace {

constexpr std::uint64_t kMostSplats = 1 << 13;

std::uint64_t points(const Scene& scene) {
    std::uint64_t sum = 0;
    for (const Layer& layer : scene.layers) sum += pointCount(layer);
    return sum;
}

// Points of all layers, evenly spread over them by multiples of the golden ratio: neighbours in
// value are neighbours in the grid where values are tied, and even steps would take whole planes.
Sorted sampleOf(const Scene& scene, std::uint64_t all, std::uint64_t count) {
    std::vector<std::uint64_t> places(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const double turns = (static_cast<double>(i) + 0.5) * 0.6180339887498949;
        const double share = turns - std::floor(turns);
        places[i] =
            count == all
                ? i
                : std::min(all - 1, static_cast<std::uint64_t>(share * static_cast<double>(all)));
    }
    std::ranges::sort(places);
    Sorted list;
    auto place = places.begin();
    std::uint64_t before = 0;  // points of the runs passed
    for (std::size_t k = 0; k < scene.layers.size(); ++k)
        for (const timeseries::Run& run : scene.layers[k].runs) {
            for (; place != places.end() && *place < before + run.count; ++place) {
                list.point.push_back(static_cast<std::uint32_t>(run.first + (*place - before)));
                list.layer.push_back(static_cast<std::uint8_t>(k));
            }
            before += run.count;
        }
    return list;
}

// So much smaller that a splat's radius, or a point's side, is a few pixels.
glm::ivec2 coarseSize(const Scene& scene, const View& view) {
    constexpr double kRadius = 3, kLeastSide = 16;
    double scale = 1;
    if (scene.footprint.kernel == Kernel::Point) {
        scale = 1 / scene.footprint.size;
    } else {
        const double depth = project(view, glm::dvec3(0)).depth;
        const double radius = scene.placed.unitLength() * scene.footprint.size * kQuarticRadius *
                              pixelRays(view).focal.x / std::max(depth, pixelRays(view).near);
        scale = kRadius / radius;
    }
    const double least = kLeastSide / std::max(view.size.x, view.size.y);
    scale = std::clamp(scale, std::min(least, 1.0), 1.0);
    return glm::max(glm::ivec2(glm::round(scale * glm::dvec2(view.size))), glm::ivec2(1));
}

bool isOneColor(const std::vector<glm::dvec3>& colors) {
    constexpr double kSame = 1e-3;
    return std::ranges::all_of(colors, [&](const glm::dvec3& color) {
        return glm::distance(color, colors.front()) < kSame;
    });
}

}  // namespace

bool mixesColors(const Scene& scene) {
    if (scene.order == Order::BackToFront) return false;
    std::vector<glm::dvec3> colors;
    for (const Layer& layer : scene.layers) {
        if (layer.runs.empty()) continue;
        // Values ascend, and so do places in a map: where both ends have one colour, all have.
        const timeseries::Run &first = layer.runs.front(), &last = layer.runs.back();
        for (const std::uint64_t point : {first.first, last.first + last.count - 1})
            colors.push_back(colorOf(layer.style, timeseries::toDouble(scene.step.value(point))));
    }
    return !isOneColor(colors);
}

double meanOpticalDepth(const Scene& scene, const View& view) {
    const std::uint64_t all = points(scene), count = std::min(all, kMostSplats);
    if (all == 0) return 0;
    const double each = static_cast<double>(all) / static_cast<double>(count);
    Scene coarse = scene;
    coarse.stride = 1;
    // Points of fixed size grow too: the picture becomes so much smaller.
    coarse.footprint.size *= std::cbrt(each);
    View small = view;
    small.size = coarseSize(coarse, view);
    if (coarse.footprint.kernel == Kernel::Point) coarse.footprint.size = 1;
    Accumulator<float> sums(small.size,
                            std::vector<Channels>(scene.layers.size(), Channels::Weight));
    splat<float>(coarse, sampleOf(scene, all, count), small, {}, sums);

    double sum = 0;
    std::uint64_t covered = 0;
    for (std::size_t pixel = 0; pixel < sums.planes.front().size(); ++pixel) {
        double depth = 0;
        for (std::size_t k = 0; k < scene.layers.size(); ++k)
            depth += each * opticalDepthPerWeight(scene.layers[k].style.opacity) *
                     static_cast<double>(sums.planes[k][pixel]);
        if (depth < kCoveredDepth) continue;
        sum += depth;
        ++covered;
    }
    return covered == 0 ? 0 : sum / static_cast<double>(covered);
}

}  // namespace render

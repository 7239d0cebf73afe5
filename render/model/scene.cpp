#include "render/model/scene.h"

namespace render {

namespace {

std::uint64_t countOf(const Layer& layer, std::uint32_t stride) {
    std::uint64_t count = 0;
    for (const timeseries::Run& run : layer.runs) count += subsetCount(run, stride);
    return count;
}

}  // namespace

std::uint64_t cellCount(const Layer& layer) {
    std::uint64_t count = 0;
    for (const timeseries::Run& run : layer.cells.candidates) count += run.count;
    return count;
}

std::uint64_t pointCount(const Layer& layer) { return countOf(layer, 1); }

std::uint32_t strideOf(const Layer& layer, std::uint32_t stride) {
    while (stride > 1 && countOf(layer, stride) == 0) stride /= 2;
    return stride;
}

bool areOneColor(const std::vector<Layer>& layers) {
    return std::ranges::all_of(layers, [&](const Layer& layer) {
        const auto* first = std::get_if<Constant>(&layers.front().style.color);
        const auto* color = std::get_if<Constant>(&layer.style.color);
        return first && color && first->linearRgb == color->linearRgb;
    });
}

std::uint64_t splatCount(const Layer& layer, std::uint32_t stride) {
    return countOf(layer, strideOf(layer, stride));
}

Footprint standingFor(Footprint footprint, double points) {
    if (footprint.kernel != Kernel::Point) footprint.size *= std::cbrt(points);
    return footprint;
}

double pointsPerSplat(const Layer& layer, std::uint32_t stride) {
    const std::uint64_t splats = splatCount(layer, stride);
    if (splats == 0) return 1;
    return static_cast<double>(pointCount(layer)) / static_cast<double>(splats);
}

timeseries::Columns columnsOf(const Scene& scene) {
    std::vector<timeseries::Run> runs;
    for (const Layer& layer : scene.layers)
        runs.insert(runs.end(), layer.runs.begin(), layer.runs.end());
    return scene.step.columns(runs);
}

bool mixesModels(const Scene& scene) {
    const auto byCells = [&](const Layer& layer) { return isByCells(scene, layer); };
    return scene.cells && !std::ranges::all_of(scene.layers, byCells);
}

Scene onlyPoints(Scene scene) {
    for (Layer& layer : scene.layers)
        if (isByCells(scene, layer)) layer.runs.clear();
    scene.cells.reset();
    scene.light = Light::Off;
    return scene;
}

Scene onlyCells(Scene scene) {
    for (Layer& layer : scene.layers)
        if (layer.byPoints) layer = {{}, layer.style, {}};
    return scene;
}

std::vector<Channels> channelsFor(const Scene& scene) {
    if (scene.order == Order::BackToFront) return {Channels::Over};
    std::vector<Channels> channels;
    for (const Layer& layer : scene.layers)
        channels.push_back(std::holds_alternative<Constant>(layer.style.color)
                               ? Channels::Weight
                               : Channels::WeightedColor);
    return channels;
}

}  // namespace render

#include "render/scene.h"

namespace render {

std::uint64_t pointCount(const Layer& layer) { return splatCount(layer, 1); }

std::uint64_t splatCount(const Layer& layer, std::uint32_t stride) {
    std::uint64_t count = 0;
    for (const timeseries::Run& run : layer.runs) count += (run.count + stride - 1) / stride;
    return count;
}

double pointsPerSplat(const Layer& layer, std::uint32_t stride) {
    const std::uint64_t splats = splatCount(layer, stride);
    if (splats == 0) return 1;
    return static_cast<double>(pointCount(layer)) / static_cast<double>(splats);
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

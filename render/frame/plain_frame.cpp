#include "render/frame/plain_frame.h"

#include <array>
#include <limits>
#include <utility>

#include "render/frame/enlarge.h"

namespace render {
namespace {

constexpr std::uint64_t kWithoutEnd = std::numeric_limits<std::uint64_t>::max();

void sum(SplatFrame& splats, const View& view, Channels channels, std::size_t plane,
         Targets& targets) {
    const auto sums = splats.begin(view, channels, plane, targets);
    while (!sums->done()) sums->add(kWithoutEnd);
}

}  // namespace

PlainFrame::PlainFrame(glm::ivec2 size, const glm::dvec3& background)
    : font_(std::array{labelStyle(size), titleStyle(size)}),
      background_(background),
      targets_(size) {
    light_.setFont(font_);
}

void PlainFrame::draw(const Scene& scene, const View& view, int across) {
    const View planes = coarser(view, across);
    if (across > 1 && (!coarse_ || coarse_->size() != planes.size)) coarse_.emplace(planes.size);
    MemoryTargets& summed = across > 1 ? *coarse_ : targets_;
    const auto splats = splatter_.prepare(scene, splatter_.order(scene, pixelRays(view).eye),
                                          GlStep(scene.step, scene.placed));
    light_.drawDepth({}, {}, planes, summed);
    const std::vector<Channels> channels = channelsFor(scene);
    for (std::size_t i = 0; i < channels.size(); ++i) sum(*splats, planes, channels[i], i, summed);
    if (across > 1) {
        light_.drawDepth({}, {}, view, targets_);
        light_.enlarge(scene, view, across, summed, targets_);
    }
    const AxesMeshes noAxes;
    const FlatMesh noLegend;
    light_.drawLight({scene, view, background_, noAxes, noLegend, {}}, LightAs::Linear, targets_);
}

std::vector<float> opticalDepthOf(const Scene& scene, const View& view,
                                  const std::atomic<bool>& wanted) {
    constexpr std::uint64_t kAtOnce = 1 << 15;  // a few milliseconds
    Scene plain = scene;
    plain.order = Order::None;
    MemoryTargets targets(view.size);
    ProcessorSplatter splatter;
    const auto splats = splatter.prepare(plain, Runs{}, GlStep(scene.step, scene.placed));
    std::vector<float> depth(static_cast<std::size_t>(view.size.x) *
                             static_cast<std::size_t>(view.size.y));
    for (std::size_t k = 0; k < plain.layers.size(); ++k) {
        const auto sum = splats->begin(view, Channels::Weight, k, targets);
        while (!sum->done()) {
            if (!wanted) return {};
            sum->add(kAtOnce);
        }
        const auto perWeight =
            static_cast<float>(opticalDepthPerWeight(plain.layers[k].style.opacity));
        const std::vector<float> weight = turnedOver(targets.readScalarPlane(k), view.size);
        for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += perWeight * weight[i];
    }
    return depth;
}

std::vector<float> enlargedDepthOf(const Scene& scene, const View& view, int across) {
    const View planes = coarser(view, across);
    std::vector<float> depth = opticalDepthOf(scene, planes);
    if (across == 1) return depth;
    std::vector<float> pixels;
    enlarge({Channels::Weight, {{0, 0}, planes.size}, std::move(depth)}, across,
            {{0, 0}, view.size}, pixels);
    return pixels;
}

}  // namespace render

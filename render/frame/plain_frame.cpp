#include "render/frame/plain_frame.h"

#include <array>
#include <utility>

#include "render/frame/enlarge.h"
#include "render/gl/driver.h"
#include "render/splat/memory_targets.h"
#include "render/splat/processor_splatter.h"

namespace render {
namespace {

std::vector<float> enlarged(std::vector<float> depth, const View& planes, const View& view,
                            int across) {
    if (across == 1) return depth;
    PlanePixels pixels;
    enlarge({Channels::Weight, {{0, 0}, planes.size}, {depth.begin(), depth.end()}}, across,
            {{0, 0}, view.size}, pixels);
    return {pixels.begin(), pixels.end()};
}

}  // namespace

PlainFrame::PlainFrame(const timeseries::SortedStep& step, const PlacedPoints& placed,
                       const glm::dvec3& background, SplatterChoice by)
    : background_(background), renderer_(by), onGpu_(step, placed) {}

FrameContent PlainFrame::contentOf(const Scene& scene, int across) const {
    return {.scene = scene,
            .grid = scene.step.grid(),
            .legend = {},
            .background = background_,
            .across = across,
            .axes = false};
}

void PlainFrame::draw(const Scene& scene, const View& view, int across) {
    const Splatters& splatters = renderer_.splatters();
    if (splatters.takesPointsFromGpu(scene)) onGpu_.upload(scene, neededScale(scene));
    const FrameContent content = contentOf(scene, across);
    const auto frame = renderer_.prepare(content, onGpu_, std::array{view});
    renderer_.drawEye(frame, view);
    if (splatters.sumsByGl(scene)) gl::finishDrawing();
}

std::vector<float> PlainFrame::depth(const Scene& scene, const View& view, int across) {
    if (!renderer_.splatters().sumsByGl(scene)) return enlargedDepthOf(scene, view, across);
    const View planes = coarser(view, across);
    const auto eyes = renderer_.render(contentOf(scene, 1), onGpu_, std::array{planes},
                                       {.opticalDepth = true, .splatCount = false});
    return enlarged(turnedOver(eyes[0].opticalDepth, planes.size), planes, view, across);
}

std::vector<float> opticalDepthOf(const Scene& scene, const View& view,
                                  const std::atomic<bool>& wanted) {
    // Some ten milliseconds: each time, a plane is read and written.
    constexpr std::uint64_t kAtOnce = 1 << 17;
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
        const auto& [channels, part, weight] = targets.plane(k);
        for (int y = 0; y < part.size.y; ++y) {
            const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(part.size.x);
            const auto at =
                static_cast<std::size_t>(part.at.y + y) * static_cast<std::size_t>(view.size.x) +
                static_cast<std::size_t>(part.at.x);
            for (std::size_t x = 0; x < static_cast<std::size_t>(part.size.x); ++x)
                depth[at + x] += perWeight * weight[row + x];
        }
    }
    return depth;
}

std::vector<float> enlargedDepthOf(const Scene& scene, const View& view, int across) {
    const View planes = coarser(view, across);
    return enlarged(opticalDepthOf(scene, planes), planes, view, across);
}

}  // namespace render

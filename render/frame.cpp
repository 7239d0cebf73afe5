#include "render/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "render/gl/debug_output.h"
#include "render/splat_cost.h"

namespace render {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kAllSplats = std::numeric_limits<std::uint64_t>::max();

std::array<FontStyle, 2> stylesFor(glm::ivec2 size) { return {labelStyle(size), titleStyle(size)}; }

glm::dvec3 midway(std::span<const View> eyes) {
    glm::dvec3 sum(0);
    for (const View& eye : eyes) sum += pixelRays(eye).eye;
    return sum / static_cast<double>(eyes.size());
}

}  // namespace

// A driver that draws on the processor takes several times longer for point sprites than the
// program does for their pixels (tests/bench/NOTES.md).
FrameRenderer::FrameRenderer(SplatterChoice splatter, LightAs as)
    : styles_(stylesFor({64, 64})),
      font_(styles_),
      sums_(splatter == SplatterChoice::Cpu ||
            (splatter == SplatterChoice::ByDevice && gl::drawsOnProcessor())),
      as_(as) {
    inMemory_.setFont(font_);
}

FrameRenderer::FrameRenderer(std::function<void()> makeCurrent)
    : FrameRenderer(SplatterChoice::Cpu) {
    makeCurrent_ = std::move(makeCurrent);
}

FrameRenderer::Gl& FrameRenderer::needGl() {
    if (!gl_) {
        if (makeCurrent_) makeCurrent_();
        gl_ = std::make_unique<Gl>();
        gl_->light.setFont(font_);
    }
    return *gl_;
}

void FrameRenderer::makeRoom(std::span<const View> eyes, const LightPass& light) {
    const auto isFor = [&](const Held& held, const View& eye) {
        return held.of == &light && held.targets->size() == eye.size;
    };
    for (const View& eye : eyes)
        if (std::ranges::none_of(targets_, [&](const Held& held) { return isFor(held, eye); }))
            targets_.push_back({&light, light.targets(eye.size)});
    std::erase_if(targets_, [&](const Held& held) {
        return std::ranges::none_of(eyes, [&](const View& eye) { return isFor(held, eye); });
    });
    // Letters of one size for all eyes, or they would not be seen as one.
    const auto styles = stylesFor(eyes.front().size);
    if (styles == styles_) return;
    font_ = Font(styles);
    if (gl_) gl_->light.setFont(font_);
    styles_ = styles;
}

Targets& FrameRenderer::use(glm::ivec2 size, const LightPass& light) {
    const auto found = std::ranges::find_if(targets_, [&](const Held& held) {
        return held.of == &light && held.targets->size() == size;
    });
    assert(found != targets_.end());
    current_ = static_cast<std::size_t>(found - targets_.begin());
    return targets();
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GpuStep& step,
                                               std::span<const View> eyes) {
    return prepare(content, step, eyes, as_);
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GpuStep& step,
                                               std::span<const View> eyes, LightAs as) {
    LightPass& light = lightFor(content, eyes);
    makeRoom(eyes, light);
    const glm::dvec3 midEye = midway(eyes);
    ++orders_;
    const Scene& scene = content.scene;
    // GL's own upload does it.
    if (&light != &inMemory_ && !takesPointsFromGpu(scene))
        needGl().splatter.setLayers(scene, ValueScale::of(scene.layers));
    return {content, splatterFor(scene).prepare(scene, order(scene, midEye), step), midEye, light,
            as};
}

LightPass& FrameRenderer::lightFor(const FrameContent& content, std::span<const View> eyes) {
    if (takesPointsFromGpu(content.scene) || !MemoryLight::canDraw(content.placards, eyes))
        return needGl().light;
    return inMemory_;
}

Splatter& FrameRenderer::splatterFor(const Scene& scene) {
    if (takesPointsFromGpu(scene)) return needGl().splatter;
    return processor_;
}

bool FrameRenderer::takesPointsFromGpu(const Scene& scene) const {
    return !(sums_ && ProcessorSplatter::canDraw(scene));
}

void FrameRenderer::drawEye(const Prepared& frame, const View& eye) {
    EyeInWork work = begin(frame, eye);
    goOn(work, kAll);
}

FrameRenderer::EyeInWork FrameRenderer::begin(const Prepared& frame, const View& eye) {
    ++eyes_;
    const FrameContent& content = frame.content;
    FlatMesh legend = legendMesh(content.legend, font_, eye.size);
    AxesMeshes axes = axesMeshes(content.grid, content.scene.lattice, eye, frame.midEye, font_,
                                 legend, content.background);
    return {frame, eye, std::move(legend), std::move(axes), splatCosts(content.scene, eye)};
}

bool FrameRenderer::goOn(EyeInWork& work, double cost) {
    if (!drawSplats(work, cost)) return false;
    const Prepared& frame = work.frame;
    const FrameContent& content = frame.content;
    frame.light.drawLight(
        {content.scene, work.eye, content.background, work.axes, work.legend, content.placards},
        frame.as, use(work.eye.size, frame.light));
    return true;
}

void FrameRenderer::drawWhole(const Prepared& frame, const View& eye,
                              const std::function<void(double)>& progress) {
    constexpr double kAtOnce = 1 << 18;  // half a second on two cores without a GPU
    if (!progress) return drawEye(frame, eye);
    const double whole = cost(frame, eye);
    EyeInWork work = begin(frame, eye);
    while (!goOn(work, kAtOnce)) progress(std::min(work.cost / whole, 1.0));
}

// Of the planes in turn; one that takes every layer has their mean.
std::vector<double> FrameRenderer::splatCosts(const Scene& scene, const View& eye) const {
    std::vector<double> costs;
    if (scene.order == Order::None) {
        for (std::size_t k = 0; k < scene.layers.size(); ++k)
            costs.push_back(splatCost(scene, k, eye));
        return costs;
    }
    std::uint64_t splats = 0;
    for (const Layer& layer : scene.layers) splats += splatCount(layer, scene.stride);
    const auto count = static_cast<double>(std::max(splats, std::uint64_t{1}));
    return {std::max(1.0, sceneCost(scene, eye) / count)};
}

double FrameRenderer::cost(const Prepared& frame, const View& eye) const {
    const Scene& scene = frame.content.scene;
    const std::vector<Channels> channels = channelsFor(scene);
    const std::vector<double> each = splatCosts(scene, eye);
    double sum = 0;
    for (std::size_t i = 0; i < channels.size(); ++i)
        sum += each[i] * static_cast<double>(frame.splats->splats(channels[i], i));
    return sum;
}

std::vector<EyePicture> FrameRenderer::render(const FrameContent& content, GpuStep& step,
                                              std::span<const View> eyes, const Extras& extras) {
    if (takesPointsFromGpu(content.scene)) step.upload(content.scene, neededScale(content.scene));
    // A sorted list brings its own points; made before prepare(), whose layers then hold.
    Scene sorted = content.scene;
    sorted.order = Order::BackToFront;
    std::unique_ptr<GpuList> counted;
    if (extras.splatCount)
        counted = needGl().splatter.upload(sorted, order(sorted, midway(eyes)), step);
    const Prepared frame = prepare(content, step, eyes, LightAs::Linear);
    std::vector<EyePicture> pictures;
    for (const View& eye : eyes) {
        drawWhole(frame, eye, extras.progress);
        EyePicture& picture = pictures.emplace_back();
        picture.image = targets().readLight();
        if (extras.splatCount) picture.splatCount = countSplats(*counted, eye, frame.light);
    }
    if (extras.opticalDepth) {
        // An ordered list interleaves the layers; their weights are added from the runs.
        Scene unordered = content.scene;
        unordered.order = Order::None;
        if (takesPointsFromGpu(unordered)) step.upload(unordered, neededScale(unordered));
        const auto splats = splatterFor(unordered).prepare(unordered, Runs{}, step);
        for (std::size_t i = 0; i < eyes.size(); ++i)
            pictures[i].opticalDepth = opticalDepth(unordered, *splats, eyes[i], frame.light);
    }
    if (gl_) gl::throwOnError();
    return pictures;
}

void FrameRenderer::drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                                 std::span<const View> eyes,
                                 const std::function<void(std::size_t eye, Targets&)>& show) {
    GlLight& light = needGl().light;
    makeRoom(eyes, light);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        light.drawPlacards(placards, background, eyes[i], use(eyes[i].size, light));
        show(i, targets());
    }
}

bool FrameRenderer::drawSplats(EyeInWork& work, double cost) {
    const FrameContent& content = work.frame.content;
    const std::vector<Channels> channels = channelsFor(content.scene);
    LightPass& light = work.frame.light;
    Targets& targets = use(work.eye.size, light);
    if (work.plane == 0 && !work.sum)
        light.drawDepth(work.axes.behind, content.placards, work.eye, targets);
    const double until = work.cost + std::max(cost, 1.0);
    for (; work.plane < channels.size(); ++work.plane, work.sum.reset()) {
        if (work.cost >= until) return false;
        if (!work.sum)
            work.sum =
                work.frame.splats->begin(work.eye, channels[work.plane], work.plane, targets);
        const double each = work.splatCosts[work.plane];
        constexpr double kMost = 1e18;
        while (!work.sum->done() && work.cost < until) {
            const double splats = std::min(std::ceil((until - work.cost) / each), kMost);
            work.cost +=
                each * static_cast<double>(work.sum->add(static_cast<std::uint64_t>(splats)));
        }
        if (!work.sum->done()) return false;
    }
    return true;
}

std::vector<float> FrameRenderer::countSplats(const GpuList& counted, const View& view,
                                              LightPass& light) {
    light.drawDepth({}, {}, view, use(view.size, light));
    GlTargets& targets = this->targets().onGl();
    needGl().splatter.draw(counted, view, Channels::Count, 0,
                           targets.clearedPlane(0, Channels::Count));
    return targets.readScalarPlane(0);
}

std::vector<float> FrameRenderer::opticalDepth(const Scene& scene, SplatFrame& splats,
                                               const View& view, LightPass& light) {
    Targets& targets = use(view.size, light);
    light.drawDepth({}, {}, view, targets);
    std::vector<float> total(std::size_t(view.size.x) * std::size_t(view.size.y));
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const auto sum = splats.begin(view, Channels::Weight, k, targets);
        while (!sum->done()) sum->add(kAllSplats);
        const std::vector<float> weight = targets.readScalarPlane(k);
        const auto perWeight =
            static_cast<float>(opticalDepthPerWeight(scene.layers[k].style.opacity));
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += perWeight * weight[i];
    }
    return total;
}

}  // namespace render

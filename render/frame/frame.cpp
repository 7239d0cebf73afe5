#include "render/frame/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "render/gl/debug_output.h"

namespace render {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kAllSplats = std::numeric_limits<std::uint64_t>::max();

constexpr double kMostAtOnce = 1e18;  // what a number of splats may be
// Of what one call draws, the first is so small a part: nothing is known of what it takes.
constexpr double kFirstSlices = 16;

// For a look at the clock every 12 ms: tiles are taken up and put down between two.
double nextSlice(double drawn, std::chrono::duration<double, std::milli> took) {
    return drawn * std::clamp(12 / std::max(took.count(), 1e-3), 1.0 / 64, 2.0);
}

std::array<FontStyle, 2> stylesFor(glm::ivec2 size) { return {labelStyle(size), titleStyle(size)}; }

}  // namespace

glm::dvec3 midEye(std::span<const View> eyes) {
    glm::dvec3 sum(0);
    for (const View& eye : eyes) sum += pixelRays(eye).eye;
    return sum / static_cast<double>(eyes.size());
}

Middle middleOf(std::span<const View> eyes) {
    glm::dvec2 sum(0);
    for (const View& eye : eyes) sum += glm::dvec2(eye.clipFromView[2]);
    return {midEye(eyes), sum / static_cast<double>(eyes.size())};
}

FrameRenderer::FrameRenderer(SplatterChoice splatter, LightAs as) : splatters_(splatter), as_(as) {}

GlLight& FrameRenderer::glLight() {
    if (!onGl_) {
        onGl_ = std::make_unique<GlLight>(splatters_.gl().layerBlock());
        if (font_) onGl_->setFont(*font_);
    }
    return *onGl_;
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
    if (font_ && styles == styles_) return;
    font_.emplace(styles);
    inMemory_.setFont(*font_);
    if (onGl_) onGl_->setFont(*font_);
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

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GlStep& step,
                                               std::span<const View> eyes) {
    return prepare(content, step, eyes, splatters_.order(content.scene, midEye(eyes)));
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GlStep& step,
                                               std::span<const View> eyes, DrawList list) {
    return prepare(content, step, eyes, std::move(list), as_);
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GlStep& step,
                                               std::span<const View> eyes, DrawList list,
                                               LightAs as) {
    LightPass& light = lightFor(content, eyes);
    std::vector<View> views(eyes.begin(), eyes.end());
    if (content.across > 1)
        std::ranges::copy(coarser(eyes, content.across), std::back_inserter(views));
    makeRoom(views, light);
    ++orders_;
    const Scene& scene = content.scene;
    // The upload of points does it.
    if (&light != &inMemory_ && !splatters_.takesPointsFromGpu(scene))
        splatters_.gl().setLayers(scene, ValueScale::of(scene.layers));
    return {content, splatters_.prepare(scene, std::move(list), step), middleOf(eyes), light, as};
}

LightPass& FrameRenderer::lightFor(const FrameContent& content, std::span<const View> eyes) {
    if (splatters_.sumsByGl(content.scene) || !MemoryLight::canDraw(content.placards, eyes))
        return glLight();
    return inMemory_;
}

double FrameRenderer::drawEye(const Prepared& frame, const View& eye) {
    EyeInWork work = begin(frame, eye);
    goOn(work, kAll);
    return work.cost;
}

FrameRenderer::EyeInWork FrameRenderer::begin(const Prepared& frame, const View& eye) {
    ++eyes_;
    const FrameContent& content = frame.content;
    FlatMesh legend = legendMesh(content.legend, *font_, eye.size);
    AxesMeshes axes;
    if (content.axes)
        axes = axesMeshes(content.grid, content.scene.placed, eye, frame.middle, *font_, legend,
                          content.background);
    const View planes = content.across > 1 ? coarser(eye, content.across) : eye;
    EyeInWork work{
        frame, eye, planes, std::move(legend), std::move(axes), splatCosts(frame, planes)};
    work.cost = planesCost(content.scene, planes);
    return work;
}

bool FrameRenderer::goOn(EyeInWork& work, double cost, Clock::time_point end) {
    if (!drawSplats(work, cost, end)) return false;
    const Prepared& frame = work.frame;
    const FrameContent& content = frame.content;
    if (content.across > 1) {
        Targets& from = use(work.planes.size, frame.light);
        Targets& to = use(work.eye.size, frame.light);
        frame.light.drawDepth(work.axes.behind, content.placards, work.eye, to);
        frame.light.enlarge(content.scene, work.eye, content.across, from, to);
    }
    frame.light.drawLight(
        {content.scene, work.eye, content.background, work.axes, work.legend, content.placards},
        frame.as, use(work.eye.size, frame.light));
    return true;
}

void FrameRenderer::drawWhole(const Prepared& frame, const View& eye,
                              const std::function<void(double)>& progress) {
    constexpr double kAtOnce = 1 << 18;  // half a second on two cores without a GPU
    if (!progress) {
        drawEye(frame, eye);
        return;
    }
    const double whole = cost(frame, eye);
    EyeInWork work = begin(frame, eye);
    while (!goOn(work, kAtOnce)) progress(std::min(work.cost / whole, 1.0));
}

// Sums count splats or cells, or what cells are drawn in pieces of.
std::vector<double> FrameRenderer::splatCosts(const Prepared& frame, const View& eye) const {
    const Scene& scene = frame.content.scene;
    const SummedBy by = summedBy(scene);
    const std::vector<Channels> channels = channelsFor(scene);
    std::vector<double> costs;
    for (std::size_t k = 0; k < channels.size(); ++k) {
        const std::uint64_t splats = frame.splats->splats(channels[k], k);
        const double plane =
            scene.order == Order::None ? layerCost(scene, k, eye, by) : sceneCost(scene, eye, by);
        costs.push_back(plane / static_cast<double>(std::max(splats, std::uint64_t{1})));
    }
    return costs;
}

double FrameRenderer::cost(const Prepared& frame, const View& eye) const {
    const View planes = coarser(eye, frame.content.across);
    return splatsCost(frame.content.scene, planes) + planesCost(frame.content.scene, planes);
}

double FrameRenderer::splatsCost(const Scene& scene, const View& eye) const {
    return sceneCost(scene, eye, summedBy(scene));
}

double FrameRenderer::planesCost(const Scene& scene, const View& eye) const {
    return summedBy(scene) == SummedBy::Gl ? 0 : render::planesCost(scene, eye);
}

std::vector<EyePicture> FrameRenderer::render(const FrameContent& content, GlStep& step,
                                              std::span<const View> eyes, const Extras& extras) {
    const Scene& scene = content.scene;
    if (splatters_.takesPointsFromGpu(scene)) step.upload(scene, neededScale(scene));
    const Prepared frame =
        prepare(content, step, eyes, splatters_.order(scene, midEye(eyes)), LightAs::Linear);
    std::vector<EyePicture> pictures;
    for (const View& eye : eyes) {
        drawWhole(frame, eye, extras.progress);
        pictures.push_back({targets().takeLight(), {}, {}});
    }
    if (extras.opticalDepth || extras.splatCount)
        addData(content, step, eyes, frame.light, extras, pictures);
    if (splatters_.hasGl()) gl::throwOnError();
    return pictures;
}

void FrameRenderer::drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                                 std::span<const View> eyes,
                                 const std::function<void(std::size_t eye, Targets&)>& show) {
    GlLight& light = glLight();
    makeRoom(eyes, light);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        light.drawPlacards(placards, background, eyes[i], use(eyes[i].size, light));
        show(i, targets());
    }
}

bool FrameRenderer::drawSplats(EyeInWork& work, double cost, Clock::time_point end) {
    const FrameContent& content = work.frame.content;
    const std::vector<Channels> channels = channelsFor(content.scene);
    LightPass& light = work.frame.light;
    Targets& targets = use(work.planes.size, light);
    if (work.plane == 0 && !work.sum)
        light.drawDepth(content.across > 1
                            ? work.axes.behind.coarser(content.across, work.eye.size.y)
                            : work.axes.behind,
                        content.placards, work.planes, targets);
    const double until = work.cost + std::max(cost, 1.0);
    const bool looksAtClock = end != Clock::time_point::max();
    if (work.slice == 0) work.slice = looksAtClock ? std::max(cost, 1.0) / kFirstSlices : kAll;
    for (; work.plane < channels.size(); ++work.plane, work.sum.reset()) {
        if (work.cost >= until) return false;
        if (!work.sum)
            work.sum =
                work.frame.splats->begin(work.planes, channels[work.plane], work.plane, targets);
        const double each = work.splatCosts[work.plane];
        while (!work.sum->done() && work.cost < until) {
            const Clock::time_point begin = Clock::now();
            if (begin >= end) return false;
            const double some = std::min(until - work.cost, work.slice);
            const double splats = std::min(std::ceil(some / each), kMostAtOnce);
            const double added =
                each * static_cast<double>(work.sum->add(static_cast<std::uint64_t>(splats)));
            work.cost += added;
            if (looksAtClock) work.slice = nextSlice(added, Clock::now() - begin);
        }
        if (!work.sum->done()) return false;
    }
    return true;
}

// From the runs: an ordered list interleaves the layers.
void FrameRenderer::addData(const FrameContent& content, GlStep& step, std::span<const View> eyes,
                            LightPass& light, const Extras& extras,
                            std::vector<EyePicture>& pictures) {
    Scene scene = content.scene;
    scene.order = Order::None;
    if (splatters_.takesPointsFromGpu(scene)) step.upload(scene, neededScale(scene));
    const auto splats = splatters_.prepare(scene, Runs{}, step);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        EyePicture& picture = pictures[i];
        if (extras.splatCount)
            picture.splatCount = dataPlane(*splats, eyes[i], Channels::Count, 0, light);
        if (!extras.opticalDepth) continue;
        picture.opticalDepth.resize(picture.image.pixels.size());
        for (std::size_t k = 0; k < scene.layers.size(); ++k) {
            const auto perWeight =
                static_cast<float>(opticalDepthPerWeight(scene.layers[k].style.opacity));
            const std::vector<float> weight =
                dataPlane(*splats, eyes[i], Channels::Weight, k, light);
            for (std::size_t p = 0; p < weight.size(); ++p)
                picture.opticalDepth[p] += perWeight * weight[p];
        }
    }
}

std::vector<float> FrameRenderer::dataPlane(SplatFrame& splats, const View& view, Channels channels,
                                            std::size_t layer, LightPass& light) {
    Targets& targets = use(view.size, light);
    light.drawDepth({}, {}, view, targets);
    const auto sum = splats.begin(view, channels, layer, targets);
    while (!sum->done()) sum->add(kAllSplats);
    return targets.readScalarPlane(layer);
}

}  // namespace render

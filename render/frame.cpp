#include "render/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "render/gl/debug_output.h"
#include "render/gl/pass.h"
#include "render/shader_sources.h"
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
FrameRenderer::FrameRenderer(SplatterChoice splatter)
    : styles_(stylesFor({64, 64})),
      font_(styles_),
      sums_(splatter == SplatterChoice::Cpu ||
            (splatter == SplatterChoice::ByDevice && gl::drawsOnProcessor())) {}

void FrameRenderer::makeRoom(std::span<const View> eyes) {
    for (const View& eye : eyes)
        if (std::ranges::none_of(targets_, [&](const auto& t) { return t->size() == eye.size; }))
            targets_.push_back(std::make_unique<Targets>(eye.size));
    std::erase_if(targets_, [&](const auto& held) {
        return std::ranges::none_of(eyes, [&](const View& e) { return e.size == held->size(); });
    });
    // Letters of one size for all eyes, or they would not be seen as one.
    const auto styles = stylesFor(eyes.front().size);
    if (flat_ && styles == styles_) return;
    font_ = Font(styles);
    flat_ = std::make_unique<FlatPass>(font_);
    styles_ = styles;
}

Targets& FrameRenderer::use(glm::ivec2 size) {
    const auto found =
        std::ranges::find_if(targets_, [&](const auto& t) { return t->size() == size; });
    assert(found != targets_.end());
    current_ = static_cast<std::size_t>(found - targets_.begin());
    return **found;
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GpuStep& step,
                                               std::span<const View> eyes) {
    makeRoom(eyes);
    const glm::dvec3 midEye = midway(eyes);
    ++orders_;
    const Scene& scene = content.scene;
    // GL's own upload does it.
    if (!takesPointsFromGpu(scene)) gl_.setLayers(scene, ValueScale::of(scene.layers));
    return {content, splatterFor(scene).prepare(scene, order(scene, midEye), step), midEye};
}

Splatter& FrameRenderer::splatterFor(const Scene& scene) {
    if (takesPointsFromGpu(scene)) return gl_;
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
    drawLight(work);
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

// All that adds to the light comes last and together: a driver that draws tile by tile then touches
// each of its pixels once.
void FrameRenderer::drawLight(const EyeInWork& work) {
    const FrameContent& content = work.frame.content;
    const GLuint light = use(work.eye.size).lightFramebuffer();
    gl::begin({.framebuffer = light,
               .size = work.eye.size,
               .clearColor = glm::vec4(glm::vec3(content.background), 1)});
    flat_->draw(work.axes.behind, light, work.eye.size);
    for (const Placard& placard : content.placards) placards_.draw(placard, work.eye, light);
    resolve(content.scene, coveredPixels(content.scene, work.eye));
    // Lines before the volume have soft edges: blended over it, not under with a depth of their
    // own.
    const gl::DepthTest behindPlacards =
        content.placards.empty() ? gl::DepthTest::None : gl::DepthTest::Test;
    for (const FlatMesh* mesh : {&work.axes.before, &work.axes.grounds, &work.axes.labels})
        flat_->draw(*mesh, light, work.eye.size, behindPlacards);
    flat_->draw(legendGround(work.legend, work.eye.size, content.background), light, work.eye.size);
    flat_->draw(work.legend, light, work.eye.size);
}

std::vector<EyePicture> FrameRenderer::render(const FrameContent& content, GpuStep& step,
                                              std::span<const View> eyes, const Extras& extras) {
    if (takesPointsFromGpu(content.scene)) step.upload(content.scene, neededScale(content.scene));
    // A sorted list brings its own points; made before prepare(), whose layers then hold.
    Scene sorted = content.scene;
    sorted.order = Order::BackToFront;
    std::unique_ptr<GpuList> counted;
    if (extras.splatCount) counted = gl_.upload(sorted, order(sorted, midway(eyes)), step);
    const Prepared frame = prepare(content, step, eyes);
    std::vector<EyePicture> pictures;
    for (const View& eye : eyes) {
        drawWhole(frame, eye, extras.progress);
        EyePicture& picture = pictures.emplace_back();
        picture.image = targets().readLight();
        if (extras.splatCount) {
            drawNoOccluders(eye);
            gl_.draw(*counted, eye, Channels::Count, 0,
                     use(eye.size).clearedPlane(0, Channels::Count));
            picture.splatCount = targets().readScalarPlane(0);
        }
    }
    if (extras.opticalDepth) {
        // An ordered list interleaves the layers; their weights are added from the runs.
        Scene unordered = content.scene;
        unordered.order = Order::None;
        if (takesPointsFromGpu(unordered)) step.upload(unordered, neededScale(unordered));
        const auto splats = splatterFor(unordered).prepare(unordered, Runs{}, step);
        for (std::size_t i = 0; i < eyes.size(); ++i)
            pictures[i].opticalDepth = opticalDepth(unordered, *splats, eyes[i]);
    }
    gl::throwOnError();
    return pictures;
}

void FrameRenderer::drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                                 const View& eye) {
    const GLuint light = use(eye.size).lightFramebuffer();
    gl::begin({.framebuffer = light,
               .size = eye.size,
               .clearColor = glm::vec4(glm::vec3(background), 1),
               .clearDepth = 1.0f});
    hidden_.drawDepth(eye, light);
    for (const Placard& placard : placards) placards_.draw(placard, eye, light);
}

void FrameRenderer::drawDepth(const Occluders& occluders, const View& view, GLuint framebuffer) {
    flat_->drawDepth(occluders.behind, framebuffer, view.size);
    for (const Placard& placard : occluders.placards)
        placards_.drawDepth(placard, view, framebuffer);
    hidden_.drawDepth(view, framebuffer);
}

void FrameRenderer::drawNoOccluders(const View& view) {
    drawDepth({{}, {}}, view, use(view.size).lightFramebuffer());
}

bool FrameRenderer::drawSplats(EyeInWork& work, double cost) {
    const FrameContent& content = work.frame.content;
    const std::vector<Channels> channels = channelsFor(content.scene);
    Targets& targets = use(work.eye.size);
    if (work.plane == 0 && !work.sum)
        drawDepth({work.axes.behind, content.placards}, work.eye, targets.lightFramebuffer());
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

const gl::Program& FrameRenderer::resolveProgram(const Scene& scene) {
    const bool over = scene.order == Order::BackToFront;
    const int variant = over ? -1 : static_cast<int>(scene.layers.size());
    if (const auto found = resolve_.find(variant); found != resolve_.end()) return found->second;
    const std::string define =
        over ? "#define OVER\n" : fmt::format("#define LAYERS {}\n", variant);
    return resolve_
        .emplace(variant, gl::Program("resolve", shaders::viewport_vert, shaders::resolve_frag,
                                      define.c_str()))
        .first->second;
}

void FrameRenderer::resolve(const Scene& scene, const PixelBox& covered) {
    if (covered.size.x == 0 || covered.size.y == 0) return;
    gl::begin({.framebuffer = targets().lightFramebuffer(),
               .size = covered.size,
               .at = covered.at,
               .blend = gl::Blend::Premultiplied});
    glUseProgram(resolveProgram(scene).id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, gl_.layerBlock().id());
    for (std::size_t i = 0; i < channelsFor(scene).size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(i), targets().plane(i).id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> FrameRenderer::opticalDepth(const Scene& scene, SplatFrame& splats,
                                               const View& view) {
    Targets& targets = use(view.size);
    drawNoOccluders(view);
    std::vector<float> total(std::size_t(view.size.x) * std::size_t(view.size.y));
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        targets.clearedPlane(k, Channels::Weight);
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

#include "render/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "render/gl/debug_output.h"
#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {
namespace {

constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

std::array<FontStyle, 2> stylesFor(glm::ivec2 size) { return {labelStyle(size), titleStyle(size)}; }

glm::dvec3 midway(std::span<const View> eyes) {
    glm::dvec3 sum(0);
    for (const View& eye : eyes) sum += pixelRays(eye).eye;
    return sum / static_cast<double>(eyes.size());
}

}  // namespace

FrameRenderer::FrameRenderer() : styles_(stylesFor({64, 64})), font_(styles_) {}

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
    const DrawList list = order(content.scene, midEye);
    return {content, splatter_.upload(content.scene, list, step), midEye};
}

void FrameRenderer::drawEye(const Prepared& frame, const View& eye) {
    EyeInWork work = begin(frame, eye);
    goOn(work, kAll);
}

FrameRenderer::EyeInWork FrameRenderer::begin(const Prepared& frame, const View& eye) {
    ++eyes_;
    FlatMesh legend = legendMesh(frame.content.legend, font_, eye.size);
    AxesMeshes axes = axesMeshes(frame.content.grid, frame.content.scene.lattice, eye, frame.midEye,
                                 font_, legend);
    return {frame, eye, std::move(legend), std::move(axes)};
}

bool FrameRenderer::goOn(EyeInWork& work, std::uint64_t splats) {
    if (!drawSplats(work, splats)) return false;
    drawLight(work);
    return true;
}

std::uint64_t FrameRenderer::cost(const Prepared& frame) const {
    const std::vector<Channels> channels = channelsFor(frame.content.scene);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (byRows(channels[i]))
            sum += splatCount(frame.content.scene.layers[i], frame.content.scene.stride);
        else
            for (const Piece& piece : frame.list->pieces(channels[i], i)) sum += piece.cost;
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
    flat_->draw(work.axes.labels, light, work.eye.size);
    for (const Placard& placard : content.placards) placards_.draw(placard, work.eye, light);
    resolve(content.scene, coveredPixels(content.scene, work.eye));
    // Lines before the volume have soft edges: blended over it, not under with a depth of their
    // own.
    flat_->draw(work.axes.before, light, work.eye.size,
                content.placards.empty() ? gl::DepthTest::None : gl::DepthTest::Test);
    flat_->draw(work.legend, light, work.eye.size);
}

std::vector<EyePicture> FrameRenderer::render(const FrameContent& content, GpuStep& step,
                                              std::span<const View> eyes, const Extras& extras) {
    step.upload(content.scene, neededScale(content.scene));
    const Prepared frame = prepare(content, step, eyes);
    std::vector<EyePicture> pictures;
    for (const View& eye : eyes) {
        drawEye(frame, eye);
        EyePicture& picture = pictures.emplace_back();
        picture.image = targets().readLight();
        if (extras.splatCount) {
            splatter_.draw(*frame.list, eye, Channels::Count, 0,
                           use(eye.size).clearedPlane(0, Channels::Count));
            picture.splatCount = targets().readScalarPlane(0);
        }
    }
    if (extras.opticalDepth) {
        // An ordered list interleaves the layers; their weights are added from the runs.
        Scene unordered = content.scene;
        unordered.order = Order::None;
        step.upload(unordered, neededScale(unordered));
        const auto runs = splatter_.upload(unordered, Runs{}, step);
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            const AxesMeshes axes =
                axesMeshes(content.grid, content.scene.lattice, eyes[i], frame.midEye, font_);
            pictures[i].opticalDepth = opticalDepth(*runs, eyes[i], axes.behind);
        }
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

bool FrameRenderer::drawSplats(EyeInWork& work, std::uint64_t splats) {
    const FrameContent& content = work.frame.content;
    const Occluders occluders{work.axes.behind, content.placards};
    const std::vector<Channels> channels = channelsFor(content.scene);
    Targets& targets = use(work.eye.size);
    const std::uint64_t until = work.cost + std::clamp<std::uint64_t>(splats, 1, kAll - work.cost);
    for (; work.plane < channels.size(); ++work.plane, work.piece = 0) {
        if (work.cost >= until) return false;
        const Channels channel = channels[work.plane];
        if (work.piece == 0 && !work.rows) {
            const GLuint plane = targets.clearedPlane(work.plane, channel);
            if (work.plane == 0) drawDepth(occluders, work.eye, plane);
        }
        if (!(byRows(channel) ? drawRows(work, channel, until) : drawPieces(work, channel, until)))
            return false;
    }
    // The placards are drawn against it even if there are no splats.
    if (channels.empty()) drawDepth(occluders, work.eye, targets.lightFramebuffer());
    return true;
}

bool FrameRenderer::drawPieces(EyeInWork& work, Channels channels, std::uint64_t until) {
    const auto left = work.frame.list->pieces(channels, work.plane).subspan(work.piece);
    std::size_t now = 0;
    while (now < left.size() && work.cost < until) work.cost += left[now++].cost;
    splatter_.draw(*work.frame.list, work.eye, channels, left.first(now),
                   targets().planeFramebuffer(work.plane));
    work.piece += now;
    return now == left.size();
}

// A driver that draws on the processor takes several times longer for point sprites than the
// program does for their pixels (tests/bench/RESULTS.md).
bool FrameRenderer::byRows(Channels channels) const {
    return onProcessor_ && (channels == Channels::Weight || channels == Channels::WeightedColor);
}

bool FrameRenderer::drawRows(EyeInWork& work, Channels channels, std::uint64_t until) {
    Targets& targets = use(work.eye.size);
    if (work.opaqueDepth.empty()) work.opaqueDepth = targets.readDepth();
    if (!work.rows)
        work.rows.emplace(work.frame.content.scene, work.eye, channels, work.plane,
                          work.opaqueDepth);
    work.cost += work.rows->add(until - work.cost);
    if (!work.rows->done()) return false;
    targets.writePlane(work.plane, work.rows->plane());
    work.rows.reset();
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
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, splatter_.layerBlock().id());
    for (std::size_t i = 0; i < channelsFor(scene).size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(i), targets().plane(i).id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> FrameRenderer::opticalDepth(const GpuList& list, const View& view,
                                               const FlatMesh& behind) {
    Targets& targets = use(view.size);
    std::vector<float> total(std::size_t(view.size.x) * std::size_t(view.size.y)), depth;
    const auto& layers = list.scene().layers;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const GLuint plane = targets.clearedPlane(0, Channels::Weight);
        if (k == 0) drawDepth({behind, {}}, view, plane);
        if (byRows(Channels::Weight)) {
            if (k == 0) depth = targets.readDepth();
            targets.writePlane(0, sumRows(list.scene(), view, Channels::Weight, k, depth));
        } else {
            splatter_.draw(list, view, Channels::Weight, k, plane);
        }
        const std::vector<float> weight = targets.readScalarPlane(0);
        const auto perWeight = static_cast<float>(opticalDepthPerWeight(layers[k].style.opacity));
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += perWeight * weight[i];
    }
    return total;
}

}  // namespace render

#include "render/frame.h"

#include <fmt/format.h>

#include "render/gl/debug_output.h"
#include "render/gl/pass.h"
#include "render/row_splatter.h"
#include "render/shader_sources.h"

namespace render {
namespace {

std::array<FontStyle, 2> stylesFor(glm::ivec2 size) { return {labelStyle(size), titleStyle(size)}; }

glm::dvec3 midway(std::span<const View> eyes) {
    glm::dvec3 sum(0);
    for (const View& eye : eyes) sum += pixelRays(eye).eye;
    return sum / static_cast<double>(eyes.size());
}

}  // namespace

FrameRenderer::FrameRenderer() : styles_(stylesFor({64, 64})), font_(styles_) {}

void FrameRenderer::ready(glm::ivec2 size) {
    if (!targets_ || targets_->size() != size) targets_ = std::make_unique<Targets>(size);
    const auto styles = stylesFor(size);
    if (flat_ && styles == styles_) return;
    font_ = Font(styles);
    flat_ = std::make_unique<FlatPass>(font_);
    styles_ = styles;
}

FrameRenderer::Prepared FrameRenderer::prepare(const FrameContent& content, const GpuStep& step,
                                               std::span<const View> eyes) {
    ready(eyes.front().size);
    const glm::dvec3 midEye = midway(eyes);
    ++orders_;
    const DrawList list = order(content.scene, midEye);
    return {content, splatter_.upload(content.scene, list, step), midEye};
}

void FrameRenderer::drawEye(const Prepared& frame, const View& eye) {
    ++eyes_;
    const FlatMesh legend = legendMesh(frame.content.legend, font_, eye.size);
    const AxesMeshes axes = axesMeshes(frame.content.grid, frame.content.scene.lattice, eye,
                                       frame.midEye, font_, legend);
    // All that adds to the light comes last and together: a driver that draws tile by tile then
    // touches each of its pixels once.
    drawSplats(*frame.list, eye, {axes.behind, frame.content.placards});
    const GLuint light = targets_->lightFramebuffer();
    gl::begin({.framebuffer = light,
               .size = eye.size,
               .clearColor = glm::vec4(glm::vec3(frame.content.background), 1)});
    flat_->draw(axes.behind, light, eye.size);
    flat_->draw(axes.labels, light, eye.size);
    for (const Placard& placard : frame.content.placards) placards_.draw(placard, eye, light);
    resolve(frame.content.scene, coveredPixels(frame.content.scene, eye));
    // Lines before the volume have soft edges: blended over it, not under with a depth of their
    // own.
    flat_->draw(axes.before, light, eye.size,
                frame.content.placards.empty() ? gl::DepthTest::None : gl::DepthTest::Test);
    flat_->draw(legend, light, eye.size);
}

std::vector<EyePicture> FrameRenderer::render(const FrameContent& content, GpuStep& step,
                                              std::span<const View> eyes, const Extras& extras) {
    step.upload(content.scene, neededScale(content.scene));
    const Prepared frame = prepare(content, step, eyes);
    std::vector<EyePicture> pictures;
    for (const View& eye : eyes) {
        drawEye(frame, eye);
        EyePicture& picture = pictures.emplace_back();
        picture.image = targets_->readLight();
        if (extras.splatCount) {
            splatter_.draw(*frame.list, eye, Channels::Count, 0,
                           targets_->clearedPlane(0, Channels::Count));
            picture.splatCount = targets_->readScalarPlane(0);
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
    ready(eye.size);
    gl::begin({.framebuffer = targets_->lightFramebuffer(),
               .size = eye.size,
               .clearColor = glm::vec4(glm::vec3(background), 1),
               .clearDepth = 1.0f});
    for (const Placard& placard : placards)
        placards_.draw(placard, eye, targets_->lightFramebuffer());
}

void FrameRenderer::drawDepth(const Occluders& occluders, const View& view, GLuint framebuffer) {
    opaqueDepth_.clear();
    flat_->drawDepth(occluders.behind, framebuffer, view.size);
    for (const Placard& placard : occluders.placards)
        placards_.drawDepth(placard, view, framebuffer);
}

void FrameRenderer::drawSplats(const GpuList& list, const View& view, const Occluders& occluders) {
    const std::vector<Channels> channels = channelsFor(list.scene());
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const GLuint plane = targets_->clearedPlane(i, channels[i]);
        if (i == 0) drawDepth(occluders, view, plane);
        drawPlane(list, view, channels[i], i, i);
    }
    // The placards are drawn against it even if there are no splats.
    if (channels.empty()) drawDepth(occluders, view, targets_->lightFramebuffer());
}

void FrameRenderer::drawPlane(const GpuList& list, const View& view, Channels channels,
                              std::size_t layer, std::size_t i) {
    const bool summed = channels == Channels::Weight || channels == Channels::WeightedColor;
    if (!onProcessor_ || !summed)
        return splatter_.draw(list, view, channels, layer, targets_->planeFramebuffer(i));
    if (opaqueDepth_.empty()) opaqueDepth_ = targets_->readDepth();
    targets_->writePlane(i, sumRows(list.scene(), view, channels, layer, opaqueDepth_));
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
    gl::begin({.framebuffer = targets_->lightFramebuffer(),
               .size = covered.size,
               .at = covered.at,
               .blend = gl::Blend::Premultiplied});
    glUseProgram(resolveProgram(scene).id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, splatter_.layerBlock().id());
    for (std::size_t i = 0; i < channelsFor(scene).size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(i), targets_->plane(i).id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> FrameRenderer::opticalDepth(const GpuList& list, const View& view,
                                               const FlatMesh& behind) {
    std::vector<float> total(std::size_t(view.size.x) * std::size_t(view.size.y));
    const auto& layers = list.scene().layers;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const GLuint plane = targets_->clearedPlane(0, Channels::Weight);
        if (k == 0) drawDepth({behind, {}}, view, plane);
        drawPlane(list, view, Channels::Weight, k, 0);
        const std::vector<float> weight = targets_->readScalarPlane(0);
        const auto perWeight = static_cast<float>(opticalDepthPerWeight(layers[k].style.opacity));
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += perWeight * weight[i];
    }
    return total;
}

}  // namespace render

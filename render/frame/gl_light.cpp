#include "render/frame/gl_light.h"

#include <fmt/format.h>

#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {

std::unique_ptr<Targets> GlLight::targets(glm::ivec2 size) const {
    return std::make_unique<GlTargets>(size);
}

// The depth attachment is shared by all planes and the light.
void GlLight::drawDepth(const FlatMesh& behind, std::span<const Placard> placards, const View& view,
                        Targets& targets) {
    const GLuint framebuffer = targets.onGl().lightFramebuffer();
    flat_->drawDepth(behind, framebuffer, view.size);
    for (const Placard& placard : placards) placards_.drawDepth(placard, view, framebuffer);
    hidden_.drawDepth(view, framebuffer);
}

// All that adds to the light comes last and together: a driver that draws tile by tile then touches
// each of its pixels once.
void GlLight::drawLight(const EyeContent& content, LightAs, Targets& targets) {
    const GLuint light = targets.onGl().lightFramebuffer();
    const glm::ivec2 size = content.view.size;
    gl::begin({.framebuffer = light,
               .size = size,
               .clearColor = glm::vec4(glm::vec3(content.background), 1)});
    for (const FlatMesh* mesh : {&content.axes.mapBehind, &content.axes.behind})
        flat_->draw(*mesh, light, size);
    for (const Placard& placard : content.placards) placards_.draw(placard, content.view, light);
    resolve(content.scene, content.view, targets.onGl());
    // Lines before the volume have soft edges: blended over it, not under with a depth of their
    // own.
    const gl::DepthTest behindPlacards =
        content.placards.empty() ? gl::DepthTest::None : gl::DepthTest::Test;
    const AxesMeshes& axes = content.axes;
    for (const FlatMesh* mesh : {&axes.mapBefore, &axes.before, &axes.grounds, &axes.labels})
        flat_->draw(*mesh, light, size, behindPlacards);
    flat_->draw(legendGround(content.legend, size, content.background), light, size);
    flat_->draw(content.legend, light, size);
}

void GlLight::enlarge(const Scene& scene, const View& view, int across, Targets& from,
                      Targets& to) {
    if (!enlarge_) enlarge_.emplace("enlarge", shaders::viewport_vert, shaders::enlarge_frag);
    const PixelBox known = coveredPixels(scene, coarser(view, across));
    const PixelBox covered = coveredPixels(scene, view);
    const std::vector<Channels> channels = channelsFor(scene);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const GLuint plane = to.onGl().plane(i, channels[i]);
        gl::begin({.framebuffer = plane, .size = covered.size, .at = covered.at});
        glUseProgram(enlarge_->id());
        glUniform4i(0, known.at.x, known.at.y, known.size.x, known.size.y);
        glUniform1i(1, across);
        glBindTextureUnit(0, from.onGl().plane(i).id());
        glBindVertexArray(noVertices_.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

void GlLight::drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                           const View& view, Targets& targets) {
    const GLuint light = targets.onGl().lightFramebuffer();
    gl::begin({.framebuffer = light,
               .size = view.size,
               .clearColor = glm::vec4(glm::vec3(background), 1),
               .clearDepth = 1.0f});
    hidden_.drawDepth(view, light);
    for (const Placard& placard : placards) placards_.draw(placard, view, light);
}

const gl::Program& GlLight::resolveProgram(const Scene& scene) {
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

void GlLight::resolve(const Scene& scene, const View& view, const GlTargets& targets) {
    const PixelBox covered = coveredPixels(scene, view);
    if (covered.size.x == 0 || covered.size.y == 0) return;
    gl::begin({.framebuffer = targets.lightFramebuffer(),
               .size = covered.size,
               .at = covered.at,
               .blend = gl::Blend::Premultiplied});
    glUseProgram(resolveProgram(scene).id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, layers_.id());
    for (std::size_t i = 0; i < channelsFor(scene).size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(i), targets.plane(i).id());
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render

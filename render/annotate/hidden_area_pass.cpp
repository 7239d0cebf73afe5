#include "render/annotate/hidden_area_pass.h"

#include <algorithm>

#include "render/gl/pass.h"
#include "render/shader_sources.h"

namespace render {
namespace {

constexpr std::size_t kMostKept = 4;

std::vector<glm::vec2> trianglesOf(const View& view) {
    std::vector<glm::vec2> corners;
    const auto clip = [&](glm::ivec2 pixel) {
        return glm::vec2(2.0 * glm::dvec2(pixel) / glm::dvec2(view.size) - 1.0);
    };
    for (const auto& [at, size] : hiddenPixels(*view.hidden, view)) {
        const glm::vec2 lo = clip(at), hi = clip(at + size);
        for (const glm::vec2& corner : {lo, {hi.x, lo.y}, hi, lo, hi, {lo.x, hi.y}})
            corners.push_back(corner);
    }
    return corners;
}

}  // namespace

HiddenAreaPass::HiddenAreaPass()
    : program_("hidden area", shaders::hidden_area_vert, shaders::hidden_area_frag) {}

const HiddenAreaPass::Pixels& HiddenAreaPass::pixelsOf(const View& view) {
    const auto found = std::ranges::find_if(kept_, [&](const Pixels& p) {
        return p.area == view.hidden && p.clipFromView == view.clipFromView && p.size == view.size;
    });
    if (found != kept_.end()) return *found;
    if (kept_.size() == kMostKept) kept_.erase(kept_.begin());
    const std::vector<glm::vec2> corners = trianglesOf(view);
    return kept_.emplace_back(Pixels{view.hidden, view.clipFromView, view.size,
                                     static_cast<GLsizei>(corners.size()),
                                     gl::Buffer{std::span<const glm::vec2>(corners)}});
}

void HiddenAreaPass::drawDepth(const View& view, GLuint framebuffer) {
    if (!view.hidden) return;
    const Pixels& pixels = pixelsOf(view);
    if (pixels.corners == 0) return;
    gl::begin({.framebuffer = framebuffer,
               .size = view.size,
               .depth = gl::DepthTest::TestAndWrite,
               .colorWrite = false});
    gl::VertexArray array;
    array.attach({0, pixels.triangles, 2, GL_FLOAT, sizeof(glm::vec2)});
    glUseProgram(program_.id());
    glBindVertexArray(array.id());
    glDrawArrays(GL_TRIANGLES, 0, pixels.corners);
}

}  // namespace render

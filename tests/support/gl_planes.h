// A context, and single planes drawn by the GL splatter.
#pragma once

#include <gtest/gtest.h>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/gl_targets.h"
#include "tests/support/scenes.h"

namespace tests {

inline const glm::dvec3 kMidEye(0, -3, 0);  // what ordered lists are made for

class GlTest : public testing::Test {
 public:
    // One plane, rows from the bottom; the first layer's for Weight and WeightedColor. The opaque
    // scene is a wall at `opaqueDepth`.
    std::vector<float> plane(const render::Scene& scene, const render::View& view,
                             render::Channels channels, float opaqueDepth = 1) {
        render::GlStep step(scene.step, scene.placed);
        step.upload(scene, render::neededScale(scene));
        return plane(scene, step, view, channels, opaqueDepth);
    }
    // By a step that is ready for the scene.
    std::vector<float> plane(const render::Scene& scene, const render::GlStep& step,
                             const render::View& view, render::Channels channels,
                             float opaqueDepth = 1) {
        using render::Channels;
        render::GlTargets targets(view.size);
        render::gl::begin({.framebuffer = targets.lightFramebuffer(),
                           .size = view.size,
                           .clearColor = glm::vec4(0),
                           .clearDepth = opaqueDepth});
        render::GlSplatter splatter;
        const auto list = splatter.upload(scene, splatter.order(scene, kMidEye), step);
        splatter.draw(*list, view, channels, 0, targets.clearedPlane(0, channels));
        const bool scalar = channels == Channels::Weight || channels == Channels::Count;
        std::vector<float> pixels(std::size_t(view.size.x) * view.size.y * (scalar ? 1 : 4));
        glGetTextureSubImage(targets.plane(0).id(), 0, 0, 0, 0, view.size.x, view.size.y, 1,
                             scalar ? GL_RED : GL_RGBA, GL_FLOAT,
                             static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
        render::gl::throwOnError();
        return pixels;
    }

 private:
    render::gl::HeadlessContext context_;
};

}  // namespace tests

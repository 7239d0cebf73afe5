// Flat shapes in picture pixels: lines of the opaque scene, labels, legends. Pure geometry;
// FlatPass draws it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "render/font.h"

namespace render {

// GLSL mirror: shaders/flat.vert.
struct FlatVertex {
    glm::vec3 at;     // picture pixels, (0, 0) the TOP left corner, y down; z: window depth [0, 1]
    glm::vec4 color;  // linear, premultiplied
    glm::vec2 texel;  // of the font atlas; negative where there is no glyph
    glm::vec2 edge;   // distance from a line's middle and half its width, in pixels
};

class FlatMesh {
 public:
    // Smooth-edged. `a` and `b`: pixels and window depth, linear between (as a projected straight
    // line is). Colour is linear, premultiplied; width in pixels.
    void line(glm::vec3 a, glm::vec3 b, float width, glm::vec4 color);
    void rect(glm::vec2 topLeft, glm::vec2 bottomRight, glm::vec4 color);
    // Colours change linearly from left to right between `stops`, evenly spaced.
    void gradient(glm::vec2 topLeft, glm::vec2 bottomRight, std::span<const glm::vec3> stops);
    // Colour linear, straight; glyphs on whole pixels.
    void text(const Font& font, FontStyle style, std::string_view text, glm::vec2 topLeft,
              glm::vec3 color);

    const std::vector<FlatVertex>& triangles() const { return vertices_; }  // 3 a triangle

 private:
    void quad(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c, const FlatVertex& d);
    std::vector<FlatVertex> vertices_;
};

}  // namespace render

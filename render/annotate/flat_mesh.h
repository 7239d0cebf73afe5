// Flat shapes in picture pixels: lines of the opaque scene, labels, legends. Pure geometry;
// FlatPass draws it.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "render/annotate/font.h"

namespace render {

// GLSL mirror: shaders/flat.vert.
struct FlatVertex {
    glm::vec3 at;     // picture pixels, (0, 0) the TOP left corner, y down; z: window depth [0, 1]
    glm::vec4 color;  // linear, premultiplied
    glm::vec2 texel;  // of the font atlas; negative where there is no glyph
    glm::vec2 edge;   // distance from a line's or disc's middle, half its width; in pixels
};

// Picture pixels, y down.
struct PixelRect {
    glm::dvec2 lo, hi;

    PixelRect grown(double by) const { return {lo - by, hi + by}; }
    PixelRect moved(const glm::dvec2& by) const { return {lo + by, hi + by}; }
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};
PixelRect around(const PixelRect& a, const PixelRect& b);
bool overlap(const PixelRect& a, const PixelRect& b);
// What a text's glyphs cover; at `topLeft` alone where it has none.
PixelRect inkOf(const Font& font, FontStyle style, std::string_view text,
                const glm::vec2& topLeft = glm::vec2(0));

// What lies under text, over the volume: of the picture's background (linear), so much that text
// can be read before the brightest volume.
glm::vec4 groundColor(const glm::dvec3& background);

class FlatMesh {
 public:
    // Smooth-edged. `a` and `b`: pixels and window depth, linear between (as a projected straight
    // line is). Colour is linear, premultiplied; width in pixels.
    void line(glm::vec3 a, glm::vec3 b, float width, glm::vec4 color);
    // Places as of lines; colours, linear and premultiplied, change linearly between the corners.
    void triangle(const std::array<glm::vec3, 3>& at, const std::array<glm::vec4, 3>& color);
    // Smooth-edged, round to a thirtieth of a pixel. Colour is linear, premultiplied; in pixels.
    // REQUIRES: a radius > 0.
    void disc(glm::vec2 middle, float radius, glm::vec4 color);
    void rect(glm::vec2 topLeft, glm::vec2 bottomRight, glm::vec4 color);
    // Colours change linearly from left to right between `stops`, evenly spaced.
    void gradient(glm::vec2 topLeft, glm::vec2 bottomRight, std::span<const glm::vec3> stops);
    // Colour linear, straight; glyphs on whole pixels.
    void text(const Font& font, FontStyle style, std::string_view text, glm::vec2 topLeft,
              glm::vec3 color, float depth = 0);
    // A ground for text: `color` inside `rect`, less and less of it up to `soft` pixels beyond.
    void plate(const PixelRect& rect, float soft, glm::vec4 color, float depth = 0);

    // In coarser(view, across) of a view as high as that (render/points/view.h).
    FlatMesh coarser(int across, int height) const;

    const std::vector<FlatVertex>& triangles() const { return vertices_; }  // 3 a triangle
    // What texts, rectangles and gradients cover, one of each, in the order in which they came.
    const std::vector<PixelRect>& covers() const { return covers_; }

 private:
    void quad(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c, const FlatVertex& d);
    std::vector<FlatVertex> vertices_;
    std::vector<PixelRect> covers_;
};

}  // namespace render

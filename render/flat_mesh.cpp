#include "render/flat_mesh.h"

#include <glm/geometric.hpp>

namespace render {
namespace {

constexpr glm::vec2 kNoGlyph{-1}, kSolid{0, 1e6};

}  // namespace

void FlatMesh::quad(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c,
                    const FlatVertex& d) {
    vertices_.insert(vertices_.end(), {a, b, c, a, c, d});
}

void FlatMesh::line(glm::vec3 a, glm::vec3 b, float width, glm::vec4 color) {
    const glm::vec2 along = glm::vec2(b) - glm::vec2(a);
    const float length = glm::length(along);
    if (length == 0) return;
    const float half = width / 2, reach = half + 1;  // one pixel for the soft edge
    const glm::vec3 side(glm::vec2(-along.y, along.x) / length * reach, 0);
    quad({a + side, color, kNoGlyph, {reach, half}}, {b + side, color, kNoGlyph, {reach, half}},
         {b - side, color, kNoGlyph, {-reach, half}}, {a - side, color, kNoGlyph, {-reach, half}});
}

void FlatMesh::rect(glm::vec2 topLeft, glm::vec2 bottomRight, glm::vec4 color) {
    const auto corner = [&](float x, float y) {
        return FlatVertex{{x, y, 0}, color, kNoGlyph, kSolid};
    };
    quad(corner(topLeft.x, topLeft.y), corner(bottomRight.x, topLeft.y),
         corner(bottomRight.x, bottomRight.y), corner(topLeft.x, bottomRight.y));
}

void FlatMesh::gradient(glm::vec2 topLeft, glm::vec2 bottomRight,
                        std::span<const glm::vec3> stops) {
    const float step = (bottomRight.x - topLeft.x) / static_cast<float>(stops.size() - 1);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const float x0 = topLeft.x + step * static_cast<float>(i), x1 = x0 + step;
        const glm::vec4 left(stops[i], 1), right(stops[i + 1], 1);
        quad({{x0, topLeft.y, 0}, left, kNoGlyph, kSolid},
             {{x1, topLeft.y, 0}, right, kNoGlyph, kSolid},
             {{x1, bottomRight.y, 0}, right, kNoGlyph, kSolid},
             {{x0, bottomRight.y, 0}, left, kNoGlyph, kSolid});
    }
}

void FlatMesh::text(const Font& font, FontStyle style, std::string_view text, glm::vec2 topLeft,
                    glm::vec3 color) {
    for (const GlyphQuad& glyph : font.layout(text, style, topLeft)) {
        const auto corner = [&](int right, int down) {
            const glm::ivec2 by = glyph.size * glm::ivec2(right, down);
            return FlatVertex{{glm::vec2(glyph.topLeft + by), 0},
                              glm::vec4(color, 1),
                              glm::vec2(glyph.texel + by),
                              kSolid};
        };
        quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
    }
}

}  // namespace render

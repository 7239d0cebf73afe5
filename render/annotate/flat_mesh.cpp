#include "render/annotate/flat_mesh.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace render {
namespace {

constexpr glm::vec2 kNoGlyph{-1}, kSolid{0, 1e6};

}  // namespace

PixelRect around(const PixelRect& a, const PixelRect& b) {
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
}

PixelRect inkOf(const Font& font, FontStyle style, std::string_view text,
                const glm::vec2& topLeft) {
    const auto glyphs = font.layout(text, style, topLeft);
    if (glyphs.empty()) return {topLeft, topLeft};
    const auto covers = [](const GlyphQuad& glyph) {
        return PixelRect{glyph.topLeft, glyph.topLeft + glyph.size};
    };
    PixelRect ink = covers(glyphs.front());
    for (const GlyphQuad& glyph : glyphs) ink = around(ink, covers(glyph));
    return ink;
}

glm::vec4 groundColor(const glm::dvec3& background) {
    constexpr double kShare = 0.9;
    return {glm::vec3(kShare * background), static_cast<float>(kShare)};
}

void FlatMesh::quad(const FlatVertex& a, const FlatVertex& b, const FlatVertex& c,
                    const FlatVertex& d) {
    vertices_.insert(vertices_.end(), {a, b, c, a, c, d});
}

FlatMesh FlatMesh::coarser(int across, int height) const {
    const double exact = 1.0 / across;
    const auto scale = static_cast<float>(exact);
    // Its last row reaches beyond the upper edge.
    const int beyondRows = (across - height % across) % across;
    const auto beyond = static_cast<float>(beyondRows);
    const glm::dvec2 moved(0, beyondRows);
    FlatMesh mesh = *this;
    for (FlatVertex& vertex : mesh.vertices_) {
        vertex.at.x *= scale;
        vertex.at.y = (vertex.at.y + beyond) * scale;
        vertex.edge *= scale;
    }
    for (PixelRect& cover : mesh.covers_)
        cover = PixelRect{exact * (cover.lo + moved), exact * (cover.hi + moved)};
    return mesh;
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

void FlatMesh::triangle(const std::array<glm::vec3, 3>& at, const std::array<glm::vec4, 3>& color) {
    for (std::size_t i = 0; i < 3; ++i) vertices_.push_back({at[i], color[i], kNoGlyph, kSolid});
}

void FlatMesh::disc(glm::vec2 middle, float radius, glm::vec4 color) {
    const float reach = radius + 1;  // one pixel for the soft edge
    // Between two of n corners the distance is told too large by reach (1 - cos(pi / n)), about
    // reach pi^2 / (2 n^2) and at most 1 / 32 of a pixel with n = 4 pi sqrt(reach).
    const int quads = static_cast<int>(std::ceil(2 * std::numbers::pi_v<float> * std::sqrt(reach)));
    const auto corner = [&](int i) {
        const float angle = std::numbers::pi_v<float> * static_cast<float>(i % (2 * quads)) /
                            static_cast<float>(quads);
        const glm::vec2 at = middle + reach * glm::vec2(std::cos(angle), std::sin(angle));
        return FlatVertex{{at, 0}, color, kNoGlyph, {reach, radius}};
    };
    const FlatVertex inmost{{middle, 0}, color, kNoGlyph, {0, radius}};
    for (int i = 0; i < 2 * quads; i += 2) quad(inmost, corner(i), corner(i + 1), corner(i + 2));
}

void FlatMesh::rect(glm::vec2 topLeft, glm::vec2 bottomRight, glm::vec4 color) {
    const auto corner = [&](float x, float y) {
        return FlatVertex{{x, y, 0}, color, kNoGlyph, kSolid};
    };
    quad(corner(topLeft.x, topLeft.y), corner(bottomRight.x, topLeft.y),
         corner(bottomRight.x, bottomRight.y), corner(topLeft.x, bottomRight.y));
    covers_.push_back({topLeft, bottomRight});
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
    covers_.push_back({topLeft, bottomRight});
}

void FlatMesh::plate(const PixelRect& rect, float soft, glm::vec4 color, float depth) {
    const auto corner = [&](int column, int row) {
        const auto place = [&](int i, double lo, double hi) {
            return static_cast<float>(i < 2 ? lo : hi) + (i == 0 ? -soft : i == 3 ? soft : 0.0f);
        };
        const bool solid = column % 3 != 0 && row % 3 != 0;
        return FlatVertex{
            {place(column, rect.lo.x, rect.hi.x), place(row, rect.lo.y, rect.hi.y), depth},
            solid ? color : glm::vec4(0),
            kNoGlyph,
            kSolid};
    };
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            // The diagonal of a corner ends at its solid one: both its triangles fall off evenly.
            const std::array around = {corner(column, row), corner(column + 1, row),
                                       corner(column + 1, row + 1), corner(column, row + 1)};
            const std::size_t first = column + row == 2 && column != row ? 1 : 0;
            quad(around[first], around[first + 1], around[first + 2], around[(first + 3) % 4]);
        }
    }
}

void FlatMesh::text(const Font& font, FontStyle style, std::string_view text, glm::vec2 topLeft,
                    glm::vec3 color, float depth) {
    std::optional<PixelRect> ink;
    for (const GlyphQuad& glyph : font.layout(text, style, topLeft)) {
        const PixelRect here{glyph.topLeft, glyph.topLeft + glyph.size};
        ink = ink ? around(*ink, here) : here;
        const auto corner = [&](int right, int down) {
            const glm::ivec2 by = glyph.size * glm::ivec2(right, down);
            return FlatVertex{{glm::vec2(glyph.topLeft + by), depth},
                              glm::vec4(color, 1),
                              glm::vec2(glyph.texel + by),
                              kSolid};
        };
        quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
    }
    if (ink) covers_.push_back(*ink);
}

}  // namespace render

// Finds texts and rectangles in flat meshes.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/annotate/axes.h"
#include "render/annotate/flat_mesh.h"

namespace tests {

struct Rect {
    glm::vec2 lo, hi;
};
inline bool overlap(const Rect& a, const Rect& b, float allowed = 0) {
    return a.lo.x + allowed < b.hi.x && b.lo.x + allowed < a.hi.x && a.lo.y + allowed < b.hi.y &&
           b.lo.y + allowed < a.hi.y;
}
inline Rect around(const Rect& a, const Rect& b) {
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

struct Shape {
    Rect covers;
    glm::vec2 texel;  // of the glyph's first corner
    bool glyph;
};
// A mesh's quads, six vertices each.
inline std::vector<Shape> shapes(const render::FlatMesh& mesh) {
    std::vector<Shape> found;
    const auto& v = mesh.triangles();
    for (std::size_t i = 0; i < v.size(); i += 6) {
        Rect covers{glm::vec2(v[i].at), glm::vec2(v[i].at)};
        for (std::size_t j = i; j < i + 6; ++j)
            covers = around(covers, {glm::vec2(v[j].at), glm::vec2(v[j].at)});
        found.push_back({covers, v[i].texel, v[i].texel.x >= 0});
    }
    return found;
}

// Where a text stands in a mesh, known by its glyphs' places in the atlas.
inline std::optional<Rect> find(const render::FlatMesh& mesh, const render::Font& font,
                                render::FontStyle style, const std::string& text) {
    const auto glyphs = font.layout(text, style, {0, 0});
    const auto all = shapes(mesh);
    for (std::size_t at = 0; at + glyphs.size() <= all.size(); ++at) {
        bool same = true;
        for (std::size_t i = 0; same && i < glyphs.size(); ++i) {
            const glm::vec2 step(glyphs[i].topLeft - glyphs[0].topLeft);
            same = all[at + i].texel == glm::vec2(glyphs[i].texel) &&
                   all[at + i].covers.lo - all[at].covers.lo == step;
        }
        if (!same) continue;
        Rect covers = all[at].covers;
        for (std::size_t i = 1; i < glyphs.size(); ++i) covers = around(covers, all[at + i].covers);
        return covers;
    }
    return std::nullopt;
}

// Fonts are slow to make; one for each size of labels.
inline const render::Font& fontFor(glm::ivec2 pictureSize) {
    static std::map<int, render::Font> fonts;
    const auto label = render::labelStyle(pictureSize);
    return fonts.try_emplace(label.linePixels, std::vector{label, render::titleStyle(pictureSize)})
        .first->second;
}

}  // namespace tests

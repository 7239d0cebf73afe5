#include "render/annotate/flat_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/flat_text.h"

namespace render {
namespace {

TEST(FlatMesh, CoversAreItsTextsAndRectangles) {
    const glm::ivec2 size(800, 600);
    const Font& font = tests::fontFor(size);
    FlatMesh mesh;
    mesh.line({0, 0, 0}, {100, 100, 0}, 2, glm::vec4(1));
    mesh.text(font, labelStyle(size), "two words", {20.4f, 30}, glm::vec3(1));
    mesh.text(font, labelStyle(size), " ", {20, 30}, glm::vec3(1));
    mesh.rect({1, 2}, {3, 5}, glm::vec4(1));
    mesh.plate({{1, 2}, {3, 5}}, 4, glm::vec4(1));
    ASSERT_EQ(mesh.covers().size(), 2u);
    tests::Rect glyphs{glm::vec2(1e9f), glm::vec2(-1e9f)};
    for (const auto& shape : tests::shapes(mesh))
        if (shape.glyph) glyphs = tests::around(glyphs, shape.covers);
    EXPECT_EQ(mesh.covers()[0], (PixelRect{glyphs.lo, glyphs.hi}));
    EXPECT_EQ(mesh.covers()[0], inkOf(font, labelStyle(size), "two words", glm::vec2(20.4f, 30)));
    EXPECT_EQ(mesh.covers()[1], (PixelRect{{1, 2}, {3, 5}}));
}

// Interpolated as a driver does, in the triangle that holds the place.
float alphaAt(const FlatMesh& mesh, glm::vec2 at) {
    const auto& v = mesh.triangles();
    for (std::size_t i = 0; i < v.size(); i += 3) {
        const glm::vec2 a(v[i].at), b(v[i + 1].at), c(v[i + 2].at);
        const auto cross = [](glm::vec2 p, glm::vec2 q) { return p.x * q.y - p.y * q.x; };
        const float whole = cross(b - a, c - a);
        const float wb = cross(at - a, c - a) / whole, wc = cross(b - a, at - a) / whole;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        return (1 - wb - wc) * v[i].color.a + wb * v[i + 1].color.a + wc * v[i + 2].color.a;
    }
    return 0;
}

TEST(FlatMesh, APlateIsSolidInsideAndFallsOffAlike) {
    FlatMesh mesh;
    mesh.plate({{10, 20}, {40, 30}}, 5, glm::vec4(0.5f));
    for (float y = 12.25f; y < 38; ++y) {
        for (float x = 2.25f; x < 48; ++x) {
            const float dx = std::max({10 - x, x - 40, 0.0f}),
                        dy = std::max({20 - y, y - 30, 0.0f});
            const float off = std::max(dx, dy);
            EXPECT_NEAR(alphaAt(mesh, {x, y}), 0.5f * std::clamp(1 - off / 5, 0.0f, 1.0f), 1e-5)
                << x << ' ' << y;
        }
    }
}

// WCAG 2.1's contrast of two luminances.
TEST(FlatMesh, TextIsLegibleOnItsGroundBeforeWhite) {
    const glm::vec4 ground = groundColor(glm::dvec3(0.005));
    const float behind = ground.r + (1 - ground.a);
    const float text = 0.8f;  // of the names' colour
    EXPECT_GE((text + 0.05f) / (behind + 0.05f), 4.5f);
}

}  // namespace
}  // namespace render

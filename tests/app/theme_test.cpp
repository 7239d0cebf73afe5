#include "app/panels/theme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/picture/still.h"
#include "render/annotate/axes.h"
#include "render/annotate/legend.h"
#include "render/image/color.h"

namespace app::panels {
namespace {

// WCAG 2.1, relative luminance and contrast ratio, of linear light.
double luminance(const glm::dvec3& light) {
    return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
}
double contrast(const glm::dvec3& a, const glm::dvec3& b) {
    const auto [dark, bright] = std::minmax({luminance(a), luminance(b)});
    return (bright + 0.05) / (dark + 0.05);
}
glm::dvec3 lightOf(ImU32 color) {
    const auto part = [&](int shift) { return static_cast<double>((color >> shift) & 255) / 255; };
    return render::linearFromSrgb(
        {part(IM_COL32_R_SHIFT), part(IM_COL32_G_SHIFT), part(IM_COL32_B_SHIFT)});
}
double contrast(ImU32 a, ImU32 b) { return contrast(lightOf(a), lightOf(b)); }

TEST(Contrast, IsTheStandards) {
    EXPECT_NEAR(contrast(rgb(0xffffff), rgb(0)), 21, 1e-9);
    EXPECT_NEAR(contrast(rgb(0x777777), rgb(0xffffff)), 4.48, 0.005);
}

TEST(Theme, EveryTextIsReadOnEveryGround) {
    for (const ImU32 ink : {kText, kDim, kFaint, kAccent, kError})
        for (const ImU32 ground : {kGround, kPanel, kField, kRaised, kPopup})
            EXPECT_GE(contrast(ink, ground), 4.5) << std::hex << ink << " on " << ground;
}

TEST(Theme, AFieldsEdgeIsSeen) {
    for (const ImU32 edge : {kEdge, kAccent, kError})
        for (const ImU32 ground : {kPanel, kField, kRaised, kPopup})
            EXPECT_GE(contrast(edge, ground), 3) << std::hex << edge << " on " << ground;
}

// Text alone: a colour bar and a swatch have the data's colours.
TEST(Theme, APicturesTextsAreReadOnItsGround) {
    const glm::ivec2 size(1200, 900);
    const render::Font font(std::array{render::titleStyle(size), render::labelStyle(size)});
    const render::FlatMesh mesh = render::legendMesh(
        {.title = "temperature (K)", .time = "0.5 s", .layers = {}, .notes = {"a note"}}, font,
        size);
    ASSERT_FALSE(mesh.triangles().empty());
    for (const auto& vertex : mesh.triangles()) {
        const glm::dvec3 light(vertex.color.r, vertex.color.g, vertex.color.b);
        EXPECT_GE(contrast(light, kBackground), 4.5);
    }
}

}  // namespace
}  // namespace app::panels

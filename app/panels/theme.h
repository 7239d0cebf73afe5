// How the interface looks: colours, fonts, spacing. The picture is what is bright; all else is
// dark, quiet and neutral, with one accent for what is active. Pure ImGui.
#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "app/panels/layout.h"

namespace app::panels {

constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
    return IM_COL32((hex >> 16) & 255, (hex >> 8) & 255, hex & 255, alpha);
}

// The picture's own background is the darkest. Every text is read on every ground at 4.5 to 1 and
// more, and the edge of what is typed into is seen at 3 to 1 (WCAG 2.1, 1.4.3 and 1.4.11; a test
// works it out).
constexpr ImU32 kGround = rgb(0x0d1117), kPanel = rgb(0x131920), kField = rgb(0x1b232c),
                kRaised = rgb(0x26303b), kPopup = rgb(0x1a2129), kLine = rgb(0x242d37),
                kEdge = rgb(0x6d7987), kText = rgb(0xd9e0e8), kDim = rgb(0xa0acb9),
                kFaint = rgb(0x8b97a5), kAccent = rgb(0x4fc3b0), kError = rgb(0xf2796b),
                kClear = rgb(0, 0);

ImU32 faded(ImU32 color, float alpha);   // alpha times `alpha`
ImU32 mixed(ImU32 a, ImU32 b, float t);  // sRGB components; opaque
ImU32 fromSrgb(const glm::dvec3& srgb, float alpha = 1);

inline ImVec2 im(glm::vec2 v) { return {v.x, v.y}; }
inline glm::vec2 vec(ImVec2 v) { return {v.x, v.y}; }

// Fonts belong to the ImGui context whose atlas they were added to.
struct Theme {
    float scale = 1;
    ImFont *text = nullptr, *strong = nullptr, *small = nullptr, *title = nullptr;
};

// Rasterises Inter for this scale and sets ImGui's style. Call between frames; what the renderer
// holds of the atlas must be made again. REQUIRES: a current ImGui context.
Theme makeTheme(float scale);

}  // namespace app::panels

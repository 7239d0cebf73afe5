#include "app/panels/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/annotate/font.h"

namespace app::panels {
namespace {

// What render::Font draws in pictures, so that interface and picture can say the same.
constexpr std::array<ImWchar, 13> kGlyphs = {0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x205f, 0x2070,
                                             0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};

// Equal widths, so that a running number does not tremble.
void equaliseDigits(ImFont& font) {
    float widest = 0;
    for (ImFontGlyph& g : font.Glyphs)
        if (g.Codepoint >= '0' && g.Codepoint <= '9') widest = std::max(widest, g.AdvanceX);
    for (ImFontGlyph& g : font.Glyphs) {
        if (g.Codepoint < '0' || g.Codepoint > '9') continue;
        const float shift = std::round(0.5f * (widest - g.AdvanceX));
        g.X0 += shift;
        g.X1 += shift;
        g.AdvanceX = widest;
    }
    font.BuildLookupTable();
}

ImFont* addFont(render::FontWeight weight, float pixels) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;  // the file is part of the program
    config.OversampleH = 2;
    config.PixelSnapH = false;
    const auto file = render::fontFile(weight);
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<std::byte*>(file.data()),
                                                      static_cast<int>(file.size()),
                                                      std::round(pixels), &config, kGlyphs.data());
}

ImVec4 color(ImU32 c) { return ImGui::ColorConvertU32ToFloat4(c); }

void setColors(ImGuiStyle& style) {
    const auto set = [&](ImGuiCol which, ImU32 c) { style.Colors[which] = color(c); };
    set(ImGuiCol_Text, kText);
    set(ImGuiCol_TextDisabled, kFaint);
    set(ImGuiCol_WindowBg, kPanel);
    set(ImGuiCol_ChildBg, kClear);
    set(ImGuiCol_PopupBg, kPopup);
    set(ImGuiCol_Border, rgb(0x2e3945));
    set(ImGuiCol_FrameBg, kField);
    set(ImGuiCol_FrameBgHovered, kRaised);
    set(ImGuiCol_FrameBgActive, kRaised);
    set(ImGuiCol_Button, kField);
    set(ImGuiCol_ButtonHovered, kRaised);
    set(ImGuiCol_ButtonActive, kLine);
    set(ImGuiCol_Header, faded(kAccent, 0.16f));
    set(ImGuiCol_HeaderHovered, kRaised);
    set(ImGuiCol_HeaderActive, kRaised);
    set(ImGuiCol_Separator, kLine);
    set(ImGuiCol_TextSelectedBg, faded(kAccent, 0.35f));
    set(ImGuiCol_NavHighlight, kAccent);
    set(ImGuiCol_CheckMark, kAccent);
    set(ImGuiCol_ScrollbarBg, kClear);
    set(ImGuiCol_ScrollbarGrab, kRaised);
    set(ImGuiCol_ScrollbarGrabHovered, kFaint);
    set(ImGuiCol_ScrollbarGrabActive, kFaint);
    set(ImGuiCol_ModalWindowDimBg, faded(kGround, 0.7f));
}

}  // namespace

ImU32 faded(ImU32 c, float alpha) {
    const auto a = static_cast<float>((c >> IM_COL32_A_SHIFT) & 255) * alpha;
    return (c & ~IM_COL32_A_MASK) |
           (static_cast<ImU32>(std::clamp(a, 0.0f, 255.0f)) << IM_COL32_A_SHIFT);
}

ImU32 mixed(ImU32 a, ImU32 b, float t) {
    ImU32 out = IM_COL32_A_MASK;
    for (const int shift : {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT}) {
        const auto from = static_cast<float>((a >> shift) & 255),
                   to = static_cast<float>((b >> shift) & 255);
        out |= static_cast<ImU32>(from + (to - from) * std::clamp(t, 0.0f, 1.0f)) << shift;
    }
    return out;
}

ImU32 fromSrgb(const glm::dvec3& srgb, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({static_cast<float>(srgb.x), static_cast<float>(srgb.y),
                                           static_cast<float>(srgb.z), alpha});
}

Theme makeTheme(float scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    Theme theme{.scale = scale};
    theme.text = addFont(render::FontWeight::Regular, 16 * scale);
    theme.strong = addFont(render::FontWeight::SemiBold, 16 * scale);
    theme.small = addFont(render::FontWeight::Regular, 14 * scale);
    theme.title = addFont(render::FontWeight::SemiBold, 22 * scale);
    atlas.Build();
    for (ImFont* font : atlas.Fonts) equaliseDigits(*font);

    ImGuiStyle style;
    style.WindowPadding = {12, 10};
    style.WindowRounding = style.PopupRounding = 6;
    style.FrameRounding = style.GrabRounding = 4;
    style.ScrollbarRounding = 4;
    style.FramePadding = {9, 5};
    style.ItemSpacing = {8, 8};
    style.ItemInnerSpacing = {6, 4};
    style.ScrollbarSize = 8;
    style.GrabMinSize = 10;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.ScaleAllSizes(scale);
    setColors(style);
    ImGui::GetStyle() = style;
    return theme;
}

}  // namespace app::panels

#include "app/panels/layer_style.h"

#include <fmt/format.h>

#include <array>

#include "app/choice_text.h"
#include "app/layer_colors.h"
#include "app/panels/widgets.h"
#include "render/color.h"

namespace app::panels {
namespace {

ImU32 encoded(const glm::vec3& linear, float alpha = 1) {
    return fromSrgb({render::srgbFromLinear(static_cast<double>(linear.x)),
                     render::srgbFromLinear(static_cast<double>(linear.y)),
                     render::srgbFromLinear(static_cast<double>(linear.z))},
                    alpha);
}

bool editConstant(const Theme& theme, LayerChoice& layer, float width) {
    const float s = theme.scale;
    bool changed = false;
    const glm::vec2 at = vec(ImGui::GetCursorScreenPos());
    const float cell = width / kLayerColors.size();
    for (std::size_t i = 0; i < kLayerColors.size(); ++i) {
        const glm::vec2 corner = at + glm::vec2(cell * static_cast<float>(i), 0);
        const Rect r{corner, corner + glm::vec2(cell - 4 * s, 24 * s)};
        const bool now = layer.color == std::variant<glm::dvec3, MapChoice>(kLayerColors[i]);
        ImGui::PushID(static_cast<int>(i));
        const Pressing p = area("##palette", r);
        ImGui::PopID();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(im(r.min), im(r.max), fromSrgb(kLayerColors[i]), 4 * s);
        if (p.hovered || now)
            list.AddRect(im(r.min - glm::vec2(2 * s)), im(r.max + glm::vec2(2 * s)),
                         now ? kText : kDim, 5 * s);
        if (p.clicked) {
            layer.color = kLayerColors[i];
            changed = true;
        }
    }
    ImGui::SetCursorScreenPos(im(at + glm::vec2(0, 34 * s)));
    const auto* constant = layer.color ? std::get_if<glm::dvec3>(&*layer.color) : nullptr;
    const glm::dvec3 srgb = constant != nullptr ? *constant : kLayerColors[0];
    std::array<float, 3> c = {static_cast<float>(srgb.x), static_cast<float>(srgb.y),
                              static_cast<float>(srgb.z)};
    ImGui::SetNextItemWidth(width - 4 * s);
    if (ImGui::ColorPicker3("##picker", c.data(),
                            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoSmallPreview |
                                ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_DisplayHex |
                                ImGuiColorEditFlags_PickerHueBar)) {
        // As a text would say it, so that what is saved is what is shown.
        layer.color = parseColor(colorText(glm::dvec3(c[0], c[1], c[2])));
        changed = true;
    }
    return changed;
}

bool editMap(const Theme& theme, LayerChoice& layer, float width) {
    const float s = theme.scale;
    bool changed = false;
    const auto* chosen = layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr;
    for (const std::string_view name : render::colorMapNames()) {
        const glm::vec2 at = vec(ImGui::GetCursorScreenPos());
        const Rect r{at, at + glm::vec2(width - 4 * s, 26 * s)};
        const Pressing p = area(std::string(name).c_str(), r);
        const render::ColorMap map = *render::colorMapNamed(name);
        const bool now = chosen != nullptr && chosen->map == map;
        drawMap(*ImGui::GetWindowDrawList(),
                {r.min + glm::vec2(84 * s, 3 * s), r.max - glm::vec2(0, 3 * s)}, map);
        text(theme, {r.min.x, r.centre().y}, name,
             now         ? kAccent
             : p.hovered ? kText
                         : kDim,
             0, theme.small);
        if (p.clicked && !now) {
            MapChoice next = chosen != nullptr ? *chosen : MapChoice{};
            next.map = map;
            layer.color = next;
            changed = true;
            chosen = &std::get<MapChoice>(*layer.color);
        }
        ImGui::SetCursorScreenPos(im(at + glm::vec2(0, 32 * s)));
    }
    if (chosen == nullptr) return changed;
    std::array<double, 2> ends = {chosen->lo.value_or(0), chosen->hi.value_or(0)};
    ImGui::SetNextItemWidth(width - 4 * s);
    if (ImGui::InputScalarN("##ends", ImGuiDataType_Double, ends.data(), 2, nullptr, nullptr,
                            "%.6g", ImGuiInputTextFlags_EnterReturnsTrue) &&
        ends[0] < ends[1]) {
        auto& map = std::get<MapChoice>(*layer.color);
        map.lo = ends[0];
        map.hi = ends[1];
        changed = true;
    }
    return changed;
}

}  // namespace

ImU32 colorAt(const LayerChoice& layer, double value, float alpha) {
    if (!layer.color) return faded(kDim, alpha);
    if (const auto* srgb = std::get_if<glm::dvec3>(&*layer.color)) return fromSrgb(*srgb, alpha);
    const auto& choice = std::get<MapChoice>(*layer.color);
    return encoded(choice.map.at(render::mapPosition(
                       {choice.map, choice.lo.value_or(0), choice.hi.value_or(1)}, value)),
                   alpha);
}

ImU32 colorOf(const LayerChoice& layer, float alpha) {
    if (layer.color)
        if (const auto* choice = std::get_if<MapChoice>(&*layer.color))
            return encoded(choice->map.at(0.65), alpha);
    return colorAt(layer, 0, alpha);
}

void drawMap(ImDrawList& list, const Rect& at, const render::ColorMap& map) {
    constexpr int kParts = 24;
    const float width = at.size().x / kParts;
    for (int i = 0; i < kParts; ++i) {
        const ImU32 a = encoded(map.at(i / static_cast<double>(kParts))),
                    b = encoded(map.at((i + 1) / static_cast<double>(kParts)));
        const float x = at.min.x + width * static_cast<float>(i);
        list.AddRectFilledMultiColor({x, at.min.y}, {x + width, at.max.y}, a, b, b, a);
    }
}

void drawSwatch(ImDrawList& list, const Rect& at, const LayerChoice& layer, float scale) {
    if (layer.color) {
        if (const auto* choice = std::get_if<MapChoice>(&*layer.color)) {
            drawMap(list, at, choice->map);
            return;
        }
    }
    list.AddRectFilled(im(at.min), im(at.max), colorOf(layer), 4 * scale);
}

bool editColor(const Theme& theme, LayerChoice& layer) {
    constexpr std::array kKinds = {"One colour", "By value"};
    const float s = theme.scale, width = 268 * s;
    const bool byValue = layer.color && std::holds_alternative<MapChoice>(*layer.color);
    const glm::vec2 at = vec(ImGui::GetCursorScreenPos());
    bool changed = false;
    if (const auto kind = segmented(theme, "kind", {at, at + glm::vec2(width - 4 * s, 28 * s)},
                                    kKinds, byValue ? 1 : 0)) {
        if (*kind == 1)
            layer.color = MapChoice{};
        else
            layer.color = kLayerColors[0];
        changed = true;
    }
    ImGui::SetCursorScreenPos(im(at + glm::vec2(0, 38 * s)));
    return (std::holds_alternative<MapChoice>(*layer.color) ? editMap(theme, layer, width)
                                                            : editConstant(theme, layer, width)) ||
           changed;
}

}  // namespace app::panels

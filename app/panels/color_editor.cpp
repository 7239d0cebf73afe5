#include "app/panels/color_editor.h"

#include <algorithm>
#include <array>

#include "app/choices/choice_text.h"
#include "app/choices/layer_colors.h"
#include "app/panels/form.h"
#include "app/panels/layer_style.h"
#include "app/panels/number_field.h"

namespace app::panels {
namespace {

// One of the colours that are offered; returns whether it was pressed.
bool paletteCell(const Theme& theme, const Rect& at, const glm::dvec3& srgb, bool now) {
    const float s = theme.scale;
    const Pressing p = button("##palette", at, now);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), fromSrgb(srgb), 4 * s);
    if (p.hovered || now)
        list.AddRect(im(at.min - glm::vec2(2 * s)), im(at.max + glm::vec2(2 * s)),
                     now ? kText : kDim, 5 * s);
    return p.clicked;
}

bool mapRow(const Theme& theme, const Rect& at, std::string_view name, bool now) {
    const float s = theme.scale;
    const Pressing p = button(std::string(name).c_str(), at, now);
    drawMap(*ImGui::GetWindowDrawList(),
            {at.min + glm::vec2(84 * s, 3 * s), at.max - glm::vec2(0, 3 * s)},
            *render::colorMapNamed(name));
    text(theme, {at.min.x, at.centre().y}, name,
         now         ? kAccent
         : p.hovered ? kText
                     : kDim,
         0, theme.small);
    return p.clicked;
}

}  // namespace

bool ColorEditor::draw(PanelContext& context, LayerChoice& layer) {
    constexpr std::array kKinds = {"One colour", "By value"};
    const float s = context.theme.scale, width = 264 * s;
    const bool byValue = layer.color && std::holds_alternative<MapChoice>(*layer.color);
    const glm::vec2 at = vec(ImGui::GetCursorScreenPos());
    bool changed = false;
    if (ImGui::IsWindowAppearing()) hex_ = lo_ = hi_ = {};  // of another layer, perhaps
    const Explorer& now = context.exploration.explorer();
    if (now.variable != variable_ || now.layers.size() < layers_) maps_.clear();
    variable_ = now.variable;
    layers_ = now.layers.size();
    MapChoice& last = maps_[ImGui::GetID("map")];
    if (byValue) last = std::get<MapChoice>(*layer.color);
    if (const auto kind = segmented(context.theme, "kind", {at, at + glm::vec2(width, 28 * s)},
                                    kKinds, byValue ? 1 : 0)) {
        if (*kind == 1)
            layer.color = last;
        else
            layer.color = kLayerColors[0];
        changed = true;
    }
    const glm::vec2 below = at + glm::vec2(0, 34 * s);
    constexpr std::array kModels = {"Auto", "Points", "Cells"};
    const std::size_t model = layer.model ? 1 + static_cast<std::size_t>(*layer.model) : 0;
    if (const auto chosen = segmented(context.theme, "model",
                                      {below, below + glm::vec2(width, 28 * s)}, kModels, model)) {
        layer.model = *chosen == 0 ? std::nullopt : std::optional(static_cast<Model>(*chosen - 1));
        changed = true;
    }
    ImGui::SetCursorScreenPos(im(at + glm::vec2(0, 72 * s)));
    const bool maps = layer.color && std::holds_alternative<MapChoice>(*layer.color);
    return (maps ? drawMaps(context, layer, width) : drawConstant(context, layer, width)) ||
           changed;
}

bool ColorEditor::drawConstant(PanelContext& context, LayerChoice& layer, float width) {
    const float s = context.theme.scale;
    bool changed = false;
    const glm::vec2 at = vec(ImGui::GetCursorScreenPos());
    const float cell = (width + 4 * s) / kLayerColors.size();
    for (std::size_t i = 0; i < kLayerColors.size(); ++i) {
        const glm::vec2 corner = at + glm::vec2(cell * static_cast<float>(i), 0);
        const bool now = layer.color == std::variant<glm::dvec3, MapChoice>(kLayerColors[i]);
        ImGui::PushID(static_cast<int>(i));
        if (paletteCell(context.theme, {corner, corner + glm::vec2(cell - 4 * s, 24 * s)},
                        kLayerColors[i], now)) {
            layer.color = kLayerColors[i];
            changed = true;
        }
        ImGui::PopID();
    }
    ImGui::SetCursorScreenPos(im(at + glm::vec2(0, 34 * s)));
    const auto* constant = layer.color ? std::get_if<glm::dvec3>(&*layer.color) : nullptr;
    const glm::dvec3 srgb = constant != nullptr ? *constant : kLayerColors[0];
    std::array<float, 3> c = {static_cast<float>(srgb.x), static_cast<float>(srgb.y),
                              static_cast<float>(srgb.z)};
    const auto take = [&](const std::string& hex) {
        try {
            layer.color = parseColor(hex);
            changed = true;
        } catch (const ChoiceError& error) {
            hex_.refuse(error.what());
        }
    };
    // Its height is about its width: smaller where the window is low.
    const float room = ImGui::GetIO().DisplaySize.y - 190 * s;
    ImGui::SetNextItemWidth(std::clamp(room, 120 * s, width));
    if (ImGui::ColorPicker3("##picker", c.data(),
                            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoSmallPreview |
                                ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoInputs |
                                ImGuiColorEditFlags_PickerHueBar))
        // As a text would say it, so that what is saved is what is shown.
        take(colorText(glm::dvec3(c[0], c[1], c[2])));
    const glm::vec2 field = vec(ImGui::GetCursorScreenPos());
    if (const auto hex =
            hex_.draw(context.theme, "##hex", {field, field + glm::vec2(width, 28 * s)},
                      colorText(srgb), "#rrggbb"))
        take(*hex);
    return changed;
}

bool ColorEditor::drawMaps(PanelContext& context, LayerChoice& layer, float width) {
    const float s = context.theme.scale;
    bool changed = false;
    MapChoice choice = std::get<MapChoice>(*layer.color);
    glm::vec2 at = vec(ImGui::GetCursorScreenPos());
    for (const std::string_view name : render::colorMapNames()) {
        const render::ColorMap map = *render::colorMapNamed(name);
        if (mapRow(context.theme, {at, at + glm::vec2(width, 26 * s)}, name, choice.map == map)) {
            choice.map = map;
            changed = true;
        }
        at.y += 32 * s;
    }
    const float fit = 48 * s;
    const Rect row{at, at + glm::vec2(width - fit - 6 * s, 28 * s)};
    const double least = choice.lo.value_or(0), most = choice.hi.value_or(0);
    const auto take = [&](const std::optional<double>& entered, std::optional<double>& end) {
        if (!entered) return;
        end = entered;
        changed = true;
    };
    const auto lo =
        valueField(context, lo_, "##lo", part(row, 0, 2, s), "the map's low end", least);
    take(lo, choice.lo);
    const auto hi =
        valueField(context, hi_, "##hi", part(row, 1, 2, s), "the map's high end", most);
    take(hi, choice.hi);
    // The layer's own ends, which may have changed since.
    if (textButton(context.theme, "##fit",
                   {{at.x + width - fit, row.min.y}, {at.x + width, row.max.y}}, "Fit")) {
        choice.lo = choice.hi = std::nullopt;
        lo_ = hi_ = {};
        changed = true;
    }
    if (changed) layer.color = choice;
    return changed;
}

}  // namespace app::panels

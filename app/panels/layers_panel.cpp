#include "app/panels/layers_panel.h"

#include <fmt/format.h>

#include "app/choices/choice_text.h"
#include "app/choices/edits.h"
#include "app/panels/counts_text.h"
#include "app/panels/layer_style.h"
#include "app/panels/number_field.h"
#include "app/picture/range_label.h"

namespace app::panels {
namespace {

std::string sweptText(const PanelContext& context) {
    const auto& sweep = context.exploration.playback().sweep;
    return sweep ? "swept  " + app::sweptText(*sweep, sweep->tick()) : "";
}

void add(PanelContext& context, const timeseries::SortedStep& step) {
    edit(context, {},
         [&](Explorer& e) { context.choices.layer = addLayer(e, newRanges(e, step), step); });
}

void amountText(PanelContext& context, const Rect& at, std::size_t row) {
    const PointCounts* counts = context.exploration.counts();
    if (counts == nullptr || row >= counts->layers.size()) return;
    const std::uint64_t count = counts->layers[row];
    const std::string amount = withCommas(count) + (counts->inClipBox ? " in the clip box"
                                                    : count == 1      ? " point"
                                                                      : " points");
    const std::string percent = percentText(count, counts->total),
                      share = percent.empty() ? "" : "  ·  " + percent;
    ImFont& font = *context.theme.small;
    const bool fits = widthOf(font, amount + share) <= at.size().x;
    text(context.theme, {at.min.x, at.centre().y}, fits ? amount + share : amount, kDim, 0, &font);
}

void opacitySlider(PanelContext& context, const Rect& at, std::size_t row) {
    Explorer next = context.exploration.explorer();
    double opacity = next.layers[row].opacity.value_or(0.5);
    const Rect bar{at.min, {at.max.x - 36 * context.theme.scale, at.max.y}};
    // The square root: most useful opacities are small.
    double fraction = std::sqrt(opacity);
    if (slider(context.theme, "##opacity", bar, fraction)) {
        opacity = roundedTo(fraction * fraction, 0.002);
        next.layers[row].opacity = opacity;
        context.exploration.edit(std::move(next), fmt::format("opacity {}", row));
    }
    if (ImGui::IsItemHovered()) tip(context.theme, "Opacity of one cell");
    text(context.theme, {at.max.x, at.centre().y}, fmt::format("{:.2g}", opacity), kDim, 1,
         context.theme.small);
}

}  // namespace

void LayersPanel::draw(PanelContext& context, const Rect& at) {
    const float s = context.theme.scale, left = at.min.x + kMargin * s,
                right = at.max.x - kMargin * s;
    const float title = at.min.y + 0.5f * kLayersTitle * s;
    text(context.theme, {left, title}, "Layers", kText, 0, context.theme.strong);
    const auto layers = [&] { return context.exploration.explorer().layers.size(); };
    const std::size_t count = layers();
    const auto shown = context.exploration.shown();
    if (shown && count < render::kMaxLayers &&
        iconButton(context.theme, "##add",
                   {{right - 24 * s, title - 12 * s}, {right, title + 12 * s}}, Icon::Add,
                   "Add a layer"))
        add(context, *shown->sorted);

    const Rect list{{at.min.x, at.min.y + kLayersTitle * s}, at.max};
    const glm::vec2 grip(kGrip * s, 0);
    ImGui::SetCursorScreenPos(im(list.min + grip));
    ImGui::BeginChild("##rows", im(list.size() - grip));
    if (shown && count == 0)
        text(context.theme, {left, list.min.y + 10 * s}, "No layer: nothing is drawn. + adds one.",
             kDim, 0, context.theme.small);
    const bool grown = count > 1 && count == texts_.size() + 1;
    texts_.resize(count);
    const glm::vec2 top = vec(ImGui::GetCursorScreenPos());
    // A row may remove itself: the rest waits for the next frame.
    for (std::size_t i = 0; i < count && layers() == count; ++i) {
        ImGui::PushID(static_cast<int>(i));
        row(context, layerRow(list, top.y + static_cast<float>(i) * kLayerRow * s, s), i);
        ImGui::PopID();
    }
    ImGui::SetCursorScreenPos({top.x, top.y + static_cast<float>(count) * kLayerRow * s});
    ImGui::Dummy({1, 1});
    if (grown) ImGui::SetScrollHereY(1);  // the new one is last
    ImGui::EndChild();
}

void LayersPanel::row(PanelContext& context, const LayerRowLayout& at, std::size_t row) {
    const Explorer& e = context.exploration.explorer();
    const LayerChoice layer = e.layers[row];
    const bool swept = layer.motion.has_value();
    const float s = context.theme.scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool selected = !swept && row == context.choices.layer;
    if (selected && e.layers.size() > 1) {
        const ImVec2 from(at.row.min.x + kGrip * s, at.row.min.y);
        list.AddRectFilled(from, im(at.row.max), faded(kField, 0.6f));
        list.AddRectFilled(from, {from.x + 3 * s, at.row.max.y}, kAccent);
    }
    const Pressing pressing = button("##swatch", at.swatch);
    drawSwatch(list, at.swatch, layer, s);
    if (pressing.hovered) list.AddRect(im(at.swatch.min), im(at.swatch.max), kText, 4 * s, 0, s);
    if (pressing.clicked) ImGui::OpenPopup("color");
    colorPopup(context, at.swatch, row);

    if (swept)
        text(context.theme, {at.text.min.x + 8 * s, at.text.centre().y},
             fitting(*context.theme.text, sweptText(context), at.text.size().x - 8 * s), kAccent);
    else
        editText(context, at, row);
    if (iconButton(context.theme, "##eye", at.eye, layer.visible ? Icon::Eye : Icon::EyeClosed,
                   layer.visible ? "Hide" : "Show"))
        edit(context, {}, [&](Explorer& next) { next.layers[row].visible = !layer.visible; });
    amountText(context, at.amount, row);
    opacitySlider(context, at.opacity, row);
    if (!swept && ImGui::IsMouseClicked(0) && at.row.holds(vec(ImGui::GetIO().MousePos)) &&
        ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
        context.choices.layer = row;
    if (!swept && focus().in(at.row)) context.choices.layer = row;
    if (iconButton(context.theme, "##remove", at.remove, Icon::Remove, "Remove"))
        edit(context, {}, [&](Explorer& next) { removeLayer(next, row); });
}

void LayersPanel::colorPopup(PanelContext& context, const Rect& swatch, std::size_t row) {
    ImGui::SetNextWindowPos({swatch.min.x, swatch.max.y + 4 * context.theme.scale});
    ImGui::SetNextWindowSize({292 * context.theme.scale, 0});
    if (!beginPopup("color")) return;
    Explorer next = context.exploration.explorer();
    if (color_.draw(context, next.layers[row]))
        context.exploration.edit(std::move(next), fmt::format("color {}", row));
    endPopup();
}

void LayersPanel::editText(PanelContext& context, const LayerRowLayout& at, std::size_t row) {
    const timeseries::RangeSet& now = context.exploration.explorer().layers[row].ranges;
    const auto entered = texts_[row].draw(context.theme, "##ranges", at.text,
                                          rangesText(context, now), "600:1600 or top 1 %");
    if (!entered) return;
    const auto shown = context.exploration.shown();
    if (!shown) return;
    try {
        const timeseries::RangeSet ranges = parseSelection(*entered, *shown->sorted);
        shown->sorted->select(ranges);  // throws where they were not kept
        edit(context, {}, [&](Explorer& next) { next.layers[row].ranges = ranges; });
    } catch (const std::invalid_argument& error) {
        texts_[row].refuse(error.what());
    }
}

}  // namespace app::panels

#include "app/panels/layers_panel.h"

#include <fmt/format.h>

#include "app/choices/choice_text.h"
#include "app/choices/edits.h"
#include "app/choices/sweep_edits.h"
#include "app/panels/layer_style.h"
#include "app/panels/number_field.h"
#include "app/picture/picture.h"

namespace app::panels {
namespace {

// Row 0 is the swept window's while there is one.
LayerChoice& layerOf(Explorer& e, std::size_t row) {
    if (e.sweep && row == 0) return e.sweepLayer;
    return e.layers[row - (e.sweep ? 1 : 0)];
}
bool isSwept(const Explorer& e, std::size_t row) { return e.sweep && row == 0; }

std::string percent(std::uint64_t count, std::uint64_t of) {
    if (of == 0) return "";
    const double share = 100 * static_cast<double>(count) / static_cast<double>(of);
    return fmt::format("{:.{}f} %", share, share >= 10 ? 1 : share >= 0.1 ? 2 : 4);
}

std::string sweptText(const Desk& desk) {
    const auto& sweep = desk.exploration.playback().sweep;
    return sweep ? "swept  " + app::sweptText(*sweep, sweep->tick()) : "";
}

void remove(Desk& desk, std::size_t row) {
    edit(desk, {}, [&](Explorer& e) {
        if (isSwept(e, row))
            stopSweep(e);
        else
            removeLayer(e, row - (e.sweep ? 1 : 0));
    });
}

void add(Desk& desk, const timeseries::SortedStep& step) {
    edit(desk, {},
         [&](Explorer& e) { desk.choices.layer = addLayer(e, newRanges(e, step), step); });
}

void amountText(Desk& desk, const Rect& at, std::size_t row) {
    const PointCounts* counts = desk.exploration.counts();
    if (counts == nullptr) return;
    const bool swept = desk.exploration.explorer().sweep.has_value();
    const std::size_t layer = row - (swept ? 1 : 0);
    if (!(swept && row == 0) && layer >= counts->layers.size()) return;
    const std::uint64_t count = swept && row == 0 ? counts->swept : counts->layers[layer];
    const std::string amount =
        withCommas(count) + (counts->inClipBox ? " in the clip box" : " points");
    const std::string share = "  ·  " + percent(count, counts->total);
    ImFont& font = *desk.theme.small;
    const bool fits = widthOf(font, amount + share) <= at.size().x;
    text(desk.theme, {at.min.x, at.centre().y}, fits ? amount + share : amount, kDim, 0, &font);
}

void opacitySlider(Desk& desk, const Rect& at, std::size_t row) {
    Explorer next = desk.exploration.explorer();
    double opacity = layerOf(next, row).opacity.value_or(0.5);
    const Rect bar{at.min, {at.max.x - 36 * desk.theme.scale, at.max.y}};
    // The square root: most useful opacities are small.
    double fraction = std::sqrt(opacity);
    if (slider(desk.theme, "##opacity", bar, fraction)) {
        opacity = roundedTo(fraction * fraction, 0.002);
        layerOf(next, row).opacity = opacity;
        desk.exploration.edit(std::move(next), fmt::format("opacity {}", row));
    }
    if (ImGui::IsItemHovered()) tip(desk.theme, "Opacity of one cell");
    text(desk.theme, {at.max.x, at.centre().y}, fmt::format("{:.2g}", opacity), kDim, 1,
         desk.theme.small);
}

}  // namespace

std::size_t LayersPanel::rows(const Explorer& e) { return e.layers.size() + (e.sweep ? 1 : 0); }

void LayersPanel::draw(Desk& desk, const Rect& at) {
    const float s = desk.theme.scale, left = at.min.x + kMargin * s, right = at.max.x - kMargin * s;
    const float title = at.min.y + 0.5f * kLayersTitle * s;
    text(desk.theme, {left, title}, "Layers", kText, 0, desk.theme.strong);
    const std::size_t count = rows(desk.exploration.explorer());
    const auto shown = desk.exploration.shown();
    if (shown && count < render::kMaxLayers &&
        iconButton(desk.theme, "##add", {{right - 24 * s, title - 12 * s}, {right, title + 12 * s}},
                   Icon::Add, "Add a layer"))
        add(desk, *shown->sorted);

    const Rect list{{at.min.x, at.min.y + kLayersTitle * s}, at.max};
    const glm::vec2 grip(kGrip * s, 0);
    ImGui::SetCursorScreenPos(im(list.min + grip));
    ImGui::BeginChild("##rows", im(list.size() - grip));
    if (shown && count == 0)
        text(desk.theme, {left, list.min.y + 10 * s}, "No layer: nothing is drawn. + adds one.",
             kDim, 0, desk.theme.small);
    const bool grown = count > texts_.size();
    texts_.resize(count);
    const glm::vec2 top = vec(ImGui::GetCursorScreenPos());
    // A row may remove itself: the rest waits for the next frame.
    for (std::size_t i = 0; i < count && rows(desk.exploration.explorer()) == count; ++i) {
        ImGui::PushID(static_cast<int>(i));
        row(desk, layerRow(list, top.y + static_cast<float>(i) * kLayerRow * s, s), i);
        ImGui::PopID();
    }
    ImGui::SetCursorScreenPos({top.x, top.y + static_cast<float>(count) * kLayerRow * s});
    ImGui::Dummy({1, 1});
    if (grown) ImGui::SetScrollHereY(1);  // the new one is last
    ImGui::EndChild();
}

void LayersPanel::row(Desk& desk, const LayerRowLayout& at, std::size_t row) {
    const Explorer& e = desk.exploration.explorer();
    Explorer now = e;
    const LayerChoice layer = layerOf(now, row);
    const bool swept = isSwept(e, row);
    const std::size_t index = row - (e.sweep ? 1 : 0);
    const float s = desk.theme.scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool selected = !swept && index == desk.choices.layer;
    if (selected && e.layers.size() > 1) {
        const ImVec2 from(at.row.min.x + kGrip * s, at.row.min.y);
        list.AddRectFilled(from, im(at.row.max), faded(kField, 0.6f));
        list.AddRectFilled(from, {from.x + 3 * s, at.row.max.y}, kAccent);
    }
    const Pressing pressing = button("##swatch", at.swatch);
    drawSwatch(list, at.swatch, layer, s);
    if (pressing.hovered) list.AddRect(im(at.swatch.min), im(at.swatch.max), kText, 4 * s, 0, s);
    if (pressing.clicked) ImGui::OpenPopup("color");
    colorPopup(desk, at.swatch, row);

    if (swept)
        text(desk.theme, {at.text.min.x + 8 * s, at.text.centre().y},
             fitting(*desk.theme.text, sweptText(desk), at.text.size().x - 8 * s), kAccent);
    else
        editText(desk, at, row);
    if (iconButton(desk.theme, "##eye", at.eye, layer.visible ? Icon::Eye : Icon::EyeClosed,
                   layer.visible ? "Hide" : "Show"))
        edit(desk, {}, [&](Explorer& next) { layerOf(next, row).visible = !layer.visible; });
    amountText(desk, at.amount, row);
    opacitySlider(desk, at.opacity, row);
    if (!swept && ImGui::IsMouseClicked(0) && at.row.holds(vec(ImGui::GetIO().MousePos)) &&
        ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
        desk.choices.layer = index;
    if (!swept && focus().in(at.row)) desk.choices.layer = index;
    if (iconButton(desk.theme, "##remove", at.remove, Icon::Remove, "Remove")) remove(desk, row);
}

void LayersPanel::colorPopup(Desk& desk, const Rect& swatch, std::size_t row) {
    ImGui::SetNextWindowPos({swatch.min.x, swatch.max.y + 4 * desk.theme.scale});
    ImGui::SetNextWindowSize({292 * desk.theme.scale, 0});
    if (!beginPopup("color")) return;
    Explorer next = desk.exploration.explorer();
    if (color_.draw(desk, layerOf(next, row)))
        desk.exploration.edit(std::move(next), fmt::format("color {}", row));
    endPopup();
}

void LayersPanel::editText(Desk& desk, const LayerRowLayout& at, std::size_t row) {
    const Explorer& e = desk.exploration.explorer();
    Explorer now = e;
    const auto entered =
        texts_[row].draw(desk.theme, "##ranges", at.text,
                         rangesText(desk, layerOf(now, row).ranges), "600:1600 or top 1 %");
    if (!entered) return;
    const auto shown = desk.exploration.shown();
    if (!shown) return;
    try {
        const timeseries::RangeSet ranges = parseSelection(*entered, *shown->sorted);
        shown->sorted->select(ranges);  // throws where they were not kept
        edit(desk, {}, [&](Explorer& next) { layerOf(next, row).ranges = ranges; });
    } catch (const std::invalid_argument& error) {
        texts_[row].refuse(error.what());
    }
}

}  // namespace app::panels

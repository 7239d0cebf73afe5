#include "app/panels/view_page.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/choice_text.h"
#include "app/choices/edits.h"
#include "app/choices/map_flaw.h"
#include "app/panels/widgets.h"
#include "render/annotate/ticks.h"

namespace app::panels {
namespace {

void sides(PanelContext& context, Form& form) {
    struct Button {
        const char* label;
        Command command;
    };
    constexpr std::array kButtons = {
        Button{"Front", Command::Front}, Button{"Back", Command::Back},
        Button{"Left", Command::Left},   Button{"Right", Command::Right},
        Button{"Top", Command::Top},     Button{"Bottom", Command::Bottom}};
    const float s = context.theme.scale;
    if (textButton(context.theme, "Fit", form.row("Look"), "Fit all   F"))
        context.requests.commands.push_back(Command::Fit);
    for (std::size_t line = 0; line < 2; ++line) {
        const Rect row = form.row(line == 0 ? "From" : " ");
        for (std::size_t i = 0; i < 3; ++i) {
            const Button& b = kButtons[3 * line + i];
            if (textButton(context.theme, b.label, part(row, i, 3, s), b.label))
                context.requests.commands.push_back(b.command);
        }
    }
}

}  // namespace

void ViewPage::draw(PanelContext& context, const Rect& at) {
    if (!context.exploration.shown()) return;
    constexpr std::array kProjections = {"Perspective", "Orthographic"};
    constexpr std::array kEyes = {"One", "Side by side", "Top, bottom"};
    Form form(context.theme, "##view", at);
    sides(context, form);
    const Explorer& e = context.exploration.explorer();
    if (const auto p = segmented(context.theme, "projection", form.row("Projection"), kProjections,
                                 static_cast<std::size_t>(e.view.projection)))
        edit(context, {},
             [&](Explorer& next) { next.view.projection = static_cast<Projection>(*p); });
    const std::size_t eyes = e.stereo.mode == Stereo::Off         ? 0
                             : e.stereo.mode == Stereo::TopBottom ? 2
                                                                  : 1;
    if (const auto chosen = segmented(context.theme, "eyes", form.row("Eyes"), kEyes, eyes))
        edit(context, {}, [&](Explorer& next) {
            next.stereo.mode = *chosen == 0   ? Stereo::Off
                               : *chosen == 1 ? Stereo::SideBySide
                                              : Stereo::TopBottom;
        });
    map(context, form);
    form.space(6);
    clip(context, form);
    form.space(6);
    scale(context, form);
    axes(context, form);
    form.space(6);
    constexpr std::array kLegends = {"Shown", "Hidden"};
    if (const auto chosen =
            segmented(context.theme, "legend", form.row("Legend"), kLegends, e.legend ? 0 : 1))
        edit(context, {}, [&](Explorer& next) { next.legend = *chosen == 0; });
}

// Where places are longitudes and latitudes, or once were.
void ViewPage::map(PanelContext& context, Form& form) {
    constexpr std::array kMaps = {"Flat", "Globe"};
    const auto now = static_cast<std::size_t>(context.exploration.explorer().map);
    if (now == 0 && !globeFlaw(context.exploration.shown()->sorted->grid()).empty()) return;
    if (const auto chosen = segmented(context.theme, "map", form.row("Map"), kMaps, now))
        edit(context, {}, [&](Explorer& e) { e.map = static_cast<render::Map>(*chosen); });
}

void ViewPage::clip(PanelContext& context, Form& form) {
    const auto shown = context.exploration.shown();
    const timeseries::Grid& grid = shown->sorted->grid();
    const float s = context.theme.scale;
    for (int i = 0; i < 3; ++i) {
        const auto place = static_cast<std::size_t>(i);
        const double least = grid.ends(place).least, most = grid.ends(place).most;
        if (least == most) continue;
        const timeseries::Axis& axis = grid.axes()[place];
        const ClipBox now = context.exploration.explorer().clip.value_or(
            ClipBox{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)});
        const double width = most - least;
        double lo = std::clamp((now.lo[i] - least) / width, 0.0, 1.0),
               hi = std::clamp((now.hi[i] - least) / width, 0.0, 1.0);
        const std::string unit = render::shownUnit(axis.units);
        const Rect row = form.row(fmt::format("Clip {}{}", axis.name,
                                              unit.empty() || unit == "index" ? "" : ", " + unit));
        const Rect bar{row.min, {row.max.x - (kSideField + kSideGap) * s, row.max.y}};
        ImGui::PushID(i);
        if (rangeSlider(context.theme, "##clip", bar, lo, hi))
            edit(context, "clip", [&](Explorer& e) {
                const double resolution = width / static_cast<double>(bar.size().x);
                const auto at = [&](double fraction) {
                    return roundedTo(least + fraction * width, resolution);
                };
                e.clip = withClipEnd(e.clip, grid, place, End::Lo, lo > 0 ? at(lo) : -kInfinity);
                e.clip = withClipEnd(e.clip, grid, place, End::Hi, hi < 1 ? at(hi) : kInfinity);
            });
        const Rect field{{row.max.x - kSideField * s, row.min.y}, row.max};
        const std::optional<ClipBox> box = context.exploration.explorer().clip;
        const int digits = clipDigits(box, grid, place, [&](std::string_view text) {
            return widthOf(*context.theme.text, text) <= field.size().x - 2 * TextField::kPad * s;
        });
        const auto entered = clip_[place].draw(context.theme, "##side", field,
                                               clipSideText(box, grid, place, digits));
        ImGui::PopID();
        if (!entered) continue;
        try {
            edit(context, {}, [&](Explorer& e) {
                e.clip = withClipSide(e.clip, grid, place, *entered, digits);
            });
        } catch (const ChoiceError& error) {
            clip_[place].refuse(error.what());
        }
    }
    form.note(grid.mesh()
                  ? "From : to. Only what lies between is drawn."
                  : "From : to, or one value for a slice. Only what lies between is drawn.");
}

void ViewPage::scale(PanelContext& context, Form& form) {
    const auto& now = context.exploration.explorer().scale;
    const std::string text = now ? fmt::format("{:g},{:g},{:g}", now->x, now->y, now->z) : "";
    const auto entered = scale_.draw(context.theme, "##scale", form.row("Axes' scale"), text,
                                     "fitted, or x,y,z: 1,1,20");
    if (!entered) return;
    try {
        edit(context, {}, [&](Explorer& e) {
            e.scale = entered->empty() ? std::nullopt : std::optional(parseScale(*entered));
        });
    } catch (const ChoiceError& error) {
        scale_.refuse(error.what());
    }
}

// For files that do not say which way an axis runs, or what it is. The file is read again.
void ViewPage::axes(PanelContext& context, Form& form) {
    constexpr std::array kLabels = {"x", "y", "z"};
    const float s = context.theme.scale;
    const auto now = context.exploration.explorer().axes;
    const auto& shown = context.exploration.shown()->sorted->grid().axes();
    const Rect flips = form.row("Flip"), names = form.row("Names");
    for (std::size_t a = 0; a < 3; ++a) {
        ImGui::PushID(kLabels[a]);
        if (textButton(context.theme, "##flip", part(flips, a, 3, s), kLabels[a], now[a].flip))
            edit(context, {}, [&](Explorer& e) { e.axes[a].flip = !now[a].flip; });
        if (const auto name = names_[a].draw(context.theme, "##name", part(names, a, 3, s),
                                             now[a].name, shown[a].name.c_str()))
            edit(context, {}, [&](Explorer& e) { e.axes[a].name = *name; });
        ImGui::PopID();
    }
}

}  // namespace app::panels

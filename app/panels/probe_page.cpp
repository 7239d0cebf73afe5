#include "app/panels/probe_page.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/annotate/ticks.h"
#include "render/points/globe.h"

namespace app::panels {
namespace {

void line(const Theme& theme, Form& form, std::string_view label, std::string_view what) {
    const Rect row = form.row(label);
    text(theme, {row.min.x, row.centre().y}, fitting(*theme.text, what, row.size().x));
}

// What is between two longitudes lies neither east nor west.
std::string unitBetween(const std::string& unit) {
    const std::string shown = render::shownUnit(unit);
    return shown == "°E" || shown == "°W" || shown == "°N" || shown == "°S" ? "°" : unit;
}

// As one length where all axes have one unit, or along the Earth's surface, and along each axis.
void ruler(PanelContext& context, Form& form, const Reading& a, const Reading& b,
           const timeseries::Grid& grid) {
    const glm::dvec3 apart = alongAxes(b, grid) - alongAxes(a, grid);
    const auto& axes = grid.axes();
    const auto from = onEarth(a, grid), to = onEarth(b, grid);
    if (from && to)
        line(context.theme, form, "Distance",
             fmt::format("{:.6g} km", kilometresApart({*from, 0}, {*to, 0})));
    else if (const auto unit = unitOfSpace(grid))
        line(context.theme, form, "Distance",
             withUnit(fmt::format("{:.6g}", glm::distance(a.position, b.position)), *unit));
    for (int i = 0; i < 3; ++i) {
        const timeseries::Axis& axis = axes[static_cast<std::size_t>(i)];
        if (axis.coordinates.size() > 1)
            line(context.theme, form, "Δ " + axis.name,
                 withUnit(fmt::format("{:.6g}", apart[i]), unitBetween(axis.units)));
    }
}

}  // namespace

double kilometresApart(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kMeanRadius = 6371.0088;  // Moritz, Geodetic Reference System 1980
    const auto squaredSine = [](double degrees) {
        const double sine = std::sin(0.5 * degrees * render::kPerDegree);
        return sine * sine;
    };
    const double h = squaredSine(b.y - a.y) + std::cos(a.y * render::kPerDegree) *
                                                  std::cos(b.y * render::kPerDegree) *
                                                  squaredSine(b.x - a.x);
    return 2 * kMeanRadius * std::asin(std::min(1.0, std::sqrt(h)));
}

std::string timesNote(const Reading& first, const Reading* second, const Shown& shown) {
    const timeseries::TimeAxis& time = *shown.dataset.variable.time;
    const Reading& told = second != nullptr ? *second : first;
    std::string note;
    if (told.step != shown.step)
        note =
            fmt::format("Read at that time, not at the picture's, {}. A double click reads anew.",
                        timeText(time, shown.step));
    if (first.step != told.step)
        note += fmt::format("{}The ruler's first point was read at another time, {}.",
                            note.empty() ? "" : " ", timeText(time, first.step));
    return note;
}

void ProbePage::take(const std::optional<Reading>& reading, bool isRuler) {
    if (isRuler && first_) {
        second_ = reading;
    } else {
        first_ = reading;
        second_.reset();
    }
}

void ProbePage::draw(PanelContext& context, const Rect& at) {
    const auto shown = context.exploration.shown();
    if (!shown) return;
    Form form(context.theme, "##probe", at);
    if (!first_) {
        form.note(
            "Double click on the picture keeps the point that is seen there, at half of the light, "
            "or is nearest to that. Shift and double click then measures to another point.");
        return;
    }
    const timeseries::Grid& grid = shown->sorted->grid();
    const Reading& r = second_ ? *second_ : *first_;
    if (r.between) line(context.theme, form, "Seen", betweenText(r, *shown));
    line(context.theme, form, shown->dataset.variable.name, valueText(r, *shown));
    for (const auto& [name, place] : placeLines(r, *shown)) line(context.theme, form, name, place);
    if (!r.cell.empty()) line(context.theme, form, "Cell", r.cell);
    line(context.theme, form, "Time", timeText(*shown->dataset.variable.time, r.step));
    if (const std::string note = timesNote(*first_, second_ ? &*second_ : nullptr, *shown);
        !note.empty())
        form.note(note);
    if (second_) ruler(context, form, *first_, *second_, grid);
    if (textButton(context.theme, "Clear", part(form.row(), 0, 3, context.theme.scale), "Clear"))
        clear();
}

}  // namespace app::panels

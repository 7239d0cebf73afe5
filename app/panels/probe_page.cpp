#include "app/panels/probe_page.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "render/ticks.h"

namespace app::panels {
namespace {

std::string withUnit(const std::string& number, const std::string& unit) {
    const std::string shown = render::shownUnit(unit);
    return shown.empty() || shown == "index" ? number : number + " " + shown;
}

// As few digits as tell the value among those of its own type.
std::string valueText(const timeseries::Number& value, timeseries::ValueType type) {
    if (type == timeseries::ValueType::F32)
        return fmt::format("{}", static_cast<float>(timeseries::toDouble(value)));
    return timeseries::toText(value);
}

void line(const Theme& theme, Form& form, std::string_view label, std::string_view what) {
    const Rect row = form.row(label);
    text(theme, {row.min.x, row.centre().y}, fitting(*theme.text, what, row.size().x));
}

// Along each axis, and as one length where all axes have one unit.
void ruler(Desk& desk, Form& form, const Reading& a, const Reading& b,
           const timeseries::Grid& grid) {
    const glm::dvec3 apart = b.position - a.position;
    const auto& axes = grid.axes();
    for (int i = 0; i < 3; ++i) {
        const timeseries::Axis& axis = axes[static_cast<std::size_t>(i)];
        if (axis.coordinates.size() > 1)
            line(desk.theme, form, "Δ " + axis.name,
                 withUnit(fmt::format("{:.6g}", apart[i]), axis.units));
    }
    if (axes[0].units == axes[1].units && axes[1].units == axes[2].units)
        line(desk.theme, form, "Distance",
             withUnit(fmt::format("{:.6g}", glm::length(apart)), axes[0].units));
}

}  // namespace

void ProbePage::take(const std::optional<Reading>& reading, bool isRuler) {
    if (isRuler && first_) {
        second_ = reading;
    } else {
        first_ = reading;
        second_.reset();
    }
}

void ProbePage::draw(Desk& desk, const Rect& at) {
    const auto shown = desk.exploration.shown();
    if (!shown) return;
    Form form(desk.theme, "##probe", at);
    if (!first_) {
        form.note(
            "Double click on the picture reads the point that is seen there. Shift and double "
            "click then measures to another.");
        return;
    }
    const timeseries::Grid& grid = shown->sorted->grid();
    const Reading& r = second_ ? *second_ : *first_;
    line(desk.theme, form, shown->dataset.about.name,
         withUnit(valueText(r.value, shown->sorted->type()), shown->dataset.about.units));
    for (int i = 0; i < 3; ++i) {
        const timeseries::Axis& axis = grid.axes()[static_cast<std::size_t>(i)];
        line(desk.theme, form, axis.name,
             fmt::format("{}   [{}]", withUnit(fmt::format("{:.6g}", r.position[i]), axis.units),
                         r.index[static_cast<std::size_t>(i)]));
    }
    line(desk.theme, form, "Time", timeText(*shown->dataset.about.time, r.step));
    if (second_) ruler(desk, form, *first_, *second_, grid);
    if (textButton(desk.theme, "Clear", part(form.row(), 0, 3, desk.theme.scale), "Clear")) clear();
}

}  // namespace app::panels

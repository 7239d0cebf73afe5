#include "app/panels/histogram_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/choices/edits.h"
#include "app/panels/histogram_drawing.h"

namespace app::panels {
namespace {

constexpr float kBinPixels = 2;  // units of the design

std::string valueText(double value, double resolution) {
    return timeseries::toText(roundedTo(value, resolution));
}

}  // namespace

std::pair<double, double> allValues(const Exploration& exploration) {
    double lo = INFINITY, hi = -INFINITY;
    const auto take = [&](double value) {
        if (!std::isfinite(value)) return;
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    };
    const timeseries::Series& series = *exploration.series();
    for (std::size_t i = 0; i < series.stepCount(); ++i) {
        const timeseries::StepSummary* summary = series.summary(i);
        if (summary == nullptr) continue;
        take(timeseries::toDouble(summary->statistics.finiteMin));
        take(timeseries::toDouble(summary->statistics.finiteMax));
    }
    if (lo > hi) return {0, 1};
    return withRoom(lo, hi);
}

std::pair<double, double> HistogramPanel::values(const PanelContext& context) const {
    return zoomed_ ? *zoomed_ : allValues(context.exploration);
}

void HistogramPanel::draw(PanelContext& context, const Rect& at) {
    const auto shown = context.exploration.shown();
    if (!shown) return;
    const std::string of =
        fmt::format("{}\n{}\n{}", shown->dataset.name, shown->dataset.variable.name,
                    shown->explorer.keep ? shown->explorer.keep->text() : std::string());
    if (of != of_) {
        of_ = of;
        zoomed_.reset();
        columns_.clear();
        countedStep_.reset();
    }
    const timeseries::Series& series = *context.exploration.series();
    const HistogramLayout parts = histogramLayout(at, context.theme.scale, series.stepCount() > 1);
    const auto [lo, hi] = values(context);
    const Drawing f{.context = context,
                    .shown = *shown,
                    .series = series,
                    .at = parts,
                    .axis = {lo, hi, parts.histogram.min.y, parts.histogram.max.y},
                    .steps = {series.stepCount(), parts.map.min.x, parts.map.max.x},
                    .list = *ImGui::GetWindowDrawList(),
                    .s = context.theme.scale};
    refresh(context.exploration, f);

    const glm::vec2 mouse = vec(ImGui::GetIO().MousePos);
    const Pressing p = area("##histogram", reach(f));
    const bool panning = p.hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
    if (p.pressed) grab_ = gripAt(f, mouse);
    if (panning)
        grab_ = {.grip = Grip::Pan,
                 .pressedAt = mouse,
                 .valueAt = f.axis.valueAt(mouse.y),
                 .values = {lo, hi}};
    if (p.held || (grab_.grip == Grip::Pan && ImGui::IsMouseDown(ImGuiMouseButton_Middle)))
        drag(f, mouse);
    else {
        if (grab_.grip == Grip::Undecided)  // pressed, and not moved
            context.exploration.seek(f.steps.stepAt(grab_.pressedAt.x));
        grab_ = {};
    }
    if (p.hovered) zoom(f, mouse);
    readout_ = p.hovered || p.held ? hoverText(f, mouse) : std::string();

    moveEndsByKeys(f);

    drawTitle(f);
    drawHistogram(f);
    if (f.hasMap()) drawMap(f);
    const Grab hovered = p.hovered && !p.held ? gripAt(f, mouse) : grab_;
    drawBands(f, hovered);
    drawEnds(f, hovered);
    drawSweep(f);
    drawAxis(f);
    if (f.hasMap()) drawTime(f);
    if (p.hovered && !p.held)
        f.list.AddLine({f.across().min.x, mouse.y}, {f.across().max.x, mouse.y},
                       faded(kText, 0.25f));
    if (hovered.grip == Grip::Lo || hovered.grip == Grip::Hi || hovered.grip == Grip::AnimationLo ||
        hovered.grip == Grip::AnimationHi)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    else if (hovered.grip == Grip::Scrub)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void HistogramPanel::refresh(Exploration& exploration, const Drawing& f) {
    const auto bins =
        static_cast<std::size_t>(std::max(1.0f, f.at.histogram.size().y / (kBinPixels * f.s)));
    const bool sameAxis = axis_.lo == f.axis.lo && axis_.hi == f.axis.hi;
    axis_ = f.axis;
    if (!sameAxis || counts_.size() != bins || countedStep_.lock() != f.shown.sorted) {
        countedStep_ = f.shown.sorted;
        counts_.assign(bins, 0);
        exploration.reading([&] {
            counts_ = histogram(*f.shown.sorted, f.axis.lo, f.axis.hi, bins);
            infinite_ = atInfinity(*f.shown.sorted, f.axis.lo, f.axis.hi);
        });
    }
    if (!f.hasMap()) return;
    const auto fit = static_cast<std::size_t>(std::max(1.0f, f.at.map.size().x / (2 * f.s)));
    const std::size_t wanted = std::min(f.steps.steps, fit);
    if (columns_.size() != wanted) columns_.assign(wanted, {});
    for (std::size_t i = 0; i < wanted; ++i) {
        // Of the steps that share a column, the first that was seen.
        const timeseries::StepSummary* summary = nullptr;
        for (std::size_t step = i * f.steps.steps / wanted;
             step < (i + 1) * f.steps.steps / wanted && summary == nullptr; ++step)
            summary = f.series.summary(step);
        Column& column = columns_[i];
        if (summary == column.summary && sameAxis && column.counts.size() == bins) continue;
        column.summary = summary;
        column.counts = summary != nullptr ? density(*summary, f.axis.lo, f.axis.hi, bins)
                                           : std::vector<double>(bins);
    }
}

std::string HistogramPanel::hoverText(const Drawing& f, glm::vec2 mouse) const {
    const double value = f.axis.valueAt(mouse.y);
    const std::string number = f.withUnit(valueText(value, f.axis.perPixel()));
    if (counts_.empty()) return number;
    const auto bin = static_cast<std::size_t>(
        std::clamp((f.at.histogram.max.y - mouse.y) / f.at.histogram.size().y, 0.0f, 0.9999f) *
        static_cast<float>(counts_.size()));
    if (f.hasMap() && mouse.x >= f.at.map.min.x) {
        const std::size_t step = f.steps.stepAt(mouse.x);
        const std::string when = timeText(*f.shown.dataset.variable.time, step);
        const Column& column =
            columns_[std::min(columns_.size() - 1, step * columns_.size() / f.steps.steps)];
        if (column.summary == nullptr) return fmt::format("{}   {}   not yet seen", when, number);
        return fmt::format(
            "{}   {}   ≈ {}", when, number,
            withCommas(static_cast<std::uint64_t>(std::llround(column.counts[bin]))));
    }
    const std::uint64_t infinite = bin == 0                    ? infinite_.below
                                   : bin + 1 == counts_.size() ? infinite_.above
                                                               : 0;
    if (infinite > 0 && infinite == counts_[bin])
        return fmt::format("{}   {} points", bin == 0 ? kBelowAll : kAboveAll,
                           withCommas(infinite));
    return fmt::format("{}   {} points", number, withCommas(counts_[bin]));
}

}  // namespace app::panels

// How the histogram looks.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/exploration/value_map.h"
#include "app/panels/histogram_drawing.h"
#include "app/panels/layer_style.h"

namespace app::panels {

using timeseries::Range;
using timeseries::toDouble;

namespace {

// How far a bar of so many points reaches.
float countLength(double count, double most, bool linear, float whole) {
    const double t = linear ? count / most : std::log1p(count) / std::log1p(most);
    return static_cast<float>(t) * whole;
}

}  // namespace

void HistogramPanel::drawTitle(const Drawing& f) {
    constexpr std::array kCounts = {"log", "linear"};
    const Rect& at = f.at.title;
    const float y = at.centre().y;
    const float left = at.max.x - 100 * f.s;
    const std::string unit = render::shownUnit(f.shown.dataset.variable.units);
    const std::string title =
        fitting(*f.context.theme.strong, unit.empty() ? "Values" : "Values, " + unit,
                0.5f * (left - at.min.x));
    // What is read off is told whole: beside the title, or in its place.
    const float whole = left - 12 * f.s - at.min.x;
    const float beside = whole - widthOf(*f.context.theme.strong, title) - 6 * f.s;
    const bool fits = widthOf(*f.context.theme.small, readout_) <= beside;
    if (fits) text(f.context.theme, {at.min.x, y}, title, kText, 0, f.context.theme.strong);
    if (const auto chosen =
            segmented(f.context.theme, "counts", {{left, y - 11 * f.s}, {at.max.x, y + 11 * f.s}},
                      kCounts, linear_ ? 1 : 0))
        linear_ = *chosen == 1;
    text(f.context.theme, {left - 12 * f.s, y},
         fitting(*f.context.theme.small, readout_, fits ? beside : whole), kDim, 1,
         f.context.theme.small);
}

// Neutral, and again in a layer's colours where it selects.
void HistogramPanel::drawInColors(const Drawing& f, const Painter& paint) const {
    paint([](double) { return rgb(0x66788b); });
    const Rect across = f.across();
    const auto within = [&](const Range& range, const LayerChoice& layer) {
        f.list.PushClipRect({across.min.x, f.axis.y(toDouble(range.hi.value))},
                            {across.max.x, f.axis.y(toDouble(range.lo.value))}, true);
        paint([&](double value) { return colorAt(layer, value); });
        f.list.PopClipRect();
    };
    const auto& sweep = f.context.exploration.playback().sweep;
    for (const LayerChoice& layer : f.explorer().layers) {
        if (!layer.visible) continue;
        for (const Range& range : layer.ranges.ranges()) within(range, layer);
        if (layer.motion && sweep) within(sweep->window(), layer);
    }
}

// Numbers of points below the bars, from 0 at their foot, and fine lines up from them.
void HistogramPanel::drawCounts(const Drawing& f, double most) const {
    const Rect& at = f.at.histogram;
    ImFont& font = *f.context.theme.small;
    const float y = f.at.times.centre().y;
    float free = at.max.x + 0.5f * (f.at.axis.max.x - f.at.axis.min.x);  // from here leftwards
    for (const double count : countTicks(most, linear_)) {
        const float x = at.max.x - countLength(count, most, linear_, at.size().x - 4 * f.s);
        const std::string number = shortCount(count);
        const float half = 0.5f * widthOf(font, number);
        if (x + half > free || x - half < at.min.x - 12 * f.s) continue;
        free = x - half - 8 * f.s;
        f.list.AddRectFilled({x - 0.5f * f.s, at.min.y}, {x + 0.5f * f.s, at.max.y + 3 * f.s},
                             faded(kLine, 0.9f));
        text(f.context.theme, {x, y}, number, kFaint, 0.5f, &font);
    }
}

void HistogramPanel::drawHistogram(const Drawing& f) const {
    const Rect& at = f.at.histogram;
    f.list.AddRectFilled(im(at.min), im(at.max), kGround);
    const std::uint64_t most = *std::max_element(counts_.begin(), counts_.end());
    if (most == 0) {
        if (f.shown.sorted->size() == 0)
            text(f.context.theme, at.centre(), "no values", kFaint, 0.5f, f.context.theme.small);
        return;
    }
    const auto length = [&](std::uint64_t count) {
        return countLength(static_cast<double>(count), static_cast<double>(most), linear_,
                           at.size().x - 4 * f.s);
    };
    drawCounts(f, static_cast<double>(most));
    const float height = at.size().y / static_cast<float>(counts_.size());
    drawInColors(f, [&](const ColorOfValue& color) {
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            if (counts_[i] == 0) continue;
            const float bottom = at.max.y - height * static_cast<float>(i);
            f.list.AddRectFilled({at.max.x - std::max(f.s, length(counts_[i])), bottom - height},
                                 {at.max.x, bottom}, color(f.axis.valueAt(bottom - 0.5f * height)));
        }
    });
}

void HistogramPanel::drawMap(const Drawing& f) const {
    const Rect& at = f.at.map;
    f.list.AddRectFilled(im(at.min), im(at.max), kGround);
    const float width = at.size().x / static_cast<float>(columns_.size());
    const auto strip = [&](std::size_t column) {
        const float left = at.min.x + width * static_cast<float>(column);
        return Rect{{left, at.min.y}, {left + width, at.max.y}};
    };
    double most = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        for (const double count : columns_[c].counts) most = std::max(most, count);
        if (columns_[c].summary == nullptr) hatch(f.list, strip(c), f.s, rgb(0x222c37));
    }
    drawInColors(f, [&](const ColorOfValue& color) {
        for (std::size_t c = 0; c < columns_.size(); ++c)
            if (columns_[c].summary != nullptr)
                drawColumn(f, strip(c), columns_[c].counts, most, color);
    });
}

// Neighbouring values of one brightness are one rectangle.
void HistogramPanel::drawColumn(const Drawing& f, const Rect& strip,
                                const std::vector<double>& counts, double most,
                                const ColorOfValue& color) const {
    constexpr int kLevels = 32;
    const auto level = [&](double count) {
        if (!(count > 0)) return 0;
        const double t = linear_ ? count / most : std::log1p(count) / std::log1p(most);
        return std::clamp(static_cast<int>(std::ceil(t * kLevels)), 1, kLevels);
    };
    const float height = strip.size().y / static_cast<float>(counts.size());
    for (std::size_t i = 0; i < counts.size();) {
        std::size_t next = i + 1;
        const int here = level(counts[i]);
        // Short enough that a colour by value does not show its steps.
        while (next < counts.size() && next < i + 6 && level(counts[next]) == here) ++next;
        const float top = strip.max.y - height * static_cast<float>(next),
                    bottom = strip.max.y - height * static_cast<float>(i);
        if (here > 0)
            f.list.AddRectFilled({strip.min.x, top}, {strip.max.x, bottom},
                                 mixed(kGround, color(f.axis.valueAt(0.5f * (top + bottom))),
                                       0.12f + 0.88f * static_cast<float>(here) / kLevels));
        i = next;
    }
}

void HistogramPanel::drawBands(const Drawing& f, const Grab& hovered) const {
    const Rect across = f.across();
    f.list.PushClipRect(im(across.min), im(across.max), true);
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (!layers[l].visible) continue;
        const bool selected = l == f.context.choices.layer;
        const auto ranges = layers[l].ranges.ranges();
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const double lo = toDouble(ranges[i].lo.value), hi = toDouble(ranges[i].hi.value);
            const float bottom = std::min(f.axis.y(lo), across.max.y + f.s),
                        top = std::max(f.axis.y(hi), across.min.y - f.s);
            if (bottom < across.min.y || top > across.max.y) continue;
            const bool here = hovered.layer == l && hovered.range == i;
            const float alpha =
                (selected ? 0.10f : 0.06f) +
                (here && (hovered.grip == Grip::Band || hovered.grip == Grip::Undecided) ? 0.06f
                                                                                         : 0.0f);
            const ImU32 low = colorAt(layers[l], f.axis.valueAt(bottom), alpha),
                        high = colorAt(layers[l], f.axis.valueAt(top), alpha);
            f.list.AddRectFilledMultiColor({across.min.x, top}, {across.max.x, bottom}, high, high,
                                           low, low);
        }
    }
    f.list.PopClipRect();
}

void HistogramPanel::drawSweep(const Drawing& f) const {
    const Rect across = f.across();
    f.list.PushClipRect(im(across.min), im(across.max), true);
    if (const auto& keep = f.explorer().keep) {  // what lies outside was dropped
        double below = -INFINITY;
        const auto gap = [&](double lo, double hi) {
            if (!(lo < hi)) return;
            const Rect r{{across.min.x, f.axis.y(hi)}, {across.max.x, f.axis.y(lo)}};
            f.list.AddRectFilled(im(r.min), im(r.max), faded(kPanel, 0.75f));
            hatch(f.list, {glm::max(r.min, across.min), glm::min(r.max, across.max)}, f.s, kLine);
        };
        for (const Range& range : keep->ranges()) {
            gap(below, toDouble(range.lo.value));
            below = std::max(below, toDouble(range.hi.value));
        }
        gap(below, INFINITY);
    }
    if (const auto& sweep = f.context.exploration.playback().sweep) {
        const float x = f.at.axis.min.x + 4 * f.s;
        for (const Range& range : sweep->settings().animation.ranges()) {
            const float lo = f.axis.y(toDouble(range.lo.value)),
                        hi = f.axis.y(toDouble(range.hi.value));
            f.list.AddRectFilled({x - f.s, hi}, {x + f.s, lo}, kAccent);
            for (const float y : {lo, hi})
                f.list.AddRectFilled({x - 4 * f.s, y - f.s}, {x + 4 * f.s, y + f.s}, kAccent);
        }
        const Range window = sweep->window();
        const float lo = f.axis.y(toDouble(window.lo.value)),
                    hi = f.axis.y(toDouble(window.hi.value));
        f.list.AddRectFilled({across.min.x, hi}, {across.max.x, lo}, faded(kAccent, 0.16f));
        f.list.AddRect({across.min.x, hi - f.s}, {across.max.x, lo + f.s}, faded(kAccent, 0.9f), 0,
                       0, f.s);
        const float y = f.axis.y(sweep->contour());
        f.list.AddTriangleFilled({x + 8 * f.s, y - 4 * f.s}, {x + 8 * f.s, y + 4 * f.s},
                                 {x + 2 * f.s, y}, kAccent);
    }
    f.list.PopClipRect();
}

void HistogramPanel::drawAxis(const Drawing& f) const {
    const Rect& at = f.at.axis;
    ImFont& font = *f.context.theme.small;
    const int wanted = std::max(2, static_cast<int>(at.size().y / (38 * f.s)));
    const auto [ticks, texts] = render::fittingTicks(
        f.axis.lo, f.axis.hi, wanted,
        [&](const std::string& tick) { return widthOf(font, tick) <= at.size().x; });
    // Infinities have the room of a label at their end.
    const float room = 6 * f.s, taken = 20 * f.s;
    const float top = at.min.y + (infinite_.above > 0 ? taken : room),
                bottom = at.max.y - (infinite_.below > 0 ? taken : room);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const float y = f.axis.y(ticks[i]);
        if (y < top || y > bottom) continue;
        text(f.context.theme, {at.centre().x, y}, texts[i], kDim, 0.5f, &font);
    }
    if (infinite_.above > 0)
        text(f.context.theme, {at.centre().x, at.min.y + room}, kAboveAll, kText, 0.5f, &font);
    if (infinite_.below > 0)
        text(f.context.theme, {at.centre().x, at.max.y - room}, kBelowAll, kText, 0.5f, &font);
}

void HistogramPanel::drawTime(const Drawing& f) const {
    const auto& time = f.context.exploration.playback().time;
    if (time) {
        const timeseries::CursorSettings& settings = time->settings();
        const Rect& at = f.at.map;
        const float in = f.steps.cell(settings.first), out = f.steps.cell(settings.last + 1);
        f.list.AddRectFilled(im(at.min), {in, at.max.y}, faded(kPanel, 0.6f));
        f.list.AddRectFilled({out, at.min.y}, im(at.max), faded(kPanel, 0.6f));
        const float x = f.steps.centre(time->step());
        if (f.shown.step != time->step()) {
            const float there = f.steps.centre(f.shown.step);
            f.list.AddLine({there, at.min.y}, {there, at.max.y}, kDim, f.s);
        }
        f.list.AddRectFilled({x - f.s, at.min.y}, {x + f.s, at.max.y}, kText);
    }
    const auto& axis = *f.shown.dataset.variable.time;
    const std::size_t last = f.steps.steps - 1;
    const float half = 0.48f * f.at.times.size().x, y = f.at.times.centre().y;
    ImFont& font = *f.context.theme.small;
    const auto dayOf = [&](std::size_t step) {
        const std::string& date = axis.points[step].date;
        return date.substr(0, date.find(' '));
    };
    // Where day and hour do not fit: the one that tells the two ends apart.
    const auto shortened = [&](std::size_t step) {
        const std::string whole = timeText(axis, step);
        if (axis.points[step].date.empty() || widthOf(font, whole) <= half)
            return fitting(font, whole, half);
        const bool oneDay = dayOf(0) == dayOf(last);
        const std::size_t gap = whole.find(' ');
        return fitting(font, oneDay ? whole.substr(gap + 1) : whole.substr(0, gap), half);
    };
    text(f.context.theme, {f.at.times.min.x, y}, shortened(0), kFaint, 0, &font);
    text(f.context.theme, {f.at.times.max.x, y}, shortened(last), kFaint, 1, &font);
}

}  // namespace app::panels

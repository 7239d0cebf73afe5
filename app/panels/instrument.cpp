#include "app/panels/instrument.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/edits.h"
#include "app/panels/layer_style.h"
#include "app/value_map.h"
#include "render/ticks.h"

namespace app::panels {
namespace {

using timeseries::Bound;
using timeseries::Range;
using timeseries::RangeSet;
using timeseries::toDouble;

constexpr float kBinPixels = 2;  // units of the design

// The finite values of all steps seen, with a little room.
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
        take(toDouble(summary->statistics.min));
        take(toDouble(summary->statistics.max));
        if (summary->quantiles.empty()) continue;
        take(summary->quantiles.front());
        take(summary->quantiles.back());
    }
    if (lo > hi) return {0, 1};
    const double room =
        hi > lo ? 0.5 * (0.04 * hi - 0.04 * lo) : std::max(0.5, 1e-3 * std::abs(lo));
    return {lo - room, hi + room};
}

Range closed(double a, double b) {
    return {Bound{std::min(a, b), false}, Bound{std::max(a, b), false}};
}

// The tick of a sweep whose contour comes nearest to a value: contours ascend over a whole Loop and
// over the first half of a Swing.
std::int64_t nearestTick(const timeseries::ValueSweep& sweep, double value) {
    const std::int64_t ticks = sweep.ticksPerCycle();
    std::int64_t lo = 0, hi = ticks - 1;
    if (sweep.settings().path == timeseries::SweepPath::Swing) hi = ticks / 2;
    while (lo < hi) {
        const std::int64_t middle = lo + (hi - lo) / 2;
        if (sweep.contour(middle) < value)
            lo = middle + 1;
        else
            hi = middle;
    }
    if (lo > 0 && std::abs(sweep.contour(lo - 1) - value) < std::abs(sweep.contour(lo) - value))
        --lo;
    return lo;
}

std::string valueText(double value, double resolution) {
    return timeseries::toText(roundedTo(value, resolution));
}

}  // namespace

struct Instrument::Frame {
    Desk& desk;
    Shown shown;
    const timeseries::Series& series;
    InstrumentLayout at;
    ValueAxis axis;
    StepAxis steps;
    ImDrawList& list;
    float s;

    const Explorer& explorer() const { return desk.exploration.explorer(); }
    bool hasMap() const { return at.map.size().x > 0; }
    Rect across() const { return {at.histogram.min, {at.map.max.x, at.map.max.y}}; }
    std::string withUnit(const std::string& number) const {
        const std::string unit = render::shownUnit(shown.dataset.about.units);
        return unit.empty() ? number : number + " " + unit;
    }
};

std::pair<double, double> Instrument::values(const Desk& desk) const {
    return zoomed_ ? *zoomed_ : allValues(desk.exploration);
}

void Instrument::draw(Desk& desk, const Rect& at) {
    const auto shown = desk.exploration.shown();
    if (!shown) return;
    const std::string of = fmt::format("{}\n{}", shown->dataset.name, shown->dataset.about.name);
    if (of != of_) {
        of_ = of;
        zoomed_.reset();
        columns_.clear();
        countedStep_.reset();
    }
    const timeseries::Series& series = *desk.exploration.series();
    const InstrumentLayout parts = instrumentLayout(at, desk.theme.scale, series.stepCount() > 1);
    const auto [lo, hi] = values(desk);
    const Frame f{.desk = desk,
                  .shown = *shown,
                  .series = series,
                  .at = parts,
                  .axis = {lo, hi, parts.histogram.min.y, parts.histogram.max.y},
                  .steps = {series.stepCount(), parts.map.min.x, parts.map.max.x},
                  .list = *ImGui::GetWindowDrawList(),
                  .s = desk.theme.scale};
    refresh(f);

    const glm::vec2 mouse = vec(ImGui::GetIO().MousePos);
    const Pressing p = area("##instrument", f.across());
    const bool panning = p.hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
    if (p.pressed) grab_ = gripAt(f, mouse);
    if (panning)
        grab_ = {.grip = Grip::Pan,
                 .pressedAt = mouse,
                 .valueAt = f.axis.valueAt(mouse.y),
                 .values = {lo, hi}};
    if (p.held || (grab_.grip == Grip::Pan && ImGui::IsMouseDown(ImGuiMouseButton_Middle)))
        drag(f, mouse);
    else
        grab_ = {};
    if (p.hovered) zoom(f, mouse);
    readout_ = p.hovered || p.held ? hoverText(f, mouse) : std::string();

    drawTitle(f);
    drawHistogram(f);
    if (f.hasMap()) drawMap(f);
    const Grab hovered = p.hovered && !p.held ? gripAt(f, mouse) : grab_;
    drawBands(f, hovered);
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

void Instrument::refresh(const Frame& f) {
    const auto bins =
        static_cast<std::size_t>(std::max(1.0f, f.at.histogram.size().y / (kBinPixels * f.s)));
    const bool sameAxis = axis_.lo == f.axis.lo && axis_.hi == f.axis.hi;
    axis_ = f.axis;
    if (!sameAxis || counts_.size() != bins || countedStep_.lock() != f.shown.sorted) {
        countedStep_ = f.shown.sorted;
        counts_ = histogram(*f.shown.sorted, f.axis.lo, f.axis.hi, bins);
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

// --- by hand ---

Instrument::Grab Instrument::gripAt(const Frame& f, glm::vec2 mouse) const {
    const float reach = 5 * f.s;
    Grab grab{.pressedAt = mouse,
              .valueAt = f.axis.valueAt(mouse.y),
              .newLayer = ImGui::GetIO().KeyShift};
    const auto& playback = f.desk.exploration.playback();
    if (playback.sweep && f.at.axis.holds(mouse)) {
        const auto ranges = playback.sweep->settings().animation.ranges();
        const float lo = f.axis.y(toDouble(ranges.front().lo.value)),
                    hi = f.axis.y(toDouble(ranges.back().hi.value));
        grab.ranges = playback.sweep->settings().animation;
        if (std::abs(mouse.y - lo) < reach) return grab.grip = Grip::AnimationLo, grab;
        if (std::abs(mouse.y - hi) < reach) return grab.grip = Grip::AnimationHi, grab;
        const Range window = playback.sweep->window();
        if (mouse.y <= f.axis.y(toDouble(window.lo.value)) + reach &&
            mouse.y >= f.axis.y(toDouble(window.hi.value)) - reach)
            return grab.grip = Grip::Window, grab;
    }
    const auto& time = playback.time;
    if (f.hasMap() && time && mouse.x >= f.at.map.min.x &&
        std::abs(mouse.x - f.steps.centre(time->step())) < reach)
        return grab.grip = Grip::Scrub, grab;

    // The selected layer first, then the others from the last, which lies on top; ends before
    // bands.
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    std::vector<std::size_t> order;
    if (f.desk.choices.layer < layers.size()) order.push_back(f.desk.choices.layer);
    for (std::size_t i = layers.size(); i-- > 0;)
        if (i != f.desk.choices.layer) order.push_back(i);
    for (const bool ends : {true, false}) {
        for (const std::size_t layer : order) {
            if (!layers[layer].visible) continue;
            const auto ranges = layers[layer].ranges.ranges();
            for (std::size_t i = 0; i < ranges.size(); ++i) {
                const float lo = f.axis.y(toDouble(ranges[i].lo.value)),
                            hi = f.axis.y(toDouble(ranges[i].hi.value));
                grab.layer = layer;
                grab.range = i;
                grab.ranges = layers[layer].ranges;
                const float toLo = std::abs(mouse.y - lo), toHi = std::abs(mouse.y - hi);
                if (ends && std::min(toLo, toHi) < reach)
                    return grab.grip = toLo < toHi ? Grip::Lo : Grip::Hi, grab;
                if (!ends && !grab.newLayer && mouse.y < lo && mouse.y > hi)
                    return grab.grip = Grip::Band, grab;
            }
        }
    }
    grab.grip = Grip::Background;
    return grab;
}

void Instrument::drag(const Frame& f, glm::vec2 mouse) {
    Desk& desk = f.desk;
    const double value = roundedTo(f.axis.valueAt(mouse.y), f.axis.perPixel());
    const glm::vec2 moved = glm::abs(mouse - grab_.pressedAt);
    const auto setRanges = [&](const RangeSet& ranges) {
        edit(desk, "instrument", [&](Explorer& e) {
            if (grab_.layer < e.layers.size()) e.layers[grab_.layer].ranges = ranges;
        });
    };
    const auto setAnimation = [&](std::size_t range, End end) {
        edit(desk, "instrument", [&](Explorer& e) {
            if (e.sweep) e.sweep->animation = withEnd(grab_.ranges, range, end, value);
        });
    };
    switch (grab_.grip) {
        case Grip::None:
            return;
        case Grip::Lo:
        case Grip::Hi:
            desk.choices.layer = grab_.layer;
            if (moved.y < 1) return;
            return setRanges(withEnd(grab_.ranges, grab_.range,
                                     grab_.grip == Grip::Lo ? End::Lo : End::Hi, value));
        case Grip::Band:
            desk.choices.layer = grab_.layer;
            if (moved.y < 1) return;
            return setRanges(
                withMoved(grab_.ranges, grab_.range,
                          roundedTo(f.axis.valueAt(mouse.y) - grab_.valueAt, f.axis.perPixel())));
        case Grip::Background:
            if (f.hasMap() && grab_.pressedAt.x >= f.at.map.min.x && moved.y < 4 * f.s) {
                desk.exploration.seek(f.steps.stepAt(mouse.x));
                if (moved.x >= 4 * f.s) grab_.grip = Grip::Scrub;
                return;
            }
            if (moved.y >= 4 * f.s) dragNew(f, value);
            return;
        case Grip::NewRange: {
            const double from = roundedTo(grab_.valueAt, f.axis.perPixel());
            const Range range = closed(from, value);
            return setRanges(grab_.newLayer ? RangeSet({range}) : with(grab_.ranges, range));
        }
        case Grip::Scrub:
            return desk.exploration.seek(f.steps.stepAt(mouse.x));
        case Grip::AnimationLo:
            return setAnimation(0, End::Lo);
        case Grip::AnimationHi:
            return setAnimation(grab_.ranges.ranges().size() - 1, End::Hi);
        case Grip::Window:
            if (const auto& sweep = desk.exploration.playback().sweep)
                desk.exploration.seekTick(nearestTick(*sweep, f.axis.valueAt(mouse.y)));
            return;
        case Grip::Pan: {
            const double by = static_cast<double>(mouse.y - grab_.pressedAt.y) * f.axis.perPixel();
            zoomed_ = {grab_.values.first + by, grab_.values.second + by};
        }
    }
}

// From here on the drag makes a range: of the selected layer, or of a layer of its own.
void Instrument::dragNew(const Frame& f, double value) {
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    const double from = roundedTo(grab_.valueAt, f.axis.perPixel());
    grab_.grip = Grip::NewRange;
    const std::size_t swept = f.explorer().sweep ? 1 : 0;
    const bool full = layers.size() + swept >= render::kMaxLayers;
    if (layers.empty() || (grab_.newLayer && !full)) {
        edit(f.desk, "instrument", [&](Explorer& e) {
            grab_.layer = addLayer(e, RangeSet({closed(from, value)}), *f.shown.sorted);
        });
        grab_.newLayer = true;
    } else {
        grab_.newLayer = false;
        grab_.layer = std::min(f.desk.choices.layer, layers.size() - 1);
        grab_.ranges = layers[grab_.layer].ranges;
    }
    f.desk.choices.layer = grab_.layer;
}

void Instrument::zoom(const Frame& f, glm::vec2 mouse) {
    const float wheel = ImGui::GetIO().MouseWheel;
    if (wheel != 0) {
        const double at = f.axis.valueAt(mouse.y),
                     factor = std::pow(0.85, static_cast<double>(wheel));
        const auto [least, most] = allValues(f.desk.exploration);
        const double lo = at + (f.axis.lo - at) * factor, hi = at + (f.axis.hi - at) * factor;
        if (hi - lo >= most - least)
            zoomed_.reset();
        else if (hi - lo > 1e-9 * std::max(std::abs(lo), std::abs(hi)))
            zoomed_ = {lo, hi};
    }
    if (ImGui::IsMouseDoubleClicked(0)) zoomed_.reset();
}

// --- drawn ---

std::string Instrument::hoverText(const Frame& f, glm::vec2 mouse) const {
    const double value = f.axis.valueAt(mouse.y);
    const std::string number = f.withUnit(valueText(value, f.axis.perPixel()));
    if (counts_.empty()) return number;
    const auto bin = static_cast<std::size_t>(
        std::clamp((f.at.histogram.max.y - mouse.y) / f.at.histogram.size().y, 0.0f, 0.9999f) *
        static_cast<float>(counts_.size()));
    if (f.hasMap() && mouse.x >= f.at.map.min.x) {
        const std::size_t step = f.steps.stepAt(mouse.x);
        const std::string when = timeText(*f.shown.dataset.about.time, step);
        const Column& column =
            columns_[std::min(columns_.size() - 1, step * columns_.size() / f.steps.steps)];
        if (column.summary == nullptr) return fmt::format("{}   {}   not yet seen", when, number);
        return fmt::format(
            "{}   {}   ≈ {}", when, number,
            withCommas(static_cast<std::uint64_t>(std::llround(column.counts[bin]))));
    }
    return fmt::format("{}   {} points", number, withCommas(counts_[bin]));
}

void Instrument::drawTitle(const Frame& f) {
    constexpr std::array kCounts = {"log", "linear"};
    const Rect& at = f.at.title;
    const float y = at.centre().y;
    text(f.desk.theme, {at.min.x, y}, "Values", kText, 0, f.desk.theme.strong);
    const float left = at.max.x - 100 * f.s;
    if (const auto chosen =
            segmented(f.desk.theme, "counts", {{left, y - 11 * f.s}, {at.max.x, y + 11 * f.s}},
                      kCounts, linear_ ? 1 : 0))
        linear_ = *chosen == 1;
    text(f.desk.theme, {left - 12 * f.s, y},
         fitting(*f.desk.theme.small, readout_, left - at.min.x - 74 * f.s), kDim, 1,
         f.desk.theme.small);
}

void Instrument::drawHistogram(const Frame& f) {
    const Rect& at = f.at.histogram;
    f.list.AddRectFilled(im(at.min), im(at.max), kGround, 3 * f.s);
    const std::uint64_t most = *std::max_element(counts_.begin(), counts_.end());
    if (most == 0) return;
    const auto length = [&](std::uint64_t count) {
        const double t = linear_ ? static_cast<double>(count) / static_cast<double>(most)
                                 : std::log1p(static_cast<double>(count)) /
                                       std::log1p(static_cast<double>(most));
        return static_cast<float>(t) * (at.size().x - 4 * f.s);
    };
    const float height = at.size().y / static_cast<float>(counts_.size());
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (counts_[i] == 0) continue;
        const float bottom = at.max.y - height * static_cast<float>(i);
        f.list.AddRectFilled({at.max.x - std::max(f.s, length(counts_[i])), bottom - height},
                             {at.max.x, bottom}, rgb(0x5a6b7d));
    }
}

void Instrument::drawMap(const Frame& f) {
    constexpr int kLevels = 32;
    const Rect& at = f.at.map;
    f.list.AddRectFilled(im(at.min), im(at.max), kGround, 3 * f.s);
    double most = 0;
    for (const Column& column : columns_)
        for (const double count : column.counts) most = std::max(most, count);
    const auto level = [&](double count) {
        if (!(count > 0)) return 0;
        const double t = linear_ ? count / most : std::log1p(count) / std::log1p(most);
        return std::clamp(static_cast<int>(std::ceil(t * kLevels)), 1, kLevels);
    };
    const float width = at.size().x / static_cast<float>(columns_.size());
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        const float left = at.min.x + width * static_cast<float>(c);
        const Rect strip{{left, at.min.y}, {left + width, at.max.y}};
        if (columns_[c].summary == nullptr) {
            hatch(f.list, strip, f.s, rgb(0x1d252e));
            continue;
        }
        const std::vector<double>& counts = columns_[c].counts;
        const float height = at.size().y / static_cast<float>(counts.size());
        for (std::size_t i = 0; i < counts.size();) {
            std::size_t next = i + 1;
            const int here = level(counts[i]);
            while (next < counts.size() && level(counts[next]) == here) ++next;
            if (here > 0)
                f.list.AddRectFilled({strip.min.x, at.max.y - height * static_cast<float>(next)},
                                     {strip.max.x, at.max.y - height * static_cast<float>(i)},
                                     mixed(kGround, rgb(0xb9c7d6),
                                           0.08f + 0.92f * static_cast<float>(here) / kLevels));
            i = next;
        }
    }
}

void Instrument::drawBands(const Frame& f, const Grab& hovered) {
    const Rect across = f.across();
    f.list.PushClipRect(im(across.min), im(across.max), true);
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (!layers[l].visible) continue;
        const bool selected = l == f.desk.choices.layer;
        const auto ranges = layers[l].ranges.ranges();
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const double lo = toDouble(ranges[i].lo.value), hi = toDouble(ranges[i].hi.value);
            const float bottom = std::min(f.axis.y(lo), across.max.y + f.s),
                        top = std::max(f.axis.y(hi), across.min.y - f.s);
            if (bottom < across.min.y || top > across.max.y) continue;
            const bool here = hovered.layer == l && hovered.range == i;
            const float alpha =
                (selected ? 0.30f : 0.20f) + (here && hovered.grip == Grip::Band ? 0.10f : 0.0f);
            const ImU32 low = colorAt(layers[l], f.axis.valueAt(bottom), alpha),
                        high = colorAt(layers[l], f.axis.valueAt(top), alpha);
            f.list.AddRectFilledMultiColor({across.min.x, top}, {across.max.x, bottom}, high, high,
                                           low, low);
            for (const bool upper : {false, true}) {
                const float y = upper ? top : bottom;
                const bool grabbed = here && hovered.grip == (upper ? Grip::Hi : Grip::Lo);
                const ImU32 line = grabbed ? kText : colorAt(layers[l], upper ? hi : lo, 0.95f);
                f.list.AddRectFilled({across.min.x, y - (grabbed ? 1.5f : 0.75f) * f.s},
                                     {across.max.x, y + (grabbed ? 1.5f : 0.75f) * f.s}, line);
                // The handle, where the hand finds it.
                const float x = f.at.axis.centre().x;
                f.list.AddRectFilled({x - 12 * f.s, y - 3 * f.s}, {x + 12 * f.s, y + 3 * f.s}, line,
                                     3 * f.s);
            }
        }
    }
    f.list.PopClipRect();
}

void Instrument::drawSweep(const Frame& f) {
    const Rect across = f.across();
    f.list.PushClipRect(im(across.min), im(across.max), true);
    if (const auto& keep = f.explorer().keep) {  // what lies outside was dropped
        double below = -INFINITY;
        const auto gap = [&](double lo, double hi) {
            const Rect r{{across.min.x, f.axis.y(hi)}, {across.max.x, f.axis.y(lo)}};
            f.list.AddRectFilled(im(r.min), im(r.max), faded(kPanel, 0.75f));
            hatch(f.list, {glm::max(r.min, across.min), glm::min(r.max, across.max)}, f.s, kLine);
        };
        for (const Range& range : keep->ranges()) {
            gap(below, toDouble(range.lo.value));
            below = toDouble(range.hi.value);
        }
        gap(below, INFINITY);
    }
    if (const auto& sweep = f.desk.exploration.playback().sweep) {
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

void Instrument::drawAxis(const Frame& f) {
    const Rect& at = f.at.axis;
    const int wanted = std::max(2, static_cast<int>(at.size().y / (38 * f.s)));
    const std::vector<double> ticks = render::niceTicks(f.axis.lo, f.axis.hi, wanted);
    const std::vector<std::string> texts = render::tickTexts(ticks);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const float y = f.axis.y(ticks[i]);
        if (y < at.min.y + 6 * f.s || y > at.max.y - 6 * f.s) continue;
        text(f.desk.theme, {at.centre().x, y}, texts[i], kDim, 0.5f, f.desk.theme.small);
    }
    const std::string unit = render::shownUnit(f.shown.dataset.about.units);
    text(f.desk.theme, {at.centre().x, f.at.times.centre().y},
         fitting(*f.desk.theme.small, unit, at.size().x + 20 * f.s), kFaint, 0.5f,
         f.desk.theme.small);
}

void Instrument::drawTime(const Frame& f) {
    const auto& time = f.desk.exploration.playback().time;
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
    const auto& axis = *f.shown.dataset.about.time;
    const std::size_t last = f.steps.steps - 1;
    const float half = 0.48f * f.at.times.size().x, y = f.at.times.centre().y;
    ImFont& font = *f.desk.theme.small;
    text(f.desk.theme, {f.at.times.min.x, y}, fitting(font, timeText(axis, 0), half), kFaint, 0,
         &font);
    text(f.desk.theme, {f.at.times.max.x, y}, fitting(font, timeText(axis, last), half), kFaint, 1,
         &font);
}

}  // namespace app::panels

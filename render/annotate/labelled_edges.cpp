#include "render/annotate/labelled_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "render/annotate/ticks.h"

namespace render {

double tickLength(FontStyle style) { return 0.36 * style.linePixels; }

namespace {

glm::dvec3 tickAt(const LabelPage& page, const Edge& edge, double coordinate) {
    const glm::dvec3 half = page.placed.boxHalf();
    glm::dvec3 p = edge.at(half, 0);
    glm::dvec3 onAxis(0);
    onAxis[edge.axis] = coordinate;
    p[edge.axis] =
        std::clamp(page.placed.axesFromGrid(onAxis)[edge.axis], -half[edge.axis], half[edge.axis]);
    return p;
}

// Across the edge in the picture, away from the box.
glm::dvec2 outward(const Screen& screen, const Stretch& shown) {
    if (shown.pixels() < 1e-9) return {0, 1};
    const glm::dvec2 along = glm::normalize(shown.to - shown.from);
    const glm::dvec2 across(-along.y, along.x);
    // The box lies on one side of its outline; which one, a point just inside tells.
    const glm::dvec3 onEdge = 0.5 * (shown.a + shown.b);
    glm::dvec3 within = onEdge * 0.999;
    within[shown.edge.axis] = onEdge[shown.edge.axis];
    const double side = glm::dot(glm::dvec2(screen.pixel(within)) - shown.from, across);
    if (side == 0) return across.y > 0 ? across : -across;  // a line: below it
    return side > 0 ? -across : across;
}

}  // namespace

std::vector<Stretch> stretches(const LabelPage& page, int axis) {
    const glm::dvec3 half = page.placed.boxHalf();
    const Screen& screen = page.sights.middle();
    std::vector<Stretch> found;
    for (const Edge& edge : edges(half)) {
        if (edge.axis != axis) continue;
        const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
        const auto part = screen.visible(a, b, Screen::Cut::Picture);
        if (!part) continue;
        Stretch shown{edge,
                      glm::mix(a, b, part->x),
                      glm::mix(a, b, part->y),
                      *part,
                      {},
                      {},
                      {},
                      lies(edge, half, page.midEye) == Lies::Outline};
        shown.from = glm::dvec2(screen.pixel(shown.a));
        shown.to = glm::dvec2(screen.pixel(shown.b));
        shown.outward = outward(screen, shown);
        found.push_back(shown);
    }
    const bool onOutline =
        std::ranges::any_of(found, [](const Stretch& stretch) { return stretch.outline; });
    if (onOutline) std::erase_if(found, [](const Stretch& stretch) { return !stretch.outline; });
    const auto badness = [&](const Stretch& stretch) {
        if (!onOutline) return -stretch.pixels();
        const glm::dvec3 middle = screen.pixel(0.5 * (stretch.a + stretch.b));
        return axis == 2 ? middle.x : -middle.y;
    };
    std::ranges::stable_sort(found, {}, badness);
    return found;
}

bool isLong(const LabelPage& page, const Stretch& stretch) {
    return stretch.pixels() > 3 * page.line();
}

Words wordsOf(const LabelPage& page, std::string text) {
    const PixelRect ink = inkOf(page.font, page.style, text);
    return {std::move(text), ink};
}

Label centred(const Words& words, const glm::dvec3& anchor, const glm::dvec2& middle) {
    const glm::dvec2 topLeft = middle - 0.5 * (words.ink.lo + words.ink.hi);
    return {words.text, anchor, words.ink.moved(topLeft), topLeft};
}

glm::dvec2 beyond(const Words& words, const glm::dvec2& outward, double away) {
    const double reach = glm::dot(0.5 * words.size(), glm::abs(outward));
    return outward * (away + reach + 0.5);  // half a pixel: rounding
}

namespace {

// Degrees divide a circle rather than a ten; none where they pass many circles.
std::vector<double> degreeTicks(double lo, double hi, int wanted) {
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (const double step : {10.0, 20.0, 30.0, 60.0, 90.0, 180.0}) {
        const double count = std::floor(hi / step) - std::ceil(lo / step) + 1;
        const double off = std::abs(std::log(count / wanted));
        if (count >= 1 && count <= 3 * wanted && off < least) {
            least = off;
            best = step;
        }
    }
    std::vector<double> ticks;
    if (best > 0)
        for (double n = std::ceil(lo / best); n * best <= hi; ++n) ticks.push_back(n * best);
    return ticks;
}

std::vector<double> ticksOf(const timeseries::Axis& axis, double lo, double hi, int wanted) {
    if (axis.units.starts_with("degree") && (hi - lo) / wanted > 7.5) {
        auto ticks = degreeTicks(lo, hi, wanted);
        if (!ticks.empty()) return ticks;
    }
    auto ticks = niceTicks(lo, hi, wanted);
    if (axis.units == "index")
        std::erase_if(ticks, [](double tick) { return tick != std::round(tick); });
    return ticks;
}

// Coordinates of the axis along a stretch. They come from files as floats or as sums: an end a
// rounding short of 1 is 1.
glm::dvec2 extent(const timeseries::Axis& axis, const glm::dvec2& part) {
    const double first = std::min(axis.coordinates.front(), axis.coordinates.back());
    const double last = std::max(axis.coordinates.front(), axis.coordinates.back());
    const double slack = 1e-6 * last - 1e-6 * first;
    const glm::dvec2 fractions = axis.down ? glm::dvec2(1 - part.y, 1 - part.x) : part;
    constexpr double kMost = std::numeric_limits<double>::max();
    return {std::max(glm::mix(first, last, fractions[0]) - slack, -kMost),
            std::min(glm::mix(first, last, fractions[1]) + slack, kMost)};
}

// The axis with these ticks along a stretch; numbers that have no place are left out. None where
// they would crowd.
std::optional<AxisLabels> withTicks(const LabelPage& page, const LabelPlaces& places,
                                    const Stretch& stretch, std::vector<double> ticks) {
    AxisLabels shown{stretch.edge, std::move(ticks), {}, stretch.outward, {}, {}};
    const auto texts = tickTexts(shown.ticks);
    const double away = tickLength(page.style) + page.gap();
    std::vector<Label> labels;
    for (std::size_t i = 0; i < shown.ticks.size(); ++i) {
        shown.places.push_back(tickAt(page, stretch.edge, shown.ticks[i]));
        const Words words = wordsOf(page, texts[i]);
        labels.push_back(centred(words, shown.places[i], beyond(words, stretch.outward, away)));
        if (i > 0 && !places.apart(labels[i - 1], labels[i], 0.5 * page.line()))
            return std::nullopt;
    }
    for (const Label& label : labels)
        shown.numbers.push_back(places.fits(label, kLeastLabelMargin, 0.25 * page.line())
                                    ? std::optional(label)
                                    : std::nullopt);
    return shown;
}

}  // namespace

std::ptrdiff_t numberCount(const AxisLabels& shown) {
    return std::ranges::count_if(shown.numbers, [](const auto& n) { return n.has_value(); });
}

AxisLabels numbered(const LabelPage& page, const LabelPlaces& places, const Stretch& stretch) {
    const timeseries::Axis& axis = page.grid.axes()[static_cast<std::size_t>(stretch.edge.axis)];
    const glm::dvec2 ends = extent(axis, stretch.part);
    AxisLabels best{stretch.edge, {}, {}, stretch.outward, {}, {}};
    if (!stretch.outline) return best;
    constexpr int kMost = 9;
    // One number tells no scale; for 2, niceTicks would rather give 1 than 5.
    const int most = std::clamp(static_cast<int>(stretch.pixels() / (4.5 * page.line())), 3, kMost);
    std::vector<int> wanted;
    for (int count = most; count >= 1; --count) wanted.push_back(count);
    // Where some have no room, others may: more of them, though they stand close.
    if (isLong(page, stretch))
        for (int count = most + 1; count <= kMost; ++count) wanted.push_back(count);
    for (const int count : wanted) {
        auto shown = withTicks(page, places, stretch, ticksOf(axis, ends[0], ends[1], count));
        if (!shown) continue;
        if (numberCount(*shown) >= 2) return *shown;
        if (numberCount(*shown) > numberCount(best) || best.ticks.empty()) best = *shown;
    }
    if (!best.ticks.empty()) return best;
    auto one = ticksOf(axis, ends[0], ends[1], 1);
    one.resize(std::min<std::size_t>(one.size(), 1));
    return withTicks(page, places, stretch, std::move(one)).value_or(best);
}

}  // namespace render

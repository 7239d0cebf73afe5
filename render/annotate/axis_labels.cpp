#include "render/annotate/axis_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <span>
#include <utility>

#include "render/annotate/fitted_text.h"
#include "render/annotate/labelled_edges.h"
#include "render/annotate/ticks.h"

namespace render {

namespace {

// The axes so far, and what they take.
class Labelling {
 public:
    Labelling(const LabelPage& page, std::span<const PixelRect> taken)
        : page_(page), others_(page.sights, page.size, taken) {
        const glm::dvec3 half = page.placed.boxHalf();
        for (const Edge& edge : edges(half)) others_.takeLine(edge.at(half, -1), edge.at(half, 1));
    }

    void number(int axis) {
        const auto along = stretches(page_, axis);
        LabelPlaces places = others_;
        for (const AxisLabels& shown : axes_)
            for (const auto& number : shown.numbers)
                if (number) places.take(*number);
        std::optional<AxisLabels> best;
        const auto consider = [&](const Stretch& stretch) {
            AxisLabels shown = numbered(page_, places, stretch);
            if (!best || numberCount(shown) > numberCount(*best)) best = std::move(shown);
            return numberCount(*best) >= 2;
        };
        // On the box only where there is no room beside it.
        if (std::ranges::none_of(along, consider))
            std::ranges::any_of(along, [&](Stretch stretch) {
                stretch.outward = -stretch.outward;
                return isLong(page_, stretch) && consider(stretch);
            });
        if (!best) return;
        for (const glm::dvec3& at : best->places)
            others_.takeTick(at, best->outward * tickLength(page_.style));
        axes_.push_back(std::move(*best));
    }

    void name(AxisLabels& shown) {
        const timeseries::Axis& axis = page_.grid.axes()[static_cast<std::size_t>(shown.edge.axis)];
        const std::string unit = shownUnit(axis.units);
        std::string text = unit.empty() ? axis.name : fmt::format("{} ({})", axis.name, unit);
        std::ranges::replace(text, '\n', ' ');
        auto along = stretches(page_, shown.edge.axis);
        std::erase_if(along, [&](const Stretch& s) { return s.pixels() < page_.line(); });
        // Not std::ranges': clang 14 does not compile it with GCC 12's library.
        const auto end = std::stable_partition(along.begin(), along.end(), [&](const Stretch& s) {
            return s.edge.side == shown.edge.side;
        });
        const std::span<const Stretch> own(along.begin(), end), others(end, along.end());
        if (text.empty() || along.empty()) return;
        constexpr std::ptrdiff_t kAll = 1000, kTwo = 2;
        std::vector<Words> names = {wordsOf(page_, text)};
        for (const double lines : {12.0, 7.0, 4.0})
            names.push_back(wordsOf(page_, shortened(page_.font, page_.style, text,
                                                     static_cast<float>(lines * page_.line()))));
        std::erase_if(names, [](const Words& name) { return name.text.empty(); });
        for (const Words& name : names) {
            for (const std::ptrdiff_t keep : {kAll, kTwo})
                if (placeBeside(shown, own, name, keep) || placeAtEnds(shown, own, name, keep) ||
                    placeBeside(shown, others, name, keep))
                    return;
            if (placeAround(shown, along, name, kTwo)) return;
        }
        if (!names.empty()) placeAround(shown, along, names.back(), 0);
    }

    std::vector<AxisLabels>& axes() { return axes_; }

 private:
    static constexpr std::array kAlong = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9, 0.0, 1.0};

    // Where a name stands well; the numbers that it displaces go. Each axis keeps as many as `keep`
    // of those it has.
    bool tryName(AxisLabels& shown, const Label& label, double margin, std::ptrdiff_t keep) {
        const double apart = 0.4 * page_.line();
        if (!others_.fits(label, margin, apart)) return false;
        const auto displaced = [&](const std::optional<Label>& number) {
            return number && !others_.apart(label, *number, apart);
        };
        for (const AxisLabels& axis : axes_) {
            const std::ptrdiff_t lost = std::ranges::count_if(axis.numbers, displaced);
            if (lost > 0 && numberCount(axis) - lost < keep) return false;
        }
        for (AxisLabels& axis : axes_)
            for (auto& number : axis.numbers)
                if (displaced(number)) number.reset();
        others_.take(label);
        shown.name = label;
        return true;
    }

    // How far the numbers reach from their edge.
    double reach(const AxisLabels& shown) const {
        double farthest = tickLength(page_.style) + page_.gap();
        for (const auto& number : shown.numbers)
            if (number)
                farthest = std::max(farthest, tickLength(page_.style) + page_.gap() +
                                                  glm::dot(number->ink.hi - number->ink.lo,
                                                           glm::abs(shown.outward)));
        return farthest;
    }

    // Beyond the numbers, as near the middle as there is room; else between two of them.
    bool placeBeside(AxisLabels& shown, std::span<const Stretch> along, const Words& name,
                     std::ptrdiff_t keep) {
        const double near = tickLength(page_.style) + page_.gap();
        for (const Stretch& stretch : along) {
            if (!stretch.outline) return false;
            const bool own = stretch.edge.side == shown.edge.side;
            for (const double margin : {page_.margin(), kLeastLabelMargin})
                for (const double away : {own ? reach(shown) + 1.2 * page_.gap() : near, near})
                    for (const double t : kAlong)
                        if (tryName(shown,
                                    centred(name, glm::mix(stretch.a, stretch.b, t),
                                            beyond(name, stretch.outward, away)),
                                    margin, keep))
                            return true;
        }
        return false;
    }

    // Where the edge ends, in its direction or leaning from it: the upper end first.
    bool placeAtEnds(AxisLabels& shown, std::span<const Stretch> along, const Words& name,
                     std::ptrdiff_t keep) {
        for (const Stretch& stretch : along) {
            if (!stretch.outline) return false;
            struct End {
                glm::dvec3 at;
                glm::dvec2 towards;
            };
            const glm::dvec2 way = glm::normalize(stretch.to - stretch.from);
            std::array ends = {End{stretch.a, -way}, End{stretch.b, way}};
            if (ends[0].towards.y > ends[1].towards.y) std::swap(ends[0], ends[1]);
            for (const End& end : ends)
                for (const double lean : {0.0, 0.5, 1.0})
                    if (tryName(shown,
                                centred(name, end.at,
                                        beyond(name,
                                               glm::normalize(end.towards + lean * stretch.outward),
                                               page_.gap())),
                                kLeastLabelMargin, keep))
                        return true;
        }
        return false;
    }

    // On any side of the edges, as near as there is room, rather outward than on the box.
    bool placeAround(AxisLabels& shown, std::span<const Stretch> along, const Words& name,
                     std::ptrdiff_t keep) {
        constexpr int kDirections = 16;
        for (double lines = 0; lines <= 4; lines += 0.5)
            for (int i = 0; i < kDirections; ++i)
                for (const Stretch& stretch : along)
                    for (const double t : kAlong) {
                        const double turn =
                            (i + 1) / 2 * (i % 2 ? 1 : -1) * (glm::two_pi<double>() / kDirections);
                        const glm::dvec2 out = stretch.outward;
                        const glm::dvec2 towards(out.x * std::cos(turn) - out.y * std::sin(turn),
                                                 out.x * std::sin(turn) + out.y * std::cos(turn));
                        if (tryName(
                                shown,
                                centred(name, glm::mix(stretch.a, stretch.b, t),
                                        beyond(name, towards, page_.gap() + lines * page_.line())),
                                kLeastLabelMargin, keep))
                            return true;
                    }
        return false;
    }

    const LabelPage& page_;
    LabelPlaces others_;  // all but numbers
    std::vector<AxisLabels> axes_;
};

}  // namespace

std::vector<AxisLabels> axisLabels(const timeseries::Grid& grid, const PlacedPoints& placed,
                                   const Sights& sights, const glm::dvec3& midEye,
                                   glm::ivec2 pictureSize, const Font& font, FontStyle style,
                                   std::span<const PixelRect> taken) {
    const LabelPage page{grid, placed, sights, midEye, glm::dvec2(pictureSize), font, style};
    Labelling labelling(page, taken);
    for (const int axis : {2, 0, 1}) labelling.number(axis);
    for (AxisLabels& axis : labelling.axes()) labelling.name(axis);
    return labelling.axes();
}

}  // namespace render

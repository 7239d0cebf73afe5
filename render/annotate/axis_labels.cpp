#include "render/annotate/axis_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
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
        : page_(page), places_(page.sights, page.size, taken) {
        const glm::dvec3 half = page.placed.boxHalf();
        for (const Edge& edge : edges(half)) places_.takeLine(edge.at(half, -1), edge.at(half, 1));
    }

    void number(int axis) {
        const auto along = stretches(page_, axis);
        std::optional<AxisLabels> best;
        const auto consider = [&](const Stretch& stretch) {
            AxisLabels shown = numbered(page_, places_, stretch);
            if (!best || numberCount(shown) > numberCount(*best)) best = std::move(shown);
            return numberCount(*best) >= 2;
        };
        // On the box only where there is no room beside it.
        if (std::ranges::none_of(along, consider))
            std::ranges::any_of(along, [&](Stretch stretch) {
                stretch.outward = -stretch.outward;
                return isLong(page_, stretch) && consider(stretch);
            });
        if (!best || isTooShort(*best)) return;
        for (const glm::dvec3& at : best->places)
            places_.takeTick(at, best->outward * tickLength(page_.style));
        for (const auto& number : best->numbers)
            if (number) places_.take(*number);
        axes_.push_back(std::move(*best));
    }

    void name(AxisLabels& shown) {
        const auto own = stretchOf(shown);
        if (!own || isSeenEndOn(shown.edge.axis)) return;
        const auto others = stretchesBut(shown.edge.axis);
        for (const std::vector<Words>& names : namesOf(shown.edge.axis))
            for (const glm::dvec2& side : {own->outward, -own->outward})
                for (const Words& name : names)
                    if (placeAlong(shown, *own, others, side, name)) return;
    }

    std::vector<AxisLabels>& axes() { return axes_; }

 private:
    std::optional<Stretch> stretchOf(const AxisLabels& shown) const {
        for (const Stretch& stretch : stretches(page_, shown.edge.axis))
            if (stretch.edge.side == shown.edge.side) return stretch;
        return std::nullopt;
    }
    // No name has room along it, without which a number says nothing.
    bool isTooShort(const AxisLabels& shown) const {
        const auto own = stretchOf(shown);
        return !own || own->pixels() < page_.line();
    }
    // Through the box, from outside: the axis' edges lie among what others are labelled beside.
    bool isSeenEndOn(int axis) const {
        const auto within = glm::lessThanEqual(glm::abs(page_.midEye), page_.placed.boxHalf());
        return !within[axis] && within[(axis + 1) % 3] && within[(axis + 2) % 3];
    }

    // The name, ever shorter while it can be read, with its unit, without which numbers mean
    // nothing, and a long one of these ever shorter; then the unit alone.
    std::array<std::vector<Words>, 2> namesOf(int index) const {
        const timeseries::Axis& axis = page_.grid.axes()[static_cast<std::size_t>(index)];
        std::string name = axis.name, unit = shownUnit(axis.units);
        for (std::string* text : {&name, &unit}) std::ranges::replace(*text, '\n', ' ');
        constexpr std::array kLines{12.0, 7.0, 4.0};
        const auto within = [&](const std::string& text, double lines) {
            return shortened(page_.font, page_.style, text,
                             static_cast<float>(lines * page_.line()));
        };
        std::array<std::vector<Words>, 2> all;
        auto& [names, unitAlone] = all;
        const auto add = [&](std::vector<Words>& to, const std::string& beginning,
                             const std::string& in) {
            std::string text = beginning;
            if (!in.empty()) text += fmt::format("{}({})", beginning.empty() ? "" : " ", in);
            if (!text.empty() && (to.empty() || to.back().text != text))
                to.push_back(wordsOf(page_, std::move(text)));
        };
        add(names, name, unit);
        for (const double lines : kLines) add(names, within(name, lines), unit);
        if (within(unit, kLines[0]) != unit)
            for (const double lines : kLines) add(names, within(name, lines), within(unit, lines));
        if (!unit.empty()) {
            add(unitAlone, "", unit);
            add(unitAlone, "", within(unit, kLines[0]));
        }
        return all;
    }

    std::vector<Stretch> stretchesBut(int axis) const {
        std::vector<Stretch> all;
        for (const AxisLabels& other : axes_)
            if (other.edge.axis != axis) {
                const auto along = stretches(page_, other.edge.axis);
                all.insert(all.end(), along.begin(), along.end());
            }
        return all;
    }

    // On that side of its edge: beyond the numbers, as near the middle as there is room; else
    // between two of them.
    bool placeAlong(AxisLabels& shown, const Stretch& own, std::span<const Stretch> others,
                    const glm::dvec2& side, const Words& name) {
        const double near = tickLength(page_.style) + page_.gap();
        const bool numbersThere = glm::dot(side, shown.outward) > 0;
        for (const double margin : {page_.margin(), kLeastLabelMargin})
            for (const double away : {numbersThere ? reach(shown) + 1.2 * page_.gap() : near, near})
                for (const double t : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9}) {
                    const Label label =
                        centred(name, glm::mix(own.a, own.b, t), beyond(name, side, away));
                    if (!places_.fits(label, margin, 0.4 * page_.line()) ||
                        !belongs(label, own, others))
                        continue;
                    places_.take(label);
                    shown.name = label;
                    return true;
                }
        return false;
    }

    // Whether it is plain which axis a name is of: no other's edge or number is as near.
    bool belongs(const Label& name, const Stretch& own, std::span<const Stretch> others) const {
        const PixelRect covers = name.ink.moved(page_.sights.pixel(0, name.anchor));
        const double near = distance(covers, own.from, own.to) + 1;  // a pixel: roundings
        if (std::ranges::any_of(others, [&](const Stretch& other) {
                return distance(covers, other.from, other.to) < near;
            }))
            return false;
        return std::ranges::all_of(axes_, [&](const AxisLabels& axis) {
            return axis.edge.axis == own.edge.axis ||
                   std::ranges::all_of(axis.numbers, [&](const std::optional<Label>& number) {
                       return !number || places_.apart(name, *number, page_.line());
                   });
        });
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

    const LabelPage& page_;
    LabelPlaces places_;
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

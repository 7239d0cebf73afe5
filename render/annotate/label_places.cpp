#include "render/annotate/label_places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace render {

std::optional<glm::dvec2> partInside(const glm::dvec2& a, const glm::dvec2& b,
                                     const PixelRect& rect) {
    glm::dvec2 part(0, 1);
    for (int axis = 0; axis < 2; ++axis) {
        const double from = a[axis], along = b[axis] - a[axis];
        if (along == 0) {
            if (from <= rect.lo[axis] || from >= rect.hi[axis]) return std::nullopt;
            continue;
        }
        double enters = (rect.lo[axis] - from) / along, leaves = (rect.hi[axis] - from) / along;
        if (enters > leaves) std::swap(enters, leaves);
        part = {std::max(part[0], enters), std::min(part[1], leaves)};
    }
    if (part[0] >= part[1]) return std::nullopt;
    return part;
}

std::vector<glm::dvec2> piecesOutside(const glm::dvec2& a, const glm::dvec2& b,
                                      std::span<const PixelRect> rects) {
    std::vector<glm::dvec2> inside;
    for (const PixelRect& rect : rects)
        if (const auto part = partInside(a, b, rect)) inside.push_back(*part);
    std::sort(inside.begin(), inside.end(),
              [](const glm::dvec2& p, const glm::dvec2& q) { return p[0] < q[0]; });
    std::vector<glm::dvec2> pieces;
    double at = 0;
    for (const glm::dvec2& part : inside) {
        if (part[0] > at) pieces.emplace_back(at, part[0]);
        at = std::max(at, part[1]);
    }
    if (at < 1) pieces.emplace_back(at, 1);
    return pieces;
}

double distance(const PixelRect& rect, const glm::dvec2& a, const glm::dvec2& b) {
    if (partInside(a, b, rect)) return 0;
    // One of the two nearest places is an end of the line or a corner.
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& end : {a, b})
        least = std::min(least, glm::distance(end, glm::clamp(end, rect.lo, rect.hi)));
    const glm::dvec2 along = b - a;
    const double square = std::max(glm::dot(along, along), std::numeric_limits<double>::min());
    for (const glm::dvec2& corner :
         {rect.lo, rect.hi, glm::dvec2(rect.lo.x, rect.hi.y), glm::dvec2(rect.hi.x, rect.lo.y)}) {
        const double t = std::clamp(glm::dot(corner - a, along) / square, 0.0, 1.0);
        least = std::min(least, glm::distance(corner, a + t * along));
    }
    return least;
}

Sights::Sights(const View& view, const Middle& middle, const glm::dvec3& boxHalf)
    : eye_(view), middle_(viewFrom(middle, view)), count_(1) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at =
            boxHalf * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        if (visible(at) &&
            glm::distance(glm::dvec2(eye_.pixel(at)), glm::dvec2(middle_.pixel(at))) > 1e-3)
            count_ = 3;
    }
}

glm::dvec2 Sights::pixel(std::size_t sight, const glm::dvec3& at) const {
    const glm::dvec2 middle(middle_.pixel(at));
    if (sight == 0) return middle;
    const glm::dvec2 eye(eye_.pixel(at));
    return sight == 1 ? eye : 2.0 * middle - eye;
}

bool Sights::visible(const glm::dvec3& at) const {
    return eye_.visible(at, at, Screen::Cut::NearPlane) &&
           middle_.visible(at, at, Screen::Cut::NearPlane);
}

LabelPlaces::LabelPlaces(const Sights& sights, glm::dvec2 size, std::span<const PixelRect> taken)
    : sights_(sights),
      size_(size),
      rects_(sights.count(), std::vector<PixelRect>(taken.begin(), taken.end())),
      lines_(sights.count()) {}

void LabelPlaces::takeLine(const glm::dvec3& from, const glm::dvec3& to) {
    const auto part = sights_.middle().visible(from, to, Screen::Cut::NearPlane);
    if (!part) return;
    const glm::dvec3 a = glm::mix(from, to, part->x), b = glm::mix(from, to, part->y);
    for (std::size_t sight = 0; sight < sights_.count(); ++sight)
        lines_[sight].push_back({sights_.pixel(sight, a), sights_.pixel(sight, b)});
}

void LabelPlaces::takeTick(const glm::dvec3& at, const glm::dvec2& to) {
    if (!sights_.visible(at)) return;
    for (std::size_t sight = 0; sight < sights_.count(); ++sight) {
        const glm::dvec2 from = sights_.pixel(sight, at);
        lines_[sight].push_back({from, from + to});
    }
}

void LabelPlaces::take(const Label& label) {
    for (std::size_t sight = 0; sight < sights_.count(); ++sight)
        rects_[sight].push_back(label.ink.moved(sights_.pixel(sight, label.anchor)));
}

bool LabelPlaces::fits(const Label& label, double margin, double apart) const {
    if (!sights_.visible(label.anchor)) return false;
    constexpr double kOffLines = 4;  // more than lines keep off texts, and a rounding
    for (std::size_t sight = 0; sight < sights_.count(); ++sight) {
        const PixelRect covers = label.ink.moved(sights_.pixel(sight, label.anchor));
        const PixelRect inPicture = covers.grown(margin), alone = covers.grown(apart),
                        clear = covers.grown(kOffLines);
        if (!(inPicture.lo.x >= 0 && inPicture.lo.y >= 0 && inPicture.hi.x <= size_.x &&
              inPicture.hi.y <= size_.y))
            return false;
        if (std::ranges::any_of(rects_[sight],
                                [&](const PixelRect& other) { return overlap(alone, other); }))
            return false;
        if (std::ranges::any_of(lines_[sight], [&](const Line& line) {
                return partInside(line.from, line.to, clear).has_value();
            }))
            return false;
    }
    return true;
}

bool LabelPlaces::apart(const Label& a, const Label& b, double by) const {
    for (std::size_t sight = 0; sight < sights_.count(); ++sight)
        if (overlap(a.ink.moved(sights_.pixel(sight, a.anchor)).grown(by),
                    b.ink.moved(sights_.pixel(sight, b.anchor))))
            return false;
    return true;
}

}  // namespace render

#include "timeseries/index/point_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/curvilinear.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/index/cell_corners.h"

namespace timeseries {
namespace {

// Of the mesh's extent: what is less far apart is in one place, to what a mesh keeps of places.
constexpr double kOnePlace = 0x1p-22;
// No gradient of a range over such ways is more.
constexpr double kSteepest = 0x1p23;

// In units of the mesh's extent and of the range of values.
class Scaled {
 public:
    Scaled(const Field& field, const Mesh& mesh) : field_(field), mesh_(mesh) {
        const glm::dvec3 extent = mesh.hi() - mesh.lo();
        for (int a = 0; a < 3; ++a)
            if (extent[a] > 0) extent_[a] = extent[a];
        double lo = std::numeric_limits<double>::infinity(), hi = -lo;
        for (std::uint64_t i = 0; i < mesh.count(); ++i) {
            const double v = finiteValue(field, i);
            lo = v < lo ? v : lo;  // NaN is neither
            hi = v > hi ? v : hi;
        }
        if (hi > lo)
            range_ = 2 * std::min(0.5 * hi - 0.5 * lo, 0.5 * std::numeric_limits<double>::max());
    }
    const glm::dvec3& extent() const { return extent_; }
    double range() const { return range_; }
    // After which longitudes come round, if they do.
    double turn() const { return mesh_.period().x / extent_.x; }
    double value(std::uint64_t point) const { return finiteValue(field_, point); }
    double between(double from, double to) const {
        return (0.5 * to - 0.5 * from) / (0.5 * range_);
    }
    glm::dvec3 place(std::uint64_t point) const { return mesh_.cornerPosition(point); }
    glm::dvec3 way(const glm::dvec3& from, const glm::dvec3& to) const {
        return shorterWay(to - from, mesh_.period()) / extent_;
    }

 private:
    const Field& field_;
    const Mesh& mesh_;
    glm::dvec3 extent_{1};
    double range_ = 0;
};

struct Difference {
    glm::dvec3 way{0};
    double change = 0;
    bool isNumber() const { return isPlace(way) && std::isfinite(change); }
    bool isInPlace() const { return !(glm::length(way) > kOnePlace); }
};
using Differences = std::array<Difference, 3>;

double turnOf(const Differences& by) {
    return glm::dot(by[0].way, glm::cross(by[1].way, by[2].way));
}
// The gradient with these differences times that, by Cramer's rule.
glm::dvec3 gradientTimesTurn(const Differences& by) {
    return by[0].change * glm::cross(by[1].way, by[2].way) +
           by[1].change * glm::cross(by[2].way, by[0].way) +
           by[2].change * glm::cross(by[0].way, by[1].way);
}

// The gradient with these differences, and none along a way that is missing.
glm::dvec3 gradientOf(Differences by) {
    constexpr double kFlattest = 1e-9;  // of a box of such sides
    const auto which = [&](bool there) {
        return static_cast<std::size_t>(std::ranges::find(by, !there, &Difference::isInPlace) -
                                        by.begin());
    };
    const auto count = std::ranges::count(by, false, &Difference::isInPlace);
    if (count == 0) return glm::dvec3(0);
    if (count == 1) {
        const Difference& only = by[which(true)];
        return only.change / glm::dot(only.way, only.way) * only.way;
    }
    if (count == 2) {
        const std::size_t a = which(false);
        const glm::dvec3 &b = by[(a + 1) % 3].way, &c = by[(a + 2) % 3].way;
        by[a] = {glm::cross(b, c) / std::sqrt(glm::length(b) * glm::length(c)), 0};
    }
    const double turn = turnOf(by);
    const double sides = glm::length(by[0].way) * glm::length(by[1].way) * glm::length(by[2].way);
    return std::abs(turn) > kFlattest * sides ? gradientTimesTurn(by) / turn : glm::dvec3(0);
}

// Differences between points that have neighbours.
class Neighbours {
 public:
    Neighbours(const Scaled& scaled, const std::array<std::size_t, 3>& size)
        : scaled_(scaled), size_(size), step_{1, size[0], size[0] * size[1]} {}

    glm::dvec3 gradientAt(std::uint64_t point) const {
        Differences by;
        for (std::size_t a = 0; a < 3; ++a) by[a] = along(point, a);
        for (std::size_t a = 0; a < 3; ++a)
            if (by[a].isInPlace() && isOnePlace(point, a))
                for (const std::size_t other : {(a + 1) % 3, (a + 2) % 3})
                    lookAcross(point, a, other, by);
        return gradientOf(by);
    }

 private:
    std::uint64_t placeAlong(std::uint64_t point, std::size_t axis) const {
        return indicesOf<std::uint64_t>(point,
                                        {size_[0], size_[1], size_[2]})[static_cast<int>(axis)];
    }
    Difference between(std::uint64_t from, std::uint64_t to) const {
        return {scaled_.way(scaled_.place(from), scaled_.place(to)),
                scaled_.between(scaled_.value(from), scaled_.value(to))};
    }
    // Whether the points before and after along an axis are where the point is.
    bool isOnePlace(std::uint64_t point, std::size_t axis) const {
        const std::uint64_t at = placeAlong(point, axis);
        const auto isHere = [&](std::uint64_t other) {
            return Difference{scaled_.way(scaled_.place(point), scaled_.place(other))}.isInPlace();
        };
        return size_[axis] > 1 && (at == 0 || isHere(point - step_[axis])) &&
               (at + 1 == size_[axis] || isHere(point + step_[axis]));
    }
    Difference along(std::uint64_t point, std::size_t axis) const {
        const std::uint64_t at = placeAlong(point, axis);
        const std::uint64_t below = at > 0 ? point - step_[axis] : beyond(point, axis);
        const std::uint64_t above =
            at + 1 < size_[axis] ? point + step_[axis] : beyond(point, axis);
        for (const auto& [from, to] :
             {std::pair(below, above), std::pair(below, point), std::pair(point, above)}) {
            if (from == to) continue;
            const Difference one = between(from, to);
            if (one.isNumber()) return one;
        }
        return {};
    }
    // Of a line's end, the point that comes next where the line comes round: the other end, if it
    // is a step on, or one before that, where the ends of a line are its beginning again. Else
    // itself.
    std::uint64_t beyond(std::uint64_t point, std::size_t axis) const {
        constexpr std::uint64_t kMostAgain = 2;
        const std::uint64_t at = placeAlong(point, axis), last = size_[axis] - 1;
        if (last < 2) return point;
        const auto numbered = [&](std::uint64_t steps) {  // from the line's other end
            return point - at * step_[axis] + (at == 0 ? last - steps : steps) * step_[axis];
        };
        const glm::dvec3 place = scaled_.place(point);
        const glm::dvec3 step = scaled_.way(scaled_.place(numbered(last - 1)), place);
        bool isAgain = false;  // the last one is in this place
        for (std::uint64_t k = 0; k <= kMostAgain && k + 1 < last; ++k) {
            const glm::dvec3 round = scaled_.way(place, scaled_.place(numbered(k)));
            const double ratio = glm::dot(round, step) / glm::dot(step, step);
            if (isAgain ? ratio > 0.1 : ratio > 0.5 && ratio < 2) return numbered(k);
            isAgain = glm::dot(round, round) < 1e-6 * glm::dot(step, step);
        }
        return point;
    }
    // Where all of a line along an axis is in one place, at an end of another axis, along which the
    // lines that are next to it come round: what differs from one side to the other, and from a
    // quarter of the way round to three quarters.
    void lookAcross(std::uint64_t point, std::size_t axis, std::size_t other,
                    Differences& by) const {
        const std::uint64_t at = placeAlong(point, other), last = size_[other] - 1;
        if (last == 0 || (at > 0 && at < last)) return;
        const std::uint64_t next = at == 0 ? point + step_[other] : point - step_[other];
        const std::uint64_t here = placeAlong(next, axis), first = next - here * step_[axis];
        const std::uint64_t end = first + (size_[axis] - 1) * step_[axis];
        const std::uint64_t before = beyond(first, axis);
        if (before == first || isOnePlace(next, axis)) return;
        // The points of the line that are not its beginning again.
        const std::uint64_t around = size_[axis] - (end - before) / step_[axis];
        const auto after = [&](std::uint64_t steps) {
            return first + (here + steps) % around * step_[axis];
        };
        const std::pair ways{between(after(around / 2), next),
                             between(after(3 * around / 4), after(around / 4))};
        if (!ways.first.isNumber() || !ways.second.isNumber()) return;
        by[other] = ways.first;
        by[axis] = ways.second;
    }

    const Scaled& scaled_;
    std::array<std::size_t, 3> size_;
    std::array<std::uint64_t, 3> step_;
};

// What the tetrahedra of solid cells have at some of their points, from `first` on.
class SumsAtPoints {
 public:
    SumsAtPoints(const Scaled& scaled, std::uint64_t first, std::size_t count)
        : scaled_(scaled), first_(first), sums_(count) {}

    bool has(std::uint64_t point) const { return point - first_ < sums_.size(); }
    void add(const std::array<std::uint32_t, 4>& points) {
        if (std::ranges::none_of(points, [&](std::uint32_t point) { return has(point); })) return;
        std::array<double, 4> values{};
        for (std::size_t i = 0; i < 4; ++i) values[i] = scaled_.value(points[i]);
        const unsigned there = fillTetrahedron(values);
        if (there == 0) return;
        const glm::dvec3 origin = scaled_.place(points[0]);
        Differences by;
        glm::dvec3 least(0), most(0);
        for (std::size_t i = 0; i < 3; ++i) {
            by[i] = {scaled_.way(origin, scaled_.place(points[i + 1])),
                     scaled_.between(values[0], values[i + 1])};
            least = glm::min(least, by[i].way);
            most = glm::max(most, by[i].way);
        }
        if (SolidCells::isAboutPole(most.x - least.x, scaled_.turn())) return;
        const double turn = turnOf(by);
        if (!std::isfinite(turn)) return;
        constexpr double kOfMissing = 1e-6;
        const double weight = (turn < 0 ? -1 : 1) * (there < 15 ? kOfMissing : 1);
        const glm::dvec3 gradient = weight * gradientTimesTurn(by);
        for (const std::uint32_t point : points) {
            if (!has(point)) continue;
            sums_[point - first_].gradient += gradient;
            sums_[point - first_].turn += weight * turn;
        }
    }
    glm::dvec3 mean(std::size_t i) const {
        return sums_[i].turn > 0 ? sums_[i].gradient / sums_[i].turn : glm::dvec3(0);
    }

 private:
    struct Sum {
        glm::dvec3 gradient{0};  // times the volumes
        double turn = 0;         // six times these
    };
    const Scaled& scaled_;
    std::uint64_t first_;
    std::vector<Sum> sums_;
};

// What solid cells have that are parted about their middles.
class AboutMiddles {
 public:
    AboutMiddles(const Scaled& scaled, const SolidCells& cells)
        : scaled_(scaled), cells_(cells), turns_(cells.count()) {}

    // The mean in it; none where its value is missing.
    glm::dvec3 gradientIn(std::uint64_t cell) {
        const std::uint32_t middle = cells_.middle(cell);
        const double own = scaled_.value(middle);
        if (std::isnan(own)) return glm::dvec3(0);
        const glm::dvec3 at = scaled_.place(middle);
        glm::dvec3 gradient(0);
        double turn = 0;
        // By Gauss: over the closed surface the field times the areas.
        cells_.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& points) {
            std::array<glm::dvec3, 3> way;
            double change = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                way[i] = scaled_.way(at, scaled_.place(points[i + 1]));
                change += scaled_.between(own, scaled_.value(points[i + 1]));
            }
            const glm::dvec3 area = glm::cross(way[1] - way[0], way[2] - way[0]);
            const double out = glm::dot(way[0], area);
            if (!std::isfinite(out)) return;
            gradient += (out < 0 ? -change : change) * area;
            turn += std::abs(out);
        });
        turns_[cell] = turn;
        return turn > 0 ? gradient / turn : glm::dvec3(0);
    }
    // After that, put(node, gradient) for the nodes from one to before another: the means of those
    // of their cells, gradientOf(middle), by volume.
    template <typename GradientOf, typename Put>
    void forEachNode(std::uint64_t first, std::uint64_t end, const GradientOf& gradientOf,
                     const Put& put) const {
        std::vector<glm::dvec4> sums(end - first, glm::dvec4(0));
        for (std::uint64_t cell = 0; cell < cells_.count(); ++cell) {
            if (!(turns_[cell] > 0)) continue;
            const glm::dvec4 of(turns_[cell] * gradientOf(cells_.middle(cell)), turns_[cell]);
            cells_.forEachNode(cell, [&](std::uint32_t node) {
                if (node >= first && node < end) sums[node - first] += of;
            });
        }
        for (std::uint64_t node = first; node < end; ++node)
            if (const glm::dvec4& sum = sums[node - first]; sum.w > 0)
                put(node, glm::dvec3(sum) / sum.w);
    }

 private:
    const Scaled& scaled_;
    const SolidCells& cells_;
    LargeVector<double> turns_;  // of each cell six times its volume
};

}  // namespace

PointGradients::PointGradients(const Field& field, const std::shared_ptr<const Mesh>& mesh,
                               unsigned threads)
    : mesh_(mesh), stored_(mesh->corners()) {
    const Scaled scaled(field, *mesh);
    range_ = scaled.range();
    extent_ = scaled.extent();
    if (range_ == 0) return;
    const auto parts = threadsFor(stored_.size(), std::size_t{1} << 12, std::max(threads, 1u));
    const auto put = [&](std::uint64_t point, const glm::dvec3& gradient) {
        stored_[point] = glm::vec3(glm::clamp(gradient, -kSteepest, kSteepest) / kPerStored);
    };
    // look(first, end) of so many.
    const auto inSuchParts = [&](std::uint64_t count, const auto& look) {
        sharing(parts, [&](unsigned k) { look(count * k / parts, count * (k + 1) / parts); });
    };
    if (mesh->solids() && mesh->solids()->haveMiddles()) {
        const SolidCells& cells = *mesh->solids();
        AboutMiddles all(scaled, cells);
        inSuchParts(cells.count(), [&](std::uint64_t cell, std::uint64_t end) {
            for (; cell < end; ++cell) put(cells.middle(cell), all.gradientIn(cell));
        });
        const std::uint64_t first = cells.firstNode(), nodes = stored_.size() - first;
        const auto own = [&](std::uint32_t middle) { return at(middle); };
        inSuchParts(nodes, [&](std::uint64_t from, std::uint64_t to) {
            all.forEachNode(first + from, first + to, own, put);
        });
        return;
    }
    inSuchParts(stored_.size(), [&](std::uint64_t first, std::uint64_t end) {
        if (mesh->hasNeighbours()) {
            const Neighbours neighbours(scaled, mesh->size());
            for (std::uint64_t i = first; i < end; ++i) put(i, neighbours.gradientAt(i));
            return;
        }
        SumsAtPoints sums(scaled, first, end - first);
        const SolidCells& solids = *mesh->solids();
        SolidCells::Room room;
        for (std::uint64_t cell = 0; cell < solids.count(); ++cell)
            if (std::ranges::any_of(solids.corners(cell, room),
                                    [&](std::uint32_t point) { return sums.has(point); }))
                solids.forEachTet(cell, [&](const auto& points) { sums.add(points); });
        for (std::uint64_t i = first; i < end; ++i) put(i, sums.mean(i - first));
    });
}

}  // namespace timeseries

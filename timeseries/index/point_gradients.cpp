#include "timeseries/index/point_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/curvilinear.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/index/cell_corners.h"

namespace timeseries {
namespace {

// Less of a length, and of a volume of such edges, is none.
constexpr double kNoLength = 1e-9;

// In units of the mesh's extent and of the range of values, which floats hold.
class Scaled {
 public:
    Scaled(const Field& field, const Mesh& mesh) : field_(field), mesh_(mesh) {
        const glm::dvec3 extent = mesh.hi() - mesh.lo();
        for (int a = 0; a < 3; ++a) perLength_[a] = extent[a] > 0 ? 1 / extent[a] : 1;
        double lo = std::numeric_limits<double>::infinity(), hi = -lo;
        for (std::uint64_t i = 0; i < mesh.count(); ++i) {
            const double v = finiteValue(field, i);
            lo = v < lo ? v : lo;  // NaN is neither
            hi = v > hi ? v : hi;
        }
        if (hi > lo) half_ = 0.5 * hi - 0.5 * lo;
    }
    bool isFlat() const { return half_ == 0; }
    // What a gradient in these units is times.
    glm::dvec3 unit() const {
        return std::min(2 * half_, std::numeric_limits<double>::max()) * perLength_;
    }
    // After which longitudes come round, if they do.
    double turn() const { return perLength_.x * mesh_.period().x; }
    double value(std::uint64_t point) const { return finiteValue(field_, point); }
    double between(double from, double to) const { return (0.5 * to - 0.5 * from) / half_; }
    glm::dvec3 place(std::uint64_t point) const { return mesh_.position(point); }
    glm::dvec3 way(const glm::dvec3& from, const glm::dvec3& to) const {
        return perLength_ * shorterWay(to - from, mesh_.period());
    }

 private:
    const Field& field_;
    const Mesh& mesh_;
    glm::dvec3 perLength_{1};
    double half_ = 0;  // of the range
};

struct Difference {
    glm::dvec3 way{0};
    double change = 0;
    bool isNumber() const { return isPlace(way) && std::isfinite(change); }
};

// The gradient with these differences, and none along a way that is missing.
glm::dvec3 gradientOf(std::array<Difference, 3> by) {
    const auto lengthOf = [&](std::size_t a) { return glm::length(by[a].way); };
    const double longest = std::max({lengthOf(0), lengthOf(1), lengthOf(2)});
    std::array<bool, 3> isThere{};
    for (std::size_t a = 0; a < 3; ++a)
        isThere[a] = lengthOf(a) > kNoLength * longest && longest > 0;
    const auto count = std::ranges::count(isThere, true);
    if (count == 0) return glm::dvec3(0);
    const auto which = [&](bool there) {
        return static_cast<std::size_t>(std::ranges::find(isThere, there) - isThere.begin());
    };
    if (count == 1) {
        const Difference& only = by[which(true)];
        return only.change / glm::dot(only.way, only.way) * only.way;
    }
    if (count == 2) {
        const std::size_t a = which(false);
        const glm::dvec3 &b = by[(a + 1) % 3].way, &c = by[(a + 2) % 3].way;
        by[a] = {glm::cross(b, c) / std::sqrt(glm::length(b) * glm::length(c)), 0};
    }
    const glm::dvec3 bc = glm::cross(by[1].way, by[2].way);
    const double turn = glm::dot(by[0].way, bc);
    if (!(std::abs(turn) > kNoLength * lengthOf(0) * lengthOf(1) * lengthOf(2)))
        return glm::dvec3(0);
    return (by[0].change * bc + by[1].change * glm::cross(by[2].way, by[0].way) +
            by[2].change * glm::cross(by[0].way, by[1].way)) /
           turn;
}

// Differences between points that have neighbours.
class Neighbours {
 public:
    Neighbours(const Scaled& scaled, const std::array<std::size_t, 3>& size)
        : scaled_(scaled), size_(size), step_{1, size[0], size[0] * size[1]} {}

    glm::dvec3 gradientAt(std::uint64_t point) const {
        std::array<Difference, 3> by;
        for (std::size_t a = 0; a < 3; ++a) by[a] = along(point, a);
        return gradientOf(by);
    }

 private:
    Difference between(std::uint64_t from, std::uint64_t to) const {
        return {scaled_.way(scaled_.place(from), scaled_.place(to)),
                scaled_.between(scaled_.value(from), scaled_.value(to))};
    }
    Difference along(std::uint64_t point, std::size_t axis) const {
        const std::uint64_t at = point / step_[axis] % size_[axis];
        const std::uint64_t below = at > 0 ? point - step_[axis] : beyond(point, at, axis);
        const std::uint64_t above =
            at + 1 < size_[axis] ? point + step_[axis] : beyond(point, at, axis);
        for (const auto& [from, to] :
             {std::pair(below, above), std::pair(below, point), std::pair(point, above)}) {
            if (from == to) continue;
            const Difference one = between(from, to);
            if (one.isNumber()) return one;
        }
        return {};
    }
    // Of a line's end, the point that comes next where it comes round: beside the other end, if
    // both are one place, or that end, if it is a step away; else itself.
    std::uint64_t beyond(std::uint64_t point, std::uint64_t at, std::size_t axis) const {
        constexpr double kOnePlace = 1e-3;
        const std::uint64_t last = size_[axis] - 1;
        if (last < 2) return point;
        const auto from = [&](std::uint64_t steps) {
            return point - at * step_[axis] + steps * step_[axis];
        };
        const std::uint64_t inward = from(at == 0 ? 1 : last - 1), other = from(last - at);
        const glm::dvec3 place = scaled_.place(point);
        const glm::dvec3 step = scaled_.way(scaled_.place(inward), place);
        const glm::dvec3 round = scaled_.way(place, scaled_.place(other));
        const double step2 = glm::dot(step, step);
        if (glm::dot(round, round) < kOnePlace * kOnePlace * step2)
            return from(at == 0 ? last - 1 : 1);
        const double ratio = glm::dot(round, step) / step2;
        return ratio > 0.5 && ratio < 2 ? other : point;
    }

    const Scaled& scaled_;
    std::array<std::size_t, 3> size_;
    std::array<std::uint64_t, 3> step_;
};

// What the tetrahedra of solid cells have at some of their points, from `first` on.
class SumsAtPoints {
 public:
    SumsAtPoints(const Scaled& scaled, std::uint64_t first, std::span<glm::vec3> sums)
        : scaled_(scaled), first_(first), sums_(sums), volumes_(sums.size()) {}

    bool has(std::uint64_t point) const { return point - first_ < sums_.size(); }
    void add(const std::array<std::uint32_t, 4>& points) {
        if (std::ranges::none_of(points, [&](std::uint32_t point) { return has(point); })) return;
        std::array<double, 4> values{};
        const unsigned there = takeValues(points, values);
        if (there == 0) return;
        const glm::dvec3 origin = scaled_.place(points[0]);
        std::array<Difference, 3> by;
        glm::dvec3 least(0), most(0);
        for (std::size_t i = 0; i < 3; ++i) {
            by[i] = {scaled_.way(origin, scaled_.place(points[i + 1])),
                     scaled_.between(values[0], values[i + 1])};
            least = glm::min(least, by[i].way);
            most = glm::max(most, by[i].way);
        }
        if (SolidCells::isAboutPole(most.x - least.x, scaled_.turn())) return;
        const glm::dvec3 bc = glm::cross(by[1].way, by[2].way);
        const double turn = glm::dot(by[0].way, bc);
        if (!std::isfinite(turn)) return;
        // Of the gradient times the volume, which no division makes large where this is small.
        const glm::dvec3 sum = by[0].change * bc + by[1].change * glm::cross(by[2].way, by[0].way) +
                               by[2].change * glm::cross(by[0].way, by[1].way);
        constexpr double kOfMissing = 1e-6;
        const double weight = (turn < 0 ? -1 : 1) * (there < 4 ? kOfMissing : 1);
        for (const std::uint32_t point : points) {
            if (!has(point)) continue;
            sums_[point - first_] += glm::vec3(weight * sum);
            volumes_[point - first_] += static_cast<float>(weight * turn);
        }
    }
    void divide() {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] = volumes_[i] > 0 ? sums_[i] / volumes_[i] : glm::vec3(0);
    }

 private:
    // How many there are.
    unsigned takeValues(const std::array<std::uint32_t, 4>& points,
                        std::array<double, 4>& values) const {
        unsigned there = 0;
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            values[i] = scaled_.value(points[i]);
            if (std::isnan(values[i])) continue;
            ++there;
            sum += values[i] / 4;  // no sum of four overflows
        }
        for (double& value : values)
            if (std::isnan(value)) value = sum * (4.0 / there);
        return there;
    }

    const Scaled& scaled_;
    std::uint64_t first_;
    std::span<glm::vec3> sums_;
    std::vector<float> volumes_;
};

}  // namespace

PointGradients::PointGradients(const Field& field, std::shared_ptr<const Mesh> mesh,
                               unsigned threads)
    : mesh_(std::move(mesh)), stored_(mesh_->count()) {
    const Scaled scaled(field, *mesh_);
    if (scaled.isFlat()) return;
    unit_ = scaled.unit();
    const auto parts = threadsFor(stored_.size(), std::size_t{1} << 12, std::max(threads, 1u));
    sharing(parts, [&](unsigned k) {
        const std::uint64_t first = stored_.size() * k / parts;
        const auto some =
            std::span(stored_).subspan(first, stored_.size() * (k + 1) / parts - first);
        if (mesh_->hasNeighbours()) {
            const Neighbours neighbours(scaled, mesh_->size());
            for (std::size_t i = 0; i < some.size(); ++i)
                some[i] = glm::vec3(neighbours.gradientAt(first + i));
            return;
        }
        SumsAtPoints sums(scaled, first, some);
        const SolidCells& solids = *mesh_->solids();
        SolidCells::Room room;
        for (std::uint64_t cell = 0; cell < solids.count(); ++cell)
            if (std::ranges::any_of(solids.corners(cell, room),
                                    [&](std::uint32_t point) { return sums.has(point); }))
                solids.forEachTet(cell, [&](const auto& points) { sums.add(points); });
        sums.divide();
    });
}

}  // namespace timeseries

// The middle and half the range of what each cell has at its corners, for CellIndex to put in
// classes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <variant>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/index/cell_corners.h"

namespace timeseries {

// What rows of cells along x take from their four rows of points, one row after another. Real has
// each value exactly.
template <typename Real>
class RowExtents {
 public:
    explicit RowExtents(const Field& field)
        : field_(field),
          points_(field.grid->size()[0], field.grid->size()[1], field.grid->size()[2]),
          least_(points_.x + 1),
          greatest_(points_.x + 1) {}

    void look(std::uint32_t j, std::uint32_t k) {
        const Pair& one = pairAt(neighbour(j, 0, points_.y), k);
        const Pair& other = pairAt(neighbour(j, 1, points_.y), k);
        const std::size_t n = points_.x;
        const auto of = [&](const auto& nearer, const Line& a, const Line& b, Line& to) {
            to[0] = nearer(a[0], b[0]);
            for (std::size_t i = 1; i < n; ++i)
                to[i] = nearer(nearer(a[i - 1], b[i - 1]), nearer(a[i], b[i]));
            to[n] = nearer(a[n - 1], b[n - 1]);
        };
        of([](Real a, Real b) { return a < b ? a : b; }, one.least, other.least, least_);
        of([](Real a, Real b) { return a > b ? a : b; }, one.greatest, other.greatest, greatest_);
    }
    // Half the range, and the middle, of the cell between two points; false where nothing is
    // finite.
    bool at(std::size_t cell, double& half, double& middle) const {
        const auto lo = static_cast<double>(least_[cell]);
        const auto hi = static_cast<double>(greatest_[cell]);
        half = 0.5 * hi - 0.5 * lo;
        middle = 0.5 * hi + 0.5 * lo;
        return lo <= hi;
    }

 private:
    using Line = std::vector<Real>;
    static std::uint32_t neighbour(std::uint32_t cell, std::uint32_t side, std::uint32_t points) {
        return std::min(cell + side > 0 ? cell + side - 1 : 0, points - 1);
    }
    static constexpr Real kBeyond = std::numeric_limits<Real>::infinity();
    // Of two rows of points, on both sides of cells along z: what the next cells along y take, too.
    struct Pair {
        std::int64_t y = -1, k = -1;
        Line least, greatest;  // inf, -inf where neither has a value
    };

    const Pair& pairAt(std::uint32_t y, std::uint32_t k) {
        Pair& pair = pairs_[y & 1];
        if (pair.y == y && pair.k == k) return pair;
        pair.y = y;
        pair.k = k;
        pair.least.assign(points_.x, kBeyond);
        pair.greatest.assign(points_.x, -kBeyond);
        for (const std::uint32_t side : {0u, 1u}) {
            const std::uint64_t z = neighbour(k, side, points_.z);
            const std::uint64_t first = points_.x * (y + std::uint64_t{points_.y} * z);
            std::visit([&](const auto& values) { add(&values[first], first, pair); },
                       field_.values);
        }
        return pair;
    }
    template <typename T>
    void add(const T* values, std::uint64_t first, Pair& to) const {
        Real* const least = to.least.data();
        Real* const greatest = to.greatest.data();
        const auto take = [&](std::size_t i, bool isThere) {
            const auto v = static_cast<Real>(values[i]);
            const bool counts = isThere && v > -kBeyond && v < kBeyond;
            const Real low = counts ? v : kBeyond, high = counts ? v : -kBeyond;
            least[i] = low < least[i] ? low : least[i];
            greatest[i] = high > greatest[i] ? high : greatest[i];
        };
        if (field_.missing.empty())
            for (std::size_t i = 0; i < points_.x; ++i) take(i, true);
        else
            for (std::size_t i = 0; i < points_.x; ++i) take(i, !field_.missing[first + i]);
    }

    const Field& field_;
    glm::uvec3 points_;
    std::array<Pair, 2> pairs_;
    Line least_, greatest_;  // of cells
};

// What solid cells take from their corners.
class SolidExtents {
 public:
    SolidExtents(const Field& field, const SolidCells& cells) : field_(field), cells_(cells) {}
    // As RowExtents::at().
    bool at(std::uint64_t cell, double& half, double& middle) const {
        if (cells_.haveMiddles() && std::isnan(finiteValue(field_, cells_.middle(cell))))
            return false;
        SolidCells::Room room;
        const auto [lo, hi] = finiteExtent(field_, cells_.corners(cell, room));
        half = 0.5 * hi - 0.5 * lo;
        middle = 0.5 * hi + 0.5 * lo;
        return lo <= hi;
    }

 private:
    const Field& field_;
    const SolidCells& cells_;
};

}  // namespace timeseries

#include "timeseries/grid/curvilinear.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "timeseries/grid/grid.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

glm::dvec3 perpendicularTo(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    if (a.x <= a.y && a.x <= a.z) return glm::cross(v, glm::dvec3(1, 0, 0));
    return glm::cross(v, a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
}

// Gives the columns along indices without extent this length, across the others, right-handed.
void thicken(glm::dmat3& cell, const MeshPlaces& places, double thickness) {
    const auto isThin = [&](int a) { return places.isThin(static_cast<std::size_t>(a % 3)); };
    const auto along = [&](const glm::dvec3& v) {
        const double length = glm::length(v);
        return length > 0 ? v / length * thickness : glm::dvec3(0);
    };
    if (isThin(0) && isThin(1) && isThin(2)) cell = glm::dmat3(thickness);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        if (isThin(a) && !isThin(b) && !isThin(c)) cell[a] = along(glm::cross(cell[b], cell[c]));
        if (!isThin(a) && isThin(b) && isThin(c)) {
            cell[b] = along(perpendicularTo(cell[a]));
            cell[c] = along(glm::cross(cell[a], cell[b]));
        }
    }
}

int thinAxes(const MeshPlaces& places) {
    return int{places.isThin(0)} + int{places.isThin(1)} + int{places.isThin(2)};
}

}  // namespace

bool isPlace(const glm::dvec3& at) {
    return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
}

CurvilinearCells::CurvilinearCells(const MeshPlaces& places)
    : places_(places),
      rings_(places),
      stride_{1, places.size[0], std::uint64_t{places.size[0]} * places.size[1]},
      firstHeight_(places.levels.size() > 1 ? places.levels[1] - places.levels[0] : 0) {
    const int thin = thinAxes(places);
    if (thin > 0) thickness_ = thin == 3 ? 1 : thin == 2 ? meanWidth() : std::sqrt(meanWidth());
}

// Of a surface's cells the area, of a thread's the length.
double CurvilinearCells::meanWidth() const {
    const bool isSurface = thinAxes(places_) == 1;
    const auto widthOf = [&](std::size_t row) {
        if (!isPlace(places_.at[row])) return 0.0;
        const glm::dmat3 steps = stepsAt(row);
        glm::dvec3 one(0), other(0);  // the columns that are not 0
        for (int a = 0; a < 3; ++a)
            if (!places_.isThin(static_cast<std::size_t>(a)))
                (one == glm::dvec3(0) ? one : other) = steps[a];
        return glm::length(isSurface ? glm::cross(one, other) : one);
    };
    const auto placed = std::ranges::count_if(places_.at, isPlace);
    return sumOf(places_.at.size(), widthOf) / static_cast<double>(placed);
}

glm::dvec3 CurvilinearCells::way(std::uint64_t from, std::uint64_t to) const {
    return shorterWay(places_.at[to] - places_.at[from], places_.period);
}

glm::dvec3 CurvilinearCells::longestWay() const {
    const glm::vec<3, std::uint64_t> size(places_.size[0], places_.size[1], places_.size[2]);
    const unsigned threads = threadsFor(places_.at.size(), 1 << 14);
    std::vector<glm::dvec3> longest(threads, glm::dvec3(0));
    together(threads, [&](unsigned k) {
        for (std::uint64_t row = places_.at.size() * k / threads;
             row < places_.at.size() * (k + 1) / threads; ++row) {
            const auto at = indicesOf(row, size);
            for (int a = 0; a < (places_.levels.empty() ? 3 : 2); ++a) {
                if (at[a] + 1 == size[a]) continue;
                const glm::dvec3 along = way(row, row + stride_[static_cast<std::size_t>(a)]);
                if (isPlace(along)) longest[k] = glm::max(longest[k], glm::abs(along));
            }
        }
    });
    glm::dvec3 most(0);
    for (const glm::dvec3& each : longest) most = glm::max(most, each);
    for (std::size_t k = 1; k < places_.levels.size(); ++k)
        most.z = std::max(most.z, std::abs(places_.levels[k] - places_.levels[k - 1]));
    return most;
}

std::uint64_t CurvilinearCells::oneSided() const {
    if (!places_.corners.at.empty()) return 0;
    const glm::vec<3, std::uint64_t> size(places_.size[0], places_.size[1], places_.size[2]);
    const auto isOneSided = [&](std::uint64_t row) {
        if (!isPlace(places_.at[row])) return false;
        const auto at = indicesOf(row, size);
        bool found = false;
        for (int a = 0; a < (places_.levels.empty() ? 3 : 2); ++a) {
            if (size[a] == 1) continue;
            const std::uint64_t stride = stride_[static_cast<std::size_t>(a)];
            const bool hasBefore = at[a] > 0, hasAfter = at[a] + 1 < size[a];
            const bool before = hasBefore && isPlace(places_.at[row - stride]);
            const bool after = hasAfter && isPlace(places_.at[row + stride]);
            if (!before && !after) return false;  // no cell at all
            found = found || before != hasBefore || after != hasAfter;
        }
        return found;
    };
    return sumOf(places_.at.size(),
                 [&](std::size_t row) { return std::uint64_t{isOneSided(row)}; });
}

// The mean of the ways from the point before and to the one after, or the only one of these that
// leads anywhere.
glm::dvec3 CurvilinearCells::stepAlong(std::uint64_t row, std::size_t axis, bool hasBefore,
                                       bool hasAfter) const {
    glm::dvec3 before(0), after(0);
    if (hasBefore) hasBefore = isPlace(before = way(row - stride_[axis], row));
    if (hasAfter) hasAfter = isPlace(after = way(row, row + stride_[axis]));
    if (hasBefore && hasAfter) return 0.5 * (before + after);
    return hasBefore ? before : hasAfter ? after : glm::dvec3(0);
}

// The mean of the ways to the second point of its line and from the last but one, if the line goes
// on there: it may also come back, as those on both sides of a wake do.
std::optional<glm::dvec3> CurvilinearCells::stepAcrossSeam(std::uint64_t row, std::size_t axis,
                                                           std::uint64_t at) const {
    constexpr double kOnePlace = 1e-3, kGoesOn = 0.5;  // of a step
    const std::uint64_t stride = stride_[axis], last = places_.size[axis] - 1;
    if (last < 2 || (at > 0 && at < last) || (axis == 2 && !places_.levels.empty())) return {};
    if (!places_.corners.at.empty()) return {};
    const std::uint64_t first = row - at * stride, end = first + last * stride;
    const glm::dvec3 after = places_.at[first + stride] - places_.at[first];
    const glm::dvec3 before = places_.at[end] - places_.at[end - stride];
    const glm::dvec3 step = 0.5 * (before + after);
    const double length = glm::length(step);
    const bool goesOn = length > kGoesOn * std::max(glm::length(before), glm::length(after));
    const double apart = glm::distance(places_.at[first], places_.at[end]);
    return goesOn && apart < kOnePlace * length ? std::optional(step) : std::nullopt;
}

// Between its corners a cell is trilinear: with u, v and w from -1 to 1, bits 1, 2 and 4 of m, a
// place is the sum of c[m] times those that are in m. The volume is the integral of the determinant
// of its slopes, of which only squares leave anything.
glm::dmat3 CurvilinearCells::sidesAt(const glm::vec<3, std::uint64_t>& at) const {
    constexpr double kMostLonger = 8;  // of volumes; a pyramid has 4 / 3
    const auto& corners = places_.corners;
    std::array<glm::dvec3, 7> c{};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto of = [&](int axis) {
            const bool isFar = corners.size[static_cast<std::size_t>(axis)] > 1;
            return at[axis] + (isFar ? corner >> axis & 1 : 0);
        };
        const glm::dvec3 place =
            corners.at[of(0) + corners.size[0] * (of(1) + corners.size[1] * of(2))] / 8.0;
        for (unsigned m = 1; m < c.size(); ++m)
            c[m] += std::popcount(m & ~corner) % 2 == 0 ? place : -place;
    }
    const auto volume = [](const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) {
        return glm::dot(u, glm::cross(v, w));
    };
    const double straight = volume(c[1], c[2], c[4]);
    const double bent =
        (volume(c[3], c[2], c[6]) + volume(c[1], c[3], c[5]) + volume(c[5], c[6], c[4])) / 3;
    // Where the sides span nothing, a sheet's or a flat cell's, a quotient would be of rounding.
    const bool isThin = std::ranges::find(corners.size, 1u) != corners.size.end();
    const double longer = isThin ? 1 : 1 + bent / straight;
    const bool isCell = longer > 0 && longer < kMostLonger;
    return (isCell ? 2 * std::cbrt(longer) : 2) * glm::dmat3(c[1], c[2], c[4]);
}

glm::dmat3 CurvilinearCells::stepsAt(std::uint64_t row) const {
    const auto& size = places_.size;
    const auto at = indicesOf(row, glm::vec<3, std::uint64_t>(size[0], size[1], size[2]));
    if (!places_.corners.at.empty()) return sidesAt(at);
    glm::dmat3 steps(0.0);
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        if (size[axis] == 1) continue;
        if (a == 2 && !places_.levels.empty())
            steps[2].z = firstHeight_;
        else
            steps[a] = stepAlong(row, axis, at[a] > 0, at[a] + 1 < size[axis]);
    }
    return steps;
}

CurvilinearCells::Cell CurvilinearCells::operator()(std::uint64_t row) const {
    const auto& size = places_.size;
    const auto at = indicesOf(row, glm::vec<3, std::uint64_t>(size[0], size[1], size[2]));
    Cell cell{stepsAt(row), 0};
    for (int a = 0; a < 3; ++a) {
        const auto acrossSeam = stepAcrossSeam(row, static_cast<std::size_t>(a), at[a]);
        if (!acrossSeam) continue;
        cell.steps[a] = *acrossSeam;
        ++cell.widened;
    }
    if (thickness_ > 0) thicken(cell.steps, places_, thickness_);
    if (rings_.empty()) return cell;
    for (int a = 0; a < 3; ++a) {
        const unsigned wider = std::min(rings_.widening(at, a, glm::length(cell.steps[a])),
                                        kMostWidened - cell.widened);
        cell.steps[a] *= std::ldexp(1.0, static_cast<int>(wider));
        cell.widened += wider;
    }
    return cell;
}

}  // namespace timeseries

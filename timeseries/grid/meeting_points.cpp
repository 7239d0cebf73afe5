#include "timeseries/grid/meeting_points.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/curvilinear.h"

namespace timeseries {
namespace {

using Quad = std::array<std::uint32_t, 4>;

// The faces of one brick, as a polyhedron lists them.
class FacesWithPoints {
 public:
    FacesWithPoints(const UnstructuredGrid& grid, const MeetingPoints& places)
        : grid_(grid), places_(places) {}

    // Whether it has more points than a brick's.
    bool take(const Quad& quad, int deep = kDeepest) {
        const std::uint32_t middle = deep > 0 ? between(quad[0], quad[2]) : kNoPoint;
        if (middle == kNoPoint) {
            const std::size_t count = list_.size();
            list_.push_back(0);
            for (std::size_t i = 0; i < 4; ++i) addEdge(quad[i], quad[(i + 1) % 4], deep);
            list_[count] = static_cast<std::uint32_t>(list_.size() - count - 1);
            ++faces_;
            return list_[count] > 4;
        }
        std::array<std::uint32_t, 4> half;
        for (std::size_t i = 0; i < 4; ++i) {
            half[i] = between(quad[i], quad[(i + 1) % 4]);
            if (half[i] == kNoPoint) half[i] = quad[i];  // it is no lattice: a triangle
        }
        for (std::size_t i = 0; i < 4; ++i)
            take({quad[i], half[i], middle, half[(i + 3) % 4]}, deep - 1);
        return true;
    }
    void addTo(std::vector<std::uint32_t>& faces) const {
        faces.push_back(faces_);
        faces.insert(faces.end(), list_.begin(), list_.end());
    }

 private:
    static constexpr int kDeepest = 3;  // levels, or a hostile file would take forever
    std::uint32_t between(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t found = places_.at(0.5 * grid_.points[a] + 0.5 * grid_.points[b]);
        return found == a || found == b ? kNoPoint : found;
    }
    void addEdge(std::uint32_t from, std::uint32_t to, int deep) {
        const std::uint32_t half = deep > 0 ? between(from, to) : kNoPoint;
        if (half == kNoPoint) return list_.push_back(from);
        addEdge(from, half, deep - 1);
        addEdge(half, to, deep - 1);
    }

    const UnstructuredGrid& grid_;
    const MeetingPoints& places_;
    std::uint32_t faces_ = 0;
    std::vector<std::uint32_t> list_;
};

// How far a cell reaches along each coordinate.
glm::vec3 sidesOf(const UnstructuredGrid& grid, std::span<const std::uint32_t> corners) {
    glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (const std::uint32_t corner : corners) {
        lo = glm::min(lo, grid.points[corner]);
        hi = glm::max(hi, grid.points[corner]);
    }
    return glm::vec3(hi - lo);
}

// Cells that may have points on their sides: beside some that are half as long along a coordinate.
std::vector<std::uint32_t> cellsBesideSmaller(const UnstructuredGrid& grid,
                                              const std::vector<std::uint32_t>& first) {
    constexpr float kSmaller = 0.6f;
    std::vector<glm::vec3> shortest(grid.points.size(),
                                    glm::vec3(std::numeric_limits<float>::infinity()));
    const auto forEachBrick = [&](const auto& use) {
        for (std::uint32_t cell = 0; cell < grid.types.size(); ++cell) {
            const CellType* const type = cellTypeOf(grid.types[cell]);
            const bool isBrick = type && type->isBrick && type->corners == 8 && !type->isCurved;
            if (!isBrick) continue;
            const auto corners = listOf(grid.corners, grid.ends, cell);
            use(cell, corners, sidesOf(grid, corners));
        }
    };
    forEachBrick([&](std::uint32_t, const auto& corners, const glm::vec3& sides) {
        for (const std::uint32_t corner : corners)
            shortest[first[corner]] = glm::min(shortest[first[corner]], sides);
    });
    std::vector<std::uint32_t> cells;
    forEachBrick([&](std::uint32_t cell, const auto& corners, const glm::vec3& sides) {
        if (std::ranges::any_of(corners, [&](std::uint32_t corner) {
                return glm::any(glm::lessThan(shortest[first[corner]], kSmaller * sides));
            }))
            cells.push_back(cell);
    });
    return cells;
}

}  // namespace

MeetingPoints::MeetingPoints(const UnstructuredGrid& grid)
    : points_(grid.points), first_(grid.points.size()) {
    std::vector<bool> used(points_.size());
    // More corners are no cell's, and those that a polyhedron lists are not its own.
    const std::uint64_t corners = grid.ends.empty() ? 0 : grid.ends.back();
    for (std::uint64_t i = 0; i < corners; ++i)
        if (grid.corners[i] < used.size()) used[grid.corners[i]] = true;
    for (std::size_t cell = 0; cell < grid.faceEnds.size(); ++cell) {
        const auto list = listOf(grid.faces, grid.faceEnds, cell);
        if (grid.types[cell] != kPolyhedron || list.empty()) continue;
        std::size_t at = 1;
        for (std::uint32_t left = list[0]; left > 0; --left) {
            for (const std::uint32_t corner : list.subspan(at + 1, list[at])) used[corner] = true;
            at += 1 + list[at];
        }
    }
    lo_ = glm::dvec3(std::numeric_limits<double>::infinity());
    hi_ = -lo_;
    const auto isPlaced = [&](std::uint32_t i) { return used[i] && isPlace(points_[i]); };
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        if (!isPlaced(i)) continue;
        lo_ = glm::min(lo_, points_[i]);
        hi_ = glm::max(hi_, points_[i]);
    }
    middle_ = 0.5 * lo_ + 0.5 * hi_;
    half_ = 0.5 * hi_ - 0.5 * lo_;
    hashed_.reserve(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i)
        if (isPlaced(i)) hashed_.push_back(hashOf(cellOf(points_[i])) | i);
    hwy::Sorter()(hashed_.data(), hashed_.size(), hwy::SortAscending());
    std::iota(first_.begin(), first_.end(), 0u);
    for (std::size_t i = 1, same = 0; i < hashed_.size(); ++i) {
        if (hashed_[i] >> 32 != hashed_[i - 1] >> 32) same = i;
        const auto point = static_cast<std::uint32_t>(hashed_[i]);
        if (same < i) first_[point] = at(points_[point]);
    }
}

bool MeetingPoints::isWithin(const glm::dvec3& place) const {
    return place.x >= lo_.x && place.y >= lo_.y && place.z >= lo_.z && place.x <= hi_.x &&
           place.y <= hi_.y && place.z <= hi_.z;
}

MeetingPoints::Cell MeetingPoints::cellOf(const glm::dvec3& place) const {
    // Of lattices few points lie where two cells meet.
    constexpr double kCells = 0x1p32, kBeside = 0.377;
    Cell cell{};
    for (int c = 0; c < 3; ++c)
        if (half_[c] > 0)
            cell[std::size_t(c)] = static_cast<std::int64_t>(
                std::floor((place[c] - middle_[c]) / half_[c] * (kCells / 2) + kBeside));
    return cell;
}

std::uint64_t MeetingPoints::hashOf(const Cell& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash << 32;
}

std::uint32_t MeetingPoints::at(const glm::dvec3& place) const {
    if (!isWithin(place)) return kNoPoint;
    const Cell cell = cellOf(place);
    const std::uint64_t hash = hashOf(cell);
    for (auto it = std::ranges::lower_bound(hashed_, hash);
         it != hashed_.end() && *it >> 32 == hash >> 32; ++it)
        if (const auto point = static_cast<std::uint32_t>(*it); cellOf(points_[point]) == cell)
            return point;
    return kNoPoint;
}

std::optional<UnstructuredGrid> withHangingPoints(const UnstructuredGrid& grid,
                                                  const MeetingPoints& places) {
    if (!grid.faceEnds.empty()) return std::nullopt;
    const std::vector<std::uint32_t>& first = places.first();
    std::map<std::uint32_t, FacesWithPoints> found;
    for (const std::uint32_t cell : cellsBesideSmaller(grid, first)) {
        const auto corners = listOf(grid.corners, grid.ends, cell);
        const CellType& type = *cellTypeOf(grid.types[cell]);
        FacesWithPoints faces(grid, places);
        bool has = false;
        for (std::size_t i = 0; i < type.faces.size(); i += 4) {
            Quad quad;
            for (std::size_t k = 0; k < 4; ++k) quad[k] = first[corners[type.faces[i + k]]];
            has |= faces.take(quad);
        }
        if (has) found.emplace(cell, std::move(faces));
    }
    if (found.empty()) return std::nullopt;
    UnstructuredGrid whole = grid;
    for (std::uint32_t cell = 0; cell < whole.types.size(); ++cell) {
        if (const auto it = found.find(cell); it != found.end()) {
            whole.types[cell] = kPolyhedron;
            it->second.addTo(whole.faces);
        }
        whole.faceEnds.push_back(whole.faces.size());
    }
    return whole;
}

}  // namespace timeseries

#include "timeseries/grid/meeting_points.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/curvilinear.h"

namespace timeseries {
namespace {

using Quad = std::array<std::uint32_t, 4>;

// The faces of one voxel, as a polyhedron lists them.
class FacesWithPoints {
 public:
    FacesWithPoints(const UnstructuredGrid& grid, const MeetingPoints& places)
        : grid_(grid), places_(places) {}

    // Whether it has more points than a voxel's.
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

// Of a voxel.
float sizeOf(const UnstructuredGrid& grid, std::span<const std::uint32_t> corners) {
    if (corners.empty()) return std::numeric_limits<float>::infinity();
    return static_cast<float>(
        glm::distance(grid.points[corners.back()], grid.points[corners.front()]));
}

}  // namespace

MeetingPoints::MeetingPoints(std::span<const glm::dvec3> points)
    : points_(points), first_(points.size()) {
    glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (const glm::dvec3& at : points) {
        if (!isPlace(at)) continue;
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    middle_ = 0.5 * lo + 0.5 * hi;
    half_ = 0.5 * hi - 0.5 * lo;
    hashed_.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (isPlace(points[i])) hashed_.push_back({hashOf(cellOf(points[i])), i});
    std::ranges::sort(hashed_, {}, [](const Hashed& h) { return std::pair(h.hash, h.point); });
    std::iota(first_.begin(), first_.end(), 0u);
    for (std::size_t i = 1, begin = 0; i < hashed_.size(); ++i) {
        if (hashed_[i].hash != hashed_[i - 1].hash) begin = i;
        if (begin < i) first_[hashed_[i].point] = at(points[hashed_[i].point]);
    }
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
    return hash;
}

std::uint32_t MeetingPoints::at(const glm::dvec3& place) const {
    const Cell cell = cellOf(place);
    const std::uint64_t hash = hashOf(cell);
    for (auto it = std::ranges::lower_bound(hashed_, hash, {}, &Hashed::hash);
         it != hashed_.end() && it->hash == hash; ++it)
        if (cellOf(points_[it->point]) == cell) return it->point;
    return kNoPoint;
}

UnstructuredGrid withHangingPoints(UnstructuredGrid grid) {
    if (!grid.faceEnds.empty()) return grid;
    const MeetingPoints places(grid.points);
    grid.inParts = false;
    grid.levels = 0;
    for (std::uint32_t& corner : grid.corners) corner = places.first()[corner];
    // Of the smallest cell about each point.
    std::vector<float> smallest(grid.points.size(), std::numeric_limits<float>::infinity());
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const auto corners = listOf(grid.corners, grid.ends, cell);
        const float size = sizeOf(grid, corners);
        for (const std::uint32_t corner : corners)
            smallest[corner] = std::min(smallest[corner], size);
    }
    const CellType& voxel = *cellTypeOf(kVoxelCell);
    constexpr float kSmaller = 0.75f;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const auto corners = listOf(grid.corners, grid.ends, cell);
        const bool mayHave = grid.types[cell] == kVoxelCell &&
                             std::ranges::any_of(corners, [&](std::uint32_t corner) {
                                 return smallest[corner] < kSmaller * sizeOf(grid, corners);
                             });
        if (mayHave) {
            FacesWithPoints faces(grid, places);
            bool has = false;
            for (std::size_t i = 0; i < voxel.faces.size(); i += 4)
                has |= faces.take({corners[voxel.faces[i]], corners[voxel.faces[i + 1]],
                                   corners[voxel.faces[i + 2]], corners[voxel.faces[i + 3]]});
            if (has) {
                grid.types[cell] = kPolyhedron;
                faces.addTo(grid.faces);
            }
        }
        grid.faceEnds.push_back(grid.faces.size());
    }
    return grid;
}

}  // namespace timeseries

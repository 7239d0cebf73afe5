#include "timeseries/grid/solid_cells.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "timeseries/together.h"

namespace timeseries {

std::shared_ptr<const SolidCells> SolidCells::of(const UnstructuredGrid& grid,
                                                 std::uint64_t points) {
    auto solids = std::make_shared<SolidCells>();
    solids->types_.reserve(grid.types.size());
    solids->ends_.reserve(grid.types.size());
    solids->corners_.reserve(grid.corners.size());
    for (std::uint64_t cell = 0; cell < grid.types.size(); ++cell) {
        const CellType* type = cellTypeOf(grid.types[cell]);
        if (type && type->dimension == 3) solids->add(grid, cell, points);
    }
    if (solids->types_.empty()) return nullptr;
    solids->measure(grid.points);
    return solids;
}

std::shared_ptr<const SolidCells> SolidCells::ofColumns(Feet feet, std::uint64_t columns,
                                                        std::size_t levels,
                                                        const glm::dvec3& longest) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (!feet || feet->empty() || levels < 2 || columns > kMost / levels ||
        feet->size() > kMost / (levels - 1))
        return nullptr;
    auto solids = std::make_shared<SolidCells>();
    solids->feet_ = std::move(feet);
    solids->columns_ = columns;
    solids->layers_ = levels - 1;
    constexpr std::uint64_t kTetsOfAPrism = 3;
    solids->tets_ = kTetsOfAPrism * solids->count();
    solids->longest_ = longest;
    return solids;
}

glm::dvec2 SolidCells::longestOf(std::span<const Foot> feet, double turn,
                                 const std::function<glm::dvec2(std::uint32_t)>& at) {
    glm::dvec2 longest(0);
    for (const Foot& foot : feet)
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2 from = at(foot[i]), to = at(foot[(i + 1) % 3]);
            glm::dvec2 way(glm::abs(shorterWay(glm::dvec3(to - from, 0), glm::dvec3(turn, 0, 0))));
            if (isAboutPole(way.x, turn)) way = {0, turn / 2 - std::abs(from.y + to.y)};
            longest = glm::max(longest, way);
        }
    return longest;
}

void SolidCells::add(const UnstructuredGrid& grid, std::uint64_t cell, std::uint64_t points) {
    const bool isPolyhedron = grid.types[cell] == kPolyhedron;
    const std::size_t facesBefore = faces_.size(), cornersBefore = corners_.size();
    if (isPolyhedron) {  // its corners are those of its faces, whatever else the file lists
        const auto list = listOf(grid.faces, grid.faceEnds, cell);
        std::size_t at = 1;
        for (std::uint32_t left = list.empty() ? 0 : list[0]; left > 0; --left) {
            const auto face = list.subspan(at, 1 + list[at]);
            faces_.insert(faces_.end(), face.begin(), face.end());
            corners_.insert(corners_.end(), face.begin() + 1, face.end());
            at += face.size();
        }
        const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(cornersBefore);
        std::sort(begin, corners_.end());
        corners_.erase(std::unique(begin, corners_.end()), corners_.end());
    } else {
        const auto corners =
            listOf(grid.corners, grid.ends, cell).first(cellTypeOf(grid.types[cell])->corners);
        corners_.insert(corners_.end(), corners.begin(), corners.end());
    }
    const auto own = std::span(corners_).subspan(cornersBefore);
    if (own.empty() || std::ranges::any_of(own, [&](std::uint32_t p) { return p >= points; })) {
        corners_.resize(cornersBefore);
        faces_.resize(facesBefore);
        return;
    }
    types_.push_back(grid.types[cell]);
    ends_.push_back(corners_.size());
    // Only where there are any.
    if (isPolyhedron || !faces_.empty()) faceEnds_.resize(types_.size(), facesBefore);
    if (isPolyhedron) faceEnds_.back() = faces_.size();
}

void SolidCells::measure(std::span<const glm::dvec3> points) {
    const auto extentOf = [&](std::uint64_t cell) {
        glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
        for (const std::uint32_t corner : listOf(corners_, ends_, cell)) {
            lo = glm::min(lo, points[corner]);
            hi = glm::max(hi, points[corner]);
        }
        return hi - lo;
    };
    const unsigned threads = threadsFor(count(), 1 << 14);
    std::vector<glm::dvec3> longest(threads, glm::dvec3(0));
    std::vector<std::uint64_t> tets(threads);
    together(threads, [&](unsigned k) {
        for (std::uint64_t cell = count() * k / threads; cell < count() * (k + 1) / threads;
             ++cell) {
            longest[k] = glm::max(longest[k], extentOf(cell));
            forEachTet(cell, [&](const auto&) { ++tets[k]; });
        }
    });
    for (const glm::dvec3& of : longest) longest_ = glm::max(longest_, of);
    constexpr std::uint64_t kOfAPrism = 3;
    tets_ =
        feet_ ? kOfAPrism * count() : std::accumulate(tets.begin(), tets.end(), std::uint64_t{0});
}

std::uint64_t SolidCells::bytes() const {
    return types_.size() + (ends_.size() + faceEnds_.size()) * sizeof(std::uint64_t) +
           (corners_.size() + faces_.size()) * sizeof(std::uint32_t) +
           (feet_ ? feet_->size() * sizeof(Foot) : 0);
}

bool SolidCells::joinsAs(const SolidCells& other) const {
    const bool sameFeet = feet_ == other.feet_ || (feet_ && other.feet_ && *feet_ == *other.feet_);
    return sameFeet && columns_ == other.columns_ && layers_ == other.layers_ &&
           types_ == other.types_ && ends_ == other.ends_ && faceEnds_ == other.faceEnds_ &&
           corners_ == other.corners_ && faces_ == other.faces_ && tets_ == other.tets_;
}

}  // namespace timeseries

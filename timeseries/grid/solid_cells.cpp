#include "timeseries/grid/solid_cells.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "timeseries/grid/meeting_points.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kMostNumbers = std::numeric_limits<std::uint32_t>::max();

// None of what is no solid, or has a corner beyond the first `points`. REQUIRES: no polyhedron.
std::span<const std::uint32_t> solidCorners(const UnstructuredGrid& grid, std::uint64_t cell,
                                            std::uint64_t points) {
    const CellType* const type = cellTypeOf(grid.types[cell]);
    if (!type || type->dimension != 3) return {};
    const auto corners = listOf(grid.corners, grid.ends, cell).first(type->corners);
    const bool areThere =
        points >= grid.points.size() ||
        std::ranges::all_of(corners, [&](std::uint32_t corner) { return corner < points; });
    return areThere ? corners : std::span<const std::uint32_t>();
}

}  // namespace

std::shared_ptr<const SolidCells> SolidCells::of(const UnstructuredGrid& grid,
                                                 std::uint64_t points) {
    return ofSolids(grid, points, 0);
}

std::shared_ptr<const SolidCells> SolidCells::aboutMiddles(const UnstructuredGrid& grid) {
    const std::uint64_t cells = grid.types.size();
    if (cells == 0 || cells + grid.points.size() > kMostNumbers) return nullptr;
    // Points are told apart in a third of a second; of more only where they are likely to meet.
    constexpr std::uint64_t kQuick = 1 << 21;
    const bool areMany = 2 * grid.points.size() > 3 * cells;  // each cell's own, say
    const auto firstNode = static_cast<std::uint32_t>(cells);
    if (!grid.inParts && !areMany && grid.points.size() > kQuick)
        return ofSolids(grid, grid.points.size(), firstNode);
    const MeetingPoints places(grid);
    const auto whole = withHangingPoints(grid, places);
    const auto solids = ofSolids(whole ? *whole : grid, grid.points.size(), firstNode);
    if (!solids) return nullptr;
    const auto share = [&](std::uint32_t& corner) {
        if (corner >= firstNode) corner = firstNode + places.first()[corner - firstNode];
    };
    std::ranges::for_each(solids->corners_, share);
    solids->forEachFaceCorner(share);
    return solids;
}

template <typename Use>
void SolidCells::forEachFaceCorner(const Use& use) {
    for (std::size_t at = 0; at < faces_.size(); at += 1 + faces_[at])
        for (std::size_t i = 1; i <= faces_[at]; ++i) use(faces_[at + i]);
}

std::shared_ptr<SolidCells> SolidCells::ofSolids(const UnstructuredGrid& grid, std::uint64_t points,
                                                 std::uint32_t firstNode) {
    auto solids = std::make_shared<SolidCells>();
    solids->firstNode_ = firstNode;
    if (grid.faceEnds.empty())
        solids->takeAll(grid, points);
    else
        for (std::uint64_t cell = 0; cell < grid.types.size(); ++cell)
            solids->add(grid, cell, points);
    if (solids->faces_.empty()) solids->faceEnds_.clear();
    if (solids->types_.empty()) return nullptr;
    solids->measure(grid.points);
    return solids;
}

std::shared_ptr<const SolidCells> SolidCells::ofColumns(Feet feet, std::uint64_t columns,
                                                        std::size_t levels,
                                                        const glm::dvec3& longest) {
    if (!feet || feet->empty() || levels < 2 || columns > kMostNumbers / levels ||
        feet->size() > kMostNumbers / (levels - 1))
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

// How many, then of each how many corners, and which.
void SolidCells::addFaces(std::span<const std::uint32_t> list) {
    if (list.empty()) return;
    const auto first = static_cast<std::ptrdiff_t>(corners_.size());
    std::size_t at = 1;
    for (std::uint32_t left = list[0]; left > 0; --left) {
        faces_.push_back(list[at]);
        for (const std::uint32_t corner : list.subspan(at + 1, list[at])) {
            faces_.push_back(firstNode_ + corner);
            corners_.push_back(corner);
        }
        at += 1 + list[at];
    }
    std::sort(corners_.begin() + first, corners_.end());
    corners_.erase(std::unique(corners_.begin() + first, corners_.end()), corners_.end());
}

// Where none is a polyhedron, on all threads.
void SolidCells::takeAll(const UnstructuredGrid& grid, std::uint64_t points) {
    struct Part {
        std::uint64_t cells = 0, corners = 0;
    };
    const std::uint64_t cells = grid.types.size();
    const unsigned threads = threadsFor(cells, 1 << 14);
    std::vector<Part> firsts(threads + 1);
    const auto forEach = [&](unsigned k, const auto& use) {
        for (std::uint64_t cell = cells * k / threads; cell < cells * (k + 1) / threads; ++cell)
            if (const auto corners = solidCorners(grid, cell, points); !corners.empty())
                use(cell, corners);
    };
    const std::uint64_t middles = haveMiddles() ? 1 : 0;
    together(threads, [&](unsigned k) {
        Part part;
        forEach(k, [&](std::uint64_t, const auto& corners) {
            ++part.cells;
            part.corners += corners.size() + middles;
        });
        firsts[k + 1] = part;
    });
    for (unsigned k = 0; k < threads; ++k) {
        firsts[k + 1].cells += firsts[k].cells;
        firsts[k + 1].corners += firsts[k].corners;
    }
    types_.resize(firsts[threads].cells);
    ends_.resize(firsts[threads].cells);
    corners_.resize(firsts[threads].corners);
    together(threads, [&](unsigned k) {
        std::uint64_t to = firsts[k].cells, corner = firsts[k].corners;
        forEach(k, [&](std::uint64_t cell, const auto& corners) {
            for (const std::uint32_t point : corners) corners_[corner++] = firstNode_ + point;
            if (haveMiddles()) corners_[corner++] = static_cast<std::uint32_t>(cell);
            types_[to] = grid.types[cell];
            ends_[to++] = corner;
        });
    });
}

void SolidCells::add(const UnstructuredGrid& grid, std::uint64_t cell, std::uint64_t points) {
    const std::size_t facesBefore = faces_.size(), cornersBefore = corners_.size();
    const bool isPolyhedron = grid.types[cell] == kPolyhedron;
    if (isPolyhedron) {  // its corners are those of its faces, whatever else the file lists
        addFaces(listOf(grid.faces, grid.faceEnds, cell));
    } else {
        const auto corners = solidCorners(grid, cell, points);
        corners_.insert(corners_.end(), corners.begin(), corners.end());
    }
    const auto own = std::span(corners_).subspan(cornersBefore);
    if (own.empty() || std::ranges::any_of(own, [&](std::uint32_t p) { return p >= points; })) {
        corners_.resize(cornersBefore);
        faces_.resize(facesBefore);
        return;
    }
    if (haveMiddles()) {
        for (std::uint32_t& corner : own) corner += firstNode_;
        corners_.push_back(static_cast<std::uint32_t>(cell));
    }
    types_.push_back(grid.types[cell]);
    ends_.push_back(corners_.size());
    faceEnds_.push_back(faces_.size());
}

std::uint64_t SolidCells::tetsOf(std::uint64_t cell) const {
    std::uint64_t count = 0;
    if (!haveMiddles()) {
        forEachTet(cell, [&](const auto&) { ++count; });
        return count;
    }
    if (types_[cell] != kPolyhedron) {
        for (const std::uint8_t size : cellTypeOf(types_[cell])->faceSizes) count += size - 2u;
        return count;
    }
    forEachFace(cell, [&](std::size_t size, const auto&) { count += size < 2 ? 0 : size - 2; });
    return count;
}

void SolidCells::measure(std::span<const glm::dvec3> points) {
    const auto extentOf = [&](std::uint64_t cell) {
        glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
        for (const std::uint32_t corner : listOf(corners_, ends_, cell)) {
            if (corner < firstNode_) continue;  // a middle lies between them
            lo = glm::min(lo, points[corner - firstNode_]);
            hi = glm::max(hi, points[corner - firstNode_]);
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
            tets[k] += tetsOf(cell);
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
    return sameFeet && firstNode_ == other.firstNode_ && columns_ == other.columns_ &&
           layers_ == other.layers_ && types_ == other.types_ && ends_ == other.ends_ &&
           faceEnds_ == other.faceEnds_ && corners_ == other.corners_ && faces_ == other.faces_ &&
           tets_ == other.tets_;
}

}  // namespace timeseries

// Points and cells of a scene of both models in one order by depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/splat_source.h"

namespace render {

// As CellRank, but without bricks: of an upright grid the sum of distances from the eye's cell,
// along each axis, for splats reach into cells beside theirs, which are to be about as far away.
class MixedRank {
 public:
    MixedRank(const Scene& scene, const View& view)
        : scene_(scene), cells_(scene, view), size_(scene.cells->size()) {}
    std::size_t count() const {
        return scene_.placed.isMesh() ? cells_.count() : std::size_t{size_.x} + size_.y + size_.z;
    }
    std::uint32_t ofCell(std::uint32_t cell) const;
    // Of a point of the grid: of an upright one, that of the farthest of the cells about it.
    std::uint32_t ofPoint(std::uint32_t index) const;

 private:
    std::uint32_t distanceTo(const glm::uvec3& cell) const;

    const Scene& scene_;
    CellRank cells_;
    glm::uvec3 size_;
};

// A cell, or a point: its position in the sorted step. Which of them, its layer says.
using CellOrPoint = CellOfLayer;

// The nearest first, listed a slice at a time. Of those of one rank, points come before cells. The
// scene and what the columns are of must outlive it.
class MixedList {
 public:
    MixedList(const Scene& scene, const View& view, const timeseries::Columns& columns);
    // Goes through so many, or a few more, or what is left of a pass; all are gone through three
    // times. Returns how many.
    std::uint64_t goOn(std::uint64_t some);
    bool done() const { return isCounted_ && placed_ == ranks_.size(); }
    // REQUIRES: done().
    std::span<const CellOrPoint> all() const { return sorted_; }

 private:
    std::uint64_t listPoints(std::uint64_t some);
    std::uint64_t rankCells(std::uint64_t some);
    std::uint64_t place(std::uint64_t some);

    const Scene& scene_;
    const Scene onlyPoints_;
    timeseries::Columns columns_;
    MixedRank rank_;
    SplatSource points_;
    SplatPoints some_;
    CellList cells_;
    std::size_t rankedCells_ = 0;
    NearestFirst order_;
    bool isCounted_ = false;
    std::vector<CellOrPoint> pointsListed_, sorted_;
    std::vector<std::uint32_t> ranks_;  // of points, then of cells
    std::size_t placed_ = 0;
};

}  // namespace render

// The cells that a ray passes where most of them are of no interest: bricks without any are passed
// at once.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "render/reference/cell_walk.h"

namespace render {

class SparseWalk {
 public:
    // Of all cells that the walk goes through.
    explicit SparseWalk(CellWalk cells) : cells_(std::move(cells)) {}
    // Of those at least for which isIn(cell), which is asked of each.
    // REQUIRES: the walk goes through all of the grid.
    template <typename IsIn>
    SparseWalk(CellWalk cells, const IsIn& isIn)
        : cells_(std::move(cells)), bricks_(cells_.inBricks(kBrick)) {
        const glm::uvec3 size = cells_.size();
        const glm::uvec3 bricks = bricks_->size();
        isOccupied_.resize(std::size_t{bricks.x} * bricks.y * bricks.z);
        for (unsigned z = 0; z < size.z; ++z)
            for (unsigned y = 0; y < size.y; ++y)
                for (unsigned x = 0; x < size.x; ++x)
                    if (const glm::uvec3 cell(x, y, z); isIn(cell))
                        isOccupied_[numberOf(cell / kBrick)] = 1;
    }

    const CellWalk& cells() const { return cells_; }
    // As CellWalk's.
    template <typename Visit>
    bool operator()(const glm::dvec3& eye, const glm::dvec3& along, double near,
                    const Visit& visit) const {
        if (!bricks_) return cells_(eye, along, near, visit);
        return (*bricks_)(eye, along, near, [&](const glm::uvec3& brick, double, double) {
            if (isOccupied_[numberOf(brick)] == 0) return true;
            return cells_.within({brick * kBrick, glm::min((brick + 1u) * kBrick, cells_.size())},
                                 eye, along, near, visit);
        });
    }

 private:
    static constexpr unsigned kBrick = 8;

    std::size_t numberOf(const glm::uvec3& brick) const {
        const glm::uvec3 size = bricks_->size();
        return brick.x + std::size_t{size.x} * (brick.y + std::size_t{size.y} * brick.z);
    }

    CellWalk cells_;
    std::optional<CellWalk> bricks_;
    std::vector<std::uint8_t> isOccupied_;  // of each brick
};

}  // namespace render

// Numbers for the points of a grid by which near points have near numbers: bricks of 32 points
// along each axis, in a brick the bits of the three places by turns (Morton 1966).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "timeseries/grid/grid.h"

namespace timeseries {

// A bijection between grid indices (x fastest) and some of the codes below codes(). Where axes have
// fewer points than a brick, bricks are smaller. Where they would have fewer than 1024 points (all
// lie along one axis, say), and where the codes would need more than 32 bits, a code is the grid
// index.
class BrickOrder {
 public:
    // REQUIRES: at most 2^32 points, at least one.
    explicit BrickOrder(const std::array<std::uint32_t, 3>& size);

    std::uint64_t codes() const { return codes_; }
    std::uint32_t code(std::uint32_t gridIndex) const;
    // Makes each code its grid index, in place. False if there is one that no point has; what is
    // there is then not to be used.
    bool toGridIndices(std::uint32_t* codes, std::size_t count) const;

 private:
    IndicesAlong along_;
    std::uint64_t points_ = 0, codes_ = 0;
    bool plain_ = false;                              // a code is the grid index
    int brickBits_ = 0;                               // of a code, its place in the brick
    std::array<std::vector<std::uint32_t>, 3> part_;  // of a code, by place along each axis
    std::vector<std::uint32_t> firstOf_;              // grid index, by brick
    // What bits of the place in a brick add to the grid index, modulo 2^32, for there are places
    // beyond the grid, and along the axes: the lower bits, and the upper ones.
    struct Step {
        std::uint32_t index;
        std::array<std::uint8_t, 3> along;
    };
    std::vector<Step> lower_, upper_;
    std::vector<std::array<std::uint8_t, 3>> extent_;  // points along the axes, by brick
    std::vector<std::uint8_t> cut_;  // of a brick, whether it has fewer points than most
};

}  // namespace timeseries

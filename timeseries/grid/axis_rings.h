// Index lines of a curvilinear grid that close about an axis, at an end of another index, nearer to
// it than a splat is wide. The splats of their cells would be needles that all reach across the
// axis, and add up to twenty times what they should there. Such a cell is drawn wider along its
// line, by a power of two, and keeps its volume: less than a tenth rms is left within three cells
// of the axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace timeseries {

struct MeshPlaces;  // timeseries/grid/curvilinear.h

constexpr unsigned kMostWidened = 31;  // a factor of 2^31

// In the mean of its points; `across`: how much nearer or farther the next line is.
struct AxisRing {
    double away = 0, across = 0;  // none: 0
};

// By how many factors of two: of a cell that is so long along its line.
inline unsigned wideningOn(const AxisRing& ring, double side) {
    constexpr double kNeedle = 0.5, kAtAxis = 1.5;
    if (!(side > 0 && side < kNeedle * ring.across)) return 0;
    const double ratio = ring.away / ring.across;
    const double wanted = (kAtAxis - ratio * ratio) * ring.across;
    if (!(wanted > side)) return 0;
    return std::min(static_cast<unsigned>(std::lround(std::log2(wanted / side))), kMostWidened);
}

class AxisRings {
 public:
    explicit AxisRings(const MeshPlaces& places);
    bool empty() const { return isEmpty_; }
    // Of the cell there, as long as that along index a.
    unsigned widening(const glm::vec<3, std::uint64_t>& at, int a, double side) const;

 private:
    static constexpr std::uint64_t kRows = 2;  // from an end, of which the first may be one place
    void find(const MeshPlaces& places, int a, int b);

    glm::vec<3, std::uint64_t> size_;
    // Of lines along a near the ends of b, [3 a + b]: [along the third index][from the first, from
    // the last][row]; empty where none is a ring.
    std::array<std::vector<AxisRing>, 9> lines_;
    bool isEmpty_ = true;
};

}  // namespace timeseries

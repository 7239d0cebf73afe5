// Which points are drawn, one after another. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "render/model/scene.h"

namespace render {

struct SplatPoints {
    std::vector<std::uint32_t> point;  // positions in the sorted step
    std::vector<std::uint8_t> layer;
};

// How many there are, of all layers, those clipped included.
std::uint64_t splatCount(const Scene& scene);

class SplatSource {
 public:
    // All layers' runs. Scene and list must outlive this.
    explicit SplatSource(const Scene& scene);
    // Of a plane. Over: what the list has, the nearest first. REQUIRES: Sorted. Else the runs: of
    // all layers for Count, of `layer` alone for the others.
    SplatSource(const Scene& scene, const DrawList& list, Channels channels, std::size_t layer);

    bool done() const;
    // The next ones: so many, or what is left, give or take the unevenness of a subset
    // (render/points/subset.h).
    void next(std::uint64_t atMost, SplatPoints& points);

 private:
    void nextOfList(std::uint64_t atMost, SplatPoints& points);
    void nextOfRuns(std::uint64_t atMost, SplatPoints& points);
    void passEnds();

    const Scene& scene_;
    const Sorted* sorted_;
    // What is next: of the list or of this run, after so many of its points; `last_` is the layer
    // after the last.
    std::size_t layer_, last_, run_ = 0;
    std::uint64_t passed_ = 0;
};

}  // namespace render

// What is said of the picture on the screen.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/exploration/point_counts.h"

namespace app {

// What the picture on the screen is after one draw() or refine(), as the overlay tells it.
struct CanvasReport {
    std::size_t step = 0;                     // the step on the screen
    std::uint64_t drawn = 0, selected = 0;    // splats an eye, of all layers; points they stand for
    std::optional<std::uint64_t> cells = {};  // likewise, where they are drawn instead,
    std::uint64_t besideCells = 0;            // and points of layers that have none of them
    // Of that step, under the choices on the screen; none before the first picture.
    std::optional<PointCounts> counts = {};
    std::uint32_t stride = 1;     // one of so many points stands for its neighbours
    int across = 1;               // so many of the picture's pixels lie across one that is drawn
    bool whole = false;           // nothing is missing: all points or cells, pixels, all uploaded
    bool lacksCells = false;      // points stand for the cells that were asked for
    bool lacksGradients = false;  // by which light is to fall on tetrahedra
    bool mixesColors = false;     // of several colours, in no order (render/frame/mean_depth.h)
    bool lacks() const { return lacksCells || lacksGradients; }
    bool told = true;     // its legend says whether its colours are mixed; else refine() finds out
    double uploaded = 1;  // share of what the picture asked for needs
    double refined = 0;   // share that refine() has drawn; it shows all at once
    std::uint64_t gpuBytes = 0;  // of steps, cells and order held there
    std::uint64_t cost = 0;      // of what this call drew, of all eyes (render/splat/splat_cost.h)
    std::uint64_t planesCost = 0;  // of it, what is left of however few splats
    // Of an earlier call of the same function (gl::Timer), what it drew and what that cost: what
    // FramePace learns from. None in most frames of a GPU that is behind.
    std::optional<std::chrono::nanoseconds> gpuTime = {};
    std::uint64_t gpuSplats = 0;
    bool gpuCells = false;
};

// What a picture would cost by the fewest points, and by twice as many as it has; 0 where it has
// all.
struct SubsetCosts {
    std::uint64_t least = 0, finer = 0;
};

}  // namespace app

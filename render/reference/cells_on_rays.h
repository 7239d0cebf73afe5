// What pixels have of a scene that is drawn by cells, each by its own ray: what CellSum sums for
// all pixels (render/model/cell_splat.h), in double, for some of them.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/together.h"

namespace render {

// Where nothing else is asked of a pixel than whether it shows something, one part of a cell tells;
// of tetrahedra, which rays do not meet one by one, all are summed.
enum class RaysEnd { BehindAll, WhereSomethingIs };

// The optical depth of all layers, of W as path length, at each of these pixels, the mean of so
// many rays across each; row 0 is at the bottom. Takes as long as walking through the cells of so
// many rays. REQUIRES: scene.cells.
std::vector<double> cellDepthAt(const Scene& scene, const View& view,
                                std::span<const glm::ivec2> pixels, int raysAcross = 1,
                                unsigned threads = sharingThreads(),
                                RaysEnd end = RaysEnd::BehindAll);

}  // namespace render

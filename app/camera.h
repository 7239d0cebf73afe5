// The eyes of a picture: one in the middle, or two side by side with off-axis frusta.
#pragma once

#include <vector>

#include "app/explorer.h"
#include "render/view.h"

namespace app {

// One view, or left then right. Without a distance, the box with these half edges (world units,
// columns, centre at 0) fills the picture but for room for labels. The eyes look along parallel
// axes and their frusta meet at the convergence distance (off-axis projection), so that nothing is
// sheared or keystoned.
std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const glm::dmat3& boxHalfEdges, glm::ivec2 size);

}  // namespace app

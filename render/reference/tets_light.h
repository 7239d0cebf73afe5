// The light of rays through a grid whose points lie one by one.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "timeseries/grid/field.h"

namespace render {

// As IntervalTruth::light has it, of n x n rays a pixel, in tetrahedra (render/splat/solid_tets.h).
// Not a bit depends on the threads. REQUIRES: a mesh with cells.
std::vector<glm::dvec4> meshLight(const Scene& scene, const timeseries::Field& field,
                                  const View& view, int raysAcross, unsigned threads);

}  // namespace render

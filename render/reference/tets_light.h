// The light of rays through a grid whose points lie one by one.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/light_on_ray.h"
#include "render/reference/opaque_depths.h"
#include "timeseries/grid/field.h"

namespace render {

// As IntervalTruth::light has it, or its sums, of rays at these places in each pixel, in tetrahedra
// (render/splat/solid_tets.h). Not a bit depends on the threads. REQUIRES: a mesh with cells.
std::vector<glm::dvec4> meshLight(const Scene& scene, const timeseries::Field& field,
                                  const View& view, std::span<const glm::dvec2> places,
                                  unsigned threads, LightOnRay::Of what = LightOnRay::Of::Front,
                                  const OpaqueDepths& opaque = {});

}  // namespace render

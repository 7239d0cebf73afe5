// Which points of a mesh a box holds, told in the floats that the mesh keeps. Pure.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "render/points/placed_points.h"

namespace render {

// Closed: a point is inside the box exactly when its stored place is between these and so is its
// level, if the mesh has levels. Nothing is: lo > hi.
struct MeshBounds {
    glm::vec3 lo, hi;
    std::uint32_t firstLevel, lastLevel;
};
MeshBounds boundsIn(const timeseries::Mesh& mesh, const IndexBox& box);

}  // namespace render

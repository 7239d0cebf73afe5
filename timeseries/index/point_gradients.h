// How a field changes about each point of a mesh. Pure.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "timeseries/grid/field.h"
#include "timeseries/grid/mesh.h"
#include "timeseries/grid/pages.h"
#include "timeseries/together.h"

namespace timeseries {

// Of points that have neighbours, the one linear field that differs along each index as the
// neighbours do (central differences, through the Jacobian); at a border, and beside what is
// missing, to one side, and where lines come round across where they begin. Along what has no
// neighbours, or where these are in one place, as at a pole, nothing changes. Of points at the
// corners of solid cells the mean of what the field has in the tetrahedra about them (SolidCells),
// by volume; corners without a value, which have the mean of the others, count where there is
// nothing else. Exact for linear fields. 12 bytes a point.
class PointGradients {
 public:
    // On so many threads; not a bit depends on them. REQUIRES: as many points as the field's, on
    // its grid's mesh or on what a map makes of that, with neighbours or solids().
    PointGradients(const Field& field, std::shared_ptr<const Mesh> mesh,
                   unsigned threads = sharingThreads());

    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    // Values a unit of each of the mesh's coordinates; to a float.
    glm::dvec3 at(std::uint64_t point) const { return unit_ * glm::dvec3(stored_[point]); }
    std::uint64_t bytes() const { return stored_.size() * sizeof(stored_[0]); }

 private:
    std::shared_ptr<const Mesh> mesh_;
    glm::dvec3 unit_{0};
    LargeVector<glm::vec3> stored_;
};

}  // namespace timeseries

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
// missing, to one side. A line that comes round goes on where it began, and where all of one are in
// one place, at a pole or on an axis, what lies across that tells. Along what has no neighbours
// nothing changes. Of points at the corners of solid cells the mean of what the field has in the
// tetrahedra about them (SolidCells), by volume; corners without a value, which have the mean of
// the others, count where there is nothing else. Of cells that have the values the mean of what the
// field has in them, and of their nodes the mean of these. Exact for linear fields, to what floats
// hold of places. 12 bytes a corner.
class PointGradients {
 public:
    // On so many threads; not a bit depends on them. REQUIRES: as many points as the field's, on
    // its grid's mesh or on what a map makes of that, with neighbours or solids(); of nodes the
    // field's values (withNodeValues()).
    PointGradients(const Field& field, const std::shared_ptr<const Mesh>& mesh,
                   unsigned threads = sharingThreads());

    bool areOn(const std::shared_ptr<const Mesh>& mesh) const { return mesh_.lock() == mesh; }
    // Of a field that is counted in units of range(), a unit of extent() along each of the mesh's
    // coordinates: the file's own units may be so large or small that the quotient of a value and a
    // length is no number.
    glm::dvec3 at(std::uint64_t point) const { return kPerStored * glm::dvec3(stored_[point]); }
    double range() const { return range_; }  // of its values; the greatest double, if it is more
    const glm::dvec3& extent() const { return extent_; }  // of its places, > 0
    std::uint64_t bytes() const { return stored_.size() * sizeof(stored_[0]); }

 private:
    // So much of a float's range is kept for what is small beside a value that nobody masked.
    static constexpr double kPerStored = 0x1p-100;

    std::weak_ptr<const Mesh> mesh_;
    double range_ = 0;
    glm::dvec3 extent_{1};
    LargeVector<glm::vec3> stored_;
};

}  // namespace timeseries

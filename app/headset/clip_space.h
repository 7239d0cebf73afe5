// The coordinates in which a clip box is upright: lengths along the grid's axes (axis coordinates),
// or on a globe the file's, longitude, latitude and height, of which its faces are meridians,
// parallels and spheres. Pure.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "app/drawing/drawn.h"
#include "app/headset/clip_faces.h"

namespace app::headset {

class ClipSpace {
 public:
    // `placed` must outlive it.
    ClipSpace(const timeseries::Grid& grid, const render::PlacedPoints& placed,
              const xr::Placement& placement);
    // Whether its faces can be held: not on a globe of a grid whose axes are no longitudes and
    // latitudes.
    static bool has(const timeseries::Grid& grid, const render::PlacedPoints& placed);

    glm::dvec3 fromStage(const glm::dvec3& at) const;
    glm::dvec3 inStage(const glm::dvec3& place) const;
    glm::dvec3 inWorld(const glm::dvec3& place) const;
    // The points' box, and what of it is inside the clip box.
    const AxisBox& whole() const { return whole_; }
    AxisBox clipped(const std::optional<ClipBox>& clip) const;
    std::optional<Hold> holdOf(const xr::Pose& aim, const AxisBox& box) const;

    // Of a coordinate here the file's, whether that grows the other way, and how long a unit of the
    // file's is in the room there.
    double inFile(int axis, double coordinate) const;
    bool isReversed(int axis) const { return !isGlobe() && placed_.scale()[axis] < 0; }
    double metresPerUnit(int axis, const glm::dvec3& place) const;
    // The same place, as near as can be to another where coordinates come round.
    double nearest(int axis, double coordinate, double to) const;
    // An edge along an axis is bent there: into how many straight parts.
    int partsAlong(int axis, double length) const;

 private:
    bool isGlobe() const { return placed_.globe() != nullptr; }
    std::vector<double> stepsOnRay(const glm::dvec3& eye, const glm::dvec3& way, const AxisBox& box,
                                   double farthest) const;
    std::optional<Hold> onRay(const xr::Pose& aim, const AxisBox& box) const;

    const render::PlacedPoints& placed_;
    glm::dmat4 stageFromAxes_, axesFromStage_;
    double metres_;  // of a unit of axis coordinates
    AxisBox whole_;
};

}  // namespace app::headset

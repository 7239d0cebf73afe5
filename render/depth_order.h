// The draw list of a frame: which splats are drawn one after another. Pure.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "render/scene.h"

namespace render {

// Of one frame after another, and what it is made in: pages that are new cost as much as what is
// done with them. Made once for both eyes: distance from the point midway between them, so that
// turning the head changes nothing. Keys are the distance in 2^22 steps over the points' own range
// of distances; ties keep the order of value.
class DepthOrder {
 public:
    DrawList operator()(const Scene& scene, const glm::dvec3& midEye);

 private:
    void forget();

    std::vector<std::uint64_t> splats_, byLower_;
    std::vector<double> away_;
};

// Of one frame alone.
DrawList order(const Scene& scene, const glm::dvec3& midEye);
// The same by the distance in double, compared: the truth's order.
DrawList orderExactly(const Scene& scene, const glm::dvec3& midEye);

}  // namespace render

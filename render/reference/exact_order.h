// The order that the truth has.
#pragma once

#include <glm/vec3.hpp>

#include "render/model/scene.h"

namespace render {

// As order() (render/splat/depth_order.h), by the distance in double, compared.
DrawList orderExactly(const Scene& scene, const glm::dvec3& midEye);

}  // namespace render

// Colours of layers that were given none.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "render/model/scene.h"

namespace app {

// sRGB, by place among several layers; distinguishable with any colour vision (Okabe and Ito 2008).
inline constexpr std::array<glm::dvec3, render::kMaxLayers> kLayerColors = {
    glm::dvec3(230, 159, 0) / 255.0,   glm::dvec3(86, 180, 233) / 255.0,
    glm::dvec3(0, 158, 115) / 255.0,   glm::dvec3(240, 228, 66) / 255.0,
    glm::dvec3(0, 114, 178) / 255.0,   glm::dvec3(213, 94, 0) / 255.0,
    glm::dvec3(204, 121, 167) / 255.0, glm::dvec3(200, 200, 200) / 255.0};

}  // namespace app

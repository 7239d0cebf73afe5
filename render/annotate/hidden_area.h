// What a headset's lenses let nobody see of an eye's picture, so that it need not be drawn. Pure.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/model/covered.h"
#include "render/points/view.h"

namespace render {

struct HiddenArea {
    // Three a triangle, in either order: where rays from the eye meet the plane before it, as
    // x / -z and y / -z in view space. They may reach beyond the picture.
    std::vector<glm::dvec2> corners;
};

// The pixels of the picture that nobody sees even where a display filters it: those whose centre
// lies in the area with the centres of their eight neighbours. What is beyond the picture's border
// counts as hidden. Parts of rows, each pixel once.
std::vector<PixelBox> hiddenPixels(const HiddenArea& area, const View& view);

}  // namespace render

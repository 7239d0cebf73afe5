// What a globe shows beside data: the Earth, which hides what lies behind it, coastlines, and lines
// of round degrees with their labels, as far as the eye sees them before the horizon.
#pragma once

#include "render/annotate/axes.h"

namespace render {

// As axesMeshes(); view and middle in axis coordinates. REQUIRES: placed.globe().
AxesMeshes globeMeshes(const PlacedPoints& placed, const View& view, const Middle& middle,
                       const Font& font, const FlatMesh& legend, const glm::dvec3& background);

// "30° N", "0°"; "120° W", "180°".
std::string latitudeText(double degrees);
std::string longitudeText(double degrees);

}  // namespace render

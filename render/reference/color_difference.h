// How different colours look: CIEDE2000 (CIE 142-2001), by Sharma, Wu and Dalal 2005, "The
// CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test Data, and
// Mathematical Observations". 1 is about what an eye can just tell.
#pragma once

#include <glm/vec3.hpp>

#include "render/image/image.h"

namespace render {

struct Lab {
    double l = 0, a = 0, b = 0;  // CIE 1976, L* from 0 to 100
};
// Of linear light (Rec. 709 primaries, D65) as a display shows it: clamped to [0, 1], its white the
// reference white.
Lab labFromLinear(const glm::dvec3& rgb);

// Parametric factors 1.
double ciede2000(const Lab& one, const Lab& other);

// The difference that a share of the pixels does not exceed (nearest rank), of those that are not
// `background` (linear) in both pictures; 0 where there is none, NaN where a picture has one there.
// Throws std::invalid_argument if the sizes differ. REQUIRES: 0 < share <= 1.
double colorDifferenceQuantile(const Image& tested, const Image& reference,
                               const glm::vec3& background, double share);

}  // namespace render

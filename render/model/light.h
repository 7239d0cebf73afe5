// Light on an interval volume that is drawn cell by cell: a lamp at the eye, and surfaces that look
// alike from both sides. Where the field hardly changes, its gradient says nothing of a surface,
// and what is there is lit evenly instead.
#pragma once

#include <algorithm>

namespace render {

enum class Light {
    Off,
    Soft,  // brighter where it faces the eye
    Full   // and with highlights (Blinn 1977)
};

// What light makes of a colour: colour * diffuse + specular, in linear light. Of |n . v|, 1 where
// the surface faces the eye, and of how far there is one: gradient / (gradient + steepness), the
// steepness being a tenth of what the scene's steeper cells have.
template <typename Real>
struct Shade {
    Real diffuse, specular;
};
inline constexpr double kAmbient = 0.25, kEven = 0.625, kSpecular = 0.35;
inline constexpr double kSteepnessShare = 0.1, kSteepQuantile = 0.9;
template <typename Real>
Shade<Real> shadeOf(Light light, Real facing, Real certainty) {
    if (light == Light::Off) return {1, 0};
    const Real diffuse = certainty * Real(kAmbient + (1 - kAmbient) * double(facing)) +
                         (1 - certainty) * Real(kEven);
    if (light == Light::Soft) return {diffuse, 0};
    const Real f2 = facing * facing, f4 = f2 * f2, f8 = f4 * f4;
    return {diffuse, certainty * Real(kSpecular) * f8 * f8 * f8 * f4 * f2};
}

}  // namespace render

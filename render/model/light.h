// Light on an interval volume that is drawn cell by cell: a lamp at the eye, and surfaces that look
// alike from both sides. Where the field hardly changes, its gradient says nothing of a surface,
// and what is there is lit evenly instead.
#pragma once

namespace render {

enum class Light {
    Off,
    Soft,  // brighter where it faces the eye
    Full   // and with highlights (Blinn 1977)
};

// What light makes of a colour: colour * diffuse + specular, in linear light, with a = kAmbient,
//   diffuse = certainty (a + (1 - a) facing) + (1 - certainty) kEven,
//   specular = certainty kSpecular facing^30 (Full alone),
// of facing = |n . v|, 1 where the surface faces the eye, and of how far there is one:
// certainty = gradient / (gradient + steepness), the steepness being this share of what the
// scene's steeper cells have. shaders/cell.frag has the same numbers.
inline constexpr double kAmbient = 0.25, kEven = 0.625, kSpecular = 0.35;
inline constexpr double kSteepnessShare = 0.1, kSteepQuantile = 0.9;

}  // namespace render

// Light on an interval volume that is drawn cell by cell: a lamp at the eye, or far away in the
// world, and surfaces that look alike from both sides. Where the field hardly changes, its gradient
// says nothing of a surface, and what is there is lit evenly instead. The gradient is that of
// points: of cells by central differences, trilinear between them (render/splat/cell_slopes.h); of
// tetrahedra linear between those of timeseries/index/point_gradients.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace render {

enum class Light {
    Off,
    Soft,  // brighter where it faces the lamp
    Full   // and with highlights (Blinn 1977)
};

// Where the light comes from: the eye, or a direction, from a place to the lamp and of length 1 in
// the world, so that light and shade stay where they are on what is turned.
using Lamp = std::optional<glm::dvec3>;

// What light makes of a colour: colour * diffuse + specular, in linear light, with a = kAmbient,
//   diffuse = certainty (a + (1 - a) max(n . l, 0)) + (1 - certainty) kEven,
//   specular = certainty kSpecular (n . h)^30 low (Full alone), low = clamp(n . l / kLow, 0, 1),
// of the normal n on the eye's side, l to the lamp, v to the eye, h halfway between these, and of
// how far there is a surface: certainty = gradient / (gradient + steepness), the steepness being
// this share of what the scene's steeper cells have. `low` lets highlights end where the lamp sets.
// Of a lamp at the eye n . l = n . h = |n . v|, and `low` shows nothing: it is left out.
// shaders/cell_range.glsl has the same numbers.
inline constexpr double kAmbient = 0.25, kEven = 0.625, kSpecular = 0.35, kLow = 0.25;
inline constexpr double kSteepnessShare = 0.1, kSteepQuantile = 0.9;

struct Shade {
    double diffuse = 1, specular = 0;
    glm::dvec3 of(const glm::dvec3& color) const { return diffuse * color + specular; }
};
// Where the field has this gradient, of a ray that goes this way; both in the world.
inline Shade shadeOf(Light light, const Lamp& lamp, const glm::dvec3& gradient,
                     const glm::dvec3& way, double steepness) {
    if (light == Light::Off) return {};
    const double size = glm::length(gradient);
    if (!(size > 0)) return {kEven, 0};
    const glm::dvec3 v = -glm::normalize(way);
    const glm::dvec3 n = (glm::dot(gradient, v) < 0 ? -1 : 1) / size * gradient;
    const glm::dvec3 l = lamp.value_or(v), between = l + v;
    const double certainty = size / (size + steepness), towards = std::max(glm::dot(n, l), 0.0);
    Shade shade{certainty * (kAmbient + (1 - kAmbient) * towards) + (1 - certainty) * kEven, 0};
    if (light == Light::Soft || !(glm::dot(between, between) > 0)) return shade;
    const double half = std::max(glm::dot(n, glm::normalize(between)), 0.0);
    const double low = lamp ? std::min(towards / kLow, 1.0) : 1.0;
    shade.specular = certainty * kSpecular * std::pow(half, 30) * low;
    return shade;
}

}  // namespace render

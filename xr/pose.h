// Poses and fields of view as doubles, and the views that they make. Pure: no runtime, no GL.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "render/points/view.h"

namespace xr {

// Where a thing is in a space: spaceFromThing. Metres; x right, y up, -z forward; unit quaternion.
struct Pose {
    glm::dquat orientation{1, 0, 0, 0};
    glm::dvec3 position{0};
    friend bool operator==(const Pose&, const Pose&) = default;
};
glm::dmat4 matrix(const Pose& pose);
Pose inverse(const Pose& pose);
Pose operator*(const Pose& aFromB, const Pose& bFromC);

// Angles in radians; left and down are negative of most eyes.
struct Fov {
    double left, right, up, down;
};

// Where the volume stands: stageFromWorld = translation * rotation * scale. The world is
// render::PlacedPoints's (z up, half diagonal 1), the stage OpenXR's (y up, metres).
struct Placement {
    Pose stageFromVolume;        // of the volume's own axes
    double metresPerUnit = 0.3;  // > 0: half the box's diagonal in metres
    friend bool operator==(const Placement&, const Placement&) = default;
};
glm::dmat4 stageFromWorld(const Placement& placement);

// What one eye sees of the world. `near` and `far` in metres.
render::View viewOf(const Pose& stageFromEye, const Fov& fov, const Placement& placement,
                    double near, double far, glm::ivec2 size);

}  // namespace xr

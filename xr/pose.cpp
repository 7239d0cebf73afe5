#include "xr/pose.h"

#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace xr {

glm::dmat4 matrix(const Pose& pose) {
    return glm::translate(glm::dmat4(1.0), pose.position) * glm::mat4_cast(pose.orientation);
}

Pose inverse(const Pose& pose) {
    const glm::dquat back = glm::conjugate(pose.orientation);
    return {back, -(back * pose.position)};
}

Pose operator*(const Pose& aFromB, const Pose& bFromC) {
    return {glm::normalize(aFromB.orientation * bFromC.orientation),
            aFromB.orientation * bFromC.position + aFromB.position};
}

glm::dmat4 stageFromWorld(const Placement& placement) {
    return glm::scale(matrix(placement.stageFromVolume), glm::dvec3(placement.metresPerUnit));
}

render::View viewOf(const Pose& stageFromEye, const Fov& fov, const Placement& placement,
                    double near, double far, glm::ivec2 size) {
    assert(0 < near && near < far);
    const render::Frustum frustum{.left = std::tan(fov.left),
                                  .right = std::tan(fov.right),
                                  .down = std::tan(fov.down),
                                  .up = std::tan(fov.up),
                                  .near = near,
                                  .far = far};
    return {render::clipFromView(frustum),
            matrix(inverse(stageFromEye)) * stageFromWorld(placement), size};
}

}  // namespace xr

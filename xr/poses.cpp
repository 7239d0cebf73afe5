#include "xr/poses.h"

#include <cmath>

namespace xr {
namespace {

bool isRotationAndPlace(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    const XrVector3f& p = pose.position;
    const double norm = std::hypot(std::hypot(q.x, q.y, q.z), q.w);
    // Quaternions may be 1 % off (OpenXR 1.0, 2.16).
    return std::abs(norm - 1) < 0.01 && std::isfinite(p.x) && std::isfinite(p.y) &&
           std::isfinite(p.z);
}

}  // namespace

Pose fromXr(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    const XrVector3f& p = pose.position;
    return {glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)), {p.x, p.y, p.z}};
}

XrPosef toXr(const Pose& pose) {
    const auto f = [](double number) { return static_cast<float>(number); };
    const glm::dquat& q = pose.orientation;
    const glm::dvec3& p = pose.position;
    return {{f(q.x), f(q.y), f(q.z), f(q.w)}, {f(p.x), f(p.y), f(p.z)}};
}

std::optional<Pose> validPose(const XrSpaceLocation& location) {
    // Valid is enough: simulated and 3-DoF headsets know places that they do not track.
    constexpr XrSpaceLocationFlags kValid =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
    if ((location.locationFlags & kValid) != kValid || !isRotationAndPlace(location.pose))
        return std::nullopt;
    return fromXr(location.pose);
}

std::optional<EyePose> validEye(const XrView& view, XrViewStateFlags flags) {
    constexpr XrViewStateFlags kValid =
        XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
    const XrFovf& f = view.fov;
    if ((flags & kValid) != kValid || !isRotationAndPlace(view.pose) ||
        !(f.angleLeft < f.angleRight) || !(f.angleDown < f.angleUp))
        return std::nullopt;
    return EyePose{fromXr(view.pose), {f.angleLeft, f.angleRight, f.angleUp, f.angleDown}};
}

}  // namespace xr

// OpenXR's poses as ours. A lost runtime answers calls with success and zeros, so each pose that is
// taken over is looked at.
#pragma once

#include <optional>

#include "xr/api.h"
#include "xr/pose.h"

namespace xr {

Pose fromXr(const XrPosef& pose);
XrPosef toXr(const Pose& pose);

// Absent unless position and orientation are said to be valid, and are.
std::optional<Pose> validPose(const XrSpaceLocation& location);
// Absent as above, and where the field of view has no inside.
struct EyePose {
    Pose stageFromEye;
    Fov fov;
};
std::optional<EyePose> validEye(const XrView& view, XrViewStateFlags flags);

}  // namespace xr

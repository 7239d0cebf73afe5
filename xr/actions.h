// What the user's hands do, by intention: OpenXR's actions, and which parts of a controller the
// runtime has bound to them.
#pragma once

#include <array>
#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "xr/api.h"
#include "xr/runtime.h"

namespace xr {

class Actions {
 public:
    // Suggests bindings for the profiles that are tested and attaches to the session.
    // REQUIRES: runtime outlives this.
    Actions(const Runtime& runtime, XrSession session);

    // The hands at `time`, in `stage`. Nothing but poses without focus.
    std::array<Hand, 2> read(XrSpace stage, XrTime time);
    // After the runtime said that the profile changed.
    Controls controls() const;
    void vibrate(int hand, double amplitude, std::chrono::nanoseconds duration) const;

 private:
    XrAction made(const char* name, const char* localizedName, XrActionType type);
    struct Part;
    void suggestBindings() const;
    void suggest(const char* profile, std::span<const Part> parts) const;
    std::vector<XrPath> sources(XrAction action) const;
    XrSpace poseSpace(XrAction action, XrPath hand) const;
    bool pressed(XrAction action, XrPath hand) const;
    glm::dvec2 position(XrAction action, XrPath hand) const;
    std::string partName(XrPath source) const;

    const Runtime* runtime_;
    XrSession session_;
    XrActionSet set_ = XR_NULL_HANDLE;
    std::array<XrPath, 2> hands_{};
    XrAction grab_, select_, menu_, swing_, bring_, stick_, grip_, aim_, vibration_;
    std::array<XrSpace, 2> gripSpaces_{}, aimSpaces_{};
};

}  // namespace xr

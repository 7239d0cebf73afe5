#include "xr/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "xr/poses.h"

namespace xr {

XrAction Actions::made(const char* name, const char* localizedName, XrActionType type) {
    auto info = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::strcpy(info.actionName, name);
    std::strcpy(info.localizedActionName, localizedName);
    info.actionType = type;
    info.countSubactionPaths = static_cast<std::uint32_t>(hands_.size());
    info.subactionPaths = hands_.data();
    XrAction action = XR_NULL_HANDLE;
    runtime_->check(xrCreateAction(set_, &info, &action), "xrCreateAction");
    return action;
}

Actions::Actions(const Runtime& runtime, XrSession session)
    : runtime_(&runtime), session_(session) {
    auto info = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    std::strcpy(info.actionSetName, "explore");
    std::strcpy(info.localizedActionSetName, "Explore");
    runtime.check(xrCreateActionSet(runtime.instance(), &info, &set_), "xrCreateActionSet");
    hands_ = {runtime.path("/user/hand/left"), runtime.path("/user/hand/right")};
    grab_ = made("grab", "Grab the volume", XR_ACTION_TYPE_BOOLEAN_INPUT);
    select_ = made("select", "Play, pause, click", XR_ACTION_TYPE_BOOLEAN_INPUT);
    menu_ = made("menu", "Help and panel", XR_ACTION_TYPE_BOOLEAN_INPUT);
    swing_ = made("swing", "Swing the sweep", XR_ACTION_TYPE_BOOLEAN_INPUT);
    bring_ = made("bring", "Bring the volume here", XR_ACTION_TYPE_BOOLEAN_INPUT);
    stick_ = made("stick", "Move value or time", XR_ACTION_TYPE_VECTOR2F_INPUT);
    grip_ = made("grip", "Hand", XR_ACTION_TYPE_POSE_INPUT);
    aim_ = made("aim", "Pointer", XR_ACTION_TYPE_POSE_INPUT);
    vibration_ = made("vibration", "Vibration", XR_ACTION_TYPE_VIBRATION_OUTPUT);
    suggestBindings();

    auto attach = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
    attach.countActionSets = 1;
    attach.actionSets = &set_;
    runtime.check(xrAttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
    for (std::size_t h = 0; h < hands_.size(); ++h) {
        gripSpaces_[h] = poseSpace(grip_, hands_[h]);
        aimSpaces_[h] = poseSpace(aim_, hands_[h]);
    }
}

// A part of a controller that means an action: of both hands' controllers, or of one.
struct Actions::Part {
    XrAction action;
    const char* source;
    enum class Of { Both, Left, Right } of = Of::Both;
};

void Actions::suggest(const char* profile, std::span<const Part> parts) const {
    std::vector<XrActionSuggestedBinding> suggested;
    for (const Part& part : parts) {
        const auto add = [&](const char* hand) {
            suggested.push_back(
                {part.action, runtime_->path(fmt::format("{}{}", hand, part.source))});
        };
        if (part.of != Part::Of::Right) add("/user/hand/left");
        if (part.of != Part::Of::Left) add("/user/hand/right");
    }
    auto info =
        typed<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    info.interactionProfile = runtime_->path(profile);
    info.countSuggestedBindings = static_cast<std::uint32_t>(suggested.size());
    info.suggestedBindings = suggested.data();
    runtime_->check(xrSuggestInteractionProfileBindings(runtime_->instance(), &info),
                    "xrSuggestInteractionProfileBindings");
}

// The fullest first: a runtime that maps one controller to another may take the first that fits.
void Actions::suggestBindings() const {
    using enum Part::Of;
    // The force, not the value, of a squeeze: a hand that only rests on the controller has a value.
    suggest("/interaction_profiles/valve/index_controller",
            std::array{Part{grab_, "/input/squeeze/force"}, Part{select_, "/input/trigger/click"},
                       Part{menu_, "/input/a/click"}, Part{swing_, "/input/b/click"},
                       Part{bring_, "/input/thumbstick/click"}, Part{stick_, "/input/thumbstick"},
                       Part{grip_, "/input/grip/pose"}, Part{aim_, "/input/aim/pose"},
                       Part{vibration_, "/output/haptic"}});
    // What WiVRn and most others give; A and X, B and Y lie alike.
    suggest(
        "/interaction_profiles/oculus/touch_controller",
        std::array{Part{grab_, "/input/squeeze/value"}, Part{select_, "/input/trigger/value"},
                   Part{menu_, "/input/x/click", Left}, Part{menu_, "/input/a/click", Right},
                   Part{menu_, "/input/menu/click", Left}, Part{swing_, "/input/y/click", Left},
                   Part{swing_, "/input/b/click", Right}, Part{bring_, "/input/thumbstick/click"},
                   Part{stick_, "/input/thumbstick"}, Part{grip_, "/input/grip/pose"},
                   Part{aim_, "/input/aim/pose"}, Part{vibration_, "/output/haptic"}});
    // One button holds and clicks: who draws knows what the ray is on.
    suggest("/interaction_profiles/khr/simple_controller",
            std::array{Part{grab_, "/input/select/click"}, Part{select_, "/input/select/click"},
                       Part{menu_, "/input/menu/click"}, Part{grip_, "/input/grip/pose"},
                       Part{aim_, "/input/aim/pose"}, Part{vibration_, "/output/haptic"}});
}

XrSpace Actions::poseSpace(XrAction action, XrPath hand) const {
    auto info = typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = action;
    info.subactionPath = hand;
    info.poseInActionSpace.orientation.w = 1;
    XrSpace space = XR_NULL_HANDLE;
    runtime_->check(xrCreateActionSpace(session_, &info, &space), "xrCreateActionSpace");
    return space;
}

bool Actions::pressed(XrAction action, XrPath hand) const {
    auto info = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    info.action = action;
    info.subactionPath = hand;
    auto state = typed<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
    runtime_->check(xrGetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
    return state.isActive && state.currentState;
}

glm::dvec2 Actions::position(XrAction action, XrPath hand) const {
    auto info = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    info.action = action;
    info.subactionPath = hand;
    auto state = typed<XrActionStateVector2f>(XR_TYPE_ACTION_STATE_VECTOR2F);
    runtime_->check(xrGetActionStateVector2f(session_, &info, &state), "xrGetActionStateVector2f");
    if (!state.isActive) return glm::dvec2(0);
    return {state.currentState.x, state.currentState.y};
}

std::array<Hand, 2> Actions::read(XrSpace stage, XrTime time) {
    const XrActiveActionSet active{set_, XR_NULL_PATH};
    auto sync = typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
    sync.countActiveActionSets = 1;
    sync.activeActionSets = &active;
    // Without focus this succeeds as XR_SESSION_NOT_FOCUSED, and every action is inactive.
    runtime_->check(xrSyncActions(session_, &sync), "xrSyncActions");
    const auto located = [&](XrSpace space) {
        auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
        runtime_->check(xrLocateSpace(space, stage, time, &location), "xrLocateSpace");
        return validPose(location);
    };
    std::array<Hand, 2> hands;
    for (std::size_t h = 0; h < hands.size(); ++h) {
        hands[h].grip = located(gripSpaces_[h]);
        hands[h].aim = located(aimSpaces_[h]);
        hands[h].grab = pressed(grab_, hands_[h]);
        hands[h].select = pressed(select_, hands_[h]);
        hands[h].menu = pressed(menu_, hands_[h]);
        hands[h].swing = pressed(swing_, hands_[h]);
        hands[h].bring = pressed(bring_, hands_[h]);
        hands[h].stick = position(stick_, hands_[h]);
    }
    return hands;
}

std::vector<XrPath> Actions::sources(XrAction action) const {
    auto info = typed<XrBoundSourcesForActionEnumerateInfo>(
        XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
    info.action = action;
    std::uint32_t count = 0;
    runtime_->check(xrEnumerateBoundSourcesForAction(session_, &info, 0, &count, nullptr),
                    "xrEnumerateBoundSourcesForAction");
    std::vector<XrPath> found(count);
    if (count > 0)
        runtime_->check(
            xrEnumerateBoundSourcesForAction(session_, &info, count, &count, found.data()),
            "xrEnumerateBoundSourcesForAction");
    return found;
}

Controls Actions::controls() const {
    Controls controls;
    const std::pair<const char*, XrAction> actions[] = {
        {"Grab the volume", grab_},        {"Play, pause, click", select_},
        {"Help and panel", menu_},         {"Swing the sweep", swing_},
        {"Bring the volume here", bring_}, {"Move value or time", stick_}};
    for (const auto& [title, action] : actions) {
        std::set<std::string> parts;  // the same of both hands are named once
        for (const XrPath source : sources(action)) parts.insert(partName(source));
        if (parts.empty()) continue;
        if (!controls.text.empty()) controls.text += '\n';
        controls.text += fmt::format("{}: {}", title, fmt::join(parts, ", "));
    }
    controls.sticks = !sources(stick_).empty();
    const std::vector<XrPath> grabs = sources(grab_);
    controls.oneButton = !grabs.empty() && grabs == sources(select_);
    return controls;
}

std::string Actions::partName(XrPath source) const {
    auto info =
        typed<XrInputSourceLocalizedNameGetInfo>(XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO);
    info.sourcePath = source;
    info.whichComponents = XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT;
    std::uint32_t size = 0;
    runtime_->check(xrGetInputSourceLocalizedName(session_, &info, 0, &size, nullptr),
                    "xrGetInputSourceLocalizedName");
    std::string name(size, '\0');
    runtime_->check(xrGetInputSourceLocalizedName(session_, &info, size, &size, name.data()),
                    "xrGetInputSourceLocalizedName");
    name.resize(std::strlen(name.c_str()));
    return name;
}

void Actions::vibrate(int hand, double amplitude, std::chrono::nanoseconds duration) const {
    auto vibration = typed<XrHapticVibration>(XR_TYPE_HAPTIC_VIBRATION);
    vibration.amplitude = static_cast<float>(std::clamp(amplitude, 0.0, 1.0));
    vibration.duration = duration.count();
    vibration.frequency = XR_FREQUENCY_UNSPECIFIED;
    auto info = typed<XrHapticActionInfo>(XR_TYPE_HAPTIC_ACTION_INFO);
    info.action = vibration_;
    info.subactionPath = hands_[static_cast<std::size_t>(hand)];
    runtime_->check(xrApplyHapticFeedback(session_, &info,
                                          reinterpret_cast<const XrHapticBaseHeader*>(&vibration)),
                    "xrApplyHapticFeedback");
}

}  // namespace xr

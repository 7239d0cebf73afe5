#include "app/choices/idle_choices.h"

#include <fmt/format.h>

namespace app {

std::string_view whyUnlit(const Explorer& e) {
    if (modelOf(e) == Model::Points) return "points are not lit";
    if (e.order == render::Order::None) return "light needs the order of depth";
    return "";
}

std::vector<std::string> idleChoices(const Explorer& e) {
    std::vector<std::string> idle;
    const auto add = [&](std::string_view option, std::string_view why) {
        if (!why.empty()) idle.push_back(fmt::format("{} does nothing: {}", option, why));
    };
    if (e.light == render::Light::Full) add("--light full", whyUnlit(e));
    if (e.lamp) add("--light-from", e.light == render::Light::Off ? "light is off" : whyUnlit(e));
    if (e.opacityPer == render::OpacityPer::Length && modelOf(e) == Model::Points)
        add("--opacity-per length", "points have no other opacity");
    const bool isStereo = e.stereo.mode != Stereo::Off;
    if (e.stereo.eyeDistance && !isStereo) add("--eye-distance", "stereo is off");
    if (e.stereo.convergence && !isStereo) add("--convergence", "stereo is off");
    return idle;
}

}  // namespace app

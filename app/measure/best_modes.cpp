#include "app/measure/best_modes.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

// The round numbers from the first that is not below `least` to the first not below `most`.
std::vector<double> roundLimits(double least, double most) {
    std::vector<double> limits;
    if (!std::isfinite(least) || !std::isfinite(most)) return limits;
    for (double decade = std::pow(10, std::floor(std::log10(least)));; decade *= 10)
        for (const double digit : {1, 2, 5}) {
            if (digit * decade < least) continue;
            limits.push_back(digit * decade);
            if (limits.back() >= most) return limits;
        }
}

std::vector<std::size_t> choicesOf(std::span<const Measured> modes) {
    const auto isLit = [](const Measured& m) { return m.mode.light != render::Light::Off; };
    const auto isOrdered = [&](const Measured& m) {
        return m.mode.order != render::Order::None && !isLit(m);
    };
    const bool someOrdered = std::ranges::any_of(modes, isOrdered);
    std::vector<std::size_t> choices;
    for (std::size_t i = 0; i < modes.size(); ++i)
        if (!isLit(modes[i]) && !modes[i].massIsOff() && std::isfinite(modes[i].depthError) &&
            isOrdered(modes[i]) == someOrdered)
            choices.push_back(i);
    return choices;
}

// Of those whose `limited` keeps to it, the one whose `wanted` is least.
std::vector<BestMode> bestWithin(std::span<const Measured> modes, double Measured::*limited,
                                 double Measured::*wanted) {
    const std::vector<std::size_t> choices = choicesOf(modes);
    double least = INFINITY, most = 0;
    for (const std::size_t i : choices) {
        const double value = modes[i].*limited;
        if (value > 0) least = std::min(least, value);
        most = std::max(most, value);
    }
    std::vector<BestMode> best;
    for (const double limit : roundLimits(least, most)) {
        BestMode& at = best.emplace_back(BestMode{limit, {}});
        for (const std::size_t i : choices)
            if (modes[i].*limited <= limit &&
                (!at.mode || modes[i].*wanted < modes[*at.mode].*wanted))
                at.mode = i;
    }
    return best;
}

}  // namespace

std::vector<BestMode> mostAccurateWithin(std::span<const Measured> modes) {
    return bestWithin(modes, &Measured::frame, &Measured::depthError);
}
std::vector<BestMode> soonestWithin(std::span<const Measured> modes) {
    return bestWithin(modes, &Measured::depthError, &Measured::frame);
}

}  // namespace app

// What is written near the hand: which values, when, how many points. Pure.
#pragma once

#include <string>

#include "app/exploration.h"

namespace app::headset {

// A line each: the values shown (with units), the time and the step, how many points, and, where
// it is so, what is shown instead of what was asked for, that nothing plays on, and the share of
// the headset's resolution that is drawn. Before there are data, what is being opened.
std::string readoutText(const Exploration& exploration, double renderScale);

}  // namespace app::headset

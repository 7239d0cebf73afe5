// What a front end does with the driver's complaints, once a frame.
#pragma once

#include "app/exploration/exploration.h"

namespace app {

// A complaint ends a program that is being tested (by std::runtime_error), and is told to a user.
// REQUIRES: a current GL context that records errors.
void checkDriver(Exploration& exploration);

}  // namespace app

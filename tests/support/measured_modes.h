// What a mode was measured to be, for plots and tables of them.
#pragma once

#include "app/measure/measurement.h"

namespace tests {

inline app::Measured measuredAt(double frame, double error, app::Mode mode = {}, double mass = 1) {
    app::Measured m;
    m.mode = mode;
    m.frame = frame;
    m.depthError = error;
    m.mass = mass;
    return m;
}

}  // namespace tests

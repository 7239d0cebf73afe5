// A GL 4.5 core context of an X display, current on the thread that made it: what a window of the
// desktop has where GLFW uses GLX.
#pragma once

#include "xr/session.h"

namespace tests {

class GlxContext {
 public:
    // On $DISPLAY. Throws std::runtime_error saying what it lacks.
    GlxContext();
    ~GlxContext();
    GlxContext(const GlxContext&) = delete;
    GlxContext& operator=(const GlxContext&) = delete;

    const xr::XlibBinding& binding() const { return binding_; }

 private:
    xr::XlibBinding binding_{};
};

}  // namespace tests

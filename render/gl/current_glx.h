// The context that is current, by GLX's names, for another library that draws with it.
#pragma once

#include <optional>

namespace render::gl {

struct GlxNames {
    void* display;           // Display*
    unsigned visual;         // VisualID
    void* config;            // GLXFBConfig
    unsigned long drawable;  // GLXDrawable
    void* context;           // GLXContext
};
// None where the current context is not GLX's.
std::optional<GlxNames> currentGlx();

}  // namespace render::gl

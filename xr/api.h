// OpenXR's headers with the platforms that are used here; included by xr/*.cpp only. X11's own
// headers define words like None and Status, so the four types that OpenXR needs of them stand
// here.
#pragma once

#include "render/gl/object.h"  // GL's names, which epoxy wants to define before EGL's header

#define EGL_NO_X11
#include <EGL/egl.h>

extern "C" {
using Display = struct _XDisplay;
using GLXFBConfig = struct __GLXFBConfigRec*;
using GLXContext = struct __GLXcontextRec*;
using GLXDrawable = unsigned long;
}

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_EGL
#define XR_USE_PLATFORM_XLIB
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace xr {

// Newer than the OpenXR 1.0.20 of Debian 12 (1.1, appendix of XR_EXT_local_floor).
inline constexpr XrVersion kApi11 = XR_MAKE_VERSION(1, 1, 0), kApi10 = XR_MAKE_VERSION(1, 0, 0);
inline constexpr const char* kLocalFloorExtension = "XR_EXT_local_floor";
inline constexpr auto kLocalFloor = static_cast<XrReferenceSpaceType>(1000426000);

// A structure of OpenXR: its type set, all else zero.
template <typename Structure>
Structure typed(XrStructureType type) {
    Structure structure{};
    structure.type = type;
    return structure;
}

}  // namespace xr

// What a headset's lenses hide of each eye's image, as the runtime tells it
// (XR_KHR_visibility_mask).
#pragma once

#include <cstdint>
#include <memory>

#include "render/annotate/hidden_area.h"
#include "xr/api.h"
#include "xr/runtime.h"

namespace xr {

// Null where the runtime knows of nothing, also by an error: Monado tells one of headsets without a
// mask. Null of a mesh that is none.
std::shared_ptr<const render::HiddenArea> hiddenArea(const Runtime& runtime, XrSession session,
                                                     std::uint32_t view);

}  // namespace xr

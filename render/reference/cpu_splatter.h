// Splatting on the CPU. In double, with the exact order, it is the truth that every picture is held
// against; in float it shows what float arithmetic alone costs.
#pragma once

#include <span>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/accumulator.h"

namespace render {

// Adds the scene to `into`. `opaqueDepth` is the depth [0, 1] of the opaque scene a pixel, row 0 at
// the bottom, or empty: a splat whose centre lies behind it is not drawn there. Colours by value
// take each point's own value in double.
// REQUIRES: into.size == view.size; into.channels fit the scene (one a layer, or one of Over,
// Count); a Sorted list for Over.
template <typename Real>
void splat(const Scene& scene, const DrawList& list, const View& view,
           std::span<const float> opaqueDepth, Accumulator<Real>& into);

extern template void splat(const Scene&, const DrawList&, const View&, std::span<const float>,
                           Accumulator<float>&);
extern template void splat(const Scene&, const DrawList&, const View&, std::span<const float>,
                           Accumulator<double>&);

// One pixel's light: premultiplied linear colour and the share of what lies behind that is hidden.
struct Resolved {
    glm::dvec3 rgb{0};
    double alpha = 0;
    double opticalDepth = 0;
};
// Unordered layers mix by optical depth: C = sum(c_k tau_k) (1 - e^-tau) / tau. REQUIRES: the
// accumulator of channelsFor(scene).
template <typename Real>
Resolved resolvePixel(const Accumulator<Real>& from, const std::vector<Layer>& layers, int x,
                      int y);

extern template Resolved resolvePixel(const Accumulator<float>&, const std::vector<Layer>&, int,
                                      int);
extern template Resolved resolvePixel(const Accumulator<double>&, const std::vector<Layer>&, int,
                                      int);

}  // namespace render

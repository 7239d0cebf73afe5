// Whether a picture without depth order mixes its colours so much that it should say so.
#pragma once

#include "render/model/scene.h"
#include "render/points/view.h"

namespace render {

// Unordered colours mix by optical depth along each ray: right where little is hidden, and above
// about this much optical depth on average no longer what an ordered picture shows.
constexpr double kMixedDepth = 0.3;
// Pixels of less optical depth than this do not count as covered: they are hardly seen.
constexpr double kCoveredDepth = 0.01;

// Unordered, and its points have more than one colour.
bool mixesColors(const Scene& scene);

// The mean optical depth of the pixels that the scene covers in this view; 0 where it covers none.
// An estimate, from at most 2^13 splats that stand for all (as in a moving picture) in a picture as
// coarse as these splats allow: exact to float where both are the picture's own, within a tenth of
// the truth where a splat stands for up to 14 points (tests/render/mean_depth_test.cpp), within a
// fifth where it stands for a hundred. Some milliseconds; draws nothing. What hides splats is left
// out.
double meanOpticalDepth(const Scene& scene, const View& view);

// What a picture is to say: both of the above.
inline bool isMixed(const Scene& scene, const View& view) {
    return mixesColors(scene) && meanOpticalDepth(scene, view) > kMixedDepth;
}

}  // namespace render

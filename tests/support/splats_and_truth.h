// Splats drawn on GL and summed on the processor, against the truth: the same model in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/gl_planes.h"

namespace render::splats_and_truth {

using tests::cube;
using tests::lookFrom;
using timeseries::RangeSet;

class GlSplat : public tests::GlTest {};

inline Scene noiseScene(const timeseries::SortedStep& step, const PlacedPoints& placed,
                        const char* range, RangeStyle style = {Constant{glm::dvec3(1)}, 0.5}) {
    return {.step = step,
            .placed = placed,
            .layers = {{step.select(RangeSet::parse(range)), style}},
            .footprint = {},
            .order = Order::None,
            .clip = {}};
}

inline std::vector<double> truth(const Scene& scene, const View& view, Channels channels,
                                 std::span<const float> opaqueDepth = {}) {
    // Of the first layer, as GlTest::plane, where every layer has its own.
    const bool alone = channels == Channels::Over || channels == Channels::Count;
    Accumulator<double> sums(view.size, std::vector(alone ? 1 : scene.layers.size(), channels));
    splat(scene, orderExactly(scene, tests::kMidEye), view, opaqueDepth, sums);
    return sums.planes[0];
}

// Of a plane, nothing opaque before it.
inline std::vector<float> onProcessor(const Scene& scene, const View& view, Channels channels) {
    return sumTiles(scene, order(scene, tests::kMidEye), view, channels, 0, {});
}

// relative L2 of a plane drawn on GL, or summed on the processor where that is worse.
inline double error(tests::GlTest& gl, const Scene& scene, const View& view, Channels channels) {
    const auto expected = truth(scene, view, channels);
    const double drawn = compareScalars(gl.plane(scene, view, channels), expected).relativeL2;
    const double summed = compareScalars(onProcessor(scene, view, channels), expected).relativeL2;
    return summed > drawn || std::isnan(summed) ? summed : drawn;
}

inline constexpr double kTarget = 1e-5;

}  // namespace render::splats_and_truth

#include "render/splat/tile_room.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/tile_room.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/tile_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// |ray| times what even splats share, and 1 / |ray / a|^2 of those.
HWY_ATTR void FillRays(const TileLayout& layout, TileRoom& room) {
    const Floats lanes;
    const F steps = hn::ConvertTo(lanes, hn::Iota(Ints(), 0));
    F most = hn::Zero(lanes);
    for (int row = 0; row < room.size.y; ++row) {
        const double y = room.at.y + row + 0.5 - layout.centre[1];
        const F ray0 = f(static_cast<float>(1 + static_cast<double>(layout.slope2[1]) * y * y));
        for (int i = 0; i < kTileStride; i += static_cast<int>(kLanes)) {
            const F x =
                hn::Add(f(static_cast<float>(room.at.x + i + 0.5 - layout.centre[0])), steps);
            F factor = hn::Sqrt(hn::MulAdd(hn::Mul(f(layout.slope2[0]), x), x, ray0));
            const auto at = static_cast<std::size_t>(row * kTileStride + i);
            if (layout.even) {
                F sum = hn::Zero(lanes);
                for (std::size_t a = 0; a < 3; ++a) {
                    const auto atY = static_cast<float>(
                        layout.axis[a] + y * static_cast<double>(layout.perPixelY[a]));
                    const F ray = hn::Mul(hn::MulAdd(x, f(layout.perPixelX[a]), f(atY)),
                                          f(1 / layout.semiAxes[a]));
                    sum = hn::MulAdd(ray, ray, sum);
                }
                const F perRay2 = hn::Div(f(1), sum);
                hn::StoreU(perRay2, lanes, room.perRay2.data() + at);
                factor = hn::Mul(factor, hn::Sqrt(perRay2));
            }
            hn::StoreU(factor, lanes, room.factor.data() + at);
            most = hn::Max(most, factor);
        }
    }
    room.largestFactor = hn::GetLane(hn::MaxOfLanes(lanes, most));
}

// Copies depths and returns the nearest of them, or 1.
HWY_ATTR float TakeDepths(const float* from, std::size_t count, float* to) {
    const Floats lanes;
    F nearest = f(1);
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        const F depths = hn::LoadU(lanes, from + i);
        hn::StoreU(depths, lanes, to + i);
        nearest = hn::Min(nearest, depths);
    }
    float least = hn::GetLane(hn::MinOfLanes(lanes, nearest));
    for (; i < count; ++i) least = std::min(least, to[i] = from[i]);
    return least;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FillRays);
HWY_EXPORT(TakeDepths);

TileRoom::TileRoom(const TileLayout& layout) {
    plane = static_cast<std::size_t>(kTileStride * (layout.tile.y + 4)) + 16;
    sums.resize(plane * floatsPerPixel(layout.channels));
    factor.resize(plane);
    perRay2.resize(plane);
    opaque.resize(plane);
}

void TileRoom::enter(const TileLayout& layout, std::size_t tile, std::span<const float> opaqueDepth,
                     int pictureWidth) {
    at = cornerOf(layout, tile);
    size = glm::min(layout.tile, layout.box.size - at);
    nearestOpaque = 1;
    if (!opaqueDepth.empty())
        for (int row = 0; row < size.y; ++row) {
            const glm::ivec2 pixel =
                (layout.box.at + glm::ivec2(at.x, at.y + row)) / layout.raysAcross;
            const float* const from =
                opaqueDepth.data() + std::ptrdiff_t(pixel.y) * pictureWidth + pixel.x;
            float* const to = opaque.data() + std::ptrdiff_t(row) * kTileStride;
            const auto count = static_cast<std::size_t>(size.x / layout.raysAcross);
            const float nearest = HWY_DYNAMIC_DISPATCH(TakeDepths)(from, count, to);
            nearestOpaque = std::min(nearestOpaque, nearest);
            if (layout.raysAcross > 1)
                for (int x = 0; x < size.x; ++x) to[x] = from[x / layout.raysAcross];
        }
    HWY_DYNAMIC_DISPATCH(FillRays)(layout, *this);
}

bool TileRoom::isClosed() const {
    for (int row = 0; row < size.y; ++row) {
        const auto first = sums.begin() + std::ptrdiff_t(3 * plane) + row * kTileStride;
        if (std::any_of(first, first + size.x, [](float opacity) { return opacity < 1; }))
            return false;
    }
    return true;
}

}  // namespace render
#endif

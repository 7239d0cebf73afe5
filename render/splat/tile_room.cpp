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

// The nearest of these depths, or 1.
HWY_ATTR float NearestOf(const float* depths, std::size_t count) {
    const Floats lanes;
    F nearest = f(1);
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes)
        nearest = hn::Min(nearest, hn::LoadU(lanes, depths + i));
    float least = hn::GetLane(hn::MinOfLanes(lanes, nearest));
    for (; i < count; ++i) least = std::min(least, depths[i]);
    return least;
}

HWY_ATTR void InterleaveRow(const float* sums, std::size_t plane, const float* factor,
                            std::size_t width, float* to) {
    const Floats lanes;
    std::size_t x = 0;
    for (; x + kLanes <= width; x += kLanes) {
        const F by = factor ? hn::LoadU(lanes, factor + x) : f(1);
        F of[4];
        for (std::size_t c = 0; c < 4; ++c)
            of[c] = hn::Mul(by, hn::LoadU(lanes, sums + c * plane + x));
        hn::StoreInterleaved4(of[0], of[1], of[2], of[3], lanes, to + 4 * x);
    }
    for (; x < width; ++x)
        for (std::size_t c = 0; c < 4; ++c)
            to[4 * x + c] = factor ? factor[x] * sums[c * plane + x] : sums[c * plane + x];
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FillRays);
HWY_EXPORT(InterleaveRow);
HWY_EXPORT(NearestOf);

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
    const auto rowOf = [&](int row) {
        const glm::ivec2 pixel = (layout.box.at + glm::ivec2(at.x, at.y + row)) / layout.raysAcross;
        return opaqueDepth.data() + std::ptrdiff_t(pixel.y) * pictureWidth + pixel.x;
    };
    const auto pixels = static_cast<std::size_t>(size.x / layout.raysAcross);
    if (!opaqueDepth.empty())
        for (int row = 0; row < size.y; row += layout.raysAcross)
            nearestOpaque =
                std::min(nearestOpaque, HWY_DYNAMIC_DISPATCH(NearestOf)(rowOf(row), pixels));
    if (nearestOpaque < 1)
        for (int row = 0; row < size.y; ++row) {
            float* const to = opaque.data() + std::ptrdiff_t(row) * kTileStride;
            for (int x = 0; x < size.x; ++x) to[x] = rowOf(row)[x / layout.raysAcross];
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

void interleaveRow(const float* sums, std::size_t plane, const float* factor, std::size_t width,
                   float* to) {
    HWY_DYNAMIC_DISPATCH(InterleaveRow)(sums, plane, factor, width, to);
}

}  // namespace render
#endif

#include "render/reference/cpu_splatter.h"

#include <cassert>

#include "render/model/footprint.h"

namespace render {
namespace {

// Calls visit(x, y, W) for every pixel of the view that the splat touches.
template <typename Real, typename Visit>
void forEachPixel(const Splat<Real>& s, glm::ivec2 size, const PointsView& view, Kernel kernel,
                  const Visit& visit) {
    using Vec2 = glm::vec<2, Real>;
    const Vec2 axis(view.rays.centre), focal(view.rays.focal);
    const Real rayUnit = static_cast<Real>(view.rayLength);
    const Vec2 window = axis + s.centre;
    const auto [x0, x1] = pixelSpan(window.x, s.lo.x, s.hi.x, kernel, size.x);
    const auto [y0, y1] = pixelSpan(window.y, s.lo.y, s.hi.y, kernel, size.y);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const Vec2 at =
                Vec2(static_cast<Real>(x) + Real(0.5), static_cast<Real>(y) + Real(0.5)) - axis;
            const auto weight = weightOn<Real>(s, kernel, at - s.centre, at / focal, rayUnit);
            if (weight) visit(x, y, *weight);
        }
    }
}

struct Painter {
    glm::dvec3 rgb;
    double depthPerWeight;
};

Painter painter(const Scene& scene, const Layer& layer, std::uint64_t point) {
    return {colorOf(layer.style, timeseries::toDouble(scene.step.value(point))),
            opticalDepthPerWeight(layer.style.opacity)};
}

template <typename Real>
void deposit(Channels channels, const Painter& paint, Real weight, Real* pixel) {
    const glm::vec<3, Real> rgb(paint.rgb);
    switch (channels) {
        case Channels::Weight:
            pixel[0] += weight;
            return;
        case Channels::Count:
            pixel[0] += 1;
            return;
        case Channels::WeightedColor:
            for (int c = 0; c < 3; ++c) pixel[c] += weight * rgb[c];
            pixel[3] += weight;
            return;
        case Channels::Over: {
            const Real alpha = -std::expm1(-static_cast<Real>(paint.depthPerWeight) * weight);
            for (int c = 0; c < 3; ++c) pixel[c] = rgb[c] * alpha + pixel[c] * (1 - alpha);
            pixel[3] = alpha + pixel[3] * (1 - alpha);
            return;
        }
    }
}

}  // namespace

template <typename Real>
void splat(const Scene& scene, const DrawList& list, const View& view,
           std::span<const float> opaqueDepth, Accumulator<Real>& into) {
    assert(scene.layers.size() <= into.channels.size() || into.channels[0] == Channels::Over ||
           into.channels[0] == Channels::Count);
    const PointsView pointsView(scene.placed, view);
    const auto gridIndex = columnsOf(scene).gridIndex;
    std::vector<double> perSplat;
    for (const Layer& layer : scene.layers) perSplat.push_back(pointsPerSplat(layer, scene.stride));
    const auto draw = [&](std::size_t layer, std::uint64_t point) {
        const std::uint32_t i = gridIndex[point];
        if (!scene.placed.inside(i, scene.clip)) return;
        auto s = splatAt<Real>(pointsView, i, scene.footprint);
        if (!s.visible) return;
        s.weight *= static_cast<Real>(perSplat[layer]);
        const double depth = windowDepth(view, static_cast<double>(s.depth));
        if (depth > 1) return;  // beyond the far plane
        const bool alone =
            into.channels[0] == Channels::Over || into.channels[0] == Channels::Count;
        const std::size_t plane = alone ? 0 : layer;
        const Channels channels = into.channels[plane];
        const std::size_t floats = floatsPerPixel(channels);
        const Painter paint = painter(scene, scene.layers[layer], point);
        const auto visit = [&](int x, int y, Real weight) {
            const std::size_t pixel = std::size_t(y) * view.size.x + x;
            if (!opaqueDepth.empty() && depth > static_cast<double>(opaqueDepth[pixel])) return;
            deposit(channels, paint, weight, &into.planes[plane][pixel * floats]);
        };
        forEachPixel<Real>(s, view.size, pointsView, scene.footprint.kernel, visit);
    };
    if (const auto* sorted = std::get_if<Sorted>(&list)) {
        for (std::size_t i = 0; i < sorted->point.size(); ++i)
            draw(sorted->layer[i], sorted->point[i]);
        return;
    }
    for (std::size_t layer = 0; layer < scene.layers.size(); ++layer)
        for (const timeseries::Run& run : scene.layers[layer].runs)
            forEachInSubset(run, strideOf(scene.layers[layer], scene.stride),
                            [&](std::uint64_t point) { draw(layer, point); });
}

template void splat(const Scene&, const DrawList&, const View&, std::span<const float>,
                    Accumulator<float>&);
template void splat(const Scene&, const DrawList&, const View&, std::span<const float>,
                    Accumulator<double>&);

template <typename Real>
Resolved resolvePixel(const Accumulator<Real>& from, const std::vector<Layer>& layers, int x,
                      int y) {
    const std::size_t pixel = std::size_t(y) * from.size.x + x;
    Resolved out;
    if (from.channels.size() == 1 && from.channels[0] == Channels::Over) {
        const Real* p = &from.planes[0][pixel * 4];
        out.rgb = {p[0], p[1], p[2]};
        out.alpha = static_cast<double>(p[3]);
        out.opticalDepth = -std::log1p(-out.alpha);
        return out;
    }
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const double perWeight = opticalDepthPerWeight(layers[k].style.opacity);
        if (const auto* constant = std::get_if<Constant>(&layers[k].style.color)) {
            const double tau = perWeight * static_cast<double>(from.planes[k][pixel]);
            out.opticalDepth += tau;
            out.rgb += tau * constant->linearRgb;
        } else {
            const Real* p = &from.planes[k][pixel * 4];
            out.opticalDepth += perWeight * static_cast<double>(p[3]);
            out.rgb += perWeight * glm::dvec3(p[0], p[1], p[2]);
        }
    }
    out.alpha = -std::expm1(-out.opticalDepth);
    // The limit of (1 - e^-t) / t at 0 is 1 - t / 2.
    out.rgb *= out.opticalDepth < 1e-8 ? 1 - out.opticalDepth / 2 : out.alpha / out.opticalDepth;
    return out;
}

template Resolved resolvePixel(const Accumulator<float>&, const std::vector<Layer>&, int, int);
template Resolved resolvePixel(const Accumulator<double>&, const std::vector<Layer>&, int, int);

}  // namespace render

#include "render/splat/cell_view.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace render {
namespace {

// What gradients are measured against, of the field a length of the world.
double steepnessOf(const Scene& scene) {
    if (scene.light == Light::Off) return 0;
    double most = 0;
    for (const Layer& layer : scene.layers)
        most = std::max(most, scene.cells->halfRange(layer.cells.candidates, kSteepQuantile));
    return kSteepnessShare * 2 * most / scene.placed.unitLength();
}

// Places among tints, and what is more than floats hold.
float place(double at) { return static_cast<float>(std::clamp(at, -1e30, 1e30)); }

}  // namespace

CellView::CellView(const Scene& scene, const View& view, Channels of)
    : CellView(PointsView(scene.placed, view), scene, view, of) {}

CellView::CellView(const PointsView& from, const Scene& scene, const View& view, Channels of)
    : TileLayout(scene, view, from, of),
      seen(from),
      weight(static_cast<float>(seen.rayLength / seen.unitLength)),
      rayLength(static_cast<float>(seen.rayLength)),
      light(channels == Channels::Over ? scene.light : Light::Off),
      steep(steepnessOf(scene)),
      byValue(std::ranges::any_of(scene.layers, [](const Layer& layer) {
          return std::holds_alternative<ByValue>(layer.style.color);
      })) {
    const glm::dmat3 back = glm::inverse(scene.placed.worldFromAxes());
    const glm::dmat3 m = back * glm::transpose(back);
    const std::array<double, 6> products = {m[0][0],     m[1][1],     m[2][2],
                                            2 * m[0][1], 2 * m[0][2], 2 * m[1][2]};
    for (std::size_t k = 0; k < 6; ++k) metric[k] = static_cast<float>(products[k]);
}

SeenCell seenCell(const CellView& view, const ValuedCell& cell, std::size_t layer,
                  const RangeStyle& style) {
    SeenCell c;
    const CellSplat<float> s = cellSplatAt<float>(view.seen, cell);
    if (!s.visible) return c;
    const auto span = [&](int a) {
        return pixelSpan(s.centre[a] + view.centre[static_cast<std::size_t>(a)],
                         static_cast<double>(s.lo[a]), static_cast<double>(s.hi[a]),
                         Kernel::Quartic, view.box.size[a]);
    };
    const PixelSpan x = span(0), y = span(1);
    if (x.first >= x.last || y.first >= y.last) return c;
    c.x = x.first;
    c.y = y.first;
    c.columns = x.last - x.first;
    c.rows = y.last - y.first;
    c.ox = static_cast<float>(x.first + 0.5 - view.centre[0] - s.centre.x);
    c.oy = static_cast<float>(y.first + 0.5 - view.centre[1] - s.centre.y);
    c.base = s.base;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto at = static_cast<int>(a);
        c.at[a] = s.at[at];
        c.ray[a] = s.ray[at];
        c.perSize[a] = s.perSize[at];
    }
    c.f = s.f;
    c.least = s.least;
    c.most = s.most;
    c.crossesLeast = s.crossesLeast;
    c.crossesMost = s.crossesMost;
    c.perRange = s.perRange;
    // A plateau is lit evenly; more than this would leave the floats.
    constexpr double kFlat = 1e10;
    c.steep = static_cast<float>(s.extent > 0 ? std::min(view.steep / s.extent, kFlat) : kFlat);
    if (view.tintsOf.empty()) return c;
    const TileLayout::Tints& tints = view.tintsOf[layer];
    c.firstTint = tints.first;
    c.lastTint = tints.first + tints.span;
    c.tint = tints.first;
    const auto* of = std::get_if<ByValue>(&style.color);
    if (of == nullptr) return c;
    const double span1 = static_cast<double>(tints.span), half = of->halfWidth();
    const bool isPoint = !(half > 0);
    c.tint = place(static_cast<double>(tints.first) +
                   span1 * (isPoint ? 0.5 : placeOnScale(s.reference, of->lo, half)));
    c.tintPerValue = isPoint ? 0 : place(span1 * (0.5 * s.extent / half));
    return c;
}

}  // namespace render

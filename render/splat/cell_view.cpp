#include "render/splat/cell_view.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace render {

std::array<float, 6> gradientMetric(const PlacedPoints& placed) {
    const glm::dmat3 back = glm::inverse(placed.worldFromAxes());
    const glm::dmat3 m = back * glm::transpose(back);
    const std::array<double, 6> products = {m[0][0],     m[1][1],     m[2][2],
                                            2 * m[0][1], 2 * m[0][2], 2 * m[1][2]};
    std::array<float, 6> metric{};
    for (std::size_t k = 0; k < 6; ++k) metric[k] = static_cast<float>(products[k]);
    return metric;
}

std::optional<AxisLamp> axisLamp(const Scene& scene, Channels channels) {
    if (channels != Channels::Over || scene.light == Light::Off || !scene.lamp) return std::nullopt;
    const glm::dmat3& world = scene.placed.worldFromAxes();
    return AxisLamp{glm::vec3(glm::inverse(world) * *scene.lamp),
                    glm::vec3(glm::transpose(world) * *scene.lamp)};
}

double steepnessOf(const Scene& scene) {
    if (scene.light == Light::Off) return 0;
    double most = 0;
    for (const Layer& layer : scene.layers)
        most = std::max(most, scene.cells->halfRange(layer.cells.candidates, kSteepQuantile));
    return kSteepnessShare * 2 * most / scene.placed.unitLength();
}

float steepnessIn(double extent, double steep) {
    return static_cast<float>(extent > 0 ? std::min(steep / extent, kSteepest) : kSteepest);
}

CellMapPlace mapPlaceOf(const ByValue& style, const cell::ColoredField& field) {
    const double half = style.halfWidth();
    if (!(half > 0)) return {0.5, 0};
    return {placeOnScale(field.reference, style.lo, half), 0.5 * field.extent / half};
}

float floatPlace(double at) { return static_cast<float>(std::clamp(at, -1e30, 1e30)); }

CellView::CellView(const Scene& scene, const View& view, Channels of, int rays)
    : CellView(CellsView(scene.placed, finer(view, rays)), scene, view, of, rays) {}

CellView::CellView(const PointsView& from, const Scene& scene, const View& view, Channels of,
                   int rays)
    : TileLayout(scene, view, from, of, rays),
      seen(from),
      weight(static_cast<float>(seen.rayLength / seen.unitLength)),
      rayLength(static_cast<float>(seen.rayLength)),
      light(channels == Channels::Over ? scene.light : Light::Off),
      lamp(axisLamp(scene, channels)),
      steep(steepnessOf(scene)),
      byValue(std::ranges::any_of(
          scene.layers,
          [](const Layer& layer) { return std::holds_alternative<ByValue>(layer.style.color); })),
      metric(gradientMetric(scene.placed)),
      isUpright(metric[3] == 0 && metric[4] == 0 && metric[5] == 0) {}

namespace {

// Which pixels it has; false where it has none.
template <typename Splat>
bool takePixels(SeenPiece& c, const CellView& view, const Splat& s) {
    if (!s.visible) return false;
    const auto span = [&](int a) {
        return pixelSpan(s.centre[a] + view.centre[static_cast<std::size_t>(a)],
                         static_cast<double>(s.lo[a]), static_cast<double>(s.hi[a]),
                         Kernel::Quartic, view.box.size[a]);
    };
    const PixelSpan x = span(0), y = span(1);
    if (x.first >= x.last || y.first >= y.last) return false;
    c.x = x.first;
    c.y = y.first;
    c.lastPixels = static_cast<std::uint32_t>(x.last - x.first - 1) |
                   static_cast<std::uint32_t>(y.last - y.first - 1) << 16;
    c.ox = static_cast<float>(x.first + 0.5 - view.centre[0] - s.centre.x);
    c.oy = static_cast<float>(y.first + 0.5 - view.centre[1] - s.centre.y);
    c.base = s.base;
    return true;
}

template <typename Splat>
void takeRange(SeenPiece& c, const Splat& s) {
    c.least = s.least;
    c.most = s.most;
    c.flags = (s.crossesLeast ? SeenPiece::kCrossesLeast : 0u) |
              (s.crossesMost ? SeenPiece::kCrossesMost : 0u);
    c.perRange = s.perRange;
}

}  // namespace

TileSpan spanOf(const CellView& view, const SeenPiece& c) {
    const glm::ivec2 first = glm::ivec2(c.x, c.y) / view.tile;
    const glm::ivec2 last = (glm::ivec2(c.x + c.columns(), c.y + c.rows()) - 1) / view.tile;
    return {static_cast<std::uint32_t>(first.y * view.tiles.x + first.x),
            static_cast<std::uint16_t>(last.x - first.x + 1),
            static_cast<std::uint16_t>(last.y - first.y + 1)};
}

void takeTints(SeenPiece& c, const CellView& view, std::size_t layer, const RangeStyle& style,
               const cell::ColoredField& field) {
    if (view.tintsOf.empty()) return;
    const TileLayout::Tints& tints = view.tintsOf[layer];
    c.firstTint = tints.first;
    c.lastTint = tints.first + tints.span;
    c.tint = tints.first;
    const auto* of = std::get_if<ByValue>(&style.color);
    if (of == nullptr) return;
    const CellMapPlace place = mapPlaceOf(*of, field);
    const auto whole = static_cast<double>(tints.span);
    c.tint = floatPlace(static_cast<double>(tints.first) + whole * place.at);
    c.tintPerValue = floatPlace(whole * place.perValue);
}

std::optional<SeenTet> seenTet(const CellView& view, const ValuedTet& tet, std::size_t layer,
                               const RangeStyle& style, TetSlopes& slopes) {
    SeenTet c{};
    const TetSplat<float> s = tetSplatAt<float>(view.seen, tet);
    if (!takePixels(c, view, s)) return std::nullopt;
    takeRange(c, s);
    takeTints(c, view, layer, style, cell::coloredField(s, tet));
    c.at = s.at;
    c.ray = s.ray;
    c.right = s.x;
    c.up = s.y;
    c.f = s.f;
    c.fRay = s.fRay;
    c.fRight = s.fX;
    c.fUp = s.fY;
    c.across = s.across;
    c.widest = s.widest;
    if (view.light == Light::Off) return c;
    const std::array<glm::dvec3, 4> gradients =
        tet::gradientsOf(s, tet.gradients, tet.gradientUnit);
    const glm::vec3 way(view.seen.rays.along(s.centre));
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        TetSlopes::Along& along = slopes.along[axis] = {};
        for (std::size_t i = 0; i < 4; ++i) {
            const auto slope = static_cast<float>(gradients[i][a]);
            along.at += slope * s.at[i];
            along.ray += slope * s.ray[i];
            along.right += slope * s.x[i];
            along.up += slope * s.y[i];
        }
        slopes.way[axis] = way[a];
    }
    slopes.steep = steepnessIn(s.extent, view.steep);
    return c;
}

bool SeenTets::add(const CellView& view, const ValuedTet& tet, std::size_t layer,
                   const RangeStyle& style) {
    TetSlopes lit;
    const auto seen = seenTet(view, tet, layer, style, lit);
    if (!seen) return false;
    tets.push_back(*seen);
    if (view.light != Light::Off) slopes.push_back(lit);
    return true;
}

}  // namespace render

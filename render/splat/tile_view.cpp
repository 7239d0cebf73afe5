#include "render/splat/tile_view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "render/model/footprint.h"
#include "render/splat/tile_kernels.h"

namespace render {
namespace {

// The largest view depth of any of the points.
double farthestDepth(const PlacedPoints& placed, const View& view) {
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at =
            placed.boxHalfEdges() *
            glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        farthest = std::max(farthest, -(view.viewFromWorld * glm::dvec4(at, 1.0)).z);
    }
    return farthest;
}

// All cells have the same sides, to 1e-12.
bool sameCells(const PlacedPoints& placed) {
    return std::ranges::all_of(placed.widths(), [](const std::vector<double>& widths) {
        return std::ranges::all_of(
            widths, [&](double width) { return std::abs(width - widths[0]) <= 1e-12 * widths[0]; });
    });
}

}  // namespace

TileView::TileView(const Scene& scene, const View& view, Channels of, std::size_t layer, int rays)
    : TileView(scene, view, PointsView(scene.placed, finer(view, rays)), of, layer, rays) {}

TileView::TileView(const Scene& scene, const View& view, const PointsView& seen, Channels of,
                   std::size_t layer, int rays)
    : TileLayout(scene, view, seen, of, rays) {
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t k = 0; k < 3; ++k)
            viewFromAxes[column][k] =
                seen.viewFromAxes[static_cast<int>(column)][static_cast<int>(k)];
    scene.placed.isMesh() ? takeMesh(scene.placed) : takeGrid(scene);
    takeFootprint(scene, seen, view);
    if (channels == Channels::Weight)
        weight *= static_cast<float>(pointsPerSplat(scene.layers[layer], scene.stride));
}

void TileView::takeMesh(const PlacedPoints& placed) {
    const auto stored = placed.mesh()->stored();
    const glm::dvec3 scale = placed.scale(), offset = placed.axesFromGrid(stored.origin);
    for (std::size_t a = 0; a < 3; ++a) {
        const auto at = static_cast<int>(a);
        meshScale[a] = scale[at] * stored.unit[at];
        meshOffset[a] = offset[at];
    }
    levelScale = scale.z;
    hasLevels = !stored.levels.empty();
    hasHeights = stored.levels.size() > 1;
}

void TileView::takeGrid(const Scene& scene) {
    const PlacedPoints& placed = scene.placed;
    clips = false;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto at = static_cast<int>(a);
        size[a] = placed.size()[at];
        position[a] = placed.positions()[a].data();
        roughPosition[a].assign(placed.positions()[a].begin(), placed.positions()[a].end());
        width[a].assign(placed.widths()[a].begin(), placed.widths()[a].end());
        constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
        clipLo[a] = static_cast<std::int32_t>(std::min(scene.clip.lo[at], kMost));
        clipHi[a] = static_cast<std::int32_t>(std::min(scene.clip.hi[at], kMost));
        clips = clips || scene.clip.lo[at] > 0 || scene.clip.hi[at] + 1.0 < size[a];
    }
    takePlaces();
}

void TileView::takePlaces() {
    evenlySpaced = true;
    viewFromIndices = viewFromAxes;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto count = static_cast<std::size_t>(size[a]);
        const double first = position[a][0], span = position[a][count - 1] - first;
        const double step = count > 1 ? span / (size[a] - 1) : 0;
        for (std::size_t i = 0; i < count; ++i)
            evenlySpaced =
                evenlySpaced && std::abs(position[a][i] - first - step * static_cast<double>(i)) <=
                                    1e-13 * std::abs(span);
        for (std::size_t k = 0; k < 3; ++k) {
            viewFromIndices[a][k] = step * viewFromAxes[a][k];
            viewFromIndices[3][k] += first * viewFromAxes[a][k];
        }
    }
    const auto bits = [&](std::size_t a) {
        return std::bit_width(static_cast<std::uint32_t>(size[a]) - 1);
    };
    yAt = bits(0);
    zAt = yAt + bits(1);
    packs = zAt + bits(2) <= 32 && zAt < 32;
}

// As crossForm() of splat_forms-inl.h has it, of c = axis + x X + y Y: c x X and c x Y change with
// one of them alone.
void TileView::takeEvenForm(const PointsView& seen) {
    const glm::dvec3 a(semiAxes[0], semiAxes[1], semiAxes[2]);
    const PixelRays& rays = seen.rays;
    const glm::dvec3 axisRay = rays.axis / a, x = rays.perPixelX / a, y = rays.perPixelY / a;
    const glm::dvec3 alongX = glm::cross(axisRay, x), alongY = glm::cross(axisRay, y),
                     change = glm::cross(x, y);
    const auto of = [](const glm::dvec3& u, const glm::dvec3& v) {
        return static_cast<float>(glm::dot(u, v));
    };
    nxx = {of(alongX, alongX), -2 * of(alongX, change), of(change, change)};
    nyy = {of(alongY, alongY), 2 * of(alongY, change), of(change, change)};
    nxy = {2 * of(alongX, alongY), 2 * of(alongX, change), -2 * of(alongY, change),
           -2 * of(change, change)};
}

void TileView::takeFootprint(const Scene& scene, const PointsView& seen, const View& view) {
    const double radius = kQuarticRadius * scene.footprint.size;
    kernel = static_cast<float>(radius);
    least = static_cast<float>(seen.smallestRadius);
    reach = static_cast<float>(seen.lengthening.most / seen.rayLength);
    const PlacedPoints& placed = scene.placed;
    const bool square = scene.footprint.kernel == Kernel::Point;
    pointSide = square ? render::pointSide(scene.footprint) * raysAcross : 0;
    endsAtFaces = placed.longCells() && !square;
    isSeenBefore = endsAtFaces || placed.isMesh();
    if (endsAtFaces || (placed.isMesh() && square)) {
        oneByOne.emplace(seen);
        weight = static_cast<float>(seen.rayLength);
        return;
    }
    const double perLength = 5 / std::numbers::pi / seen.unitLength * seen.rayLength;
    if (placed.isMesh()) {
        weight = static_cast<float>(perLength * placed.mesh()->volumePerDeterminant());
        return;
    }
    const glm::dvec3 sides(placed.widths()[0][0], placed.widths()[1][0], placed.widths()[2][0]);
    const double shortest = radius * std::min({sides.x, sides.y, sides.z});
    for (std::size_t a = 0; a < 3; ++a)
        semiAxes[a] = static_cast<float>(radius * sides[static_cast<int>(a)]);
    even = !square &&
           (placed.cubes() ||
            (sameCells(placed) && farthestDepth(placed, view) * seen.smallestRadius < shortest));
    spheres = even && placed.cubes();
    if (even) takeEvenForm(seen);
    double mass = perLength;
    if (even) mass /= radius * radius * radius;
    if (square) mass = seen.cellVolume / (seen.unitLength * seen.pixelArea * pointSide * pointSide);
    weight = static_cast<float>(mass);
}

}  // namespace render

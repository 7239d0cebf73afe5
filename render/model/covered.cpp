#include "render/model/covered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "timeseries/grid/solid_cells.h"

namespace render {
namespace {

using Corners = std::array<glm::dvec3, 8>;

Corners corners(const PlacedPoints& placed, const PlacedPoints::Box& box) {
    Corners at;
    for (std::size_t i = 0; i < 8; ++i)
        at[i] = placed.worldFromAxes() * glm::dvec3(i & 1 ? box.hi.x : box.lo.x,
                                                    i & 2 ? box.hi.y : box.lo.y,
                                                    i & 4 ? box.hi.z : box.lo.z);
    return at;
}

// How far splats of this radius along the axes, or the least one, reach in pixels, their centres
// being between the corners.
double reachOf(double widest, const Corners& centres, const PointsView& view) {
    double nearest = std::numeric_limits<double>::infinity(), steepest = 0;
    for (const glm::dvec3& at : centres) {
        const glm::dvec4 p = view.viewFromWorld * glm::dvec4(at, 1.0);
        nearest = std::min(nearest, -p.z);
        if (-p.z > 0) steepest = std::max(steepest, glm::length(glm::dvec2(p)) / -p.z);
    }
    if (!(nearest > view.rays.near)) return std::numeric_limits<double>::infinity();
    const double radius = longestSemiAxis(view.placed, widest, nearest * view.smallestRadius) *
                          view.lengthening.most / view.rayLength;
    const double reach = sphereExtent(nearest, radius, steepest);
    const double focal = std::max(view.rays.focal.x, view.rays.focal.y);
    return reach < 0 ? std::numeric_limits<double>::infinity() : reach * focal;
}

}  // namespace

namespace {

// What a scene's cells fill: of a mesh its nodes, or the outermost reach half a cell beyond its
// points, at most as far as its widest cell is wide; or where coordinates begin anew as far as a
// prism reaches.
PlacedPoints::Box boxOfCells(const PointsView& seen) {
    if (!seen.placed.isMesh()) return seen.domain;
    if (seen.placed.mesh()->corners() > seen.placed.mesh()->count())
        return seen.placed.cornersBox();
    PlacedPoints::Box box = seen.placed.pointsBox();
    const timeseries::Mesh& mesh = *seen.placed.mesh();
    glm::dvec3 more = mesh.widest();
    if (mesh.solids() && mesh.period() != glm::dvec3(0))
        more = glm::max(more, mesh.solids()->longest());
    more *= glm::abs(seen.placed.scale());
    return {box.lo - more, box.hi + more};
}

}  // namespace

double farthestReach(const Scene& scene, const PointsView& view) {
    if (scene.footprint.kernel == Kernel::Point) return pointSide(scene.footprint) / 2.0;
    return reachOf(scene.footprint.size * kQuarticRadius * scene.placed.widest(),
                   corners(scene.placed, scene.placed.pointsBox()), view);
}

namespace {

PixelBox aroundBoth(const PixelBox& a, const PixelBox& b) {
    const glm::ivec2 first = glm::min(a.at, b.at);
    return {first, glm::max(a.at + a.size, b.at + b.size) - first};
}

}  // namespace

PixelBox coveredPixels(const Scene& scene, const View& view) {
    if (mixesModels(scene))
        return aroundBoth(coveredPixels(onlyCells(scene), view),
                          coveredPixels(onlyPoints(scene), view));
    const PixelBox whole{{0, 0}, view.size};
    const PointsView seen(scene.placed, view);
    // Cells fill the domain; splats of long ones end at the domain's faces, or the least radius
    // beyond the points.
    const bool cut = scene.cells || (scene.placed.longCells() && !scene.placed.isMesh() &&
                                     scene.footprint.kernel != Kernel::Point);
    const Corners at = corners(scene.placed, scene.cells ? boxOfCells(seen)
                                             : cut       ? seen.domain
                                                         : scene.placed.pointsBox());
    // What the rasteriser's rounding may add; a point splat is moved to whole pixels, too.
    const double reach = (cut ? reachOf(0, at, seen) : farthestReach(scene, seen)) + 2;
    if (!std::isfinite(reach)) return whole;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    glm::dvec2 lo(kFar), hi(-kFar);
    for (const glm::dvec3& corner : at) {
        const Projected seenAt = project(view, corner);
        if (!(seenAt.depth > seen.rays.near)) return whole;
        lo = glm::min(lo, seenAt.window);
        hi = glm::max(hi, seenAt.window);
    }
    const glm::dvec2 size(view.size);
    const glm::ivec2 first(glm::clamp(glm::floor(lo - reach), glm::dvec2(0), size));
    const glm::ivec2 last(glm::clamp(glm::ceil(hi + reach), glm::dvec2(0), size));
    return {first, last - first};
}

}  // namespace render

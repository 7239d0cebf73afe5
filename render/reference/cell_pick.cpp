#include "render/reference/cell_pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <vector>

#include "render/reference/parts_on_rays.h"

namespace render {
namespace {

// The corner whose octant of the cell holds a place in it, [0, 1]: it is there, for what is nearest
// to a point that is not is seen by nobody.
std::uint32_t cornerAt(const Scene& scene, std::uint32_t cell, const glm::dvec3& place) {
    unsigned corner = 0;
    for (int a = 0; a < 3; ++a)
        if (place[a] > 0.5) corner |= 1u << a;
    const glm::uvec3 at = scene.cells->cornersOf().pointAt(
                         timeseries::indicesOf(cell, scene.cells->size()), corner),
                     size = scene.placed.size();
    return at.x + size.x * (at.y + size.y * at.z);
}

timeseries::Number valueOfPoint(const timeseries::Field& field, std::uint64_t index) {
    return std::visit([&](const auto& values) { return timeseries::numberOf(values[index]); },
                      field.values);
}

Met metOf(const PartInLayer& passed) {
    const PartOnRay& part = passed.part;
    return {passed.layer, std::midpoint(part.from, part.to), passed.opticalDepth,
            std::midpoint(part.begin, part.end)};
}

struct PassedTet {
    PartInLayer passed;
    unsigned nearest;  // of its corners, to the middle
};

std::size_t nearestCorner(const PointsView& view, const TetSplat<double>& s,
                          const glm::dvec2& window, double depth) {
    const glm::dvec2 offset = window - view.rays.centre - s.centre;
    const auto shareOf = [&](std::size_t i) {
        const double shift = offset.x * s.x[i] + offset.y * s.y[i];
        return s.at[i] + s.base * shift + (depth - s.base) * (s.ray[i] + shift);
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 4; ++i)
        if (shareOf(i) > shareOf(nearest)) nearest = i;
    return nearest;
}

std::vector<PassedTet> tetsOnRay(const Scene& scene, const View& view, const glm::dvec2& window) {
    const CellsView seen(scene.placed, view);
    const glm::ivec2 pixel(glm::floor(window));
    const double perDepth = lengthPerDepth(seen, window);
    std::vector<std::vector<PassedTet>> parts(kCellParts);
    forEachTetSplat(
        scene, scene.cells->field(), seen, PixelBins(std::span(&pixel, 1), view.size),
        sharingThreads(), OpacityPer::Length,
        [&](std::size_t part, std::uint32_t cell, const MeshCells::Tetrahedron& tet,
            const TetSplat<double>& s, const timeseries::Interval<double>&, std::size_t layer,
            std::size_t) {
            if (const auto in = partOnRay(seen, s, window))
                parts[part].push_back(
                    {partInLayer(scene, layer, cell, *in, perDepth),
                     tet.corners[nearestCorner(seen, s, window, std::midpoint(in->from, in->to))]});
        });
    std::vector<PassedTet> passed;
    for (const auto& some : parts) passed.insert(passed.end(), some.begin(), some.end());
    return passed;
}

std::optional<Picked> pickTet(const Scene& scene, const View& view, const glm::dvec2& window) {
    std::vector<PassedTet> passed = tetsOnRay(scene, view, window);
    const double ball = depthOfBall(scene.placed, view, window);
    std::erase_if(passed, [&](const PassedTet& p) { return metOf(p.passed).depth > ball; });
    std::ranges::stable_sort(passed, {}, [](const PassedTet& p) { return metOf(p.passed).depth; });
    std::vector<Met> met;
    for (const PassedTet& p : passed) met.push_back(metOf(p.passed));
    const auto half = atHalfOfLight(scene, met);
    if (!half) return std::nullopt;
    const PassedTet& at = passed[half->at];
    const PartOnRay& part = at.passed.part;
    std::uint64_t nearest = 0;
    withTets(scene, scene.cells->field(),
             [&](const auto& tets) { nearest = tets.pointOf(at.passed.cell, at.nearest); });
    return Picked{.layer = at.passed.layer,
                  .gridIndex = nearest,
                  .value = valueOfPoint(scene.cells->field(), nearest),
                  .world = scene.placed.position(nearest),
                  .depth = std::lerp(part.from, part.to, half->share),
                  .between = std::lerp(part.begin, part.end, half->share)};
}

}  // namespace

std::optional<Picked> pickCell(const Scene& scene, const View& view, const glm::dvec2& window) {
    if (mixesModels(scene)) {
        const auto cell = pickCell(onlyCells(scene), view, window);
        const auto point = pick(onlyPoints(scene), view, window);
        return cell && (!point || cell->depth < point->depth) ? cell : point;
    }
    if (scene.placed.isMesh()) return pickTet(scene, view, window);
    const CellRays rays(scene, scene.cells->field(), view);
    std::vector<PartInLayer> passed = rays.partsOn(window);
    std::ranges::stable_sort(passed, {}, [](const PartInLayer& p) { return metOf(p).depth; });
    std::vector<Met> met;
    for (const PartInLayer& p : passed) met.push_back(metOf(p));
    const auto half = atHalfOfLight(scene, met);
    if (!half) return std::nullopt;
    const PartInLayer& seen = passed[half->at];
    const double depth = std::lerp(seen.part.from, seen.part.to, half->share);
    const glm::dvec3 place = rays.placeIn(seen.cell, window, depth);
    const std::uint32_t at = cornerAt(scene, seen.cell, place);
    return Picked{.layer = seen.layer,
                  .gridIndex = at,
                  .value = valueOfPoint(scene.cells->field(), at),
                  .world = scene.placed.position(at),
                  .depth = depth,
                  .between = rays.valueAt(seen.layer, seen.cell, place)};
}

}  // namespace render

#include "render/reference/cell_pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "render/reference/cell_walk.h"
#include "render/reference/interval_cells.h"
#include "render/reference/tets_on_pixels.h"

namespace render {
namespace {

// A part of the ray's way in a layer.
struct Passed {
    Met met;  // its depth and value are those of its middle
    glm::uvec3 cell;
    glm::dvec3 from, to;  // its ends, in the cell
    double fromDepth, toDepth;
};

// W of a piece of the way that is so long, in units of l, and along which the field goes from one
// value to another (OpacityPer).
double weightOf(const Scene& scene, const Layer& layer, double length, double from, double to) {
    if (scene.opacityPer == OpacityPer::Length) return length;
    const double middle = std::midpoint(from, to);
    for (const auto& range : layer.cells.ranges) {
        const double width = range.hi - range.lo;
        if (range.lo <= middle && middle <= range.hi && width > 0 && std::isfinite(width))
            length = std::max(length, std::abs(to - from) / width);
    }
    return length;
}

class Ray {
 public:
    Ray(const Scene& scene, const View& view, const glm::dvec2& window)
        : scene_(scene), walk_(scene.placed), rays_(pixelRays(scene.placed.inAxes(view))) {
        const glm::dvec2 o = window - rays_.centre;
        along_ = rays_.axis + o.x * rays_.perPixelX + o.y * rays_.perPixelY;
        perDepth_ = glm::length(scene.placed.worldFromAxes() * along_) / scene.placed.unitLength();
        for (const Layer& layer : scene.layers)
            layers_.emplace_back(scene.cells->field(), scene.clip, layer.cells.ranges, 1,
                                 IntervalCells::Look::WhenAsked);
    }

    double valueAt(const Passed& passed, const glm::dvec3& place) const {
        return layers_[passed.met.layer].valueAt(passed.cell, place);
    }
    std::vector<Passed> passed() const {
        std::vector<Passed> all;
        walk_(rays_.eye, along_, rays_.near, [&](const glm::uvec3& cell, double from, double to) {
            for (std::size_t k = 0; k < layers_.size(); ++k) pass(cell, from, to, k, all);
        });
        return all;
    }

 private:
    glm::dvec3 at(double depth) const { return rays_.eye + depth * along_; }
    void pass(const glm::uvec3& cell, double from, double to, std::size_t layer,
              std::vector<Passed>& into) const {
        const IntervalCells& cells = layers_[layer];
        const IntervalCells::Kind kind = cells.kind(cell);
        if (kind == IntervalCells::Kind::Nothing) return;
        const glm::dvec3 a = walk_.inCell(cell, at(from)), b = walk_.inCell(cell, at(to));
        std::vector<LinePart> parts;
        if (kind == IntervalCells::Kind::Whole) parts.push_back({0, 1});
        if (kind == IntervalCells::Kind::Part) cells.addParts(cell, a, b, parts);
        const auto value = [&](double t) { return cells.valueAt(cell, glm::mix(a, b, t)); };
        const Layer& of = scene_.layers[layer];
        for (const LinePart& part : parts) {
            const double middle = std::midpoint(part.from, part.to);
            const double weight =
                weightOf(scene_, of, (to - from) * (part.to - part.from) * perDepth_,
                         value(part.from), value(part.to));
            into.push_back({{layer, from + middle * (to - from),
                             opticalDepthPerWeight(of.style.opacity) * weight, value(middle)},
                            cell,
                            glm::mix(a, b, part.from),
                            glm::mix(a, b, part.to),
                            from + part.from * (to - from),
                            from + part.to * (to - from)});
        }
    }

    const Scene& scene_;
    CellWalk walk_;
    PixelRays rays_;  // in axis coordinates
    glm::dvec3 along_{0};
    double perDepth_;  // of a unit of depth, in units of l
    std::vector<IntervalCells> layers_;
};

// The corner whose octant of the cell holds a place in it, [0, 1]: it is there, for what is nearest
// to a point that is not is seen by nobody.
std::uint32_t cornerAt(const Scene& scene, const glm::uvec3& cell, const glm::dvec3& place) {
    unsigned corner = 0;
    for (int a = 0; a < 3; ++a)
        if (place[a] > 0.5) corner |= 1u << a;
    const glm::uvec3 at = scene.cells->cornersOf().pointAt(cell, corner),
                     size = scene.placed.size();
    return at.x + size.x * (at.y + size.y * at.z);
}

timeseries::Number valueOfPoint(const timeseries::Field& field, std::uint64_t index) {
    return std::visit([&](const auto& values) { return timeseries::numberOf(values[index]); },
                      field.values);
}

// A part of the ray's way in a tetrahedron: its depth and value are those of its middle.
struct PassedTet {
    Met met;
    PartOnRay part;
    std::uint32_t cell;
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
    const PointsView seen(scene.placed, view);
    const glm::ivec2 pixel(glm::floor(window));
    const double perDepth = lengthPerDepth(seen, window);
    std::vector<std::vector<PassedTet>> parts(kCellParts);
    forEachTetBefore(
        scene, scene.cells->field(), seen, PixelBins(std::span(&pixel, 1), view.size),
        sharingThreads(),
        [&](std::size_t part, std::uint32_t cell, const MeshCells::Tetrahedron& tet,
            std::size_t layer, std::size_t) {
            const Layer& of = scene.layers[layer];
            for (const auto& range : of.cells.ranges) {
                const auto s = tetSplatAt<double>(
                    seen, {tet.at, tet.values, range.lo, range.hi, OpacityPer::Length});
                const auto in = s.visible ? partOnRay(seen, s, window) : std::nullopt;
                if (!in) continue;
                const double middle = std::midpoint(in->from, in->to);
                const double weight =
                    weightOf(scene, of, (in->to - in->from) * perDepth, in->begin, in->end);
                parts[part].push_back(
                    {{layer, middle, opticalDepthPerWeight(of.style.opacity) * weight,
                      std::midpoint(in->begin, in->end)},
                     *in,
                     cell,
                     tet.corners[nearestCorner(seen, s, window, middle)]});
            }
        });
    std::vector<PassedTet> passed;
    for (const auto& some : parts) passed.insert(passed.end(), some.begin(), some.end());
    return passed;
}

std::optional<Picked> pickTet(const Scene& scene, const View& view, const glm::dvec2& window) {
    std::vector<PassedTet> passed = tetsOnRay(scene, view, window);
    const double ball = depthOfBall(scene.placed, view, window);
    std::erase_if(passed, [&](const PassedTet& p) { return p.met.depth > ball; });
    std::ranges::stable_sort(passed, {}, [](const PassedTet& p) { return p.met.depth; });
    std::vector<Met> met;
    for (const PassedTet& p : passed) met.push_back(p.met);
    const auto half = atHalfOfLight(scene, met);
    if (!half) return std::nullopt;
    const PassedTet& seen = passed[half->at];
    const PartOnRay& part = seen.part;
    std::uint64_t nearest = 0;
    withTets(scene.placed, scene.cells->field(), scene.clip,
             [&](const auto& tets) { nearest = tets.pointOf(seen.cell, seen.nearest); });
    return Picked{.layer = seen.met.layer,
                  .gridIndex = nearest,
                  .value = valueOfPoint(scene.cells->field(), nearest),
                  .world = scene.placed.position(nearest),
                  .depth = std::lerp(part.from, part.to, half->share),
                  .between = std::lerp(part.begin, part.end, half->share)};
}

}  // namespace

std::optional<Picked> pickCell(const Scene& scene, const View& view, const glm::dvec2& window) {
    if (scene.placed.isMesh()) return pickTet(scene, view, window);
    const Ray ray(scene, view, window);
    std::vector<Passed> passed = ray.passed();
    std::ranges::stable_sort(passed, {}, [](const Passed& p) { return p.met.depth; });
    std::vector<Met> met;
    for (const Passed& p : passed) met.push_back(p.met);
    const auto half = atHalfOfLight(scene, met);
    if (!half) return std::nullopt;
    const Passed& seen = passed[half->at];
    const glm::dvec3 place = glm::mix(seen.from, seen.to, half->share);
    const std::uint32_t at = cornerAt(scene, seen.cell, place);
    return Picked{.layer = seen.met.layer,
                  .gridIndex = at,
                  .value = valueOfPoint(scene.cells->field(), at),
                  .world = scene.placed.position(at),
                  .depth = std::lerp(seen.fromDepth, seen.toDepth, half->share),
                  .between = ray.valueAt(seen, place)};
}

}  // namespace render

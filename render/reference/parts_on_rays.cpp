#include "render/reference/parts_on_rays.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace render {
namespace {

// Of a part, the field at a share of its way: linear, as it is in a tetrahedron, and nearly in a
// cell.
double valueOn(const PartOnRay& part, double share) {
    return std::lerp(part.begin, part.end, share);
}

// The range that holds a value, of a layer whose ranges are disjoint.
std::size_t rangeOf(const Layer& layer, double value) {
    const auto& ranges = layer.cells.ranges;
    const auto holds = [&](const auto& range) { return range.lo <= value && value <= range.hi; };
    return static_cast<std::size_t>(std::ranges::find_if(ranges, holds) - ranges.begin());
}

void addPartsOfMesh(const Scene& scene, const timeseries::Field& field, const View& view,
                    std::span<const glm::ivec2> pixels, unsigned threads,
                    std::span<std::vector<PartInLayer>> into) {
    struct OfPixel {
        std::size_t pixel;
        PartInLayer part;
    };
    const CellsView seen(scene.placed, view);
    std::vector<std::vector<OfPixel>> found(kCellParts);
    forEachTetSplat(
        scene, field, seen, PixelBins(pixels, view.size), threads, OpacityPer::Length,
        [&](std::size_t part, std::uint32_t cell, const MeshCells::Tetrahedron&,
            const TetSplat<double>& s, const timeseries::Interval<double>&, std::size_t layer,
            std::size_t pixel) {
            const glm::dvec2 window = glm::dvec2(pixels[pixel]) + 0.5;
            if (const auto in = partOnRay(seen, s, window))
                found[part].push_back(
                    {pixel, partInLayer(scene, layer, cell, *in, lengthPerDepth(seen, window))});
        });
    for (const auto& some : found)
        for (const OfPixel& each : some) into[each.pixel].push_back(each.part);
}

}  // namespace

PartInLayer partInLayer(const Scene& scene, std::size_t layer, std::uint32_t cell,
                        const PartOnRay& part, double lengthPerDepth) {
    const Layer& of = scene.layers[layer];
    const std::size_t range = rangeOf(of, std::midpoint(part.begin, part.end));
    double weight = (part.to - part.from) * lengthPerDepth;
    if (scene.opacityPer == OpacityPer::Crossing && range < of.cells.ranges.size()) {
        const double width = of.cells.ranges[range].hi - of.cells.ranges[range].lo;
        if (width > 0 && std::isfinite(width))
            weight = std::max(weight, std::abs(part.end - part.begin) / width);
    }
    return {static_cast<std::uint32_t>(layer),
            static_cast<std::uint32_t>(range),
            cell,
            part,
            opticalDepthPerWeight(of.style.opacity) * weight,
            {},
            0};
}

CellRays::CellRays(const Scene& scene, const timeseries::FieldSlab& slab, const View& view)
    : scene_(scene),
      walk_(scene.placed, slab.firstCell, slab.endCell),
      rays_(besideFaces(pixelRays(scene.placed.inAxes(view)))) {
    for (const Layer& layer : scene.layers)
        layers_.emplace_back(slab, scene.clip, layer.cells.ranges, 1,
                             IntervalCells::Look::WhenAsked);
}

glm::dvec3 CellRays::alongOf(const glm::dvec2& window) const {
    return rays_.along(window - rays_.centre);
}

std::vector<PartInLayer> CellRays::partsOn(const glm::dvec2& window) const {
    std::vector<PartInLayer> all;
    const glm::dvec3 along = alongOf(window);
    walk_(rays_.eye, along, rays_.near, [&](const glm::uvec3& cell, double from, double to) {
        for (std::size_t k = 0; k < layers_.size(); ++k) pass(cell, along, from, to, k, all);
    });
    return all;
}

void CellRays::pass(const glm::uvec3& cell, const glm::dvec3& along, double from, double to,
                    std::size_t layer, std::vector<PartInLayer>& into) const {
    const IntervalCells& cells = layers_[layer];
    const IntervalCells::Kind kind = cells.kind(cell);
    if (kind == IntervalCells::Kind::Nothing) return;
    const glm::dvec3 a = walk_.inCell(cell, rays_.eye + from * along),
                     b = walk_.inCell(cell, rays_.eye + to * along);
    std::vector<LinePart> parts;
    if (kind == IntervalCells::Kind::Whole) parts.push_back({0, 1});
    if (kind == IntervalCells::Kind::Part) cells.addParts(cell, a, b, parts);
    const glm::uvec3 size = walk_.size();
    const double perDepth =
        glm::length(scene_.placed.worldFromAxes() * along) / scene_.placed.unitLength();
    const auto value = [&](double t) { return cells.valueAt(cell, glm::mix(a, b, t)); };
    for (const LinePart& part : parts)
        into.push_back(partInLayer(scene_, layer, cell.x + size.x * (cell.y + size.y * cell.z),
                                   {std::lerp(from, to, part.from), std::lerp(from, to, part.to),
                                    value(part.from), value(part.to)},
                                   perDepth));
}

glm::dvec3 CellRays::placeIn(std::uint32_t cell, const glm::dvec2& window, double depth) const {
    return walk_.inCell(timeseries::indicesOf(cell, walk_.size()),
                        rays_.eye + depth * alongOf(window));
}

double CellRays::valueAt(std::size_t layer, std::uint32_t cell, const glm::dvec3& place) const {
    return layers_[layer].valueAt(timeseries::indicesOf(cell, walk_.size()), place);
}

void addPartsOnRays(const Scene& scene, const timeseries::FieldSlab& slab, const View& view,
                    std::span<const glm::ivec2> pixels, unsigned threads,
                    std::span<std::vector<PartInLayer>> into) {
    if (scene.placed.isMesh())
        return addPartsOfMesh(scene, slab.values, view, pixels, threads, into);
    const CellRays rays(scene, slab, view);
    std::atomic<std::size_t> next{0};
    together(threads, [&](unsigned) {
        for (std::size_t i; (i = next++) < pixels.size();) {
            const auto parts = rays.partsOn(glm::dvec2(pixels[i]) + 0.5);
            into[i].insert(into[i].end(), parts.begin(), parts.end());
        }
    });
}

void orderAlongRay(std::vector<PartInLayer>& parts) {
    std::ranges::stable_sort(parts, {}, [](const PartInLayer& p) { return p.part.from; });
}

Shade LightOfParts::shadeAt(const PartInLayer& part, double share) const {
    if (lit_ == nullptr) return {};
    return shadeOf(lit_->light, lit_->lamp, glm::mix(part.gradients[0], part.gradients[1], share),
                   way_, part.steepness);
}

glm::dvec4 LightOfParts::inOrder(std::span<const PartInLayer> parts) {
    ends_.clear();
    for (const PartInLayer& each : parts) {
        ends_.push_back(each.part.from);
        ends_.push_back(each.part.to);
    }
    std::ranges::sort(ends_);
    light_.begin();
    open_.clear();
    std::size_t next = 0;
    for (std::size_t i = 1; i < ends_.size() && !light_.isOpaque(); ++i) {
        const double from = ends_[i - 1], to = ends_[i];
        while (next < parts.size() && parts[next].part.from <= from)
            open_.push_back(&parts[next++]);
        if (to > from) passOpen(from, to);
    }
    return light_.light();
}

void LightOfParts::passOpen(double from, double to) {
    std::erase_if(open_, [&](const PartInLayer* each) { return each->part.to <= from; });
    in_.clear();
    depths_.clear();
    const auto shareAt = [](const PartOnRay& part, double depth) {
        return (depth - part.from) / (part.to - part.from);
    };
    for (const PartInLayer* each : open_) {
        in_.push_back(each->layer);
        depths_.push_back(each->opticalDepth * (to - from) / (each->part.to - each->part.from));
    }
    const auto shareOf = [&](std::size_t i, double share) {
        return shareAt(open_[i]->part, std::lerp(from, to, share));
    };
    light_.pass(
        in_, depths_,
        [&](std::size_t i, double share) { return valueOn(open_[i]->part, shareOf(i, share)); },
        [&](std::size_t i, double share) { return shadeAt(*open_[i], shareOf(i, share)); });
}

glm::dvec4 LightOfParts::oneByOne(std::span<const PartInLayer> parts) {
    light_.begin();
    for (const PartInLayer& each : parts) {
        const std::size_t layer = each.layer;
        light_.pass(
            std::span(&layer, 1), std::span(&each.opticalDepth, 1),
            [&](std::size_t, double share) { return valueOn(each.part, share); },
            [&](std::size_t, double share) { return shadeAt(each, share); });
    }
    return light_.light();
}

glm::dvec4 LightOfParts::mixed(std::span<const PartInLayer> parts) const {
    constexpr int kSteps = LightOnRay::kSteps;
    double depth = 0;
    glm::dvec3 rgb(0);
    for (const PartInLayer& each : parts) {
        depth += each.opticalDepth;
        for (int step = 0; step < kSteps; ++step) {
            const double share = (step + 0.5) / kSteps;
            rgb += each.opticalDepth / kSteps *
                   shadeAt(each, share)
                       .of(colorOf(layers_[each.layer].style, valueOn(each.part, share)));
        }
    }
    const double taken = -std::expm1(-depth);
    return depth > 0 ? glm::dvec4(taken / depth * rgb, taken) : glm::dvec4(0);
}

}  // namespace render

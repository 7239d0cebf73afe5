#include "render/reference/interval_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "render/reference/tets_light.h"
#include "render/reference/tets_on_pixels.h"
#include "render/reference/truth_per.h"
#include "render/splat/cell_slopes.h"
#include "render/splat/cell_view.h"

namespace render {
namespace {

using Kind = IntervalCells::Kind;

std::vector<glm::ivec2> allPixels(glm::ivec2 size) {
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) pixels.emplace_back(x, y);
    return pixels;
}

// A part of a ray's way through a cell, [0, 1], that lies in a layer.
struct LayerPart {
    LinePart part;
    std::size_t layer;
    double width;  // IntervalCells::Passage
};
// A ray's way through a cell: places in it, and of W what its length makes.
struct Through {
    glm::uvec3 cell;
    glm::dvec3 from, to, along;
    double whole;
};

struct LightWork {
    std::vector<IntervalCells::Passage> passages;
    std::vector<LayerPart> ofLayers;
    std::vector<double> ends;
    std::vector<std::size_t> in;                   // layers, of a piece,
    std::vector<double> widths;                    // the ranges of these,
    std::vector<double> depths;                    // and optical depths
    std::vector<IntervalCells::CellField> fields;  // of these
    std::array<glm::dvec3, 8> slopes;              // at the corners of a cell
    std::vector<IntervalCells::Lately> lately;     // of each layer
    std::optional<LightOnRay> seen;
};

}  // namespace

std::vector<glm::dvec2> placesOfRays(int across) {
    std::vector<glm::dvec2> places;
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x)
            places.push_back((glm::dvec2(x, y) + 0.5) / static_cast<double>(across));
    return places;
}

template <typename Pixel, typename Work, typename Sum>
std::vector<Pixel> IntervalTruth::meanOfRays(const View& view, std::span<const glm::ivec2> pixels,
                                             std::span<const glm::dvec2> places,
                                             const Sum& sum) const {
    constexpr std::size_t kAtOnce = 64;
    const PixelRays rays = besideFaces(pixelRays(scene_.placed.inAxes(view)));
    const auto rayAt = [&](const glm::ivec2& pixel, const glm::dvec2& place) {
        const glm::dvec3 along = rays.along(glm::dvec2(pixel) + place - rays.centre);
        return Ray{rays.eye, along, rays.near, opaque_.at(pixel),
                   glm::length(scene_.placed.worldFromAxes() * along) / scene_.placed.unitLength()};
    };
    std::vector<Pixel> means(pixels.size());
    std::atomic<std::size_t> next{0};
    together(threads_, [&](unsigned) {
        Work work;
        for (std::size_t first; (first = next.fetch_add(kAtOnce)) < pixels.size();)
            for (std::size_t p = first; p < std::min(first + kAtOnce, pixels.size()); ++p) {
                Pixel all(0);
                for (const glm::dvec2& place : places) all += sum(rayAt(pixels[p], place), work);
                means[p] = all / static_cast<double>(places.size());
            }
    });
    return means;
}

IntervalTruth::IntervalTruth(const Scene& scene, const timeseries::FieldSlab& slab, int raysAcross,
                             unsigned threads, IntervalCells::Look look)
    : scene_(scene),
      slab_(slab),
      places_(placesOfRays(raysAcross)),
      threads_(std::max(threads, 1u)) {
    if (scene.placed.isMesh()) return;
    for (const Layer& layer : scene.layers)
        layers_.emplace_back(slab, scene.clip, layer.cells.ranges, threads_, look,
                             truthPer(scene, layer));
    CellWalk cells(scene.placed, slab.firstCell, slab.endCell);
    if (look == IntervalCells::Look::WhenAsked)
        walk_.emplace(std::move(cells));
    else
        walk_.emplace(std::move(cells), [&](const glm::uvec3& cell) {
            return std::ranges::any_of(layers_, [&](const IntervalCells& layer) {
                return layer.kind(cell) != Kind::Nothing;
            });
        });
}

template <typename Visit>
void IntervalTruth::walk(const Ray& ray, const Visit& visit) const {
    (*walk_)(ray.eye, ray.along, ray.near, [&](const glm::uvec3& cell, double from, double to) {
        return from < ray.far && visit(cell, from, std::min(to, ray.far));
    });
}

double IntervalTruth::weight(const Ray& ray, std::size_t layer, WeightWork& work) const {
    std::vector<LinePart>& parts = work.parts;
    const IntervalCells& inLayer = layers_[layer];
    const CellWalk& cells = walk_->cells();
    if (truthPer(scene_, scene_.layers[layer]) == OpacityPer::Crossing) {
        double passed = 0;
        walk(ray, [&](const glm::uvec3& cell, double from, double to) {
            if (inLayer.kind(cell, work.lately) == Kind::Nothing) return true;
            passed += inLayer.passage(cell, cells.inCell(cell, ray.eye + from * ray.along),
                                      cells.inCell(cell, ray.eye + to * ray.along),
                                      (to - from) * ray.weight, work.lately);
            return true;
        });
        return passed;
    }
    double length = 0;
    walk(ray, [&](const glm::uvec3& cell, double from, double to) {
        const Kind kind = inLayer.kind(cell, work.lately);
        if (kind == Kind::Whole) length += to - from;
        if (kind != Kind::Part) return true;
        parts.clear();
        inLayer.addParts(cell, cells.inCell(cell, ray.eye + from * ray.along),
                         cells.inCell(cell, ray.eye + to * ray.along), parts, work.lately);
        for (const LinePart& part : parts) length += (to - from) * (part.to - part.from);
        return true;
    });
    return length * ray.weight;
}

std::vector<double> IntervalTruth::weight(const View& view, std::size_t layer) const {
    return weight(view, layer, allPixels(view.size), places_);
}

std::vector<double> IntervalTruth::weight(const View& view, std::size_t layer,
                                          std::span<const glm::ivec2> pixels,
                                          std::span<const glm::dvec2> places) const {
    if (!walk_)
        return meshWeight(scene_, slab_.values, view, layer, pixels, places, threads_, opaque_);
    return meanOfRays<double, WeightWork>(
        view, pixels, places, [&](const Ray& ray, auto& work) { return weight(ray, layer, work); });
}

std::vector<glm::dvec4> IntervalTruth::light(const View& view, LightOnRay::Of what) const {
    if (!walk_) return meshLight(scene_, slab_.values, view, places_, threads_, what, opaque_);
    const auto collect = [&](const Through& way, LightWork& work) {
        work.ofLayers.clear();
        work.ends.clear();
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            work.passages.clear();
            layers_[k].addPassages(way.cell, way.from, way.to, work.passages, work.lately[k]);
            for (const IntervalCells::Passage& each : work.passages) {
                work.ofLayers.push_back({each.part, k, each.width});
                work.ends.push_back(each.part.from);
                work.ends.push_back(each.part.to);
            }
        }
        std::ranges::sort(work.ends);
    };
    const CellWalk& cells = walk_->cells();
    const double steepness = steepnessOf(scene_);
    const glm::dmat3& worldFromAxes = scene_.placed.worldFromAxes();
    const glm::dmat3 gradients = glm::transpose(glm::inverse(worldFromAxes));
    std::optional<PointSlopes> slopes;
    if (scene_.light != Light::Off) slopes.emplace(scene_);
    const double scale = steepness > 0 ? steepness : 1;  // of gradients, which may be any
    const auto shadeAt = [&](const std::array<glm::dvec3, 8>& corners, const glm::dvec3& place,
                             const glm::dvec3& along) {
        if (!slopes) return Shade();
        return shadeOf(scene_.light, scene_.lamp, gradients * cell::valueAt(corners, place),
                       worldFromAxes * along, steepness / scale);
    };
    // A piece of the way, in which no layer begins or ends, each as deep as it is there.
    const auto passEven = [&](const Through& way, LinePart piece, LightWork& work) {
        const auto placeAt = [&](double share) {
            return glm::mix(way.from, way.to, piece.from + (piece.to - piece.from) * share);
        };
        work.depths.clear();
        for (std::size_t i = 0; i < work.in.size(); ++i) {
            const std::size_t k = work.in[i];
            work.depths.push_back(opticalDepthPerWeight(scene_.layers[k].style.opacity) *
                                  layers_[k].passageInside(way.cell, placeAt(0), placeAt(1),
                                                           way.whole * (piece.to - piece.from),
                                                           work.widths[i], work.lately[k]));
        }
        work.seen->pass(
            work.in, work.depths,
            [&](std::size_t i, double share) { return work.fields[i].valueAt(placeAt(share)); },
            [&](std::size_t, double share) {
                return shadeAt(work.slopes, placeAt(share), way.along);
            });
    };
    const auto pass = [&](const Through& way, LinePart piece, LightWork& work) {
        const double middle = 0.5 * (piece.from + piece.to);
        work.in.clear();
        work.widths.clear();
        work.fields.clear();
        bool isEven = true;
        for (const auto& [part, k, width] : work.ofLayers)
            if (middle >= part.from && middle <= part.to) {
                work.in.push_back(k);
                work.widths.push_back(width);
                work.fields.push_back(layers_[k].fieldIn(way.cell, work.lately[k]));
                isEven = isEven && !std::isfinite(width);
            }
        // What a crossing makes of a way changes along it.
        const int steps = isEven ? 1 : LightOnRay::kSteps;
        for (int i = 0; i < steps; ++i)
            passEven(way,
                     {std::lerp(piece.from, piece.to, double(i) / steps),
                      std::lerp(piece.from, piece.to, double(i + 1) / steps)},
                     work);
    };
    return meanOfRays<glm::dvec4, LightWork>(
        view, allPixels(view.size), places_, [&](const Ray& ray, LightWork& work) {
            if (!work.seen) {
                work.seen.emplace(scene_.layers, what);
                work.lately.resize(layers_.size());
            }
            LightOnRay& seen = *work.seen;
            seen.begin();
            walk(ray, [&](const glm::uvec3& cell, double from, double to) {
                const auto isIn = [&](std::size_t k) {
                    return layers_[k].kind(cell, work.lately[k]) != Kind::Nothing;
                };
                std::size_t in = 0;
                while (in < layers_.size() && !isIn(in)) ++in;
                if (in == layers_.size()) return true;
                const Through way{cell, cells.inCell(cell, ray.eye + from * ray.along),
                                  cells.inCell(cell, ray.eye + to * ray.along), ray.along,
                                  (to - from) * ray.weight};
                collect(way, work);
                if (slopes) {
                    const bool isEven = layers_[in].fieldIn(cell, work.lately[in]).isEven();
                    work.slopes =
                        isEven ? std::array<glm::dvec3, 8>{} : slopes->gradients(cell, scale);
                }
                for (std::size_t i = 1; i < work.ends.size(); ++i)
                    if (work.ends[i] > work.ends[i - 1])
                        pass(way, {work.ends[i - 1], work.ends[i]}, work);
                return !seen.isOpaque();
            });
            return seen.light();
        });
}

}  // namespace render

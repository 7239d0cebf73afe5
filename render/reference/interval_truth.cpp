#include "render/reference/interval_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace render {
namespace {

using Kind = IntervalCells::Kind;

struct Ray {
    glm::dvec3 eye, along;  // axis coordinates; a unit of t is one of view depth
    double weight;          // W of a unit of t
};

// The mean over a pixel's rays of sum(ray, work), for all pixels; each thread has a `Work`.
template <typename Work, typename Pixel, typename Sum>
std::vector<Pixel> meanOfRays(const Scene& scene, const View& view, int across, unsigned threads,
                              const Sum& sum) {
    const PixelRays rays = pixelRays(scene.placed.inAxes(view));
    std::vector<Pixel> pixels(static_cast<std::size_t>(view.size.x) *
                              static_cast<std::size_t>(view.size.y));
    std::atomic<int> next{0};
    const auto rayAt = [&](double x, double y) {
        const glm::dvec2 o = glm::dvec2(x, y) - rays.centre;
        const glm::dvec3 along = rays.axis + o.x * rays.perPixelX + o.y * rays.perPixelY;
        return Ray{rays.eye, along,
                   glm::length(scene.placed.worldFromAxes() * along) / scene.placed.unitLength()};
    };
    together(threads, [&](unsigned) {
        Work work;
        for (int y; (y = next++) < view.size.y;)
            for (int x = 0; x < view.size.x; ++x) {
                Pixel all(0);
                for (int j = 0; j < across; ++j)
                    for (int i = 0; i < across; ++i)
                        all += sum(rayAt(x + (i + 0.5) / across, y + (j + 0.5) / across), rays.near,
                                   work);
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.x) +
                       static_cast<std::size_t>(x)] = all / static_cast<double>(across * across);
            }
    });
    return pixels;
}

// A part of a ray's way through a cell, [0, 1], that lies in a layer.
struct LayerPart {
    LinePart part;
    std::size_t layer;
};

struct LightWork {
    std::vector<LinePart> parts;
    std::vector<LayerPart> ofLayers;
    std::vector<double> ends;
};

// What is seen of a ray so far.
struct Seen {
    glm::dvec3 rgb{0};
    double through = 1;
};

}  // namespace

IntervalTruth::IntervalTruth(const Scene& scene, const timeseries::Field& field, int raysAcross,
                             unsigned threads)
    : scene_(scene), raysAcross_(raysAcross), threads_(std::max(threads, 1u)), walk_(scene.placed) {
    for (const Layer& layer : scene.layers)
        layers_.emplace_back(field, scene.clip, layer.cells.ranges, threads_);
}

std::vector<double> IntervalTruth::weight(const View& view, std::size_t layer) const {
    const IntervalCells& cells = layers_[layer];
    using Parts = std::vector<LinePart>;
    return meanOfRays<Parts, double>(
        scene_, view, raysAcross_, threads_, [&](const Ray& ray, double near, Parts& parts) {
            double length = 0;
            walk_(ray.eye, ray.along, near, [&](const glm::uvec3& cell, double from, double to) {
                const Kind kind = cells.kind(cell);
                if (kind == Kind::Whole) length += to - from;
                if (kind != Kind::Part) return;
                parts.clear();
                cells.addParts(cell, walk_.inCell(cell, ray.eye + from * ray.along),
                               walk_.inCell(cell, ray.eye + to * ray.along), parts);
                for (const LinePart& part : parts) length += (to - from) * (part.to - part.from);
            });
            return length * ray.weight;
        });
}

std::vector<glm::dvec4> IntervalTruth::light(const View& view) const {
    std::vector<double> depthPerWeight;
    for (const Layer& layer : scene_.layers)
        depthPerWeight.push_back(opticalDepthPerWeight(layer.style.opacity));
    // Along what lies in a range of one cell a colour by value is taken in so many steps.
    constexpr int kSteps = 4;
    constexpr double kNothing = 1e-7;  // what comes through is not seen
    const auto collect = [&](const glm::uvec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                             LightWork& work) {
        work.ofLayers.clear();
        work.ends.clear();
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            work.parts.clear();
            if (layers_[k].kind(cell) == Kind::Whole) work.parts.push_back({0, 1});
            if (layers_[k].kind(cell) == Kind::Part) layers_[k].addParts(cell, a, b, work.parts);
            for (const LinePart& part : work.parts) {
                work.ofLayers.push_back({part, k});
                work.ends.push_back(part.from);
                work.ends.push_back(part.to);
            }
        }
        std::ranges::sort(work.ends);
    };
    // All of a piece of the way, in which no layer begins or ends: of W a unit, in the cell.
    const auto pass = [&](const glm::uvec3& cell, const glm::dvec3& a, const glm::dvec3& b,
                          LinePart piece, double weight, const LightWork& work, Seen& seen) {
        const double middle = 0.5 * (piece.from + piece.to);
        for (int i = 0; i < kSteps; ++i) {
            const double t = piece.from + (piece.to - piece.from) * (i + 0.5) / kSteps;
            glm::dvec3 colors(0);
            double depth = 0;
            for (const auto& [part, k] : work.ofLayers) {
                if (middle < part.from || middle > part.to) continue;
                const double value = layers_[k].valueAt(cell, glm::mix(a, b, t));
                colors += depthPerWeight[k] * colorOf(scene_.layers[k].style, value);
                depth += depthPerWeight[k];
            }
            if (!(depth > 0)) return;
            const double taken = -std::expm1(-depth * weight * (piece.to - piece.from) / kSteps);
            seen.rgb += seen.through * taken / depth * colors;
            seen.through *= 1 - taken;
        }
    };
    return meanOfRays<LightWork, glm::dvec4>(
        scene_, view, raysAcross_, threads_, [&](const Ray& ray, double near, LightWork& work) {
            Seen seen;
            walk_(ray.eye, ray.along, near, [&](const glm::uvec3& cell, double from, double to) {
                const auto isIn = [&](const IntervalCells& layer) {
                    return layer.kind(cell) != Kind::Nothing;
                };
                if (seen.through < kNothing || std::ranges::none_of(layers_, isIn)) return;
                const glm::dvec3 a = walk_.inCell(cell, ray.eye + from * ray.along);
                const glm::dvec3 b = walk_.inCell(cell, ray.eye + to * ray.along);
                collect(cell, a, b, work);
                for (std::size_t i = 1; i < work.ends.size(); ++i)
                    if (work.ends[i] > work.ends[i - 1])
                        pass(cell, a, b, {work.ends[i - 1], work.ends[i]}, (to - from) * ray.weight,
                             work, seen);
            });
            return glm::dvec4(seen.rgb, 1 - seen.through);
        });
}

}  // namespace render

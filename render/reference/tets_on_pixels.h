// Which pixels, of some, may see which tetrahedra of a mesh's cells: rays of a few pixels, or one,
// through a grid whose points lie one by one, without a structure that would find them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/opaque_depths.h"
#include "render/splat/solid_tets.h"
#include "render/splat/window_box.h"
#include "render/together.h"

namespace render {

// Pixels by squares of the picture, to find those in a rectangle.
class PixelBins {
 public:
    PixelBins(std::span<const glm::ivec2> pixels, glm::ivec2 size);
    // use(index) for those whose centres lie in the box, or a pixel beside it: their rays are not
    // all at their centres.
    template <typename Use>
    void forEachIn(const WindowBox& box, const Use& use) const {
        if (box.hi.x < box.lo.x) return;
        const glm::dvec2 lo = box.lo - 1.0, hi = box.hi + 1.0;
        const glm::ivec2 first = squareOf(lo), last = squareOf(hi);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const auto square = static_cast<std::size_t>(y * across_.x + x);
                for (std::size_t i = firsts_[square]; i < firsts_[square + 1]; ++i) {
                    const glm::dvec2 at = glm::dvec2(pixels_[order_[i]]) + 0.5;
                    if (at.x >= lo.x && at.y >= lo.y && at.x <= hi.x && at.y <= hi.y)
                        use(order_[i]);
                }
            }
    }
    bool hasAnyIn(const WindowBox& box) const {
        bool any = false;
        forEachIn(box, [&](std::size_t) { any = true; });
        return any;
    }

 private:
    glm::ivec2 squareOf(const glm::dvec2& at) const;

    std::span<const glm::ivec2> pixels_;
    glm::ivec2 size_, across_;
    std::vector<std::size_t> firsts_, order_;
};

// The parts that all cells are gone through in, each by one thread: what is summed part by part and
// then added up in their order is the same for any number of threads.
inline constexpr std::size_t kCellParts = 16;

// use(part, cell, tet, layer, box) for each tetrahedron that touches ranges of a layer and may be
// seen by some of the pixels, those in that box. Looks at the scene's candidates, or without them
// at all of the field's cells.
template <typename Use>
void forEachTetBefore(const Scene& scene, const timeseries::Field& field, const PointsView& view,
                      const PixelBins& pixels, unsigned threads, const Use& use) {
    withTets(scene, field, [&](const auto& tets) {
        const ReachBox reachBox(view, tets.reach());
        const auto touches = [](double lo, double hi, const Layer& layer) {
            return std::ranges::any_of(layer.cells.ranges, [&](const auto& range) {
                return cell::touches(lo, hi, range.lo, range.hi);
            });
        };
        // Of the layers [first, last). Cells that are asked for by value lie anywhere: one place
        // tells of most that they are not seen by these pixels, all are waited for of few.
        const auto look = [&](std::size_t part, std::uint32_t at, std::size_t first,
                              std::size_t last) {
            if (!pixels.hasAnyIn(reachBox(tets.about(at)))) return;
            const auto mayBeSeen = [&](const auto& places) {
                return pixels.hasAnyIn(windowBox(view, places));
            };
            tets.forEachTet(at, nullptr, mayBeSeen, [&](const MeshCells::Tetrahedron& tet) {
                const auto [lo, hi] = std::ranges::minmax(tet.values);
                for (std::size_t k = first; k < last; ++k)
                    if (touches(lo, hi, scene.layers[k]))
                        use(part, at, tet, k, windowBox(view, tet.at));
            });
        };
        const auto inRun = [&](std::size_t part, const timeseries::Run& run, std::size_t layer) {
            const std::uint64_t end = run.count * (part + 1) / kCellParts;
            for (std::uint64_t i = run.count * part / kCellParts; i < end; ++i) {
                tets.prefetch([&](std::uint64_t ahead) -> std::optional<std::uint32_t> {
                    if (i + ahead >= end) return std::nullopt;
                    return scene.cells->cell(run.first + i + ahead);
                });
                look(part, scene.cells->cell(run.first + i), layer, layer + 1);
            }
        };
        const auto inPart = [&](std::size_t part) {
            if (scene.cells) {
                for (std::size_t k = 0; k < scene.layers.size(); ++k)
                    for (const timeseries::Run& run : scene.layers[k].cells.candidates)
                        inRun(part, run, k);
                return;
            }
            for (std::uint64_t i = tets.count() * part / kCellParts;
                 i < tets.count() * (part + 1) / kCellParts; ++i) {
                const auto at = static_cast<std::uint32_t>(i);
                const std::pair extent = tets.extentOf(at);
                if (std::ranges::any_of(scene.layers, [&](const Layer& of) {
                        return touches(extent.first, extent.second, of);
                    }))
                    look(part, at, 0, scene.layers.size());
            }
        };
        std::atomic<std::size_t> next{0};
        together(threads, [&](unsigned) {
            for (std::size_t part; (part = next++) < kCellParts;) inPart(part);
        });
    });
}

// use(part, cell, tet, seen, range, layer, pixel) for each pixel that may see one of those, and
// each range of the layer in which it is seen.
template <typename Use>
void forEachTetSplat(const Scene& scene, const timeseries::Field& field, const PointsView& view,
                     const PixelBins& pixels, unsigned threads, OpacityPer opacityPer,
                     const Use& use) {
    forEachTetBefore(scene, field, view, pixels, threads,
                     [&](std::size_t part, std::uint32_t cell, const MeshCells::Tetrahedron& tet,
                         std::size_t layer, const WindowBox& box) {
                         for (const auto& range : scene.layers[layer].cells.ranges) {
                             std::optional<TetSplat<double>> seen;  // when a pixel asks for it
                             pixels.forEachIn(box, [&](std::size_t pixel) {
                                 if (!seen)
                                     seen = tetSplatAt<double>(view, {tet.at, tet.values, range.lo,
                                                                      range.hi, opacityPer});
                                 if (seen->visible)
                                     use(part, cell, tet, *seen, range, layer, pixel);
                             });
                         }
                     });
}

// What of a ray's way through a tetrahedron lies in the range that it was seen with: view depths,
// and the field there, linear in between.
struct PartOnRay {
    double from, to;
    double begin, end;
};
// Of the ray at a window position, as far as view depth `opaque`.
std::optional<PartOnRay> partOnRay(const PointsView& view, const TetSplat<double>& seen,
                                   const glm::dvec2& window,
                                   double opaque = std::numeric_limits<double>::infinity());
// W of it, of a length or a crossing as it was seen with.
double passageOf(const TetSplat<double>& seen, const PartOnRay& part, double lengthPerDepth);
// How long the ray there is for a unit of view depth, in units of l.
double lengthPerDepth(const PointsView& view, const glm::dvec2& window);

// Of each pixel the sum of what all parts have, in their order.
std::vector<double> addedUp(std::span<const std::vector<double>> parts);

// The plane W of a layer of a mesh at these pixels, of rays at these places in each, as
// IntervalTruth has it.
std::vector<double> meshWeight(const Scene& scene, const timeseries::Field& field, const View& view,
                               std::size_t layer, std::span<const glm::ivec2> pixels,
                               std::span<const glm::dvec2> places, unsigned threads,
                               const OpaqueDepths& opaque = {});

}  // namespace render

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
#include "render/splat/mesh_cells.h"
#include "render/together.h"

namespace render {

// Pixels by squares of the picture, to find those in a rectangle.
class PixelBins {
 public:
    PixelBins(std::span<const glm::ivec2> pixels, glm::ivec2 size);
    // use(index) for those whose centres lie between these window positions; false where none of
    // the squares there has any.
    template <typename Use>
    bool forEachIn(const glm::dvec2& lo, const glm::dvec2& hi, const Use& use) const {
        const glm::ivec2 first = squareOf(lo), last = squareOf(hi);
        bool any = false;
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const auto square = static_cast<std::size_t>(y * across_.x + x);
                for (std::size_t i = firsts_[square]; i < firsts_[square + 1]; ++i) {
                    const glm::dvec2 at = glm::dvec2(pixels_[order_[i]]) + 0.5;
                    any = true;
                    if (at.x >= lo.x && at.y >= lo.y && at.x <= hi.x && at.y <= hi.y)
                        use(order_[i]);
                }
            }
        return any;
    }

 private:
    glm::ivec2 squareOf(const glm::dvec2& at) const;

    std::span<const glm::ivec2> pixels_;
    glm::ivec2 size_, across_;
    std::vector<std::size_t> firsts_, order_;
};

// Where a cell or a tetrahedron is seen, in window positions; all of the picture where a corner is
// behind the near plane.
struct WindowBox {
    glm::dvec2 lo, hi;
};
WindowBox windowBox(const PointsView& view, std::span<const glm::dvec3> corners);

// The parts that all cells are gone through in, each by one thread: what is summed part by part and
// then added up in their order is the same for any number of threads.
inline constexpr std::size_t kCellParts = 16;

// use(part, cell, tet, layer, pixel) for each pixel that may see a tetrahedron which reaches into
// ranges of a layer. Looks at the scene's candidates, or without them at all of the field's cells.
template <typename Use>
void forEachTetBefore(const Scene& scene, const timeseries::Field& field, const PointsView& view,
                      const PixelBins& pixels, unsigned threads, const Use& use) {
    constexpr double kBeside = 1;  // pixels: their rays are not all at their centres
    const timeseries::CellCorners corners(field);
    const MeshCells mesh(scene.placed, corners, scene.clip);
    // Of a cell with corners that have no values, what the others have is all that there is.
    const auto reaches = [](const auto& values, const Layer& layer) {
        double lo = std::numeric_limits<double>::infinity(), hi = -lo;
        for (const double v : values) {
            lo = std::isnan(v) ? lo : std::min(lo, v);
            hi = std::isnan(v) ? hi : std::max(hi, v);
        }
        return std::ranges::any_of(layer.cells.ranges, [&](const auto& range) {
            return cell::reaches(lo, hi, range.lo, range.hi);
        });
    };
    const auto look = [&](std::size_t part, const glm::uvec3& at, std::size_t first,
                          std::size_t last) {
        const auto cell = mesh(at);
        if (!cell) return;
        const WindowBox box = windowBox(view, cell->at);
        if (!pixels.forEachIn(box.lo - kBeside, box.hi + kBeside, [](std::size_t) {})) return;
        mesh.forEachTet(*cell, nullptr, [&](const MeshCells::Tetrahedron& tet) {
            for (std::size_t k = first; k < last; ++k) {
                if (!reaches(tet.values, scene.layers[k])) continue;
                const WindowBox of = windowBox(view, tet.at);
                pixels.forEachIn(of.lo - kBeside, of.hi + kBeside,
                                 [&](std::size_t pixel) { use(part, at, tet, k, pixel); });
            }
        });
    };
    const auto inPart = [&](std::size_t part) {
        if (scene.cells) {
            for (std::size_t k = 0; k < scene.layers.size(); ++k)
                for (const timeseries::Run& run : scene.layers[k].cells.candidates)
                    for (std::uint64_t i = run.count * part / kCellParts;
                         i < run.count * (part + 1) / kCellParts; ++i)
                        look(part,
                             timeseries::indicesOf(scene.cells->cell(run.first + i),
                                                   scene.cells->size()),
                             k, k + 1);
            return;
        }
        const glm::uvec3 size = corners.size();
        const std::uint64_t rows = std::uint64_t{size.y} * size.z;
        for (std::uint64_t row = rows * part / kCellParts; row < rows * (part + 1) / kCellParts;
             ++row)
            for (unsigned x = 0; x < size.x; ++x) {
                const glm::uvec3 at(x, row % size.y, row / size.y);
                const auto values = corners.values(at);
                if (std::ranges::any_of(scene.layers,
                                        [&](const Layer& layer) { return reaches(values, layer); }))
                    look(part, at, 0, scene.layers.size());
            }
    };
    std::atomic<std::size_t> next{0};
    together(threads, [&](unsigned) {
        for (std::size_t part; (part = next++) < kCellParts;) inPart(part);
    });
}

// What of a ray's way through a tetrahedron lies in the range that it was seen with: view depths,
// and the field there, linear in between.
struct PartOnRay {
    double from, to;
    double begin, end;
};
// Of the ray at a window position.
std::optional<PartOnRay> partOnRay(const PointsView& view, const TetSplat<double>& seen,
                                   const glm::dvec2& window);
// How long the ray there is for a unit of view depth, in units of l.
double lengthPerDepth(const PointsView& view, const glm::dvec2& window);

// Of each pixel the sum of what all parts have, in their order.
std::vector<double> addedUp(std::span<const std::vector<double>> parts);

// The plane W of a layer of a mesh at these pixels, as IntervalTruth has it.
std::vector<double> meshWeight(const Scene& scene, const timeseries::Field& field, const View& view,
                               std::size_t layer, std::span<const glm::ivec2> pixels,
                               int raysAcross, unsigned threads);

}  // namespace render

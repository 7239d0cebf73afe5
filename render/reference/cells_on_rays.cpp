#include "render/reference/cells_on_rays.h"

#include <atomic>
#include <limits>

#include "render/model/cell_splat.h"
#include "render/reference/cell_walk.h"
#include "render/reference/interval_cells.h"
#include "render/reference/tets_on_pixels.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/tile_layout.h"

namespace render {
namespace {

std::vector<double> tetDepthAt(const Scene& scene, const View& view,
                               std::span<const glm::ivec2> pixels, unsigned threads) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const CellsView seen(scene.placed, view);
    const PixelBins bins(pixels, view.size);
    std::vector<std::vector<double>> parts(kCellParts, std::vector<double>(pixels.size()));
    forEachTetSplat(
        scene, scene.cells->field(), seen, bins, threads, scene.opacityPer,
        [&](std::size_t part, std::uint32_t, const MeshCells::Tetrahedron&,
            const TetSplat<double>& s, const timeseries::Interval<double>&, std::size_t layer,
            std::size_t pixel) {
            const glm::dvec2 offset = glm::dvec2(pixels[pixel]) + 0.5 - seen.rays.centre;
            parts[part][pixel] += opticalDepthPerWeight(scene.layers[layer].style.opacity) *
                                  fragmentOn<double>(seen, s, offset - s.centre, kNever).weight;
        });
    return addedUp(parts);
}

// Of each pixel of this view, by its own ray; so many of them in a row are of one pixel.
std::vector<double> depthAt(const Scene& scene, const View& view,
                            std::span<const glm::ivec2> pixels, std::size_t each, unsigned threads,
                            RaysEnd end) {
    if (scene.placed.isMesh()) return tetDepthAt(scene, view, pixels, threads);
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const CellsView seen(scene.placed, view);
    const CellWalk walk(scene.placed);
    const glm::uvec3 size = scene.cells->size();
    std::vector<IntervalCells> layers;
    for (const Layer& layer : scene.layers)
        layers.emplace_back(scene.cells->field(), scene.clip, layer.cells.ranges, 1,
                            IntervalCells::Look::WhenAsked, scene.opacityPer);
    const auto isEnough = [&](double depth) {
        return end == RaysEnd::WhereSomethingIs && depth > 0;
    };
    const auto depthOf = [&](const glm::dvec2& offset) {
        const PixelRays& rays = seen.rays;
        const glm::dvec3 along = rays.along(offset);
        double depth = 0;
        walk(rays.eye, along, rays.near, [&](const glm::uvec3& cell, double, double) {
            for (std::size_t k = 0; k < layers.size(); ++k) {
                if (layers[k].kind(cell) == IntervalCells::Kind::Nothing) continue;
                const CellOfLayer of{cell.x + size.x * (cell.y + size.y * cell.z),
                                     static_cast<std::uint8_t>(k)};
                const double perWeight = opticalDepthPerWeight(scene.layers[k].style.opacity);
                forEachPiece(
                    scene, {&of, 1}, [&](const ValuedCell& piece, const CellOfLayer&, unsigned) {
                        const auto s = cellSplatAt<double>(seen, piece);
                        if (s.visible)
                            depth += perWeight *
                                     fragmentOn<double>(seen, s, offset - s.centre, kNever).weight;
                    });
            }
            return !isEnough(depth);
        });
        return depth;
    };
    std::vector<double> depths(pixels.size());
    std::atomic<std::size_t> next{0};
    together(threads, [&](unsigned) {
        for (std::size_t first; (first = next.fetch_add(each)) < pixels.size();)
            for (std::size_t i = first; i < first + each; ++i) {
                depths[i] = depthOf(glm::dvec2(pixels[i]) + 0.5 - seen.rays.centre);
                if (isEnough(depths[i])) break;
            }
    });
    return depths;
}

}  // namespace

std::vector<double> cellDepthAt(const Scene& scene, const View& view,
                                std::span<const glm::ivec2> pixels, int raysAcross,
                                unsigned threads, RaysEnd end) {
    std::vector<glm::ivec2> rays;
    for (const glm::ivec2& pixel : pixels)
        for (int y = 0; y < raysAcross; ++y)
            for (int x = 0; x < raysAcross; ++x)
                rays.push_back(raysAcross * pixel + glm::ivec2(x, y));
    const auto each = static_cast<std::size_t>(raysAcross * raysAcross);
    const std::vector<double> depths =
        depthAt(scene, finer(view, raysAcross), rays, each, threads, end);
    std::vector<double> means(pixels.size());
    for (std::size_t i = 0; i < depths.size(); ++i)
        means[i / each] += depths[i] / static_cast<double>(each);
    return means;
}

}  // namespace render

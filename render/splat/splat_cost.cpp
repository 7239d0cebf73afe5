#include "render/splat/splat_cost.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/model/cell_splat.h"
#include "render/model/covered.h"
#include "render/model/footprint.h"
#include "render/model/rays_across.h"
#include "render/model/tet_splat.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/tile_layout.h"

namespace render {
namespace {

// Calls use(position) for some of the layer's runs' elements: the k-th is in the middle of the k-th
// part of all. Returns how many.
template <typename Use>
std::uint64_t forSome(std::span<const timeseries::Run> runs, std::uint64_t all, std::uint64_t most,
                      const Use& use) {
    const std::uint64_t samples = std::min(all, most);
    std::uint64_t passed = 0, k = 0;
    for (const timeseries::Run& run : runs) {
        for (std::uint64_t at;
             k < samples && (at = (2 * k + 1) * all / (2 * samples)) < passed + run.count; ++k)
            use(run.first + (at - passed));
        passed += run.count;
    }
    return samples;
}

// Within the picture: how wide and high it is.
template <typename Seen>
glm::dvec2 sidesOf(const Seen& s, const PointsView& seen, glm::ivec2 size) {
    const glm::dvec2 window = seen.rays.centre + s.centre, most(size);
    return glm::max(glm::clamp(window + glm::dvec2(s.hi), glm::dvec2(0), most) -
                        glm::clamp(window + glm::dvec2(s.lo), glm::dvec2(0), most),
                    glm::dvec2(0));
}

// Of a piece of a cell: what setting it up takes, and of its rays, which are taken in blocks, a
// block; less where all of the piece is in the range. Of a plane, a pixel.
struct PieceCost {
    double setUp, crossed, whole, pixel;
};
constexpr PieceCost kUnordered{2.4, 0.8, 0.34, 0.1}, kOrdered{1.25, 1.36, 1, 0.06};
const PieceCost& costsOf(const Scene& scene) {
    return scene.order == Order::None ? kUnordered : kOrdered;
}

class CellCosts {
 public:
    CellCosts(const Scene& scene, const View& view)
        : fine_(finer(view, raysAcross(scene, view))),
          seen_(scene.placed, fine_),
          per_(costsOf(scene)) {}

    double of(const ValuedCell& cell) const { return ofSeen(cellSplatAt<double>(seen_, cell)); }
    double of(const ValuedTet& tet) const { return ofSeen(tetSplatAt<double>(seen_, tet)); }

 private:
    template <typename Seen>
    double ofSeen(const Seen& s) const {
        if (!s.visible) return 0;
        constexpr double kSide = 4;  // of a block, of which the last along a side is part empty
        const glm::dvec2 sides = sidesOf(s, seen_, fine_.size);
        const glm::dvec2 blocks = sides / kSide + (1 - 1 / kSide);
        const bool isWhole = !s.crossesLeast && !s.crossesMost;
        return per_.setUp + (sides.x > 0 && sides.y > 0
                                 ? blocks.x * blocks.y * (isWhole ? per_.whole : per_.crossed)
                                 : 0);
    }

    View fine_;
    PointsView seen_;
    PieceCost per_;
};

double cellCost(const Scene& scene, std::size_t layer, const View& view) {
    constexpr std::uint64_t kSamples = 64;
    const CellCosts costs(scene, view);
    double sum = 0;
    const Layer& of = scene.layers[layer];
    std::vector<CellOfLayer> some;
    const std::uint64_t samples =
        forSome(of.cells.candidates, cellCount(of), kSamples, [&](std::uint64_t candidate) {
            some.push_back({scene.cells->cell(candidate), static_cast<std::uint8_t>(layer)});
        });
    if (scene.placed.isMesh())
        forEachTet(scene, some, nullptr,
                   [&](const ValuedTet& tet, const CellOfLayer&) { sum += costs.of(tet); });
    else
        forEachPiece(scene, some, [&](const ValuedCell& piece, const CellOfLayer&, unsigned) {
            sum += costs.of(piece);
        });
    return samples == 0 ? 1 : std::max(1.0, sum / static_cast<double>(samples));
}

}  // namespace

double splatCost(const Scene& scene, std::size_t layer, const View& view, SummedBy by) {
    if (isByCells(scene, scene.layers[layer])) return cellCost(scene, layer, view);
    constexpr std::uint64_t kSamples = 32;
    const Layer& of = scene.layers[layer];
    const PointsView seen(scene.placed, view);
    double pixels = 0;
    const std::uint64_t samples =
        forSome(of.runs, pointCount(of), kSamples, [&](std::uint64_t point) {
            auto s = splatAt<double>(seen, scene.step.gridIndex(point), scene.footprint);
            if (!s.visible) return;
            if (scene.footprint.kernel != Kernel::Point) narrow(s);
            const glm::dvec2 sides = sidesOf(s, seen, view.size);
            pixels += sides.x * sides.y;
        });
    if (samples == 0) return 1;
    const Channels channels = channelsFor(scene)[scene.order == Order::None ? layer : 0];
    return 1 + pixels / static_cast<double>(samples) / pixelsOfASplat(by, channels);
}

double layerCost(const Scene& scene, std::size_t layer, const View& view, SummedBy by) {
    return splatCost(scene, layer, view, by) *
           static_cast<double>(drawnCount(scene, scene.layers[layer]));
}

double planesCost(const Scene& scene, const View& view) {
    const int rays = scene.cells ? raysAcross(scene, view) : 1;
    const glm::dvec2 covered(coveredPixels(scene, view).size * rays);
    return costsOf(scene).pixel * covered.x * covered.y *
           static_cast<double>(channelsFor(scene).size());
}

double sceneCost(const Scene& scene, const View& view, SummedBy by) {
    double sum = 0;
    for (std::size_t k = 0; k < scene.layers.size(); ++k) sum += layerCost(scene, k, view, by);
    return sum;
}

}  // namespace render

#include "render/reference/order_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "render/reference/parts_on_rays.h"
#include "render/splat/cell_pieces.h"

namespace render {
namespace {

// As cells are drawn (CellList): by rank, of one rank layer by layer; in an upright cell range by
// range, in others tetrahedron by tetrahedron, the nearest first.
void orderAsDrawn(const CellRank& rank, bool isMesh, std::vector<PartInLayer>& parts) {
    const auto place = [&](const PartInLayer& p) {
        return std::tuple(rank(p.cell), p.layer, p.cell, isMesh ? 0u : p.range, p.part.from);
    };
    std::ranges::stable_sort(parts, {}, place);
}

}  // namespace

double orderError(const Scene& scene, const timeseries::Field& field, const View& view,
                  std::span<const glm::ivec2> pixels, std::span<const double> weights,
                  unsigned threads) {
    const bool isMixed = scene.order == Order::None;
    if (areOneColor(scene.layers) || (!isMixed && !scene.cells)) return 0;
    std::optional<CellRank> rank;
    if (!isMixed) rank.emplace(scene, view);
    LightOfParts light(scene.layers);
    double errors = 0, all = 0;
    auto rays = partsOnRays(scene, field, view, pixels, threads);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 exact(light.inOrder(rays[i]));
        if (rank) orderAsDrawn(*rank, scene.placed.isMesh(), rays[i]);
        const glm::dvec3 drawn(rank ? light.oneByOne(rays[i]) : light.mixed(rays[i]));
        errors += weights[i] * glm::dot(drawn - exact, drawn - exact);
        all += weights[i] * glm::dot(exact, exact);
    }
    return errors == 0 ? 0 : std::sqrt(errors / all);
}

}  // namespace render

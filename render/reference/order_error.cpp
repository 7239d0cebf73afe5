#include "render/reference/order_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

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

OrderError::OrderError(const Scene& scene, const View& view, std::span<const glm::ivec2> pixels,
                       std::span<const double> weights, unsigned threads)
    : scene_(scene),
      view_(view),
      pixels_(pixels),
      weights_(weights),
      threads_(threads),
      parts_(pixels.size()) {}

bool OrderError::isNone() const {
    return areOneColor(scene_.layers) || (scene_.order != Order::None && !scene_.cells);
}

void OrderError::add(const timeseries::FieldSlab& slab) {
    if (!isNone()) addPartsOnRays(scene_, slab, view_, pixels_, threads_, parts_);
}

double OrderError::error() const {
    if (isNone()) return 0;
    std::optional<CellRank> rank;
    if (scene_.order != Order::None) rank.emplace(scene_, view_);
    LightOfParts light(scene_.layers);
    double errors = 0, all = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        std::vector<PartInLayer> parts = parts_[i];
        orderAlongRay(parts);
        const glm::dvec3 exact(light.inOrder(parts));
        if (rank) orderAsDrawn(*rank, scene_.placed.isMesh(), parts);
        const glm::dvec3 drawn(rank ? light.oneByOne(parts) : light.mixed(parts));
        errors += weights_[i] * glm::dot(drawn - exact, drawn - exact);
        all += weights_[i] * glm::dot(exact, exact);
    }
    return errors == 0 ? 0 : std::sqrt(errors / all);
}

}  // namespace render

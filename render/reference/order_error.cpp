#include "render/reference/order_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

#include "render/splat/cell_pieces.h"

namespace render {
namespace {

// As cells are drawn (CellList): of one rank layer by layer; in an upright cell range by range, in
// others tetrahedron by tetrahedron, the nearest first.
class DrawnOrder {
 public:
    DrawnOrder(const Scene& scene, const View& view, unsigned threads,
               const std::atomic<bool>* wanted)
        : isMesh_(scene.placed.isMesh()), rank_(scene, view) {
        constexpr std::uint64_t kAtOnce = 1 << 20;
        if (!isMesh_) return;
        CellList list(scene, Channels::Over, 0, &rank_, threads);
        for (; !list.done(); list.goOn(kAtOnce))
            if (wanted != nullptr && !*wanted) return;
        withTets(scene, scene.cells->field(),
                 [&](const auto& tets) { places_.resize(tets.count()); });
        for (std::uint32_t at = 0; at < list.cells().size(); ++at)
            places_[list.cells()[at].cell] = at;  // its layers come one after another
    }
    void put(std::vector<PartInLayer>& parts) const {
        std::ranges::stable_sort(parts, {}, [&](const PartInLayer& p) {
            const std::uint32_t at = isMesh_ ? places_[p.cell] : rank_(p.cell);
            return std::tuple(at, p.layer, p.cell, isMesh_ ? 0u : p.range, p.part.from);
        });
    }

 private:
    bool isMesh_;
    CellRank rank_;
    std::vector<std::uint32_t> places_;  // of a mesh's cells, in the list
};

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

double OrderError::error(const std::atomic<bool>* wanted) const {
    if (isNone()) return 0;
    std::optional<DrawnOrder> order;
    if (scene_.order != Order::None) order.emplace(scene_, view_, threads_, wanted);
    if (wanted != nullptr && !*wanted) return 0;
    LightOfParts light(scene_.layers);
    double errors = 0, all = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        std::vector<PartInLayer> parts = parts_[i];
        orderAlongRay(parts);
        const glm::dvec3 exact(light.inOrder(parts));
        if (order) order->put(parts);
        const glm::dvec3 drawn(order ? light.oneByOne(parts) : light.mixed(parts));
        errors += weights_[i] * glm::dot(drawn - exact, drawn - exact);
        all += weights_[i] * glm::dot(exact, exact);
    }
    return errors == 0 ? 0 : std::sqrt(errors / all);
}

}  // namespace render

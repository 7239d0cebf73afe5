#include "timeseries/index/node_values.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/mesh.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/index/cell_corners.h"

namespace timeseries {
namespace {

constexpr double kNearest = 1e-9;  // of the mesh's extent: no value counts infinitely more

// Of some of a mesh's nodes, from `first` on: means of what is added, in its order.
class MeansAtNodes {
 public:
    MeansAtNodes(const Mesh& mesh, std::uint64_t first, std::span<double> means)
        : mesh_(mesh), first_(first), means_(means), weights_(means.size()) {
        const glm::dvec3& unit = mesh.stored().unit;
        perLength_ = 1 / std::max({unit.x, unit.y, unit.z});
    }
    void add(std::uint32_t node, const glm::dvec3& middle, double value) {
        const std::uint64_t i = node - first_;  // of a lesser one far beyond
        if (i >= means_.size()) return;
        const double away = glm::length(perLength_ * (mesh_.cornerPosition(node) - middle));
        if (!std::isfinite(away)) return;
        const double weight = 1 / std::max(away, kNearest);
        weights_[i] += weight;
        if (weight == weights_[i]) {
            means_[i] = value;
            return;
        }
        const double share = weight / weights_[i], change = value - means_[i];
        means_[i] = std::isfinite(change) ? means_[i] + share * change
                                          : (1 - share) * means_[i] + share * value;
    }

 private:
    const Mesh& mesh_;
    std::uint64_t first_;
    std::span<double> means_;
    std::vector<double> weights_;  // added up
    double perLength_;
};

std::vector<double> nodeValues(const Field& field, const Mesh& mesh, unsigned threads) {
    const SolidCells& solids = *mesh.solids();
    const std::uint64_t nodes = mesh.corners() - mesh.count();
    std::vector<double> values(nodes, std::numeric_limits<double>::quiet_NaN());
    const auto parts = threadsFor(nodes, std::size_t{1} << 12, std::max(threads, 1u));
    sharing(parts, [&](unsigned k) {
        const std::uint64_t begin = nodes * k / parts, end = nodes * (k + 1) / parts;
        MeansAtNodes means(mesh, solids.firstNode() + begin,
                           std::span(values).subspan(begin, end - begin));
        SolidCells::Room room;
        for (std::uint64_t cell = 0; cell < solids.count(); ++cell) {
            const double value = finiteValue(field, solids.middle(cell));
            if (std::isnan(value)) continue;
            const glm::dvec3 middle = mesh.position(solids.middle(cell));
            for (const std::uint32_t corner : solids.corners(cell, room))
                means.add(corner, middle, value);
        }
    });
    return values;
}

}  // namespace

std::shared_ptr<const Field> withNodeValues(std::shared_ptr<const Field> field, unsigned threads) {
    const Mesh* const mesh = field->grid->mesh().get();
    if (!mesh || !mesh->solids() || !mesh->solids()->haveMiddles() || !field->atNodes.empty())
        return field;
    auto with = std::make_shared<Field>(*field);
    with->atNodes = nodeValues(*field, *mesh, threads);
    return with;
}

}  // namespace timeseries

#include "timeseries/index/node_values.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
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
        : mesh_(mesh), first_(first), means_(means), ways_(means.size()), weights_(means.size()) {
        const glm::dvec3& unit = mesh.stored().unit;
        perLength_ = 1 / std::max({unit.x, unit.y, unit.z});
    }
    // All of them first, then all of them again with their values.
    void look(std::uint32_t node, const glm::dvec3& middle) {
        const Way way = wayTo(node, middle);
        if (way.weight == 0) return;
        Ways& ways = ways_[node - first_];
        ways.weight += way.weight;
        ways.sum += way.weight * way.along;
        for (int c = 0; c < 3; ++c) ways.second[c] += way.weight * way.along[c] * way.along;
    }
    void add(std::uint32_t node, const glm::dvec3& middle, double value) {
        const Way way = wayTo(node, middle);
        if (way.weight == 0) return;
        const std::uint64_t i = node - first_;
        const glm::dvec3 slope = slopeOf(ways_[i]);
        const double weight = way.weight * std::clamp(1 + glm::dot(slope, way.along), 0.0, 2.0);
        if (weight == 0) return;
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
    struct Way {
        glm::dvec3 along{0};
        double weight = 0;  // none of another node, or one without a place
    };
    struct Ways {
        double weight = 0;
        glm::dvec3 sum{0};
        glm::dmat3 second{0.0};
    };
    Way wayTo(std::uint32_t node, const glm::dvec3& middle) const {
        if (node - first_ >= means_.size()) return {};  // of a lesser one far beyond
        const glm::dvec3 along = perLength_ * (middle - mesh_.cornerPosition(node));
        const double away = glm::length(along);
        return std::isfinite(away) ? Way{along, 1 / std::max(away, kNearest)} : Way{};
    }
    // The s of weights w (1 + s . way) that have no way left in the mean; 0 where cells lie to one
    // side, or in a plane.
    static glm::dvec3 slopeOf(const Ways& ways) {
        constexpr double kFlattest = 1e-12, kOneSided = 0.25;
        const glm::dmat3& m = ways.second;
        const double turn = glm::determinant(m);
        if (!(turn > kFlattest * m[0][0] * m[1][1] * m[2][2])) return glm::dvec3(0);
        const glm::dvec3 slope = -(glm::inverse(m) * ways.sum);
        const double left = ways.weight + glm::dot(slope, ways.sum);
        return left > kOneSided * ways.weight ? slope : glm::dvec3(0);
    }

    const Mesh& mesh_;
    std::uint64_t first_;
    std::span<double> means_;
    std::vector<Ways> ways_;
    std::vector<double> weights_;  // added up
    double perLength_;
};

std::vector<double> nodeValues(const Field& field, const Mesh& mesh, unsigned threads) {
    constexpr std::uint64_t kMostAtOnce = 1 << 20;
    const SolidCells& solids = *mesh.solids();
    const std::uint64_t nodes = mesh.corners() - mesh.count();
    std::vector<double> values(nodes, std::numeric_limits<double>::quiet_NaN());
    threads = threadsFor(nodes, std::size_t{1} << 12, std::max(threads, 1u));
    const std::uint64_t parts = std::max<std::uint64_t>(threads, (nodes - 1) / kMostAtOnce + 1);
    std::atomic<std::uint64_t> next = 0;
    sharing(threads, [&](unsigned) {
        for (std::uint64_t part = next++; part < parts; part = next++) {
            const std::uint64_t begin = nodes * part / parts, end = nodes * (part + 1) / parts;
            MeansAtNodes means(mesh, solids.firstNode() + begin,
                               std::span(values).subspan(begin, end - begin));
            const auto forEach = [&](const auto& use) {
                for (std::uint64_t cell = 0; cell < solids.count(); ++cell) {
                    const double value = finiteValue(field, solids.middle(cell));
                    if (std::isnan(value)) continue;
                    const glm::dvec3 middle = mesh.position(solids.middle(cell));
                    solids.forEachNode(cell, [&](std::uint32_t node) { use(node, middle, value); });
                }
            };
            forEach([&](std::uint32_t node, const glm::dvec3& middle, double) {
                means.look(node, middle);
            });
            forEach([&](std::uint32_t node, const glm::dvec3& middle, double value) {
                means.add(node, middle, value);
            });
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

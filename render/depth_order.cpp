#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "render/scene.h"

namespace render {
namespace {

struct Distances {
    Sorted list;               // unordered: layer by layer, ascending by value
    std::vector<double> away;  // squared would do for comparing; keys want it linear
};

Distances distances(const Scene& scene, const glm::dvec3& midEye) {
    Distances d;
    const auto index = scene.step.gridIndex();
    const glm::uvec3 n = scene.lattice.size();
    const auto& at = scene.lattice.positions();
    const glm::dmat3& worldFromAxes = scene.lattice.worldFromAxes();
    for (std::size_t layer = 0; layer < scene.layers.size(); ++layer) {
        const std::uint32_t stride = strideOf(scene.layers[layer], scene.stride);
        for (const timeseries::Run& run : scene.layers[layer].runs) {
            forEachInSubset(run, stride, [&](std::uint64_t p) {
                const std::uint32_t i = index[p];
                const glm::uvec3 ijk(i % n.x, i / n.x % n.y, i / n.x / n.y);
                if (!scene.clip.holds(ijk)) return;
                d.list.point.push_back(static_cast<std::uint32_t>(p));
                d.list.layer.push_back(static_cast<std::uint8_t>(layer));
                const glm::dvec3 along(at[0][ijk.x], at[1][ijk.y], at[2][ijk.z]);
                d.away.push_back(glm::distance(worldFromAxes * along, midEye));
            });
        }
    }
    return d;
}

Sorted permuted(const Sorted& list, const std::vector<std::uint32_t>& order) {
    Sorted out;
    out.point.reserve(order.size());
    out.layer.reserve(order.size());
    for (const std::uint32_t i : order) {
        out.point.push_back(list.point[i]);
        out.layer.push_back(list.layer[i]);
    }
    return out;
}

// Counting sort over all 2^16 keys; stable.
std::vector<std::uint32_t> orderOfKeys(const std::vector<std::uint16_t>& keys) {
    std::vector<std::uint32_t> next(65537);
    for (const std::uint16_t key : keys) ++next[key + 1u];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        order[next[keys[i]]++] = static_cast<std::uint32_t>(i);
    return order;
}

}  // namespace

DrawList order(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    const Distances d = distances(scene, midEye);
    if (d.away.empty()) return Sorted{};
    const auto [nearest, farthest] = std::minmax_element(d.away.begin(), d.away.end());
    const double span = *farthest - *nearest;
    const double perUnit = span > 0 ? 65535 / span : 0;
    std::vector<std::uint16_t> keys(d.away.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = static_cast<std::uint16_t>((*farthest - d.away[i]) * perUnit + 0.5);
    return permuted(d.list, orderOfKeys(keys));
}

DrawList orderExactly(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    const Distances d = distances(scene, midEye);
    std::vector<std::uint32_t> order(d.away.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return d.away[a] > d.away[b]; });
    return permuted(d.list, order);
}

}  // namespace render

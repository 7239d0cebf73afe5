#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "render/scene.h"
#include "render/together.h"

namespace render {
namespace {

// Fewer are ordered before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 15;

struct Distances {
    Sorted list;               // unordered: layer by layer, ascending by value
    std::vector<double> away;  // squared would do for comparing; keys want it linear
};

Sorted candidates(const Scene& scene) {
    Sorted list;
    std::uint64_t count = 0;
    for (const Layer& layer : scene.layers) count += splatCount(layer, scene.stride);
    list.point.reserve(count);
    list.layer.reserve(count);
    for (std::size_t layer = 0; layer < scene.layers.size(); ++layer) {
        const std::uint32_t stride = strideOf(scene.layers[layer], scene.stride);
        for (const timeseries::Run& run : scene.layers[layer].runs)
            forEachInSubset(run, stride, [&](std::uint64_t p) {
                list.point.push_back(static_cast<std::uint32_t>(p));
                list.layer.push_back(static_cast<std::uint8_t>(layer));
            });
    }
    return list;
}

// Of a point's centre, or a negative number outside of the clip box.
double distanceOf(const Scene& scene, std::uint32_t i, const glm::dvec3& midEye) {
    const glm::uvec3 ijk = timeseries::indicesOf(i, scene.lattice.size());
    if (!scene.clip.holds(ijk)) return -1;
    const auto& at = scene.lattice.positions();
    const glm::dvec3 along(at[0][ijk.x], at[1][ijk.y], at[2][ijk.z]);
    return glm::distance(scene.lattice.worldFromAxes() * along, midEye);
}

void dropClipped(Distances& d) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < d.away.size(); ++i) {
        if (d.away[i] < 0) continue;
        d.list.point[kept] = d.list.point[i];
        d.list.layer[kept] = d.list.layer[i];
        d.away[kept++] = d.away[i];
    }
    d.list.point.resize(kept);
    d.list.layer.resize(kept);
    d.away.resize(kept);
}

Distances distances(const Scene& scene, const glm::dvec3& midEye) {
    Distances d{candidates(scene), {}};
    d.away.resize(d.list.point.size());
    const auto index = columnsOf(scene).gridIndex;
    inParts(d.away.size(), threadsFor(d.away.size(), kWorthAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    d.away[i] = distanceOf(scene, index[d.list.point[i]], midEye);
            });
    dropClipped(d);
    return d;
}

Sorted permuted(const Sorted& list, const std::vector<std::uint32_t>& order) {
    Sorted out;
    out.point.resize(order.size());
    out.layer.resize(order.size());
    inParts(order.size(), threadsFor(order.size(), kWorthAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    out.point[i] = list.point[order[i]];
                    out.layer[i] = list.layer[order[i]];
                }
            });
    return out;
}

// Half of a key's bits sort in one pass over so few counters that they stay in the first-level
// cache.
constexpr unsigned kHalfBits = 11, kHalf = 1u << kHalfBits;
constexpr double kLastKey = (1u << 2 * kHalfBits) - 1;

// A key above, a place in the list below.
using Keyed = std::uint64_t;
unsigned halfOf(Keyed keyed, unsigned half) {
    return static_cast<unsigned>(keyed >> (32 + half * kHalfBits)) & (kHalf - 1);
}

// Where those of each key's half begin, in its order.
std::array<std::uint32_t, kHalf> beginnings(const std::vector<Keyed>& keys, unsigned half) {
    std::array<std::uint32_t, kHalf> begin{};
    for (const Keyed keyed : keys) ++begin[halfOf(keyed, half)];
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0u);
    return begin;
}

// Counting sort by the lower half, then by the upper; stable.
std::vector<std::uint32_t> orderOfKeys(const std::vector<Keyed>& keys) {
    std::vector<Keyed> byLower(keys.size());
    auto next = beginnings(keys, 0);
    for (const Keyed keyed : keys) byLower[next[halfOf(keyed, 0)]++] = keyed;
    std::vector<std::uint32_t> order(keys.size());
    next = beginnings(keys, 1);
    for (const Keyed keyed : byLower)
        order[next[halfOf(keyed, 1)]++] = static_cast<std::uint32_t>(keyed);
    return order;
}

}  // namespace

DrawList order(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    const Distances d = distances(scene, midEye);
    if (d.away.empty()) return Sorted{};
    const auto ends = std::minmax_element(d.away.begin(), d.away.end());
    const double farthest = *ends.second, span = farthest - *ends.first;
    const double perUnit = span > 0 ? kLastKey / span : 0;
    std::vector<Keyed> keys(d.away.size());
    inParts(keys.size(), threadsFor(keys.size(), kWorthAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    keys[i] = static_cast<Keyed>((farthest - d.away[i]) * perUnit + 0.5) << 32 | i;
            });
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

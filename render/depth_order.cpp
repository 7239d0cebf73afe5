#include "render/depth_order.h"

#include <algorithm>
#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "render/distances.h"
#include "render/together.h"

namespace render {
namespace {

// Fewer are ordered before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 15;

// A splat and its key: from the highest bit on, key, layer and point. Half of a key's bits sort in
// one pass over so few counters that they stay in the first-level cache.
using Keyed = std::uint64_t;
constexpr unsigned kHalfBits = 11, kHalf = 1u << kHalfBits, kLayerAt = 32, kKeyAt = 40;
constexpr double kLastKey = (1u << 2 * kHalfBits) - 1;
static_assert(kMaxLayers <= 1u << (kKeyAt - kLayerAt) && kKeyAt + 2 * kHalfBits <= 64);

std::uint32_t pointOf(Keyed keyed) { return static_cast<std::uint32_t>(keyed); }
std::uint8_t layerOf(Keyed keyed) { return static_cast<std::uint8_t>(keyed >> kLayerAt); }
unsigned halfOf(Keyed keyed, unsigned half) {
    return static_cast<unsigned>(keyed >> (kKeyAt + half * kHalfBits)) & (kHalf - 1);
}

// All layers' splats, without keys: layer by layer, ascending by value.
void listSplats(const Scene& scene, std::vector<Keyed>& splats) {
    std::uint64_t count = 0;
    for (const Layer& layer : scene.layers) count += splatCount(layer, scene.stride);
    splats.resize(count);
    auto next = splats.begin();
    for (std::size_t layer = 0; layer < scene.layers.size(); ++layer) {
        const std::uint32_t stride = strideOf(scene.layers[layer], scene.stride);
        for (const timeseries::Run& run : scene.layers[layer].runs)
            forEachInSubset(run, stride, [&](std::uint64_t point) {
                *next++ = Keyed{layer} << kLayerAt | point;
            });
    }
}

// Of each splat's centre, negative outside of the clip box.
void findDistances(std::span<const Keyed> splats, const Scene& scene, const glm::dvec3& midEye,
                   std::vector<double>& away) {
    constexpr std::size_t kBatch = 1 << 9;
    const Distances distances(scene, midEye);
    const auto gridIndex = columnsOf(scene).gridIndex;
    away.resize(splats.size());
    inParts(splats.size(), threadsFor(splats.size(), kWorthAThread),
            [&](std::size_t first, std::size_t last) {
                std::array<std::uint32_t, kBatch> index;
                for (std::size_t count; first < last; first += count) {
                    count = std::min(kBatch, last - first);
                    for (std::size_t i = 0; i < count; ++i)
                        index[i] = gridIndex[pointOf(splats[first + i])];
                    distances.find(std::span(index).first(count),
                                   std::span(away).subspan(first, count));
                }
            });
}

void dropClipped(std::vector<Keyed>& splats, std::vector<double>& away) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < away.size(); ++i) {
        if (away[i] < 0) continue;
        splats[kept] = splats[i];
        away[kept++] = away[i];
    }
    splats.resize(kept);
    away.resize(kept);
}

struct Ends {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
};
Ends endsOf(std::span<const double> values) {
    const unsigned threads = threadsFor(values.size(), kWorthAThread);
    std::vector<Ends> ends(threads);
    together(threads, [&](unsigned k) {
        Ends part;  // not that of a neighbour's cache line
        for (std::size_t i = values.size() * k / threads; i < values.size() * (k + 1) / threads;
             ++i) {
            part.least = std::min(part.least, values[i]);
            part.greatest = std::max(part.greatest, values[i]);
        }
        ends[k] = part;
    });
    for (const Ends& part : ends) {
        ends[0].least = std::min(ends[0].least, part.least);
        ends[0].greatest = std::max(ends[0].greatest, part.greatest);
    }
    return ends[0];
}

void putKeys(std::span<Keyed> splats, std::span<const double> away, const Ends& ends) {
    const double span = ends.greatest - ends.least;
    const double perUnit = span > 0 ? kLastKey / span : 0;
    inParts(splats.size(), threadsFor(splats.size(), kWorthAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    splats[i] |= static_cast<Keyed>((ends.greatest - away[i]) * perUnit + 0.5)
                                 << kKeyAt;
            });
}

// One pass of a counting sort: put(to, splat) for each, ascending by this half of the keys, in
// their order where it is equal. On several threads, each of which takes a part of them.
template <typename Put>
void sortBy(unsigned half, std::span<const Keyed> splats, const Put& put) {
    const unsigned threads = threadsFor(splats.size(), kWorthAThread);
    const auto part = [&](unsigned k) {
        const std::size_t first = splats.size() * k / threads;
        return splats.subspan(first, splats.size() * (k + 1) / threads - first);
    };
    std::vector<std::array<std::uint32_t, kHalf>> next(threads);  // of each part, where it puts
    together(threads, [&](unsigned k) {
        for (const Keyed splat : part(k)) ++next[k][halfOf(splat, half)];
    });
    std::uint32_t begin = 0;
    for (unsigned value = 0; value < kHalf; ++value)
        for (auto& of : next) begin += std::exchange(of[value], begin);
    together(threads, [&](unsigned k) {
        for (const Keyed splat : part(k)) put(next[k][halfOf(splat, half)]++, splat);
    });
}

}  // namespace

DrawList DepthOrder::operator()(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    listSplats(scene, splats_);
    findDistances(splats_, scene, midEye, away_);
    Ends ends = endsOf(away_);
    if (ends.least < 0) {
        dropClipped(splats_, away_);
        ends = endsOf(away_);
    }
    putKeys(splats_, away_, ends);
    byLower_.resize(splats_.size());
    sortBy(0, splats_, [&](std::uint32_t to, Keyed splat) { byLower_[to] = splat; });
    Sorted list;
    list.point.resize(splats_.size());
    list.layer.resize(splats_.size());
    sortBy(1, byLower_, [&](std::uint32_t to, Keyed splat) {
        list.point[to] = pointOf(splat);
        list.layer[to] = layerOf(splat);
    });
    forget();
    return list;
}

// Of more splats than pictures have that move.
void DepthOrder::forget() {
    constexpr std::size_t kKept = 1 << 21;
    if (splats_.capacity() > kKept) *this = {};
}

DrawList order(const Scene& scene, const glm::dvec3& midEye) { return DepthOrder()(scene, midEye); }

DrawList orderExactly(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    const auto gridIndex = columnsOf(scene).gridIndex;
    std::vector<std::pair<double, Keyed>> splats;
    std::vector<Keyed> all;
    listSplats(scene, all);
    for (const Keyed splat : all) {
        const std::uint32_t i = gridIndex[pointOf(splat)];
        if (scene.clip.holds(scene.lattice.indices(i)))
            splats.emplace_back(glm::distance(scene.lattice.position(i), midEye), splat);
    }
    std::ranges::stable_sort(splats, std::greater(), &std::pair<double, Keyed>::first);
    Sorted list;
    for (const auto& [distance, splat] : splats) {
        list.point.push_back(pointOf(splat));
        list.layer.push_back(layerOf(splat));
    }
    return list;
}

}  // namespace render

#include "render/splat/depth_order.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "render/together.h"

namespace render {
namespace {

// Fewer are ordered before another thread has begun.
constexpr std::size_t kKeysWorthAThread = 1 << 15;

// A splat and its key: from the highest bit on, key, layer and point. Half of a key's bits sort in
// one pass over so few counters that they stay in the first-level cache.
constexpr unsigned kHalfBits = DepthKeys::kBits / 2, kHalf = 1u << kHalfBits, kLayerAt = 32,
                   kKeyAt = 40;
constexpr std::uint64_t kClipped = ~std::uint64_t{0};
static_assert(kMaxLayers <= 1u << (kKeyAt - kLayerAt) && kKeyAt + 2 * kHalfBits < 64);

std::uint32_t pointOf(std::uint64_t keyed) { return static_cast<std::uint32_t>(keyed); }
std::uint8_t layerOf(std::uint64_t keyed) { return static_cast<std::uint8_t>(keyed >> kLayerAt); }
unsigned halfOf(std::uint64_t keyed, unsigned half) {
    return static_cast<unsigned>(keyed >> (kKeyAt + half * kHalfBits)) & (kHalf - 1);
}

// work(k, part) for every part of the slice, each on a thread.
template <typename Keyed, typename Work>
void eachPart(unsigned threads, std::span<Keyed> slice, const Work& work) {
    together(threads, [&](unsigned k) {
        const std::size_t first = slice.size() * k / threads;
        work(k, slice.subspan(first, slice.size() * (k + 1) / threads - first));
    });
}

// How many have each value of a half.
using Counts = std::array<std::uint32_t, kHalf>;

}  // namespace

DepthKeys depthKeysOf(const Scene& scene, const glm::dvec3& midEye) {
    double radius = 0;
    const auto [lo, hi] = scene.placed.pointsBox();
    for (const double x : {lo.x, hi.x})
        for (const double y : {lo.y, hi.y})
            for (const double z : {lo.z, hi.z})
                radius = std::max(radius,
                                  glm::length(scene.placed.worldFromAxes() * glm::dvec3(x, y, z)));
    const double away = glm::length(midEye);
    const double span = away + radius - std::max(away - radius, 0.0);
    return {radius, away + radius, span > 0 ? DepthKeys::kLast / span : 0};
}

void DepthOrder::begin(const Scene& scene, const glm::dvec3& midEye) {
    ordered_ = scene.order == Order::BackToFront && !scene.cells;
    phase_ = ordered_ ? Phase::List : Phase::Done;
    if (!ordered_) return;
    scene_ = &scene;
    source_.emplace(scene);
    distances_.emplace(scene, midEye);
    keys_ = depthKeysOf(scene, midEye);
    all_ = splatCount(scene);
    count_ = passed_ = 0;
    // Room alone: it is written slice by slice.
    splats_.reserve(all_);
    byLower_.reserve(all_);
    list_.point.reserve(all_);
    list_.layer.reserve(all_);
    for (auto& next : next_) next.assign(kHalf, 0);
    if (source_->done()) enter(Phase::Lower);
}

double DepthOrder::share() const {
    if (done()) return 1;
    return (static_cast<double>(phase_) +
            static_cast<double>(passed_) / static_cast<double>(std::max<std::uint64_t>(all_, 1))) /
           3;
}

void DepthOrder::goOn(std::uint64_t splats) {
    if (phase_ == Phase::List) return list(splats);
    const std::size_t many = std::min<std::uint64_t>(splats, count_ - passed_);
    if (phase_ == Phase::Lower)
        sortBy(0, std::span(splats_).subspan(passed_, many),
               [&](std::uint32_t to, Keyed splat) { byLower_[to] = splat; });
    else
        sortBy(1, std::span(byLower_).subspan(passed_, many), [&](std::uint32_t to, Keyed splat) {
            list_.point[to] = pointOf(splat);
            list_.layer[to] = layerOf(splat);
        });
    passed_ += many;
    if (passed_ == count_) enter(phase_ == Phase::Lower ? Phase::Upper : Phase::Done);
}

// Layer by layer, ascending by value.
void DepthOrder::list(std::uint64_t splats) {
    source_->next(std::min(splats, all_), points_);
    const std::size_t many = points_.point.size(), end = count_ + many;
    const auto grow = [end](auto& column) {
        if (column.size() < end) column.resize(end);
    };
    grow(splats_);
    grow(byLower_);
    grow(list_.point);
    grow(list_.layer);
    const std::span<Keyed> slice = std::span(splats_).subspan(count_, many);
    findKeys(slice);
    const auto kept =
        distances_->clips ? std::remove(slice.begin(), slice.end(), kClipped) : slice.end();
    count_ += static_cast<std::size_t>(kept - slice.begin());
    passed_ += many;
    if (source_->done()) enter(Phase::Lower);
}

void DepthOrder::findKeys(std::span<Keyed> slice) {
    constexpr std::size_t kBatch = 1 << 9;
    const auto gridIndex = columnsOf(*scene_).gridIndex;
    const unsigned threads = threadsFor(slice.size(), kKeysWorthAThread);
    std::vector<std::array<Counts, 2>> counts(threads);
    eachPart(threads, slice, [&](unsigned k, std::span<Keyed> part) {
        std::array<std::uint32_t, kBatch> index;
        std::array<double, kBatch> away;
        const auto first = static_cast<std::size_t>(part.data() - slice.data());
        for (std::size_t i = 0; i < part.size(); i += kBatch) {
            const std::size_t some = std::min(kBatch, part.size() - i);
            const auto point = std::span(points_.point).subspan(first + i, some);
            for (std::size_t j = 0; j < some; ++j) index[j] = gridIndex[point[j]];
            distances_->find(std::span(index).first(some), std::span(away).first(some));
            for (std::size_t j = 0; j < some; ++j) {
                Keyed& splat = part[i + j] = kClipped;
                if (away[j] < 0) continue;
                splat = Keyed{keys_.of(away[j])} << kKeyAt |
                        Keyed{points_.layer[first + i + j]} << kLayerAt | point[j];
                for (const unsigned half : {0u, 1u}) ++counts[k][half][halfOf(splat, half)];
            }
        }
    });
    for (const auto& part : counts)
        for (const unsigned half : {0u, 1u})
            for (unsigned value = 0; value < kHalf; ++value)
                next_[half][value] += part[half][value];
}

void DepthOrder::enter(Phase phase) {
    if (phase == Phase::Lower)
        for (auto& next : next_)
            std::exclusive_scan(next.begin(), next.end(), next.begin(), std::uint32_t{0});
    passed_ = 0;
    phase_ = count_ > 0 ? phase : Phase::Done;
    if (!done()) return;
    list_.point.resize(count_);
    list_.layer.resize(count_);
}

// A slice of one pass of a counting sort: put(to, splat) for each, ascending by this half of the
// keys, in their order where it is equal. On several threads, each of which takes a part of them.
template <typename Put>
void DepthOrder::sortBy(unsigned half, std::span<const Keyed> slice, const Put& put) {
    const unsigned threads = threadsFor(slice.size(), kKeysWorthAThread);
    std::vector<Counts> to(threads);  // where each part's next goes
    eachPart(threads, slice, [&](unsigned k, std::span<const Keyed> part) {
        for (const Keyed splat : part) ++to[k][halfOf(splat, half)];
    });
    for (unsigned value = 0; value < kHalf; ++value)
        for (Counts& of : to) next_[half][value] += std::exchange(of[value], next_[half][value]);
    eachPart(threads, slice, [&](unsigned k, std::span<const Keyed> part) {
        for (const Keyed splat : part) put(to[k][halfOf(splat, half)]++, splat);
    });
}

DrawList DepthOrder::take() {
    if (!ordered_) return Runs{};
    Sorted list = std::exchange(list_, {});
    shrink();
    return list;
}

void DepthOrder::shrink() {
    constexpr std::size_t kKept = 1 << 21;
    if (splats_.capacity() <= kKept) return;
    splats_ = byLower_ = std::vector<Keyed>();
    list_ = {};
}

DrawList DepthOrder::operator()(const Scene& scene, const glm::dvec3& midEye) {
    begin(scene, midEye);
    while (!done()) goOn(std::numeric_limits<std::uint64_t>::max());
    return take();
}

DrawList order(const Scene& scene, const glm::dvec3& midEye) { return DepthOrder()(scene, midEye); }

}  // namespace render

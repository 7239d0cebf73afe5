#include "render/splat/face_order.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "render/splat/solid_tets.h"
#include "render/together.h"

namespace render {
namespace {

constexpr std::size_t kPassedWorthAThread = 1 << 10;
constexpr std::uint64_t kFacesOfACell = 6;
constexpr std::uint64_t kFacesAtOnce = 1 << 22;  // 80 MB of them
constexpr std::uint64_t kFacesOfABucket = 4;

}  // namespace

FaceOrder::FaceOrder(const Scene& scene, const glm::dvec3& eye, std::span<CellOfLayer> nearestFirst,
                     unsigned threads)
    : scene_(scene), eye_(eye), list_(nearestFirst), threads_(threads) {
    const std::uint64_t faces = kFacesOfACell * list_.size();
    rounds_ = static_cast<std::uint32_t>(faces / kFacesAtOnce + 1);
    buckets_ = static_cast<std::uint32_t>(faces / rounds_ / kFacesOfABucket + 1);
    withTets(scene_, scene_.cells->field(),
             [&](const auto& tets) { nodeOf_.assign(tets.count(), kNone); });
    another_.assign(list_.size(), kNone);
    first_.assign(list_.size(), kNone);
    if (list_.size() >= kNone) enter(Phase::Done);
}

void FaceOrder::find(std::uint64_t cells) {
    const std::uint64_t end = passed_ + std::min<std::uint64_t>(cells, list_.size() - passed_);
    for (; passed_ < end; ++passed_)
        another_[passed_] =
            std::exchange(nodeOf_[list_[passed_].cell], static_cast<std::uint32_t>(passed_));
}

void FaceOrder::enter(Phase phase) {
    phase_ = phase;
    passed_ = 0;
    if (phase == Phase::Count) ends_.assign(buckets_, 0);
    if (phase == Phase::Place) {
        const std::uint64_t count = std::accumulate(ends_.begin(), ends_.end(), std::uint64_t{0});
        std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0u);
        faces_ = timeseries::Pages<Face>(count, timeseries::Filled::Sparsely);
    }
    if (phase == Phase::Walk) {
        nodeOf_ = {};
        faces_ = timeseries::Pages<Face>();
        before_.assign(list_.begin(), list_.end());
        taken_.resize(list_.size());
    }
}

void FaceOrder::goOn(std::uint64_t cells) {
    const std::uint64_t all = list_.size();
    switch (phase_) {
        case Phase::Find:
            find(cells);
            if (passed_ == all) enter(Phase::Count);
            break;
        case Phase::Count:
            forEachFace(cells,
                        [&](std::uint32_t bucket, const FaceKey&, const auto&, std::uint32_t) {
                            std::atomic_ref(ends_[bucket]).fetch_add(1, std::memory_order_relaxed);
                        });
            if (passed_ == nodeOf_.size()) enter(Phase::Place);
            break;
        case Phase::Place:
            forEachFace(cells, [&](std::uint32_t bucket, const FaceKey& key, const auto& sideOf,
                                   std::uint32_t node) {
                const double side = sideOf(eye_);
                faces_.data()[std::atomic_ref(ends_[bucket])
                                  .fetch_add(1, std::memory_order_relaxed)] = {key, node,
                                                                               side > 0   ? 1
                                                                               : side < 0 ? -1
                                                                                          : 0};
            });
            if (passed_ == nodeOf_.size()) enter(Phase::Match);
            break;
        case Phase::Match:
            match(cells * buckets_ / std::max<std::uint64_t>(all, 1) + 1);
            if (passed_ == buckets_) enter(++round_ < rounds_ ? Phase::Count : Phase::Walk);
            break;
        case Phase::Walk:
            walk(cells);
            if (walked_ == all && passed_ == all) enter(Phase::Done);
            break;
        case Phase::Done:
            break;
    }
}

template <typename Use>
void FaceOrder::forEachFace(std::uint64_t cells, const Use& use) {
    const std::uint64_t some = std::min<std::uint64_t>(cells, nodeOf_.size() - passed_);
    const std::uint64_t allBuckets = std::uint64_t{rounds_} * buckets_;
    withTets(scene_, scene_.cells->field(), [&](const auto& tets) {
        const std::uint64_t keys = tets.faceKeys();
        const auto pass = [&](std::uint32_t cell, std::uint32_t node) {
            tets.forEachFace(cell, [&](const FaceKey& key, const auto& sideOf) {
                const std::uint64_t bucket = key[0] * allBuckets / keys - round_ * buckets_;
                if (bucket >= buckets_) return;
                for (std::uint32_t each = node; each != kNone; each = another_[each])
                    use(static_cast<std::uint32_t>(bucket), key, sideOf, each);
            });
        };
        inParts(some, threadsFor(some, kPassedWorthAThread, threads_),
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t cell = passed_ + first; cell < passed_ + last; ++cell)
                        if (nodeOf_[cell] != kNone)
                            pass(static_cast<std::uint32_t>(cell), nodeOf_[cell]);
                });
    });
    passed_ += some;
}

// A cell is there once for each of its layers, which come as they did.
template <typename Use>
void FaceOrder::related(std::span<Face> bucket, const Use& use) const {
    std::ranges::sort(bucket, [](const Face& a, const Face& b) {
        return a.key != b.key ? a.key < b.key : a.node < b.node;
    });
    for (auto at = bucket.begin(); at != bucket.end();) {
        const auto end =
            std::find_if(at, bucket.end(), [&](const Face& other) { return other.key != at->key; });
        for (auto a = at; a != end; ++a)
            for (auto b = a + 1; b != end; ++b) {
                const bool isOne = list_[a->node].cell == list_[b->node].cell;
                const std::int32_t side = isOne ? -1 : a->eye != 0 ? a->eye : -b->eye;
                if (side != 0) side > 0 ? use(b->node, a->node) : use(a->node, b->node);
            }
        at = end;
    }
}

void FaceOrder::match(std::uint64_t buckets) {
    const std::uint64_t some = std::min<std::uint64_t>(buckets, buckets_ - passed_);
    const unsigned shared = threadsFor(some, kPassedWorthAThread, threads_);
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(shared);
    together(shared, [&](unsigned k) {
        for (std::uint64_t b = passed_ + some * k / shared; b < passed_ + some * (k + 1) / shared;
             ++b) {
            const std::uint32_t from = b == 0 ? 0 : ends_[b - 1];
            related(std::span(faces_.data() + from, ends_[b] - from),
                    [&](std::uint32_t before, std::uint32_t behind) {
                        found[k].emplace_back(before, behind);
                    });
        }
    });
    for (const auto& part : found)
        for (const auto& [before, behind] : part) {
            inFront_.push_back({before, first_[behind]});
            first_[behind] = static_cast<std::uint32_t>(inFront_.size() - 1);
        }
    passed_ += some;
}

void FaceOrder::walk(std::uint64_t cells) {
    const std::uint64_t until = walked_ + std::min<std::uint64_t>(cells, list_.size() - walked_);
    while (walked_ < until) {
        if (open_.empty()) {
            while (taken_[passed_]) ++passed_;
            taken_[passed_] = true;
            open_.push_back(static_cast<std::uint32_t>(passed_++));
        }
        const std::uint32_t node = open_.back();
        std::uint32_t& next = first_[node];
        while (next != kNone && taken_[inFront_[next].node]) next = inFront_[next].next;
        if (next == kNone) {
            list_[walked_++] = before_[node];
            open_.pop_back();
            continue;
        }
        taken_[inFront_[next].node] = true;
        open_.push_back(inFront_[next].node);
    }
    if (walked_ == list_.size()) passed_ = walked_;
}

}  // namespace render

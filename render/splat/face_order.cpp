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
constexpr std::uint64_t kFacesAtOnce = 1 << 22;  // 80 MB of them, if they are so few
constexpr std::uint64_t kMostRounds = 4;
constexpr std::uint64_t kFacesOfABucket = 4;
constexpr std::uint32_t kBlocks = 1 << 16;
constexpr std::size_t kMostOuter = 1 << 20;
constexpr std::uint64_t kSeenAtOnce = 1 << 13;

// What comes before each: where it begins, and when it is filled, ends.
void addUp(std::vector<std::uint32_t>& counts) {
    std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), 0u);
}

template <typename T>
void release(std::vector<T>& values) {
    std::vector<T>().swap(values);
}

}  // namespace

FaceOrder::FaceOrder(const Scene& scene, const View& view, std::span<CellOfLayer> nearestFirst,
                     unsigned threads)
    : scene_(scene),
      eye_(pixelRays(view).eye),
      list_(nearestFirst),
      threads_(threads),
      gaps_(std::in_place, view) {
    const std::uint64_t faces = kFacesOfACell * list_.size();
    rounds_ = static_cast<std::uint32_t>(std::min(faces / kFacesAtOnce + 1, kMostRounds));
    buckets_ = static_cast<std::uint32_t>(faces / rounds_ / kFacesOfABucket + 1);
    std::uint64_t cells = 0;
    withTets(scene_, scene_.cells->field(), [&](const auto& tets) { cells = tets.count(); });
    while (cells >> shift_ >= kBlocks) ++shift_;
    constexpr std::uint64_t kMostListed = kNone / kFacesOfACell;  // places are numbers of 32 bits
    if (list_.size() >= kMostListed) {
        enter(Phase::Done);
        return;
    }
    ends_.assign((cells >> shift_) + 1, 0);
    listed_.resize(list_.size());
    enter(Phase::Spread);
}

void FaceOrder::enter(Phase phase) {
    phase_ = phase;
    passed_ = 0;
    switch (phase) {
        case Phase::Gather:
            addUp(ends_);
            break;
        case Phase::Sort:
            ofNode_.resize(list_.size());
            break;
        case Phase::Count:
            ends_.assign(buckets_, 0);
            first_.resize(list_.size(), kNone);
            break;
        case Phase::Place:
            faces_ = timeseries::Pages<Face>(
                std::accumulate(ends_.begin(), ends_.end(), std::uint64_t{0}),
                timeseries::Filled::Sparsely);
            addUp(ends_);
            break;
        case Phase::See:
            faces_ = timeseries::Pages<Face>();
            release(ends_);
            // So many are small, and come in order by their middles.
            if (outer_.size() > kMostOuter) outer_.clear();
            break;
        case Phase::Follow:
            release(outer_);
            gaps_->begin();
            break;
        case Phase::Walk:
            gaps_.reset();
            before_.assign(list_.begin(), list_.end());
            taken_.resize(list_.size());
            break;
        case Phase::Done:
            for (auto* const kept : {&ofNode_, &first_, &open_}) release(*kept);
            release(listed_);
            release(inFront_);
            release(before_);
            release(taken_);
            break;
        default:
            break;
    }
}

std::uint64_t FaceOrder::shareOf(std::uint64_t cells, std::uint64_t all) const {
    const double share = static_cast<double>(std::max<std::uint64_t>(cells, 1)) /
                         static_cast<double>(std::max<std::size_t>(list_.size(), 1));
    return static_cast<std::uint64_t>(std::min(share, 1.0) * static_cast<double>(all)) + 1;
}

void FaceOrder::goOn(std::uint64_t cells) {
    const std::uint64_t all = list_.size();
    switch (phase_) {
        case Phase::Spread:
            spread(cells);
            if (passed_ == all) enter(Phase::Gather);
            break;
        case Phase::Gather:
            gather(cells);
            if (passed_ == all) enter(Phase::Sort);
            break;
        case Phase::Sort:
            sort(shareOf(cells, ends_.size()));
            if (passed_ == ends_.size()) enter(Phase::Count);
            break;
        case Phase::Count:
            forEachFace(cells,
                        [&](std::uint32_t bucket, const FaceKey&, const auto&, std::uint32_t) {
                            std::atomic_ref(ends_[bucket]).fetch_add(1, std::memory_order_relaxed);
                        });
            if (passed_ == all) enter(Phase::Place);
            break;
        case Phase::Place:
            forEachFace(cells, [&](std::uint32_t bucket, const FaceKey& key, const auto& sideOf,
                                   std::uint32_t at) {
                const double side = sideOf(eye_);
                faces_.data()[std::atomic_ref(ends_[bucket])
                                  .fetch_add(1, std::memory_order_relaxed)] = {key, at,
                                                                               side > 0   ? 1
                                                                               : side < 0 ? -1
                                                                                          : 0};
            });
            if (passed_ == all) enter(Phase::Match);
            break;
        case Phase::Match:
            match(shareOf(cells, buckets_));
            if (passed_ == buckets_) enter(++round_ < rounds_ ? Phase::Count : Phase::See);
            break;
        case Phase::See:
            // Few at once, whose triangles are not in the way of each other in memory.
            for (std::uint64_t left = shareOf(cells, outer_.size());
                 left > 0 && passed_ < outer_.size(); left -= std::min(left, kSeenAtOnce))
                see(std::min(left, kSeenAtOnce));
            if (passed_ == outer_.size()) enter(Phase::Follow);
            break;
        case Phase::Follow:
            follow(cells);
            if (gaps_->done()) enter(Phase::Walk);
            break;
        case Phase::Walk:
            walk(cells);
            if (walked_ == all) enter(Phase::Done);
            break;
        case Phase::Done:
            break;
    }
}

void FaceOrder::spread(std::uint64_t cells) {
    const std::uint64_t end = passed_ + std::min<std::uint64_t>(cells, list_.size() - passed_);
    for (; passed_ < end; ++passed_) ++ends_[list_[passed_].cell >> shift_];
}

void FaceOrder::gather(std::uint64_t cells) {
    const std::uint64_t end = passed_ + std::min<std::uint64_t>(cells, list_.size() - passed_);
    for (; passed_ < end; ++passed_) {
        const std::uint32_t cell = list_[passed_].cell;
        listed_[ends_[cell >> shift_]++] = {cell, static_cast<std::uint32_t>(passed_)};
    }
}

void FaceOrder::sort(std::uint64_t blocks) {
    const std::uint64_t some = std::min<std::uint64_t>(blocks, ends_.size() - passed_);
    inParts(some, threadsFor(some, 1, threads_), [&](std::size_t first, std::size_t last) {
        for (std::size_t block = passed_ + first; block < passed_ + last; ++block) {
            const std::uint32_t from = block == 0 ? 0 : ends_[block - 1];
            std::sort(listed_.begin() + from, listed_.begin() + ends_[block]);
            for (std::uint32_t at = from, its = from; at < ends_[block]; ++at) {
                if (listed_[at].cell != listed_[its].cell) its = at;
                ofNode_[listed_[at].node] = its;
            }
        }
    });
    passed_ += some;
}

// Beside those of keys like this one, spread over some, for a point may be of very many faces.
std::uint64_t FaceOrder::bucketOf(const FaceKey& key, std::uint64_t keys) const {
    constexpr std::uint32_t kSpread = 1 << 9;
    const std::uint64_t all = std::uint64_t{rounds_} * buckets_;
    const std::uint32_t mixed = (key[1] * 0x9e3779b9u ^ key[2]) * 0x85ebca6bu;
    return (key[0] * all / keys + (mixed >> 16) % kSpread) % all;
}

template <typename Use>
void FaceOrder::forEachFace(std::uint64_t cells, const Use& use) {
    const std::uint64_t some = std::min<std::uint64_t>(cells, list_.size() - passed_);
    const std::uint64_t firstBucket = std::uint64_t{round_} * buckets_;
    withTets(scene_, scene_.cells->field(), [&](const auto& tets) {
        const std::uint64_t keys = tets.faceKeys();
        inParts(some, threadsFor(some, kPassedWorthAThread, threads_),
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t at = passed_ + first; at < passed_ + last; ++at) {
                        if (!isFirst(at)) continue;
                        tets.forEachFace(
                            listed_[at].cell, [&](const FaceKey& key, const auto& sideOf) {
                                const std::uint64_t bucket = bucketOf(key, keys) - firstBucket;
                                if (bucket < buckets_)
                                    use(static_cast<std::uint32_t>(bucket), key, sideOf,
                                        static_cast<std::uint32_t>(at));
                            });
                    }
                });
    });
    passed_ += some;
}

void FaceOrder::match(std::uint64_t buckets) {
    const std::uint64_t some = std::min<std::uint64_t>(buckets, buckets_ - passed_);
    const unsigned shared = threadsFor(some, kPassedWorthAThread, threads_);
    struct Found {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        std::vector<Outer> outer;
    };
    std::vector<Found> found(shared);
    sharing(shared, [&](unsigned k) {
        for (std::uint64_t b = passed_ + some * k / shared; b < passed_ + some * (k + 1) / shared;
             ++b) {
            const std::uint32_t from = b == 0 ? 0 : ends_[b - 1];
            const std::span bucket(faces_.data() + from, ends_[b] - from);
            std::ranges::sort(bucket);
            for (std::size_t i = 0; i < bucket.size(); ++i) {
                const Face& one = bucket[i];
                const bool isLast = i + 1 == bucket.size() || bucket[i + 1].key != one.key;
                if (isLast && (i == 0 || bucket[i - 1].key != one.key))
                    found[k].outer.push_back({one.key, one.at});
                if (isLast || bucket[i + 1].at == one.at) continue;
                const Face& other = bucket[i + 1];
                const std::int32_t side = one.eye != 0 ? one.eye : -other.eye;
                if (side > 0) found[k].pairs.emplace_back(other.at, one.at);
                if (side < 0) found[k].pairs.emplace_back(one.at, other.at);
            }
        }
    });
    for (const Found& part : found) {
        for (const auto& [before, behind] : part.pairs) putBefore(before, behind);
        outer_.insert(outer_.end(), part.outer.begin(), part.outer.end());
    }
    passed_ += some;
}

void FaceOrder::see(std::uint64_t cells) {
    const std::uint64_t some = std::min<std::uint64_t>(cells, outer_.size() - passed_);
    const unsigned shared = threadsFor(some, kPassedWorthAThread, threads_);
    std::vector<std::vector<GapOrder::Outer>> triangles(shared);
    withTets(scene_, scene_.cells->field(), [&](const auto& tets) {
        sharing(shared, [&](unsigned k) {
            for (std::uint64_t i = passed_ + some * k / shared;
                 i < passed_ + some * (k + 1) / shared; ++i) {
                const Outer& face = outer_[i];
                tets.forEachTriangle(listed_[face.at].cell, face.key, eye_,
                                     [&](const std::array<glm::dvec3, 3>& at, double side) {
                                         if (side != 0)
                                             triangles[k].push_back({at, face.at, side > 0});
                                     });
            }
        });
    });
    for (const auto& own : triangles) gaps_->add(own, threads_);
    passed_ += some;
}

void FaceOrder::follow(std::uint64_t cells) {
    std::vector<GapOrder::Pair> pairs;
    const double share = static_cast<double>(cells) / static_cast<double>(list_.size());
    gaps_->goOn(std::min(share, 1.0), threads_, pairs);
    for (const auto& [before, behind] : pairs) putBefore(before, behind);
}

void FaceOrder::walk(std::uint64_t cells) {
    const std::uint64_t until = walked_ + std::min<std::uint64_t>(cells, list_.size() - walked_);
    while (walked_ < until) {
        if (open_.empty()) {
            while (taken_[ofNode_[passed_]]) ++passed_;
            open_.push_back(ofNode_[passed_]);
            taken_[open_.back()] = true;
        }
        const std::uint32_t at = open_.back();
        std::uint32_t& next = first_[at];
        while (next != kNone && taken_[inFront_[next].at]) next = inFront_[next].next;
        if (next == kNone) {
            open_.pop_back();
            pass(at);
            continue;
        }
        open_.push_back(inFront_[next].at);
        taken_[open_.back()] = true;
    }
}

void FaceOrder::pass(std::uint32_t at) {
    const std::uint32_t cell = listed_[at].cell;
    for (; at < listed_.size() && listed_[at].cell == cell; ++at)
        list_[walked_++] = before_[listed_[at].node];
}

}  // namespace render

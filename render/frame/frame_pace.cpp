#include "render/frame/frame_pace.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace render {
namespace {

constexpr std::size_t kFrames = 8;
// Times of 0, from a clock that is too coarse, must not stop the model for good.
constexpr double kLeastPerSplatNs = 1e-4;
// Frames whose splats differ by less say nothing of what a splat costs.
constexpr double kTellingDifference = 0.05;
// Where splats take less of a frame, what one costs drowns in what frames differ by.
constexpr double kTellingShare = 0.1;
// A model from few frames may promise too much.
constexpr double kMostGrowth = 3;

double ns(std::chrono::nanoseconds time) { return static_cast<double>(time.count()); }

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

FramePace::FramePace(std::chrono::nanoseconds target, std::uint64_t first)
    : targetNs_(ns(target)), first_(first), budget_(first) {}

void FramePace::setTarget(std::chrono::nanoseconds target) {
    targetNs_ = ns(target);
    if (knows()) follow();
}

std::optional<FramePace::Cost> FramePace::learnt() const {
    const double ofSplats = perSplatNs_ * mostSplats_;
    if (!isTold_ || mostSplats_ < double{kFewest} ||
        ofSplats < kTellingShare * (fixedNs_ + ofSplats))
        return std::nullopt;
    return Cost{fixedNs_, perSplatNs_, mostSplats_};
}

void FramePace::beginFrom(const Cost& learnt) {
    recent_.clear();
    fixedNs_ = learnt.fixedNs;
    perSplatNs_ = std::max(learnt.perSplatNs, kLeastPerSplatNs);
    mostSplats_ = learnt.splats;
    isTold_ = true;
    budget_ = static_cast<std::uint64_t>(fittingTarget());
}

void FramePace::forget() {
    recent_.clear();
    fixedNs_ = perSplatNs_ = mostSplats_ = 0;
    isTold_ = false;
    budget_ = first_;
}

void FramePace::took(std::uint64_t splats, std::chrono::nanoseconds time) {
    recent_.push_back({static_cast<double>(splats), std::max(ns(time), 0.0)});
    if (recent_.size() > kFrames) recent_.pop_front();
    fit();
    follow();
}

std::chrono::nanoseconds FramePace::costOf(std::uint64_t splats) const {
    return std::chrono::nanoseconds(std::llround(perSplatNs_ * static_cast<double>(splats)));
}

std::chrono::nanoseconds FramePace::predicted(std::uint64_t splats) const {
    return std::chrono::nanoseconds(std::llround(fixedNs_)) + costOf(splats);
}

std::uint64_t FramePace::fitting(std::chrono::nanoseconds time) const {
    if (!knows()) return first_;
    return static_cast<std::uint64_t>(
        std::clamp(ns(time) / perSplatNs_, double{kFewest}, static_cast<double>(kMost)));
}

void FramePace::fit() {
    std::vector<double> slopes, fixed, shares;
    for (std::size_t i = 1; i < recent_.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Sample &a = recent_[i], &b = recent_[j];
            const double apart = a.splats - b.splats;
            if (std::abs(apart) > kTellingDifference * std::max(a.splats, b.splats))
                slopes.push_back((a.ns - b.ns) / apart);
        }
    mostSplats_ = 0;
    for (const Sample& f : recent_) {
        shares.push_back(f.ns / std::max(f.splats, 1.0));
        mostSplats_ = std::max(mostSplats_, f.splats);
    }
    // Nothing tells the two apart in the first frame of all.
    if (!knows()) perSplatNs_ = shares[0] / 2;
    isTold_ = isTold_ || !slopes.empty();
    if (!slopes.empty()) perSplatNs_ = median(std::move(slopes));
    perSplatNs_ = std::max(perSplatNs_, kLeastPerSplatNs);
    for (const Sample& f : recent_) fixed.push_back(f.ns - perSplatNs_ * f.splats);
    fixedNs_ = median(std::move(fixed));
    if (fixedNs_ >= 0) return;
    fixedNs_ = 0;
    perSplatNs_ = std::max(median(std::move(shares)), kLeastPerSplatNs);
}

double FramePace::fittingTarget() const {
    const double known = std::max(static_cast<double>(first_), kMostGrowth * mostSplats_);
    const double most = std::min(known, static_cast<double>(kMost));
    return std::clamp((targetNs_ - fixedNs_) / perSplatNs_, static_cast<double>(kFewest), most);
}

void FramePace::follow() {
    const auto now = static_cast<double>(budget_);
    const double wanted = fittingTarget();
    if (std::abs(wanted - now) >= 0.1 * now) budget_ = static_cast<std::uint64_t>(wanted);
}

}  // namespace render

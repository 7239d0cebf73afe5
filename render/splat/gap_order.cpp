#include "render/splat/gap_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "render/together.h"

namespace render {
namespace {

// More cost more than they tell (tests/bench/NOTES.md).
constexpr double kMostMet = 1 << 17;
constexpr int kRowsOfAStrip = 8;
constexpr double kInFront = 1 + 1e-6;  // of the near plane's depth
constexpr std::size_t kSeenWorthAThread = 1 << 11;
// Of a depth, or of how far depths differ: where a cell is left and another one entered in one
// place, it is left before.
constexpr double kSamePlace = 1e-5;

// A ray that meets the edge between two triangles meets one of them, at least.
constexpr float kBeside = 1e-4f;

float across(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

}  // namespace

GapOrder::GapOrder(const View& view) : view_(view), rays_(pixelRays(view)) {}

void GapOrder::add(std::span<const Outer> outer, unsigned threads) {
    const unsigned shared = threadsFor(outer.size(), kSeenWorthAThread, threads);
    std::vector<std::vector<Seen>> seen(shared);
    sharing(shared, [&](unsigned k) {
        const std::size_t first = outer.size() * k / shared, end = outer.size() * (k + 1) / shared;
        for (const Outer& each : outer.subspan(first, end - first)) see(each, seen[k]);
    });
    const double picture = static_cast<double>(view_.size.x) * view_.size.y;
    for (const std::vector<Seen>& part : seen) {
        for (const Seen& each : part) {
            const auto [least, most] = std::ranges::minmax(each.perDepth);
            least_ = std::min(least_, least);
            most_ = std::max(most_, most);
            area_ += std::min(0.5 * std::abs(across(each.at[0], each.at[1], each.at[2])), picture);
        }
        seen_.insert(seen_.end(), part.begin(), part.end());
    }
}

// What of it is in front of the eye: a fan.
void GapOrder::see(const Outer& outer, std::vector<Seen>& into) const {
    const double near = rays_.near * kInFront;
    const auto placeOf = [&](const glm::dvec3& inView) {
        const double perDepth = -1 / inView.z;
        return glm::dvec3(rays_.centre + perDepth * rays_.focal * glm::dvec2(inView), perDepth);
    };
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = glm::dvec3(view_.viewFromWorld * glm::dvec4(outer.at[i], 1));
    std::array<glm::dvec3, 4> fan;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &at = corners[i], &next = corners[(i + 1) % 3];
        if (-at.z > near) fan[count++] = placeOf(at);
        if ((-at.z > near) != (-next.z > near))
            fan[count++] = placeOf(glm::mix(at, next, (near + at.z) / (at.z - next.z)));
    }
    for (std::size_t i = 2; i < count; ++i) {
        const Seen seen{{glm::vec2(fan[0]), glm::vec2(fan[i - 1]), glm::vec2(fan[i])},
                        {fan[0].z, fan[i - 1].z, fan[i].z},
                        outer.cell,
                        outer.isEntered};
        const float twice = across(seen.at[0], seen.at[1], seen.at[2]);
        if (!std::isfinite(twice) || twice == 0) continue;
        const auto [low, high] = std::ranges::minmax(seen.at, {}, &glm::vec2::y);
        const auto [left, right] = std::ranges::minmax(seen.at, {}, &glm::vec2::x);
        if (high.y >= 0 && right.x >= 0 && low.y <= static_cast<float>(view_.size.y) &&
            left.x <= static_cast<float>(view_.size.x))
            into.push_back(seen);
    }
}

void GapOrder::begin() {
    while (area_ / apart_ / apart_ > kMostMet) ++apart_;
    count_ = (view_.size + apart_ - 1) / apart_;
    strips_ = (count_.y + kRowsOfAStrip - 1) / kRowsOfAStrip;
    ends_.assign(static_cast<std::size_t>(strips_) + 1, 0);
    for (const Seen& seen : seen_)
        for (auto [strip, end] = stripsOf(seen); strip < end; ++strip)
            ++ends_[static_cast<std::size_t>(strip)];
    std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0u);
    inStrips_.resize(ends_.back());
    for (std::uint32_t i = 0; i < seen_.size(); ++i)
        for (auto [strip, end] = stripsOf(seen_[i]); strip < end; ++strip)
            inStrips_[ends_[static_cast<std::size_t>(strip)]++] = i;
}

std::pair<int, int> GapOrder::stripsOf(const Seen& seen) const {
    const auto [low, high] = std::ranges::minmax(seen.at, {}, &glm::vec2::y);
    const auto stripOf = [&](float y) {
        const float rows = static_cast<float>(kRowsOfAStrip * apart_);
        return static_cast<int>(std::clamp(y / rows, 0.0f, static_cast<float>(strips_)));
    };
    return {stripOf(low.y), std::min(stripOf(high.y) + 1, strips_)};
}

// Rays through the middles of pixels.
void GapOrder::meet(const Seen& seen, int firstRow, int endRow, std::vector<Met>& met) const {
    const auto& [a, b, c] = seen.at;
    const float whole = across(a, b, c), step = static_cast<float>(apart_);
    std::array<double, 3> nearness;  // from the farthest
    for (std::size_t i = 0; i < 3; ++i) nearness[i] = seen.perDepth[i] - least_;
    const auto [left, right] = std::ranges::minmax(seen.at, {}, &glm::vec2::x);
    const auto [low, high] = std::ranges::minmax(seen.at, {}, &glm::vec2::y);
    const auto rayBefore = [&](float place, int most) {  // the first that is not before
        return static_cast<int>(
            std::clamp(std::ceil(place / step - 0.5f), 0.0f, static_cast<float>(most)));
    };
    const int firstX = rayBefore(left.x, count_.x), endX = rayBefore(right.x, count_.x);
    firstRow = std::max(firstRow, rayBefore(low.y, count_.y));
    endRow = std::min(endRow, rayBefore(high.y, count_.y));
    for (int y = firstRow; y < endRow; ++y)
        for (int x = firstX; x < endX; ++x) {
            const glm::vec2 at((static_cast<float>(x) + 0.5f) * step,
                               (static_cast<float>(y) + 0.5f) * step);
            const float ofA = across(at, b, c) / whole, ofB = across(a, at, c) / whole;
            const float ofC = 1 - ofA - ofB;
            if (std::min({ofA, ofB, ofC}) < -kBeside) continue;
            double near = ofA * nearness[0] + ofB * nearness[1] + ofC * nearness[2];
            if (!seen.isEntered) near += kSamePlace * std::min(near + least_, most_ - least_);
            const auto ray = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(count_.x) +
                             static_cast<std::uint64_t>(x);
            met.push_back({ray << 32 | ~std::bit_cast<std::uint32_t>(
                                           std::max(static_cast<float>(near), 0.0f)),
                           seen.cell, seen.isEntered});
        }
}

void GapOrder::follow(int strip, std::vector<Pair>& pairs) const {
    thread_local std::vector<Met> met;
    met.clear();
    const auto s = static_cast<std::size_t>(strip);
    const int firstRow = strip * kRowsOfAStrip, endRow = firstRow + kRowsOfAStrip;
    for (std::uint32_t i = s == 0 ? 0 : ends_[s - 1]; i < ends_[s]; ++i)
        meet(seen_[inStrips_[i]], firstRow, endRow, met);
    std::ranges::sort(met);
    const std::size_t before = pairs.size();
    for (std::size_t i = 1; i < met.size(); ++i) {
        const Met &left = met[i - 1], &entered = met[i];
        if (left.ray >> 32 == entered.ray >> 32 && !left.isEntered && entered.isEntered &&
            left.cell != entered.cell)
            pairs.emplace_back(left.cell, entered.cell);
    }
    const auto own = pairs.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(own, pairs.end());
    pairs.erase(std::unique(own, pairs.end()), pairs.end());
}

void GapOrder::goOn(double share, unsigned threads, std::vector<Pair>& pairs) {
    const int some = std::min(static_cast<int>(std::ceil(share * strips_)), strips_ - strip_);
    const unsigned shared = threadsFor(static_cast<std::size_t>(some), 2, threads);
    std::vector<std::vector<Pair>> found(shared);
    sharing(shared, [&](unsigned k) {
        const auto part = [&](unsigned at) {
            return strip_ + some * static_cast<int>(at) / static_cast<int>(shared);
        };
        for (int strip = part(k); strip < part(k + 1); ++strip) follow(strip, found[k]);
    });
    for (const auto& own : found) pairs.insert(pairs.end(), own.begin(), own.end());
    strip_ += some;
}

}  // namespace render

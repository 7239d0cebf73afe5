#include "render/points/subset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <vector>

namespace render {
namespace {

constexpr std::size_t kStrides = std::countr_zero(kMaxStride) + 1;

using Places = std::vector<std::uint16_t>;

Places placesOf(std::uint32_t stride) {
    Places places;
    for (std::uint32_t p = 0; p < kSubsetPeriod; ++p)
        if (inSubset(p, stride)) places.push_back(static_cast<std::uint16_t>(p));
    return places;
}

// Among the points [0, end).
std::uint64_t countBelow(std::uint64_t end, std::uint32_t stride) {
    const auto places = subsetPlaces(stride);
    const auto rest = std::ranges::lower_bound(places, end % kSubsetPeriod) - places.begin();
    return end / kSubsetPeriod * places.size() + static_cast<std::uint64_t>(rest);
}

}  // namespace

std::span<const std::uint16_t> subsetPlaces(std::uint32_t stride) {
    assert(std::has_single_bit(stride) && stride <= kMaxStride);
    static const auto all = [] {
        std::array<Places, kStrides> made;
        for (std::size_t i = 0; i < kStrides; ++i) made[i] = placesOf(std::uint32_t{1} << i);
        return made;
    }();
    return all[static_cast<std::size_t>(std::countr_zero(stride))];
}

std::uint64_t subsetCount(const timeseries::Run& run, std::uint32_t stride) {
    return countBelow(run.first + run.count, stride) - countBelow(run.first, stride);
}

}  // namespace render

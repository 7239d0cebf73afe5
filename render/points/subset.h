// The points that stand for all while a picture moves: 2^15 / stride of every 2^15 that follow each
// other in the sorted step, evenly. Pure.
//
// Point p has the rank p K mod 2^15, K odd, so that any 2^15 points in a row have every rank once;
// those whose rank is below 2^15 / stride are drawn. K / 2^15 is near the golden ratio: its
// multiples are spread evenly at every length (Knuth, The Art of Computer Programming, volume
// 3, 6.4), so a run of any n points has n / stride of them, give or take kSubsetUnevenness. Points
// of equal value stand in grid order, where every stride-th one would take whole planes and leave
// others out. A larger stride's subset is part of a smaller one's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "timeseries/index/sorted_step.h"

namespace render {

constexpr std::uint32_t kMaxStride = 512;
constexpr std::uint64_t kSubsetPeriod = 1 << 15;
// By Denjoy and Koksma's inequality, q points in a row, q a denominator of a convergent of
// K / 2^15, are even to within the total variation of an interval's indicator, 2; and at most 15
// such rows make up any number of points below 2^15.
constexpr std::uint64_t kSubsetUnevenness = 30;

// [0, 2^15)
constexpr std::uint64_t subsetRank(std::uint64_t point) {
    constexpr std::uint64_t kMultiplier = 20249;
    return point * kMultiplier % kSubsetPeriod;
}

// `stride` below is a power of two, 1 to kMaxStride.
constexpr bool inSubset(std::uint64_t point, std::uint32_t stride) {
    return subsetRank(point) < kSubsetPeriod / stride;
}
// Of the points [0, 2^15), ascending; others repeat them.
std::span<const std::uint16_t> subsetPlaces(std::uint32_t stride);
// How many of the run's points are drawn.
std::uint64_t subsetCount(const timeseries::Run& run, std::uint32_t stride);

// Calls visit(point) for each, ascending.
template <typename Visit>
void forEachInSubset(const timeseries::Run& run, std::uint32_t stride, const Visit& visit) {
    const std::uint64_t end = run.first + run.count;
    for (std::uint64_t period = run.first / kSubsetPeriod * kSubsetPeriod; period < end;
         period += kSubsetPeriod) {
        const auto places = subsetPlaces(stride);
        auto place = places.begin();
        if (period < run.first) place = std::ranges::lower_bound(places, run.first - period);
        for (; place != places.end() && period + *place < end; ++place) visit(period + *place);
    }
}

}  // namespace render

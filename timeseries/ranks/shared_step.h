// One time step that several processes hold a part of each, sorted by all of them into one file:
// the bytes that writeStep() makes of the whole, for any number of processes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "timeseries/grid/field.h"
#include "timeseries/ranks/ranks.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {

// A rank's part of a grid; along each index its first place and how many.
struct GridBox {
    std::array<std::uint64_t, 3> first{}, size{};  // a size of 0: it has none
    std::uint64_t count() const { return size[0] * size[1] * size[2]; }
};

struct SharedStep {
    std::array<std::uint32_t, 3> size{};  // of the whole grid, in points
    std::string about;                    // kept beside the points
};

// What keeps the boxes from being the parts of a grid of this size, each point in one of them, in
// words; "" when nothing does. Collective.
std::string flawOf(const Ranks& ranks, const GridBox& mine,
                   const std::array<std::uint32_t, 3>& size);

// Collective. `values` is this rank's part, in the order of its box; its grid may be null. It is
// taken, for memory's sake: at most 16 bytes a point of it, 32 of types of 8 bytes, are held
// beside, or of its share of the list where that is more, and some MB a thread. The same type on
// all ranks. `file`: the first rank's, which has yet to finish() it; null on all others, which
// write beside it under its name of now. REQUIRES: no flawOf(). Throws RanksError, everywhere.
void writeShared(const Ranks& ranks, Field values, const GridBox& box, const SharedStep& step,
                 WholeFile* file);

}  // namespace timeseries

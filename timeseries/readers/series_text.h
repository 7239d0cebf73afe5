// What is told of a series of files: which were recognised, what is missing, stands twice or is
// passed over.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/series_files.h"
#include "timeseries/readers/text/numbered_names.h"

namespace timeseries {

// "3 files a_1.nc to a_9.nc". REQUIRES: files not empty.
std::string namesText(const std::vector<std::filesystem::path>& files);

// What was recognised, with its numbers; notes of those that are missing or stand twice.
void describe(const Numbered& series, ExpandedSeries& into);

// A note of the files named alike that are no part of the series; none when there are none.
void tellOthers(std::vector<std::filesystem::path> others, ExpandedSeries& into);

// A note of the files whose names have a dot in a number where those of the series have none, or
// the other way round; none when there are none.
void tellOtherDots(std::vector<std::filesystem::path> others, ExpandedSeries& into);

// Why only the first of these files is opened: digits at this place of their names may be a
// fraction or a count. REQUIRES: they are not of one length.
void tellUnclear(const std::vector<std::filesystem::path>& files, std::size_t at,
                 ExpandedSeries& into);

// Files found together are ordered by whole numbers, which fractions need not follow: a note where
// the orders may differ.
void tellFractions(const std::vector<std::filesystem::path>& files, ExpandedSeries& into);

// "a_*.nc (2 files), b.nc", by the names of each.
std::string candidatesText(std::span<const std::vector<std::filesystem::path>> candidates);

}  // namespace timeseries

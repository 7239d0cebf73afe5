// The times of a variable: as one file stores them, as a TimeAxis with dates, and several files'
// joined into one series (CF 1.10, section 4.4).
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

struct StoredTimes {
    std::string name = "step", units, calendar;
    std::vector<Number> values{Number(0.0)};
    bool counted = true;    // no time coordinate: the values are 0, 1, 2, ...
    bool single = true;     // no time dimension either
    bool inText = false;    // dates that the file has in words
    std::string note = {};  // why such are not read; "" for none
};

// From the time dimension, else from a scalar time coordinate (CF 1.10, section 5.7).
// Throws FileError.
StoredTimes timesOf(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                    const Roles& roles);

TimeAxis timeAxisOf(const StoredTimes& times, std::vector<std::string>& notes);

// One file's part of a series: all its steps, in its order.
struct Segment {
    std::size_t file, count;
};

struct JoinedTimes {
    StoredTimes times;
    std::vector<Segment> segments;  // by time; in the order given when the files have none
};

// Where a file's texts are no dates, or one has no times, those of the others that are in text are
// not taken either: steps are counted, which a note tells.
// REQUIRES: parts not empty, none without a step, one for each path or one for all. Throws
// FileError, naming two files, when the units cannot be brought together or the files' times
// overlap.
JoinedTimes join(const std::vector<StoredTimes>& parts,
                 const std::vector<std::filesystem::path>& paths, const std::string& variable);

}  // namespace timeseries

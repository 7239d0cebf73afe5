// A file opened and one of its variables chosen.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/choices/explorer.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_files.h"

namespace app {

// What a user named, opened.
struct OpenedSeries {
    std::unique_ptr<timeseries::Reader> reader;
    timeseries::ExpandedSeries series;  // the files opened, and what is told of them
};

// A member of a numbered series, a folder, a pattern, or several files. Files that were found
// beside the one named, but cannot be joined with it, are left out with a note that tells why; so
// are damaged variables. Throws FileError.
OpenedSeries openSeries(std::span<const std::filesystem::path> named);

// A variable of a series, with all that is told of it. Apart from the reader, which a loader takes.
struct Dataset {
    timeseries::ExpandedSeries series;
    std::size_t variableIndex = 0;
    timeseries::Variable variable;

    std::string name;             // the file, folder or pattern named first, for messages
    std::size_t defaultStep = 0;  // the middle one; of the member's own when one was named
    std::vector<timeseries::Variable> variables = {};  // all that the reader has

    std::size_t stepCount() const { return variable.time->points.size(); }
};

struct OpenDataset : Dataset {
    std::unique_ptr<timeseries::Reader> reader;
};

// Which variable is meant when none is named: the one of the most levels, then of the most steps.
// Of those rather a field than classes, one of a time than a mask of none, and what is no surface's
// direction; then of the most points; of equals the first. REQUIRES: one at least.
std::size_t defaultVariable(std::span<const timeseries::Variable> variables);

// `variable`: by name; "" is the default one. Throws FileError, also for a name that is not there
// or of what is damaged.
OpenDataset openDataset(std::span<const std::filesystem::path> named, const std::string& variable);

// The chosen steps, all there; throws FileError when one is not.
std::vector<std::size_t> stepsOf(const Dataset& dataset, const StepChoice& choice);

// By what a step is found again in a series that has more steps, or fewer: its date, or its number
// in its units; "" where steps are counted.
std::string timeKept(const timeseries::TimeAxis& axis, std::size_t step);
// The step that has the time kept of this one, where one alone has; else as it is. A note tells
// what is another than it was.
std::size_t stepThen(Dataset& dataset, std::size_t step, const std::string& kept);
// Of a session whose one step has its time kept, `steps` is that step now. It is asked for once.
void findStepThen(Dataset& dataset, Explorer& session);

// "2000-01-04 12:00:00", "1.1 s", or "step 3".
std::string timeText(const timeseries::TimeAxis& axis, std::size_t step);

// "13402" -> "13,402".
std::string withCommas(std::uint64_t count);

}  // namespace app

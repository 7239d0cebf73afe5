// The points of a step that lies in a file, read where somebody looks.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "timeseries/index/lazy_column.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/index/step_file.h"

namespace timeseries {

using Again = std::function<SortedStep(const std::string& why)>;  // SortedStep::Source's

// REQUIRES: T is of file->type().
template <typename T>
std::unique_ptr<LazyColumn<T>> storedColumn(std::shared_ptr<const StepFile> file, Again again,
                                            unsigned threads);

}  // namespace timeseries

// The points of a step that lies in a file, read where somebody looks.
#pragma once

#include <memory>

#include "timeseries/index/lazy_column.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/index/step_file.h"

namespace timeseries {

// REQUIRES: T is of file->type(). `again`: as SortedStep::stored takes it.
template <typename T>
std::unique_ptr<const LazyColumn<T>> storedColumn(std::shared_ptr<const StepFile> file,
                                                  SortedStep::Again again, unsigned threads);

}  // namespace timeseries

// The grids of a file as a user says that they lie: for files that do not say which way an axis
// runs, or what it is.
#pragma once

#include <array>

#include "app/files/dataset.h"

namespace app {

// From here on the dataset's grids, and those of every step that is read, have the axes chosen: a
// flipped one counts downwards where the file's counts upwards, and the reverse. Whatever places,
// labels or reads points follows.
void chooseAxes(OpenDataset& dataset, const std::array<AxisChoice, 3>& axes);

}  // namespace app

// What the planes of a picture are held in. Pure.
#pragma once

#include "timeseries/grid/pages.h"

namespace render {

// [y][x][channel], rows from the bottom. A tile has a few bytes on each of many rows: in large
// pages, or each would be on a page of its own.
using PlanePixels = timeseries::LargeVector<float>;

}  // namespace render

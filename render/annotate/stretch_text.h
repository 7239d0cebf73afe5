// What a picture says of axes that are drawn to scales of their own.
#pragma once

#include <string>

#include "render/points/placed_points.h"
#include "timeseries/grid/grid.h"

namespace render {

// How much the axes are stretched against each other, in words: "5.6 m depth drawn as 1° lon";
// empty when all are drawn to one scale.
std::string stretchText(const timeseries::Grid& grid, const PlacedPoints& placed);

}  // namespace render

// How data on a globe are looked at before anybody has chosen: straight at their middle, north up.
// Pure.
#pragma once

#include "app/choices/explorer.h"
#include "timeseries/grid/grid.h"

namespace app {

// On a flat map a look from the side. On a globe one at the middle of the field's longitudes and
// latitudes, in whole degrees; of a field that goes all round and beyond both sides of the equator,
// which has no such middle, the same as on a flat map.
ViewChoice firstLook(render::Map map, const timeseries::Grid& grid);

// Where nobody has chosen a view, the first look at a globe.
void lookFirst(Explorer& explorer, const timeseries::Grid& grid);
// A first look at one map becomes that at the explorer's.
void followMap(Explorer& explorer, render::Map before, const timeseries::Grid& grid);

}  // namespace app

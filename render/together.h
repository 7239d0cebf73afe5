// Work that several threads share, as timeseries/together.h has it.
#pragma once

#include "timeseries/together.h"

namespace render {

using timeseries::inParts;
using timeseries::sharing;
using timeseries::sharingThreads;
using timeseries::threadsFor;
using timeseries::together;

}  // namespace render

// The commands of the program. Each prints its result on stdout and returns the exit code; failures
// of the world (files, drivers, disks) are exceptions, caught in main.
#pragma once

#include "app/choices/options.h"

namespace app {

int info(const InfoOptions& options);
int count(const CountOptions& options);
// Draws without a window and writes files.
int renderHeadless(const RenderOptions& options);
// Draws one step in every way, and tells times and errors.
int measureModes(const MeasureOptions& options);
// Sorts steps into files.
int index(const IndexOptions& options);
// Lists the files of sorted steps, or removes them.
int cache(const CacheOptions& options);
// A headset session where there is a headset, else a window. When both are over the program ends
// here, without what else would be destroyed: a read that nobody waits for may still run.
[[noreturn]] int view(const ViewOptions& options);

}  // namespace app

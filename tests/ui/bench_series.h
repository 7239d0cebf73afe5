// How long a window that plays lets its user wait.
#pragma once

#include <filesystem>
#include <string>

#include "tests/ui/driver.h"

namespace ui {

// A series that is to play faster than it can: while its steps are read and sorted, then again.
void runPlaying(const Screen& screen, const std::filesystem::path& home);

// A series of `count` steps with an index each, one range of which plays once, ten steps a second,
// from a disk that nothing is remembered of. `file` is each step's; the indices are not.
void runPlayingCold(const Screen& screen, const std::filesystem::path& home, const char* what,
                    const std::filesystem::path& file, int count, const std::string& range);

// A thin window that sweeps through the fire's step whose values reach far: its shell by cells,
// lit.
void runSweeping(const Screen& screen, const std::filesystem::path& home);

}  // namespace ui

// Options of every command, and of those that show something.
#pragma once

#include <CLI/CLI.hpp>

#include "app/choices/options.h"

namespace app {

// What is given goes into `into`, which must outlive the parsing.
void addCommon(CLI::App& app, CommonOptions& into);
void addMemory(CLI::App& app, CommonOptions& into);

}  // namespace app

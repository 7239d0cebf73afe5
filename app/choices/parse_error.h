// Why a command line is refused, in a sentence about what the user wrote: CLI11's own are about its
// parser.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace app {

std::string parseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           std::span<const char* const> arguments);

}  // namespace app

// An answer from a library that may crash or never give one, asked for in a forked copy of this
// process: only the copy dies of it.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <variant>

namespace xr {

enum class NoAnswer { Crashed, TookTooLong };

// What `ask` returns in the copy, whose output is seen by nobody. For so long at most: then the
// copy is ended. What it changes is not seen here.
std::variant<std::string, NoAnswer> forkedAnswer(const std::function<std::string()>& ask,
                                                 std::chrono::milliseconds limit);

}  // namespace xr

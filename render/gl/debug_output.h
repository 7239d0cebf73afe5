// The driver's own complaints. The first error since the last call becomes an exception, so that a
// GL error is found at the frame that made it.
#pragma once

#include <optional>
#include <string>

namespace render::gl {

// Errors and undefined behaviour are recorded from now on, on the context that is current.
void recordErrors();
// Throws std::runtime_error with the driver's message when an error was recorded since the last
// call.
void throwOnError();
// For errors that somebody else's calls on this context have left.
void forgetErrors();
// The recorded error itself, forgotten thereby; needs no context any more.
std::optional<std::string> takeRecordedError();

}  // namespace render::gl

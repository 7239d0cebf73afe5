// The driver's own complaints. The first error since the last call becomes an exception, so that a
// GL error is found at the frame that made it.
#pragma once

namespace render::gl {

// Errors and undefined behaviour are recorded from now on, on the context that is current.
void recordErrors();
// Throws std::runtime_error with the driver's message when an error was recorded since the last
// call.
void throwOnError();

}  // namespace render::gl

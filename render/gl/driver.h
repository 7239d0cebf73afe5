// What is known of the driver of the context that is current.
#pragma once

namespace render::gl {

// Whether it draws on the processor, as Mesa's llvmpipe and softpipe do.
bool drawsOnProcessor();
// Returns when all that was asked for is drawn.
void finishDrawing();

}  // namespace render::gl

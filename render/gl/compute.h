// What compute shaders are started with.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>

namespace render::gl {

// Starts so many workgroups of the program in use, numbered gl_WorkGroupID.x + gl_WorkGroupID.y *
// gl_NumWorkGroups.x: a few more, for GL promises no more than 65,535 in a row. Shaders after it
// read what it wrote into buffers that they bind.
void startGroups(std::uint64_t groups);
// As many as have a thread for each of these, 256 in one.
void startFor(std::uint64_t threads);

}  // namespace render::gl

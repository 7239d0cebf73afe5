// What stands in a buffer on the GPU.
#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/debug_output.h"
#include "render/gl/object.h"

namespace tests {

// The first so many, also of what shaders have just written.
template <typename T>
std::vector<T> contentsOf(const render::gl::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(count * sizeof(T)),
                            values.data());
    render::gl::throwOnError();
    return values;
}

}  // namespace tests

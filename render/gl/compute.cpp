#include "render/gl/compute.h"

#include <algorithm>

namespace render::gl {

void startGroups(std::uint64_t groups) {
    constexpr std::uint64_t kMostInARow = 65535;
    if (groups == 0) return;
    const std::uint64_t rows = (groups + kMostInARow - 1) / kMostInARow;
    const std::uint64_t inARow = (groups + rows - 1) / rows;
    glDispatchCompute(static_cast<GLuint>(inARow), static_cast<GLuint>(rows), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void startFor(std::uint64_t threads) {
    constexpr std::uint64_t kThreads = 256;
    startGroups((threads + kThreads - 1) / kThreads);
}

}  // namespace render::gl

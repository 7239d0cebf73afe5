// What the CPU splatter adds up: planes of pixels, row 0 at the bottom as in a View.
#pragma once

#include <vector>

#include "render/model/scene.h"

namespace render {

template <typename Real>
struct Accumulator {
    glm::ivec2 size{0};
    std::vector<Channels> channels;
    std::vector<std::vector<Real>> planes;  // per channel entry: [y][x][1 or 4]

    Accumulator(glm::ivec2 imageSize, std::vector<Channels> wanted)
        : size(imageSize), channels(std::move(wanted)) {
        for (const Channels c : channels)
            planes.emplace_back(std::size_t(size.x) * size.y * floatsPerPixel(c));
    }
};

}  // namespace render

#include "render/splat/open_tiles.h"

#include <glm/common.hpp>

namespace render {

bool OpenTiles::isOpenIn(const WindowBox& box) const {
    constexpr double kMore = 1;  // pixel, than arithmetic loses
    const glm::dvec2 size(view_.box.size);
    const glm::dvec2 lo = box.lo - glm::dvec2(view_.box.at) - kMore;
    const glm::dvec2 hi = box.hi - glm::dvec2(view_.box.at) + kMore;
    if (view_.count() == 0) return false;
    if (!(hi.x >= 0 && hi.y >= 0 && lo.x < size.x && lo.y < size.y)) return false;
    const auto tileOf = [&](const glm::dvec2& at) {
        return glm::ivec2(glm::clamp(at, glm::dvec2(0), size - 1.0)) / view_.tile;
    };
    const glm::ivec2 first = tileOf(lo), last = tileOf(hi);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (!plane_.isClosed(static_cast<std::size_t>(y * view_.tiles.x + x))) return true;
    return false;
}

}  // namespace render

#include "render/splat/seen_splat.h"

#include <algorithm>

namespace render {

SeenSplat seenSplat(const Scene& scene, const TileLayout& layout, const PointsView& seen,
                    std::uint32_t gridIndex, double factor) {
    SeenSplat out{};
    if (!scene.placed.inside(gridIndex, scene.clip)) return out;
    const auto s = splatAt<double>(seen, gridIndex, scene.footprint);
    if (!s.visible) return out;
    const double depth = layout.depthA / s.depth + layout.depthB;
    if (!(depth <= 1)) return out;  // beyond the far plane
    // An outline that reaches behind the eye has no bounds.
    constexpr double kFar = 1e9;
    const auto offset = [](const glm::dvec2& o) {
        return glm::vec2(glm::clamp(o, glm::dvec2(-kFar), glm::dvec2(kFar)));
    };
    out.window = glm::dvec2(layout.centre[0], layout.centre[1]) + s.centre;
    out.lo = offset(s.lo);
    out.hi = offset(s.hi);
    for (std::size_t i = 0; i < 3; ++i) {
        const int k = static_cast<int>(i);
        out.n[i] = static_cast<float>(s.n[k]);
        out.d[i] = static_cast<float>(s.d[k]);
    }
    out.l = {static_cast<float>(s.l.x), static_cast<float>(s.l.y)};
    out.weight = static_cast<float>(s.weight * factor);
    out.depth = static_cast<float>(depth);
    return out;
}

}  // namespace render

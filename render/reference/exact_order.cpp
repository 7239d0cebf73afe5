#include "render/reference/exact_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "render/splat/splat_source.h"

namespace render {

DrawList orderExactly(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    const auto gridIndex = columnsOf(scene).gridIndex;
    struct Splat {
        double away;
        std::uint32_t point;
        std::uint8_t layer;
    };
    std::vector<Splat> splats;
    SplatPoints some;
    for (SplatSource source(scene); !source.done();) {
        source.next(1 << 16, some);
        for (std::size_t i = 0; i < some.point.size(); ++i) {
            const std::uint32_t at = gridIndex[some.point[i]];
            const double away = glm::distance(scene.placed.position(at), midEye);
            if (scene.placed.inside(at, scene.clip) && std::isfinite(away))
                splats.push_back({away, some.point[i], some.layer[i]});
        }
    }
    std::ranges::stable_sort(splats, std::greater(), &Splat::away);
    Sorted list;
    for (const Splat& splat : splats) {
        list.point.push_back(splat.point);
        list.layer.push_back(splat.layer);
    }
    return list;
}

}  // namespace render

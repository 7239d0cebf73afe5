#include "render/points/mesh_bounds.h"

#include <bit>
#include <functional>
#include <limits>

namespace render {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Floats by their place in order: 0 is 0, and so on up to infinity and down to its opposite.
float floatAt(std::int32_t place) {
    return place < 0 ? -std::bit_cast<float>(-place) : std::bit_cast<float>(place);
}

// The place of the first float that is `past`, as all greater ones are, and infinity is.
std::int32_t firstPlace(const std::function<bool(double)>& past) {
    std::int32_t hi = std::bit_cast<std::int32_t>(kInfinity), lo = -hi;
    while (lo < hi) {
        const auto middle = static_cast<std::int32_t>(lo + (std::int64_t{hi} - lo) / 2);
        past(static_cast<double>(floatAt(middle))) ? hi = middle : lo = middle + 1;
    }
    return lo;
}

}  // namespace

MeshBounds boundsIn(const timeseries::Mesh& mesh, const IndexBox& box) {
    const auto stored = mesh.stored();
    MeshBounds bounds{glm::vec3(-kInfinity), glm::vec3(kInfinity), 0, ~std::uint32_t{0}};
    const bool columns = !stored.levels.empty();
    for (int a = 0; a < (columns ? 2 : 3); ++a) {
        // As Mesh::position() has it.
        const auto at = [&](double x) { return stored.origin[a] + stored.unit[a] * x; };
        const std::int32_t first = firstPlace([&](double x) { return at(x) >= box.from[a]; });
        const std::int32_t past =
            firstPlace([&](double x) { return at(x) > box.to[a] || x == kInfinity; });
        bounds.lo[a] = floatAt(first);
        bounds.hi[a] = floatAt(past - 1);
    }
    if (!columns) return bounds;
    bounds.firstLevel = 1, bounds.lastLevel = 0;
    bool any = false;
    for (std::uint32_t k = 0; k < stored.levels.size(); ++k) {  // monotonic: one stretch
        const double at = stored.origin.z + stored.levels[k].at;
        if (!(box.from.z <= at && at <= box.to.z)) continue;
        if (!any) bounds.firstLevel = k;
        bounds.lastLevel = k;
        any = true;
    }
    return bounds;
}

}  // namespace render

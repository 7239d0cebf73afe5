#include "timeseries/readers/cf/cf_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace timeseries {
namespace {

using Feet = std::vector<SolidCells::Foot>;
constexpr std::uint32_t kNone = 0xFFFFFFFF;

// Round the least of a ring's places.
void addFan(Feet& feet, std::span<const std::uint32_t> ring) {
    if (ring.empty()) return;
    const std::size_t n = ring.size(),
                      least = std::size_t(std::ranges::min_element(ring) - ring.begin());
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const std::uint32_t a = ring[least], b = ring[(least + i) % n],
                            c = ring[(least + i + 1) % n];
        if (a != b && b != c && c != a) feet.push_back({a, b, c});
    }
}

// A face at a node, and the nodes beside this round it.
struct Around {
    std::uint32_t face;
    std::array<std::uint32_t, 2> beside;
};

// The faces at a node put into rings and open chains of faces that share an edge, which no third
// one has.
class Rings {
 public:
    // use(faces of a ring or a chain).
    template <typename Use>
    void forEach(std::span<const Around> around, const Use& use) {
        edges_.clear();
        for (std::uint32_t i = 0; i < around.size(); ++i)
            for (const std::uint32_t node : around[i].beside) edges_.push_back({node, i});
        std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.node, a.place) < std::tie(b.node, b.place);
        });
        taken_.assign(around.size(), false);
        // Chains from their ends, then rings from anywhere.
        for (const bool closed : {false, true})
            for (std::uint32_t i = 0; i < around.size(); ++i) {
                const auto open = std::ranges::find_if(
                    around[i].beside, [&](std::uint32_t node) { return at(node).size() != 2; });
                if (taken_[i] || (!closed && open == around[i].beside.end())) continue;
                walk(around, i, closed ? around[i].beside[0] : *open);
                use(std::span<const std::uint32_t>(ring_));
            }
    }

 private:
    struct Edge {  // to a node, of a face at a place in the list
        std::uint32_t node, place;
    };
    std::span<const Edge> at(std::uint32_t node) const {
        const auto [first, last] =
            std::equal_range(edges_.begin(), edges_.end(), Edge{node, 0},
                             [](const Edge& a, const Edge& b) { return a.node < b.node; });
        return {edges_.data() + (first - edges_.begin()), std::size_t(last - first)};
    }
    // From a place on, away from that node beside.
    void walk(std::span<const Around> around, std::uint32_t place, std::uint32_t from) {
        ring_.clear();
        for (;;) {
            taken_[place] = true;
            ring_.push_back(around[place].face);
            const auto& beside = around[place].beside;
            from = beside[0] == from ? beside[1] : beside[0];
            const auto both = at(from);
            if (both.size() != 2) return;
            place = both[both[0].place == place ? 1 : 0].place;
            if (taken_[place]) return;
        }
    }

    std::vector<Edge> edges_;
    std::vector<bool> taken_;
    std::vector<std::uint32_t> ring_;
};

// Without corners that are the one before again, as triangles among squares are written.
std::vector<std::uint32_t> cornersOf(std::vector<std::uint32_t> face) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    while (face.size() > 1 && face.front() == face.back()) face.pop_back();
    return face;
}

}  // namespace

Feet trianglesOfNodes(const NodesOf& faces) {
    Feet feet;
    for (const auto& face : faces) addFan(feet, face);
    return feet;
}

Feet trianglesOfFaces(const NodesOf& faces, std::size_t nodes) {
    struct AtNode {
        std::uint32_t node;
        Around around;
    };
    std::vector<AtNode> all;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto face = cornersOf(faces[f]);
        const std::size_t n = face.size();
        for (std::size_t i = 0; n >= 3 && i < n; ++i)
            all.push_back({face[i], {f, {face[(i + n - 1) % n], face[(i + 1) % n]}}});
    }
    std::vector<std::size_t> ends(nodes + 1);
    for (const AtNode& each : all) ++ends[each.node + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Around> around(all.size());
    std::vector<std::size_t> free(ends.begin(), ends.end() - 1);
    for (const AtNode& each : all) around[free[each.node]++] = each.around;
    Feet feet;
    Rings rings;
    for (std::size_t node = 0; node < nodes; ++node)
        rings.forEach(std::span(around).subspan(ends[node], ends[node + 1] - ends[node]),
                      [&](std::span<const std::uint32_t> ring) { addFan(feet, ring); });
    return feet;
}

// Corners by latitude, then longitude, of which those that lie nearer to each other than floats
// tell, or on two sides of where longitudes begin anew, are one node.
std::size_t nodesAtCorners(const PlaneCoordinates& corners, std::size_t each, NodesOf& polygons) {
    constexpr double kNear = 4e-5;  // degrees
    const std::size_t count = each > 0 ? corners.x.size() / each : 0;
    struct Corner {
        double x, y;
        std::size_t at;
    };
    std::vector<Corner> all;
    for (std::size_t i = 0; i < count * each; ++i) {
        Corner corner{corners.x[i], corners.y[i], i};
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) continue;
        if (corners.turn > 0) {
            corner.x = std::fmod(corner.x, corners.turn);
            if (corner.x < 0) corner.x += corners.turn;
            if (isPole(corner.y, corners.turn)) corner = {0, std::copysign(90, corner.y), i};
        }
        all.push_back(corner);
    }
    std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) {
        return std::tie(a.y, a.x, a.at) < std::tie(b.y, b.x, b.at);
    });
    const double near = corners.turn > 0 ? kNear : 0;
    std::vector<std::uint32_t> nodeOf(count * each, kNone);
    std::uint32_t nodes = 0;
    for (std::size_t i = 0, first = 0; i < all.size(); ++i) {
        const bool isFirst = i == 0 || all[i].y != all[i - 1].y;  // there
        if (isFirst) first = i;
        const bool isAsBefore = !isFirst && all[i].x - all[i - 1].x <= near;
        const bool isAsFirst =
            !isFirst && near > 0 && all[first].x + corners.turn - all[i].x <= near;
        nodeOf[all[i].at] = isAsFirst    ? nodeOf[all[first].at]
                            : isAsBefore ? nodeOf[all[i - 1].at]
                                         : nodes++;
    }
    polygons.assign(count, {});
    for (std::size_t i = 0; i < count * each; ++i)
        if (nodeOf[i] != kNone) polygons[i / each].push_back(nodeOf[i]);
    for (auto& polygon : polygons) polygon = cornersOf(std::move(polygon));
    return nodes;
}

}  // namespace timeseries

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

// The faces at a node put into rings and open chains of faces that share an edge.
class Rings {
 public:
    // use(faces of a ring or a chain).
    template <typename Use>
    void forEach(std::span<const Around> around, const Use& use) {
        edges_.clear();
        for (std::uint32_t i = 0; i < around.size(); ++i)
            for (const std::uint32_t node : around[i].beside) edges_.emplace_back(node, i);
        std::ranges::sort(edges_);
        taken_.assign(around.size(), false);
        // Chains from their ends, then rings from anywhere.
        for (const bool closed : {false, true})
            for (std::uint32_t i = 0; i < around.size(); ++i) {
                if (taken_[i]) continue;
                const auto open = std::ranges::find_if(
                    around[i].beside, [&](std::uint32_t node) { return at(node).size() == 1; });
                if (!closed && open == around[i].beside.end()) continue;
                const std::uint32_t last = closed ? around[i].beside[0] : *open;
                walk(around, i, last);
                use(std::span<const std::uint32_t>(ring_));
            }
    }

 private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;  // a node, and a face at it
    std::span<const Edge> at(std::uint32_t node) const {
        const auto [first, last] = std::ranges::equal_range(edges_, node, {}, &Edge::first);
        return {first, last};
    }
    // From a face on, away from that node beside.
    void walk(std::span<const Around> around, std::uint32_t face, std::uint32_t from) {
        ring_.clear();
        for (bool goesOn = true; goesOn;) {
            taken_[face] = true;
            ring_.push_back(around[face].face);
            const auto& beside = around[face].beside;
            from = beside[0] == from ? beside[1] : beside[0];
            goesOn = false;
            for (const auto& [node, next] : at(from))
                if (!taken_[next] && !goesOn) {
                    face = next;
                    goesOn = true;
                }
        }
    }

    std::vector<Edge> edges_;
    std::vector<bool> taken_;
    std::vector<std::uint32_t> ring_;
};

}  // namespace

Feet trianglesOfNodes(const NodesOf& faces) {
    Feet feet;
    for (const auto& face : faces) addFan(feet, face);
    return feet;
}

Feet trianglesOfFaces(const NodesOf& faces, std::size_t nodes) {
    std::vector<std::size_t> ends(nodes + 1);
    for (const auto& face : faces)
        for (const std::uint32_t node : face) ++ends[node + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Around> around(ends.back());
    std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto& face = faces[f];
        for (std::size_t i = 0, n = face.size(); i < n; ++i)
            around[next[face[i]]++] = {f, {face[(i + n - 1) % n], face[(i + 1) % n]}};
    }
    Feet feet;
    Rings rings;
    for (std::size_t node = 0; node < nodes; ++node)
        rings.forEach(std::span(around).subspan(ends[node], ends[node + 1] - ends[node]),
                      [&](std::span<const std::uint32_t> ring) { addFan(feet, ring); });
    return feet;
}

std::size_t nodesAtCorners(const PlaneCoordinates& corners, std::size_t each, NodesOf& polygons) {
    constexpr double kPerDegree = 1e9;  // nearer to each other they are one place
    constexpr double kPole = 90 - 1e-6;
    const std::size_t count = each > 0 ? corners.x.size() / each : 0;
    struct Corner {
        double x, y;
        std::size_t at;
    };
    std::vector<Corner> all;
    for (std::size_t i = 0; i < count * each; ++i) {
        double x = corners.x[i], y = corners.y[i];
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        if (corners.turn > 0) {
            const double steps = corners.turn * kPerDegree;
            const double turned = std::fmod(std::round(x * kPerDegree), steps);
            x = std::abs(y) > kPole ? 0 : turned < 0 ? turned + steps : turned;
            y = std::round(y * kPerDegree);
        }
        all.push_back({x, y, i});
    }
    const auto place = [](const Corner& corner) { return std::tie(corner.x, corner.y); };
    std::ranges::sort(all, [&](const Corner& a, const Corner& b) {
        return std::tuple(place(a), a.at) < std::tuple(place(b), b.at);
    });
    std::vector<std::uint32_t> nodeOf(count * each);
    std::vector<bool> isThere(count * each);
    std::size_t nodes = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || place(all[i]) != place(all[i - 1])) ++nodes;
        nodeOf[all[i].at] = static_cast<std::uint32_t>(nodes - 1);
        isThere[all[i].at] = true;
    }
    polygons.assign(count, {});
    for (std::size_t i = 0; i < count * each; ++i) {
        auto& polygon = polygons[i / each];
        if (isThere[i] && (polygon.empty() || polygon.back() != nodeOf[i]))
            polygon.push_back(nodeOf[i]);
    }
    for (auto& polygon : polygons)
        if (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    return nodes;
}

}  // namespace timeseries

// A cubed sphere: six panels of n x n faces, whose sides are great circles as far apart in angle
// (Ronchi, Iacono, Paolucci, 1996).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace tests {

// Longitude and latitude in degrees.
inline glm::dvec2 lonLatOf(const glm::dvec3& at) {
    return 180 / std::numbers::pi * glm::dvec2(std::atan2(at.y, at.x), std::asin(at.z));
}

struct CubedSphere {
    explicit CubedSphere(int n);
    std::vector<glm::dvec3> nodes, middles;          // of unit length; [face]
    std::vector<std::array<std::int32_t, 4>> faces;  // nodes around it
    std::vector<std::array<std::int32_t, 2>> edges;  // the lesser node first

 private:
    std::int32_t nodeAt(const glm::dvec3& at) {
        const auto key =
            std::tuple(std::lround(1e6 * at.x), std::lround(1e6 * at.y), std::lround(1e6 * at.z));
        const auto [found, isNew] = numbers_.emplace(key, static_cast<std::int32_t>(nodes.size()));
        if (isNew) nodes.push_back(at);
        return found->second;
    }
    std::map<std::tuple<long, long, long>, std::int32_t> numbers_;
};

inline CubedSphere::CubedSphere(int n) {
    const auto at = [&](int panel, double i, double j) {
        const double step = std::numbers::pi / 2 / n;
        const double x = std::tan(i * step - std::numbers::pi / 4),
                     y = std::tan(j * step - std::numbers::pi / 4);
        const std::array<glm::dvec3, 6> panels{glm::dvec3(1, x, y),   glm::dvec3(-x, 1, y),
                                               glm::dvec3(-1, -x, y), glm::dvec3(x, -1, y),
                                               glm::dvec3(-y, x, 1),  glm::dvec3(y, x, -1)};
        return glm::normalize(panels[std::size_t(panel)]);
    };
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    for (int panel = 0; panel < 6; ++panel)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                middles.push_back(at(panel, i + 0.5, j + 0.5));
                faces.push_back({nodeAt(at(panel, i, j)), nodeAt(at(panel, i + 1, j)),
                                 nodeAt(at(panel, i + 1, j + 1)), nodeAt(at(panel, i, j + 1))});
                for (std::size_t k = 0; k < 4; ++k) {
                    const auto ends = std::minmax(faces.back()[k], faces.back()[(k + 1) % 4]);
                    sides[{ends.first, ends.second}];
                }
            }
    for (const auto& [ends, unused] : sides) edges.push_back({ends.first, ends.second});
}

}  // namespace tests

// The cells that a ray passes, in axis coordinates (Amanatides and Woo 1987, "A Fast Voxel
// Traversal Algorithm for Ray Tracing", with faces at any distances from each other).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <type_traits>
#include <vector>

#include "render/points/placed_points.h"

namespace render {

// Cells as CellIndex numbers them: between points, and half ones beyond the outermost.
class CellWalk {
 public:
    explicit CellWalk(const PlacedPoints& placed);
    // Of its cells those alone that are [first, end) along the last axis.
    CellWalk(const PlacedPoints& placed, std::size_t first, std::size_t end);

    glm::uvec3 size() const { return size_; }  // cells along the axes, all of them
    // A place counted from the cell's first corner, in units of its sides: [0, 1] inside.
    glm::dvec3 inCell(const glm::uvec3& cell, const glm::dvec3& place) const {
        glm::dvec3 out(0);
        for (int a = 0; a < 3; ++a) {
            const double first = face(a, cell[a]);
            out[a] = std::clamp((place[a] - first) / (face(a, cell[a] + 1) - first), 0.0, 1.0);
        }
        return out;
    }
    // Cells [first, end) along each axis.
    struct Box {
        glm::uvec3 first{0}, end{0};
    };
    // The same space in bricks of so many cells along each axis, the last ones with fewer.
    // REQUIRES: all cells are walked through.
    CellWalk inBricks(unsigned cells) const;

    // visit(cell, from, to) for every cell that eye + t along passes at t >= near, the nearest
    // first; from < to. Where it returns something, as long as that is true. False: it was not.
    template <typename Visit>
    bool operator()(const glm::dvec3& eye, const glm::dvec3& along, double near,
                    const Visit& visit) const {
        return within(box_, eye, along, near, visit);
    }
    // Of those in a box of them.
    template <typename Visit>
    bool within(const Box& box, const glm::dvec3& eye, const glm::dvec3& along, double near,
                const Visit& visit) const;

 private:
    CellWalk() = default;
    static constexpr double kNever = std::numeric_limits<double>::infinity();

    double face(int axis, std::size_t i) const { return faces_[static_cast<std::size_t>(axis)][i]; }
    std::size_t cellAt(int axis, double place, const Box& box) const;

    // Per axis, in the order of indices, ascending or descending: one more than cells.
    std::array<std::vector<double>, 3> faces_;
    glm::uvec3 size_{0};
    Box box_;  // what is walked through
};

template <typename Visit>
bool CellWalk::within(const Box& box, const glm::dvec3& eye, const glm::dvec3& along, double near,
                      const Visit& visit) const {
    double at = near, end = kNever;
    for (int a = 0; a < 3; ++a) {
        const double one = face(a, box.first[a]), other = face(a, box.end[a]);
        if (along[a] == 0) {
            if (!(eye[a] > std::min(one, other) && eye[a] < std::max(one, other))) return true;
            continue;
        }
        const double t = (one - eye[a]) / along[a], u = (other - eye[a]) / along[a];
        at = std::max(at, std::min(t, u));
        end = std::min(end, std::max(t, u));
    }
    if (!(at < end)) return true;
    glm::uvec3 cell{0};
    std::array<bool, 3> up{};
    glm::dvec3 leaves(kNever);
    const auto leave = [&](int a) {
        return (face(a, up[static_cast<std::size_t>(a)] ? cell[a] + 1 : cell[a]) - eye[a]) /
               along[a];
    };
    const auto isLast = [&](int a) {
        return cell[a] == (up[static_cast<std::size_t>(a)] ? box.end[a] - 1 : box.first[a]);
    };
    for (int a = 0; a < 3; ++a) {
        cell[a] = static_cast<unsigned>(cellAt(a, eye[a] + at * along[a], box));
        if (along[a] == 0) continue;
        up[static_cast<std::size_t>(a)] = (along[a] > 0) == (face(a, size_[a]) > face(a, 0));
        for (leaves[a] = leave(a); leaves[a] <= at && !isLast(a); leaves[a] = leave(a))
            cell[a] += up[static_cast<std::size_t>(a)] ? 1u : -1u;  // rounding put it one behind
    }
    while (true) {
        const int a =
            leaves.x < leaves.y ? (leaves.x < leaves.z ? 0 : 2) : (leaves.y < leaves.z ? 1 : 2);
        const double to = std::min(leaves[a], end);
        if (to > at) {
            if constexpr (std::is_void_v<decltype(visit(cell, at, to))>)
                visit(cell, at, to);
            else if (!visit(cell, at, to))
                return false;
        }
        if (!(leaves[a] < end) || isLast(a)) return true;
        at = std::max(at, to);
        cell[a] += up[static_cast<std::size_t>(a)] ? 1u : -1u;
        leaves[a] = leave(a);
    }
}

}  // namespace render

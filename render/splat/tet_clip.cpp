#include "render/splat/tet_clip.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "render/model/tet_splat.h"

namespace render {
namespace {

struct Corner {
    glm::dvec3 at;
    double value;
    unsigned corner;
    glm::dvec3 gradient;
};

Corner cornerOf(const Tetrahedron& tet, std::size_t i) {
    return {tet.at[i], tet.values[i], tet.corners[i], tet.gradients[i]};
}

// One half of space: where side * (place[axis] - bound) >= 0.
struct Half {
    int axis;
    double side, bound;
    double within(const glm::dvec3& place) const { return side * (place[axis] - bound); }

    // Where an edge from inside to outside leaves it: the same for all who share the edge.
    Corner leaves(const Corner& inside, const Corner& outside) const {
        const double in = within(inside.at), share = in / (in - within(outside.at));
        Corner c{glm::mix(inside.at, outside.at, share),
                 inside.value + share * (outside.value - inside.value), inside.corner,
                 glm::mix(inside.gradient, outside.gradient, share)};
        c.at[axis] = bound;
        return c;
    }
};

// Adds one that is turned as another.
void add(std::array<Corner, 4> corners, double turn, std::vector<Tetrahedron>& into) {
    if (turnOf({corners[0].at, corners[1].at, corners[2].at, corners[3].at}) * turn < 0)
        std::swap(corners[2], corners[3]);
    Tetrahedron& tet = into.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
        tet.at[i] = corners[i].at;
        tet.values[i] = corners[i].value;
        tet.corners[i] = corners[i].corner;
        tet.gradients[i] = corners[i].gradient;
    }
}

// Between two triangles, whose corners face each other: three parts, of which the second shares a
// face with each of the others.
void addWedge(const std::array<Corner, 3>& p, const std::array<Corner, 3>& q, double turn,
              const glm::dvec3* eye, std::vector<Tetrahedron>& into) {
    const std::array<std::array<Corner, 4>, 3> parts{std::array{p[0], p[1], p[2], q[0]},
                                                     std::array{p[1], p[2], q[0], q[1]},
                                                     std::array{p[2], q[0], q[1], q[2]}};
    // Whether the eye is on this side of the others' face.
    const auto isBeside = [&](const Corner& on, const Corner& a, const Corner& b, const Corner& c) {
        const double side = turnOf({on.at, a.at, b.at, c.at});
        return eye == nullptr || turnOf({*eye, a.at, b.at, c.at}) * side > 0;
    };
    const bool firstIsInFront = isBeside(p[0], p[1], p[2], q[0]);
    const bool lastIsBehind = isBeside(p[1], p[2], q[0], q[1]);
    if (firstIsInFront) add(parts[0], turn, into);
    if (lastIsBehind) {
        add(parts[1], turn, into);
        if (!firstIsInFront) add(parts[0], turn, into);
        return add(parts[2], turn, into);
    }
    add(parts[2], turn, into);
    add(parts[1], turn, into);
    if (!firstIsInFront) add(parts[0], turn, into);
}

void cutBy(const Half& half, const Tetrahedron& tet, double turn, const glm::dvec3* eye,
           std::vector<Tetrahedron>& into) {
    std::array<Corner, 4> in, out;
    std::size_t ins = 0, outs = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Corner corner = cornerOf(tet, i);
        (half.within(corner.at) >= 0 ? in[ins++] : out[outs++]) = corner;
    }
    const auto leaves = [&](std::size_t i, std::size_t o) { return half.leaves(in[i], out[o]); };
    if (ins == 4) into.push_back(tet);
    if (ins == 3)
        addWedge({in[0], in[1], in[2]}, {leaves(0, 0), leaves(1, 0), leaves(2, 0)}, turn, eye,
                 into);
    if (ins == 2)
        addWedge({in[0], leaves(0, 0), leaves(0, 1)}, {in[1], leaves(1, 0), leaves(1, 1)}, turn,
                 eye, into);
    if (ins == 1) add({in[0], leaves(0, 0), leaves(0, 1), leaves(0, 2)}, turn, into);
}

}  // namespace

TetClip::TetClip(const PlacedPoints& placed, const IndexBox& clip)
    : cuts_(placed.isMesh() && !placed.globe() && !clip.holdsAll()) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (!cuts_) return;
    const glm::dvec3 from = placed.axesFromGrid(clip.from), to = placed.axesFromGrid(clip.to);
    const PlacedPoints::Box all = placed.pointsBox();
    for (int a = 0; a < 3; ++a) {
        lo_[a] = std::min(from[a], to[a]);
        hi_[a] = std::max(from[a], to[a]);
        cuts_ = cuts_ && lo_[a] < hi_[a];
        const bool holdsFirst = lo_[a] <= all.lo[a], holdsLast = hi_[a] >= all.hi[a];
        // The cell across where coordinates begin anew lies beyond both.
        if (placed.period()[a] > 0 && !(holdsFirst && holdsLast)) continue;
        if (holdsFirst) lo_[a] = -kInfinity;
        if (holdsLast) hi_[a] = kInfinity;
    }
}

TetClip::Lies TetClip::where(const Tetrahedron& tet) const {
    glm::dvec3 least = tet.at[0], most = tet.at[0];
    for (const glm::dvec3& at : tet.at) {
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    Lies lies = Lies::Inside;
    for (int a = 0; a < 3; ++a) {
        if (most[a] < lo_[a] || least[a] > hi_[a]) return Lies::Outside;
        if (least[a] < lo_[a] || most[a] > hi_[a]) lies = Lies::Across;
    }
    return lies;
}

const std::vector<Tetrahedron>& TetClip::cut(const Tetrahedron& tet, const glm::dvec3* eye) const {
    thread_local std::vector<Tetrahedron> parts, left;
    const double turn = turnOf(tet.at);
    parts.assign(1, tet);
    for (int a = 0; a < 3; ++a)
        for (const Half& half : {Half{a, 1, lo_[a]}, Half{a, -1, hi_[a]}}) {
            left.clear();
            for (const Tetrahedron& part : parts) cutBy(half, part, turn, eye, left);
            parts.swap(left);
        }
    return parts;
}

}  // namespace render

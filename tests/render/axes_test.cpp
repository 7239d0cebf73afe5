#include "render/annotate/axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/drawn_axes.h"

namespace render {
namespace {

using namespace drawn_axes;

struct Segment {
    glm::dvec3 a, b;
};
// Edges first: the ticks are the last lines of `before`.
std::vector<Segment> segments(const AxesMeshes& meshes) {
    std::vector<Segment> found;
    for (const FlatMesh* lines : {&meshes.behind, &meshes.before}) {
        const auto& v = lines->triangles();
        for (std::size_t i = 0; i < v.size(); i += 6)  // a, b, b' | a, b', a' around the line
            found.push_back({0.5 * (glm::dvec3(v[i].at) + glm::dvec3(v[i + 5].at)),
                             0.5 * (glm::dvec3(v[i + 1].at) + glm::dvec3(v[i + 2].at))});
    }
    return found;
}

void expectEdgesBetweenCorners(const Grid& grid) {
    for (const glm::dvec3& eye : {eyeAt(-60, 25, 3), eyeAt(130, -50, 2.5), eyeAt(5, 5, 4)}) {
        const Drawn d(grid, eye, {640, 480});
        const auto drawn = segments(d.meshes);
        ASSERT_GE(drawn.size(), 12u);
        for (int axis = 0; axis < 3; ++axis) {
            for (int sides = 0; sides < 4; ++sides) {
                glm::dvec3 from(-1), to(1);
                from[(axis + 1) % 3] = to[(axis + 1) % 3] = sides & 1 ? 1 : -1;
                from[(axis + 2) % 3] = to[(axis + 2) % 3] = sides & 2 ? 1 : -1;
                const glm::dmat3 half = d.placed.boxHalfEdges();
                const glm::dvec3 a = seen(d.view, half * from), b = seen(d.view, half * to);
                const auto is = [&](const Segment& s) {
                    const auto near = [](const glm::dvec3& p, const glm::dvec3& q) {
                        return glm::distance(glm::dvec2(p), glm::dvec2(q)) < 0.01 &&
                               std::abs(p.z - q.z) < 1e-5;
                    };
                    return (near(s.a, a) && near(s.b, b)) || (near(s.a, b) && near(s.b, a));
                };
                EXPECT_EQ(std::count_if(drawn.begin(), drawn.begin() + 12, is), 1)
                    << "axis " << axis << " sides " << sides;
            }
        }
    }
}

TEST(Axes, EdgesEndAtTheProjectedCornersAtTheirDepth) {
    expectEdgesBetweenCorners(ocean());
    expectEdgesBetweenCorners(sheared());
}

TEST(Axes, OfATurnedGridAreTheUprightOnesSeenByATurnedCamera) {
    const glm::dmat3 turn = tests::rotation(0.8);
    const Grid turned(ocean().axes(), {turn, {1, 2, 3}});
    for (const glm::dvec3& eye : {eyeAt(-60, 25, 3), eyeAt(130, -50, 2.5)}) {
        const Drawn upright(ocean(), eye, {640, 480});
        View view = upright.view;
        view.viewFromWorld *= glm::dmat4(glm::transpose(turn));
        const AxesMeshes meshes =
            axesMeshes(turned, PlacedPoints(turned), view, {turn * eye}, upright.font);
        const auto same = [](const FlatMesh& a, const FlatMesh& b) {
            ASSERT_EQ(a.triangles().size(), b.triangles().size());
            for (std::size_t i = 0; i < a.triangles().size(); ++i)
                EXPECT_LT(glm::distance(a.triangles()[i].at, b.triangles()[i].at), 1e-3) << i;
        };
        same(meshes.behind, upright.meshes.behind);
        same(meshes.before, upright.meshes.before);
        same(meshes.labels, upright.meshes.labels);
    }
}

TEST(Axes, OnlyEdgesBehindTheWholeBoxAreDrawnBeforeTheVolume) {
    // From a corner's direction three edges meet at the farthest corner: those, no other.
    const Drawn d(fire(), eyeAt(-60, 25, 3), {640, 480});
    double deepest = 0;
    for (const Segment& s : segments(d.meshes)) deepest = std::max({deepest, s.a.z, s.b.z});
    AxesMeshes onlyBehind;
    onlyBehind.behind = d.meshes.behind;
    const auto behind = segments(onlyBehind);
    EXPECT_EQ(behind.size(), 3u);
    for (const Segment& s : behind) EXPECT_NEAR(std::max(s.a.z, s.b.z), deepest, 1e-6);
    // Inside, everything is behind what the box holds between the eye and its walls.
    const Drawn inside(fire(), {0.1, -0.2, 0.05}, {400, 300});
    EXPECT_FALSE(inside.meshes.behind.triangles().empty());
    EXPECT_TRUE(inside.meshes.before.triangles().empty());
}

TEST(Axes, EdgesEndAtTheNearPlaneWhenTheEyeIsInside) {
    const Drawn d(fire(), {0.1, -0.2, 0.05}, {400, 300});
    const auto drawn = segments(d.meshes);
    EXPECT_FALSE(drawn.empty());
    for (const Segment& s : drawn)
        for (const glm::dvec3& p : {s.a, s.b}) {
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
            EXPECT_GE(p.z, -1e-6);
            EXPECT_LE(p.z, 1);
        }
}

TEST(Axes, AFlatBoxHasFourEdgesAndALineOne) {
    const auto edgeCount = [](const Grid& grid) {
        const Drawn d(grid, eyeAt(-60, 25, 3), {640, 480});
        std::size_t count = 0;
        for (const Segment& s : segments(d.meshes))
            if (glm::distance(s.a, s.b) > 0.5 * 13) ++count;  // ticks are shorter
        return count;
    };
    EXPECT_EQ(edgeCount(fire()), 12u);
    EXPECT_EQ(edgeCount(Grid({tests::measuredAxis("x", "index", 0, 255, 256),
                              tests::measuredAxis("y", "index", 30, 0, 31),
                              tests::measuredAxis("z", "index", 0, 0, 1)})),
              4u);
    EXPECT_EQ(edgeCount(worlds()[5]), 1u);
    EXPECT_EQ(edgeCount(worlds()[6]), 0u);
}

}  // namespace
}  // namespace render

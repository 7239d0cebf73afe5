// Triangles between the nodes and between the faces of a mesh: once over what is between them.
#include "timeseries/readers/cf/cf_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <numeric>
#include <random>
#include <vector>

namespace timeseries {
namespace cf_triangles {
namespace {

constexpr int kSide = 6;  // squares along each way
using Feet = std::vector<SolidCells::Foot>;

std::uint32_t nodeAt(int i, int j) { return static_cast<std::uint32_t>(i + (kSide + 1) * j); }

// Squares of a lattice, every other one of them two triangles, that begin at any corner and turn
// either way; without the one square at `hole`.
struct Lattice {
    std::vector<glm::dvec2> nodes;
    NodesOf faces;
    std::vector<glm::dvec2> middles;  // of the faces

    explicit Lattice(std::mt19937& random, bool bent, glm::ivec2 hole = {-1, -1}) {
        std::uniform_real_distribution<double> off(bent ? -0.2 : 0, bent ? 0.2 : 1e-300);
        for (int j = 0; j <= kSide; ++j)
            for (int i = 0; i <= kSide; ++i) nodes.emplace_back(i + off(random), j + off(random));
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                if (hole == glm::ivec2(i, j)) continue;
                const std::uint32_t a = nodeAt(i, j), b = nodeAt(i + 1, j),
                                    c = nodeAt(i + 1, j + 1), d = nodeAt(i, j + 1);
                if (bent && (i + j) % 2 == 0) {
                    add({a, b, c}, random);
                    add({a, c, d}, random);
                } else {
                    add({a, b, c, d}, random);
                }
            }
        std::vector<std::uint32_t> to(nodes.size());
        std::iota(to.begin(), to.end(), 0u);
        std::ranges::shuffle(to, random);
        std::vector<glm::dvec2> moved(nodes.size());
        for (std::size_t n = 0; n < to.size(); ++n) moved[to[n]] = nodes[n];
        nodes = moved;
        for (auto& face : faces)
            for (std::uint32_t& node : face) node = to[node];
        std::ranges::shuffle(faces, random);
        for (const auto& face : faces) {
            glm::dvec2 sum(0);
            for (const std::uint32_t node : face) sum += nodes[node];
            middles.push_back(sum / double(face.size()));
        }
    }

 private:
    void add(std::vector<std::uint32_t> face, std::mt19937& random) {
        std::rotate(face.begin(), face.begin() + int(random() % face.size()), face.end());
        if (random() % 2 == 0) std::reverse(face.begin(), face.end());
        faces.push_back(std::move(face));
    }
};

// How many of the triangles a place is in.
int timesIn(const Feet& feet, const std::vector<glm::dvec2>& at, const glm::dvec2& place) {
    int times = 0;
    for (const SolidCells::Foot& foot : feet) {
        const auto side = [&](std::size_t i) {
            const glm::dvec2 from = at[foot[i]], to = at[foot[(i + 1) % 3]] - from,
                             way = place - from;
            return to.x * way.y - to.y * way.x > 0;
        };
        times += side(0) == side(1) && side(1) == side(2) ? 1 : 0;
    }
    return times;
}

template <typename Use>
void atPlaces(std::mt19937& random, const Use& use) {
    std::uniform_real_distribution<double> any(0, kSide);
    for (int n = 0; n < 3000; ++n) use(glm::dvec2(any(random), any(random)));
}

bool leastIsFirst(const Feet& feet) {
    return std::ranges::all_of(
        feet, [](const auto& foot) { return foot[0] < foot[1] && foot[0] < foot[2]; });
}

TEST(CfTriangles, BetweenNodesAreTheFaces) {
    std::mt19937 random(1);
    for (int turn = 0; turn < 5; ++turn) {
        const Lattice lattice(random, true);
        const Feet feet = trianglesOfNodes(lattice.faces);
        EXPECT_EQ(feet.size(), 2u * kSide * kSide);
        EXPECT_TRUE(leastIsFirst(feet));
        atPlaces(random, [&](const glm::dvec2& place) {
            const bool isWithin =
                std::min(place.x, place.y) > 0.2 && std::max(place.x, place.y) < kSide - 0.2;
            if (isWithin) {
                EXPECT_EQ(timesIn(feet, lattice.nodes, place), 1);
            }
        });
    }
}

// Squares' middles are half a square from the lattice's sides; triangles' are nearer.
TEST(CfTriangles, BetweenFacesCoverWhatIsBetweenTheirMiddlesOnce) {
    std::mt19937 random(2);
    for (int turn = 0; turn < 5; ++turn)
        for (const bool bent : {false, true}) {
            const Lattice lattice(random, bent);
            const Feet feet = trianglesOfFaces(lattice.faces, lattice.nodes.size());
            EXPECT_TRUE(leastIsFirst(feet));
            if (!bent) {
                EXPECT_EQ(feet.size(), 2u * (kSide - 1) * (kSide - 1));
            }
            atPlaces(random, [&](const glm::dvec2& place) {
                const double aside =
                    std::min(std::min(place.x, place.y), kSide - std::max(place.x, place.y));
                const int times = timesIn(feet, lattice.middles, place);
                if (aside > (bent ? 0.8 : 0.5)) {
                    EXPECT_EQ(times, 1) << place.x << ' ' << place.y;
                }
                EXPECT_LE(times, 1);
            });
        }
}

// About a node at a hole's corner the three squares' middles are a triangle that ends there.
TEST(CfTriangles, BetweenFacesNothingCoversAHole) {
    std::mt19937 random(3);
    const glm::ivec2 hole(2, 3);
    const Lattice lattice(random, false, hole);
    const Feet feet = trianglesOfFaces(lattice.faces, lattice.nodes.size());
    atPlaces(random, [&](const glm::dvec2& place) {
        const glm::dvec2 in = place - glm::dvec2(hole);
        const int times = timesIn(feet, lattice.middles, place);
        if (in.x > 0 && in.x < 1 && in.y > 0 && in.y < 1) {
            EXPECT_EQ(times, 0);
        }
        EXPECT_LE(times, 1);
        const double aside =
            std::min(std::min(place.x, place.y), kSide - std::max(place.x, place.y));
        const double fromHole = std::max(std::abs(in.x - 0.5), std::abs(in.y - 0.5));
        if (aside > 0.5 && fromHole > 1) {
            EXPECT_EQ(times, 1);
        }
    });
}

// Boxes all about a sphere, whose corners are written anew for each, with longitudes about its own:
// each node within has four of them, and each pole all that there are in a row.
TEST(CfTriangles, CornersAtOnePlaceAreOneNode) {
    constexpr int kRound = 8, kUp = 5;
    for (const double around : {-180.0, 0.0, 180.0}) {
        PlaneCoordinates corners{{}, {}, 360};
        for (int j = 0; j < kUp; ++j)
            for (int i = 0; i < kRound; ++i)
                for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                    const double x = 45.0 * (i + di) + 0.3;
                    corners.x.push_back(x - 360 * std::round((x - around) / 360));
                    corners.y.push_back(-90 + 36.0 * (j + dj));
                }
        NodesOf faces;
        const std::size_t nodes = nodesAtCorners(corners, 4, faces);
        EXPECT_EQ(nodes, std::size_t(kRound * (kUp - 1) + 2));
        ASSERT_EQ(faces.size(), std::size_t(kRound * kUp));
        EXPECT_EQ(faces.front().size(), 3u);  // two of its corners are the pole
        EXPECT_EQ(trianglesOfFaces(faces, nodes).size(),
                  std::size_t(2 * kRound * (kUp - 1) + 2 * (kRound - 2)));
    }
    // Elsewhere than on a sphere nothing comes round.
    NodesOf faces;
    EXPECT_EQ(nodesAtCorners({{0, 1, 1, 360, 361, 361}, {90, 90, 91, 90, 90, 91}, 0}, 3, faces),
              6u);
}

// As floats have them, whose longitudes differ where they begin anew.
TEST(CfTriangles, CornersThatFloatsTellApartAreOneNode) {
    PlaneCoordinates corners{{}, {}, 360};
    for (int i = 0; i < 6; ++i)
        for (const auto& [di, y] : {std::pair(0, 10.f), {1, 10.f}, {1, 20.1f}, {0, 20.1f}}) {
            const double x = 60 * (i + di) + 0.02 - 180;
            corners.x.push_back(float(i == 5 ? x - 360 : x));
            corners.y.push_back(y);
        }
    NodesOf faces;
    EXPECT_EQ(nodesAtCorners(corners, 4, faces), 12u);
    for (double& x : corners.x) x = x > 0 ? x - 0.02 : x - 0.02 + 360 - 1e-5;  // about 0 and 360
    for (const std::size_t left : {12u, 15u}) corners.x[left] = 360 - 1e-5;  // of the one from 0 on
    EXPECT_EQ(nodesAtCorners(corners, 4, faces), 12u);
    corners.x[0] = 1e300;  // wherever that is
    EXPECT_LE(nodesAtCorners(corners, 4, faces), 13u);
}

// Triangles among squares may have a corner twice.
TEST(CfTriangles, CornersThatAreThereTwiceAreOne) {
    std::mt19937 random(5);
    Lattice lattice(random, true);
    const Feet byNodes = trianglesOfNodes(lattice.faces),
               byFaces = trianglesOfFaces(lattice.faces, lattice.nodes.size());
    for (auto& face : lattice.faces)
        if (face.size() == 3) face.push_back(random() % 2 == 0 ? face.back() : face.front());
    EXPECT_EQ(trianglesOfNodes(lattice.faces), byNodes);
    EXPECT_EQ(trianglesOfFaces(lattice.faces, lattice.nodes.size()), byFaces);
}

// Faces that are all alike have no edge that two of them share; a square of their number would
// take hours.
TEST(CfTriangles, AnyNumberOfEqualFacesIsSoonDone) {
    EXPECT_TRUE(trianglesOfFaces(NodesOf(300'000, {0, 1, 2}), 3).empty());
    NodesOf polygons;
    const std::vector<double> zero(1'200'000);
    const std::size_t nodes = nodesAtCorners({zero, zero, 360}, 4, polygons);
    EXPECT_EQ(nodes, 1u);
    EXPECT_TRUE(trianglesOfFaces(polygons, nodes).empty());
}

TEST(CfTriangles, OfWhatIsNoMeshThereAreNone) {
    EXPECT_TRUE(trianglesOfNodes({}).empty());
    EXPECT_TRUE(trianglesOfNodes({{}, {0}, {0, 1}, {2, 2, 2, 2}}).empty());
    EXPECT_TRUE(trianglesOfFaces({}, 0).empty());
    // Again and again the same face, or the same node of it.
    EXPECT_TRUE(trianglesOfFaces({{0}, {1, 1, 1}, {0, 1}, {2, 2}}, 3).empty());
    for (const SolidCells::Foot& foot : trianglesOfFaces({{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}, 3))
        EXPECT_TRUE(foot[0] != foot[1] && foot[1] != foot[2] && foot[2] != foot[0]);
}

}  // namespace
}  // namespace cf_triangles
}  // namespace timeseries

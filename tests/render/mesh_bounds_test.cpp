// Which of a mesh's points a box holds, told in the mesh's own floats, against its places in
// double.
#include "render/points/mesh_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::gridOf;
using tests::placesOf;

bool isWithin(const MeshBounds& bounds, const timeseries::Mesh& mesh, std::uint64_t index) {
    const auto stored = mesh.stored();
    const glm::vec3 at = stored.points[index % stored.points.size()].at();
    const auto level = static_cast<std::uint32_t>(index / stored.points.size());
    for (int a = 0; a < 3; ++a)
        if (!(bounds.lo[a] <= at[a] && at[a] <= bounds.hi[a])) return false;
    return bounds.firstLevel <= level && level <= bounds.lastLevel;
}

// Returns how many points the box holds.
std::uint64_t expectSame(const timeseries::Mesh& mesh, const IndexBox& box) {
    const MeshBounds bounds = boundsIn(mesh, box);
    std::uint64_t held = 0;
    for (std::uint64_t i = 0; i < mesh.count(); ++i) {
        const bool inside = box.holdsPlace(mesh.position(i));
        EXPECT_EQ(isWithin(bounds, mesh, i), inside) << "point " << i;
        held += inside;
    }
    return held;
}

// Boxes whose faces stand exactly where points do, and an ulp beside them.
void expectSameInManyBoxes(const timeseries::Mesh& mesh) {
    std::mt19937_64 random(5);
    std::uint64_t some = 0;
    const double infinity = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 60; ++trial) {
        const glm::dvec3 a = mesh.position(random() % mesh.count());
        const glm::dvec3 b = mesh.position(random() % mesh.count());
        if (!timeseries::isPlace(a) || !timeseries::isPlace(b)) continue;
        IndexBox box{.from = glm::min(a, b), .to = glm::max(a, b)};
        const auto c = static_cast<glm::length_t>(random() % 3);
        switch (random() % 4) {
            case 0:
                box.from[c] = std::nextafter(box.from[c], infinity);
                break;
            case 1:
                box.to[c] = std::nextafter(box.to[c], -infinity);
                break;
            case 2:
                box.from[c] = -infinity;
                break;
            default:
                box.to[c] = infinity;
                break;
        }
        some += expectSame(mesh, box);
    }
    EXPECT_GT(some, 0u);
    EXPECT_EQ(expectSame(mesh, {}), mesh.count() - mesh.absent());
    EXPECT_EQ(expectSame(mesh, {.from = glm::dvec3(1), .to = glm::dvec3(-1)}), 0u);
    EXPECT_EQ(expectSame(mesh, {.from = glm::dvec3(infinity)}), 0u);
    EXPECT_EQ(expectSame(mesh, {.to = glm::dvec3(-infinity)}), 0u);
}

TEST(MeshBounds, HoldThePointsThatTheBoxHolds) {
    // Near the origin and so far from it that neighbouring floats are one place, large and small.
    for (const double offset : {0.0, 1e3, 1e9})
        for (const double scale : {1.0, 1e-200, 1e200}) {
            const auto grid = gridOf(placesOf({6, 5, 4}, [&](double i, double j, double k) {
                if (i == 2 && j == 3) return glm::dvec3(std::nan(""));
                return scale *
                       (offset + glm::dvec3(i + 0.3 * std::sin(j), j * 0.7, k - 0.2 * i * j));
            }));
            expectSameInManyBoxes(*grid->mesh());
        }
}

TEST(MeshBounds, OfColumnsHoldLevelsByTheirPlaces) {
    for (const std::vector<double>& levels :
         {std::vector<double>{1000, 850.5, 700.1, 500, 0.1}, {-5, 0, 3, 4e4}, {7}}) {
        auto places = placesOf(
            {6, 5, 1}, [](double i, double j, double) { return glm::dvec3(i + 0.1 * j, j, 0); });
        places.size[2] = levels.size();
        places.levels = levels;
        expectSameInManyBoxes(*gridOf(places)->mesh());
    }
}

}  // namespace
}  // namespace render

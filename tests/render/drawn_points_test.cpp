#include "render/splat/drawn_points.h"

#include <gtest/gtest.h>

#include <numeric>

#include "render/splat/tile_splatter.h"
#include "tests/support/meshes.h"
#include "tests/support/splat_world.h"

namespace render {
namespace {

// Each point of a mesh is another.
std::shared_ptr<const timeseries::Mesh> slanted(double by) {
    return tests::curvilinear({5, 4, 3},
                              [&](double i, double j, double k) {
                                  return glm::dvec3(i + by * j, j + 0.1 * k * i, k + 0.01 * i * j);
                              })
        ->mesh();
}

void expectKept(DrawnPoints& drawn, const timeseries::Mesh& mesh, std::size_t first,
                const std::vector<std::uint32_t>& index) {
    const auto stored = mesh.stored();
    const auto points = drawn.of(first, index);
    ASSERT_EQ(points.size(), index.size());
    for (std::size_t i = 0; i < index.size(); ++i)
        EXPECT_EQ(points[i], stored.points[index[i] % stored.points.size()]) << i;
}

TEST(DrawnPoints, AreTheMeshsWhateverWasDrawnBefore) {
    const auto mesh = slanted(0.2);
    DrawnPoints drawn;
    drawn.begin(mesh, 6);
    expectKept(drawn, *mesh, 0, {3, 1, 4});
    expectKept(drawn, *mesh, 3, {1, 5, 9});
    expectKept(drawn, *mesh, 0, {3, 1, 4});
    expectKept(drawn, *mesh, 0, {3, 1, 4, 1, 5, 8});  // one of them is another
    expectKept(drawn, *mesh, 2, {59, 0, 0});
    drawn.begin(mesh, 60);
    std::vector<std::uint32_t> all(60);
    std::iota(all.rbegin(), all.rend(), 0u);
    expectKept(drawn, *mesh, 0, all);
}

TEST(DrawnPoints, OfAnotherMeshAreNotThoseOfTheOneBefore) {
    DrawnPoints drawn;
    const std::vector<std::uint32_t> index{7, 0, 30};
    for (const double by : {0.1, 0.2, 0.3}) {  // where the last one was, the next may be
        const auto mesh = slanted(by);
        drawn.begin(mesh, 3);
        expectKept(drawn, *mesh, 0, index);
        expectKept(drawn, *mesh, 0, index);
    }
    const auto grid = tests::columns({1, 2, 4});
    drawn.begin(grid->mesh(), 3);
    expectKept(drawn, *grid->mesh(), 0, {7, 70, 133});
}

// Points that a mesh places, all between a tenth and half.
struct SlantedWorld : splat_world::World {
    SlantedWorld(double by, unsigned seed)
        : World(tests::noise(tests::curvilinear({9, 8, 7},
                                                [&](double i, double j, double k) {
                                                    return glm::dvec3(i + by * j, j, k + by * i);
                                                }),
                             seed),
                timeseries::RangeSet(std::vector{timeseries::Range{{0.1}, {0.5}}})) {
        scene.layers[0].style.color = ByValue{{}, 0.1, 0.5};
        scene.order = Order::BackToFront;
    }
    std::vector<float> sum(double azimuth, TileMemory& memory) const {
        const glm::dvec3 eye(3 * std::sin(azimuth), -3 * std::cos(azimuth), 0.5);
        TileSum tiles(scene, SortWhenDrawn{eye}, tests::lookFrom(eye, {64, 48}), Channels::Over, 0,
                      {}, 2, std::move(memory));
        tiles.add(std::numeric_limits<std::uint64_t>::max());
        const std::vector<float> plane(tiles.plane().begin(), tiles.plane().end());
        memory = tiles.takeMemory();
        return plane;
    }
};

// Another view, another step of the same mesh, another mesh.
TEST(DrawnPoints, PicturesInMemoryThatIsKeptAreThoseOfNewMemory) {
    const SlantedWorld first(0.1, 1), laterStep(0.1, 2), otherMesh(0.3, 1);
    TileMemory kept;
    for (const SlantedWorld* world : {&first, &first, &laterStep, &otherMesh, &first})
        for (const double azimuth : {0.0, 0.7}) {
            TileMemory fresh;
            EXPECT_EQ(world->sum(azimuth, kept), world->sum(azimuth, fresh));
        }
}

}  // namespace
}  // namespace render

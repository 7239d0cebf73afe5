// Splats of points that lie one by one, drawn by GL, against the truth in double.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "tests/support/gl_planes.h"
#include "tests/support/meshes.h"
#include "tests/support/splat_world.h"
#include "tests/support/unstructured.h"

namespace render {
namespace {

using splat_world::World;
using tests::columns;
using tests::curvilinear;
using tests::lookFrom;

std::shared_ptr<const timeseries::Grid> leaningLayer() {
    return curvilinear({7, 6, 8}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.3 * j, j - 0.2 * i, 0.4 * i + 0.25 * j + 1e-4 * k * (1 + 0.1 * k));
    });
}

class GlMeshes : public tests::GlTest {
 protected:
    std::vector<double> truth(const Scene& scene, const View& view, Channels channels) {
        Accumulator<double> sums(view.size, {channels});
        splat(scene, order(scene, tests::kMidEye), view, {}, sums);
        return sums.planes[0];
    }
    double error(const Scene& scene, const View& view, Channels channels = Channels::Weight) {
        const auto expected = truth(scene, view, channels);
        EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0.0), 0);
        return compareScalars(plane(scene, view, channels), expected).relativeL2;
    }
    static World worldOf(std::shared_ptr<const timeseries::Grid> grid, Footprint footprint = {}) {
        return World(
            tests::stepOf(std::move(grid), [](std::size_t i) { return double(i * 7919 % 1000); }),
            timeseries::RangeSet::everything(), footprint);
    }
};

// From outside, from inside and from so far that cells are below a pixel.
const std::array kEyes{glm::dvec3(1.5, -2, 1), glm::dvec3(0.2, -0.3, 0.1), glm::dvec3(30, -40, 10)};

TEST_F(GlMeshes, AreTheTruths) {
    for (const auto& grid :
         {tests::twisted(), tests::rings(4, 0.5), columns({1000, 850, 700, 500}), columns({3}),
          columns({0, 1}), columns({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}),
          tests::gridOf(tests::atCells(tests::bricks(
              {6, 5, 4}, tests::Cut::Tetrahedra,
              [](double i, double j, double k) { return glm::dvec3(i, j + 0.1 * i * k, k); })))})
        for (const double size : {1.0, 2.0})
            for (const glm::dvec3& eye : kEyes) {
                const World world = worldOf(grid, {Kernel::Quartic, size});
                EXPECT_LE(error(world.scene, lookFrom(eye, {160, 120}, 0.5)), 2e-5)
                    << grid->size()[2] << " levels, size " << size << ", eye " << eye.x;
            }
}

// One layer is turned inside out beside the others, in a mesh of either hand.
TEST_F(GlMeshes, FoldedCellsAreNotDrawn) {
    for (const double hand : {1.0, -1.0}) {
        const auto grid = curvilinear({6, 5, 4}, [&](double i, double j, double k) {
            return glm::dvec3(i == 3 ? 0.5 : i, hand * j, k);
        });
        ASSERT_EQ(grid->mesh()->folded(), 20u);
        for (const Footprint& footprint : {Footprint{}, Footprint{Kernel::Point, 1}}) {
            const World world = worldOf(grid, footprint);
            EXPECT_LE(error(world.scene, lookFrom(kEyes[0], {160, 120}, 0.5)), 2e-5) << hand;
        }
    }
}

// A boundary layer, ten thousand times as wide as high.
TEST_F(GlMeshes, FlatCellsThatLeanAreTheTruths) {
    const World world = worldOf(leaningLayer());
    for (const glm::dvec3& eye : kEyes)
        EXPECT_LE(error(world.scene, lookFrom(eye, {160, 120}, 0.5)), 2e-4) << eye.x;
}

TEST_F(GlMeshes, AsPointsEachDrawsItsMass) {
    for (const float side : {1.0f, 5.0f}) {
        const World world = worldOf(tests::twisted(), {Kernel::Point, side});
        EXPECT_LE(error(world.scene, lookFrom(kEyes[0], {160, 120}, 0.5)), 1e-5);
    }
}

TEST_F(GlMeshes, DrawEveryChannelByValueAndInOrder) {
    World world = worldOf(tests::twisted());
    world.scene.layers[0].style = {ByValue{ColorMap(), 0, 1000}, 0.7};
    const View view = lookFrom(kEyes[0], {160, 120}, 0.5);
    for (const std::uint32_t stride : {1u, 2u}) {
        world.scene.stride = stride;
        world.scene.order = Order::None;
        EXPECT_LE(error(world.scene, view, Channels::WeightedColor), 2e-5);
        world.scene.order = Order::BackToFront;
        EXPECT_LE(error(world.scene, view, Channels::Over), 2e-5);
    }
}

TEST_F(GlMeshes, OfOtherExtentsAndProportionsAreDrawnAlike) {
    const auto drawn = [&](double scale, bool down) {
        auto places = tests::placesOf({6, 5, 4}, [&](double i, double j, double k) {
            return scale * glm::dvec3(i + 0.1 * j * k, j, k + 0.2 * i);
        });
        const auto mesh = std::make_shared<const timeseries::Mesh>(places);
        std::array<timeseries::Axis, 3> axes;
        for (auto& axis : axes) axis.units = "m";
        axes[0].down = down;
        const World world = worldOf(std::make_shared<timeseries::Grid>(axes, mesh));
        const View view = lookFrom(kEyes[0], {160, 120}, 0.5);
        EXPECT_LE(error(world.scene, view), 2e-5) << scale << down;
        return plane(world.scene, view, Channels::Weight);
    };
    const auto one = drawn(1, false);
    for (const int power : {-700, -40, 40, 700})
        EXPECT_EQ(drawn(std::ldexp(1.0, power), false), one);
    EXPECT_NE(drawn(1, true), one);
}

// Clipped where points stand: as many are drawn as brute force says, each on a pixel of its own.
TEST_F(GlMeshes, AreClippedToThePoint) {
    for (const auto& grid : {tests::twisted(), columns({1000, 850, 700, 500})}) {
        World world = worldOf(grid, {Kernel::Point, 1});
        const View view = lookFrom({1, -4, 1.5}, {128, 128});
        for (std::uint64_t i = 0; i < grid->count(); i += 17) {
            const glm::dvec3 corner = grid->position(i);
            if (!timeseries::isPlace(corner)) continue;
            for (const bool above : {false, true}) {
                world.scene.clip = IndexBox{};
                (above ? world.scene.clip.from : world.scene.clip.to) = corner;
                double held = 0;
                for (std::uint64_t p = 0; p < grid->count(); ++p)
                    held += world.scene.clip.holdsPlace(grid->position(p)) ? 1 : 0;
                const auto counts = plane(world.scene, view, Channels::Count);
                EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), held);
            }
        }
    }
}

TEST_F(GlMeshes, ComeInSlicesAndOnceForAllSteps) {
    const auto grid = tests::twisted();
    const World one = worldOf(grid), other = worldOf(grid), own = worldOf(tests::twisted());
    const std::uint64_t whole = grid->count() * 24;
    EXPECT_EQ(GlMesh::bytesOf(*grid->mesh()), whole);
    Scene nothing = one.scene;  // but the mesh
    nothing.layers.clear();
    GlStep first(one.step, one.placed);
    EXPECT_FALSE(first.ready(nothing));
    EXPECT_EQ(first.missingBytes(nothing, {}), whole);
    EXPECT_EQ(GlStep::neededBytes(nothing, {}), whole);
    first.upload(nothing, {}, 100);
    EXPECT_EQ(first.missingBytes(nothing, {}), whole - 100);
    EXPECT_FALSE(first.ready(nothing));
    first.upload(nothing, {});
    EXPECT_EQ(first.missingBytes(nothing, {}), 0u);
    EXPECT_TRUE(first.ready(nothing));
    const std::uint64_t alone = first.bytes();

    const GlStep second(other.step, other.placed, first.mesh());
    EXPECT_EQ(second.mesh(), first.mesh());
    EXPECT_EQ(first.bytes() + whole / 2, alone);
    EXPECT_NE(GlStep(own.step, own.placed, first.mesh()).mesh(), first.mesh());
}

}  // namespace
}  // namespace render

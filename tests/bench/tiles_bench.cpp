// The splatter by tiles against what it takes the place of, by turns: rows for unordered planes,
// and what the driver makes of point sprites for ordered ones.
#include <benchmark/benchmark.h>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_targets.h"
#include "render/splat/processor_splatter.h"
#include "render/splat/row_splatter.h"
#include "render/splat/tile_splatter.h"
#include "tests/bench/alternate.h"
#include "tests/bench/scattered_splats.h"
#include "tests/support/meshes.h"

namespace {

using namespace render;
using namespace bench::what;

// A picture, and an eye of a headset.
constexpr std::array<glm::ivec2, 2> kSizes{bench::ScatteredSplats::kSize, {1440, 1600}};
// A frame by tiles, whose order is made anew for the eye, as the program has it made.
struct ByTiles {
    ProcessorSplatter splatter;
    TileMemory memory;
    void operator()(const bench::ScatteredSplats& world, std::span<const float> opaqueDepth) {
        const DrawList list = splatter.order(world.scene, pixelRays(world.view).eye);
        TileSum sum(world.scene, list, world.view, channelsFor(world.scene)[0], 0, opaqueDepth,
                    sharingThreads(), std::move(memory));
        sum.add(std::numeric_limits<std::uint64_t>::max());
        memory = sum.takeMemory();
    }
};

void tiles(benchmark::State& state) {
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)),
                                 static_cast<double>(state.range(1)), tests::cube(256),
                                 kSizes[static_cast<std::size_t>(state.range(3))]);
    const auto what = static_cast<What>(state.range(2));
    colorAndOrder(world.scene, what);
    const Channels channels = channelsFor(world.scene)[0];
    const std::vector<float> far(std::size_t(world.view.size.x) * world.view.size.y, 1);
    const glm::dvec3 eye = pixelRays(world.view).eye;
    const gl::HeadlessContext context;
    GlStep onGpu(world.step, world.placed);
    onGpu.upload(world.scene, neededScale(world.scene));
    GlSplatter splatter;
    GlTargets targets(world.view.size);
    gl::begin({.framebuffer = targets.lightFramebuffer(),
               .size = world.view.size,
               .clearColor = glm::vec4(0),
               .clearDepth = 1.0f});
    DepthOrder inDepth;
    ByTiles byTiles;
    const auto before = [&] {
        if (what != Ordered) {
            benchmark::DoNotOptimize(sumRows(world.scene, Runs{}, world.view, channels, 0, far));
            return;
        }
        const auto uploaded = splatter.upload(world.scene, inDepth(world.scene, eye), onGpu);
        splatter.draw(*uploaded, world.view, channels, 0, targets.clearedPlane(0, channels));
        glFinish();
    };
    bench::alternate(
        state, [&] { byTiles(world, far); }, before, 3);
}
BENCHMARK(tiles)
    ->ArgNames({"splats", "pixels", "what", "eye"})
    ->Args({1'000'000, 8, OneColor, 0})
    ->Args({1'000'000, 8, ByTheirValues, 0})
    ->Args({1'000'000, 8, Ordered, 0})
    ->Args({100'000, 8, OneColor, 0})
    ->Args({100'000, 8, Ordered, 0})
    ->Args({1'000'000, 1, OneColor, 0})
    ->Args({1'000'000, 8, Ordered, 1})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

// A window's frame of points placed one by one, beside the same ones of the upright grid, whose
// cells are cubes or, in the middle of one axis, a little larger than at its ends.
void meshBesideUpright(benchmark::State& state) {
    const auto splats = static_cast<std::uint64_t>(state.range(0));
    const auto diameter = static_cast<double>(state.range(1));
    const auto what = static_cast<What>(state.range(2));
    std::array<timeseries::Axis, 3> axes = tests::cube(256)->axes();
    if (state.range(3) == 0)
        for (double& x : axes[0].coordinates) x += 1e-4 * x * x;
    const auto grid = std::make_shared<const timeseries::Grid>(axes);
    bench::ScatteredSplats upright(splats, diameter, grid);
    bench::ScatteredSplats mesh(
        splats, diameter, tests::curvilinear({256, 256, 256}, [&](double i, double j, double k) {
            return glm::dvec3(axes[0].coordinates[static_cast<std::size_t>(i)], j, k);
        }));
    const gl::HeadlessContext context;
    FrameRenderer renderer;
    GlStep uprightOnGpu(upright.step, upright.placed), meshOnGpu(mesh.step, mesh.placed);
    for (bench::ScatteredSplats* world : {&upright, &mesh}) colorAndOrder(world->scene, what);
    uprightOnGpu.upload(upright.scene, neededScale(upright.scene));
    meshOnGpu.upload(mesh.scene, neededScale(mesh.scene));
    const auto draw = [&](bench::ScatteredSplats& world, GlStep& onGpu) {
        const std::array views{world.view};
        const FrameContent content{world.scene, world.step.grid(), {}, glm::dvec3(0)};
        renderer.drawEye(renderer.prepare(content, onGpu, views), world.view);
        glFinish();
    };
    bench::alternate(
        state, [&] { draw(upright, uprightOnGpu); }, [&] { draw(mesh, meshOnGpu); });
}
BENCHMARK(meshBesideUpright)
    ->ArgNames({"splats", "pixels", "what", "cubes"})
    ->ArgsProduct({{1'000'000, 100'000}, {8}, {OneColor, Ordered}, {1, 0}})
    ->Iterations(25)
    ->Unit(benchmark::kMillisecond);

}  // namespace

// Splats by tiles: of points that are placed one by one beside those of an upright grid.
#include <benchmark/benchmark.h>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "tests/bench/alternate.h"
#include "tests/bench/scattered_splats.h"
#include "tests/support/meshes.h"

namespace {

using namespace render;
using namespace bench::what;

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

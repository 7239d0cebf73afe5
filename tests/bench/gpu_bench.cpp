// Whole frames by GL beside the program's of the same scene, by turns: what a GPU buys. On a driver
// that draws on the processor these figures say nothing.
#include <benchmark/benchmark.h>

#include <array>
#include <utility>

#include "render/frame/plain_frame.h"
#include "render/gl/headless_context.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_splatter.h"
#include "tests/bench/alternate.h"
#include "tests/bench/cells_of_range.h"
#include "tests/bench/scattered_splats.h"

namespace {

using namespace render;
using namespace bench::what;
using bench::CellsOfRange;

void glBesideProgram(benchmark::State& state, const Scene& scene, const View& view) {
    const gl::HeadlessContext context;
    PlainFrame onGpu(scene.step, scene.placed, glm::dvec3(0), SplatterChoice::Gl),
        here(scene.step, scene.placed, glm::dvec3(0));
    bench::alternate(
        state, [&] { onGpu.draw(scene, view); }, [&] { here.draw(scene, view); });
    state.counters["sharing"] = sharingThreads();
    state.SetLabel(context.renderer());
}

void glPoints(benchmark::State& state) {
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)),
                                 static_cast<double>(state.range(1)));
    colorAndOrder(world.scene, static_cast<What>(state.range(2)));
    glBesideProgram(state, world.scene, world.view);
}
BENCHMARK(glPoints)
    ->ArgNames({"splats", "diameter", "what"})
    ->Args({100'000, 8, OneColor})
    ->Args({100'000, 8, Ordered})
    ->Args({1'000'000, 8, OneColor})
    ->Args({1'000'000, 8, ByTheirValues})
    ->Args({1'000'000, 8, Ordered})
    ->Args({1'000'000, 1, OneColor})
    ->Args({8'000'000, 3, OneColor})
    ->Args({8'000'000, 3, Ordered})
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);

// A draw list in order of depth: by the GPU from what lies there, by the program and sent.
void glOrder(benchmark::State& state) {
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)), 3);
    colorAndOrder(world.scene, Ordered);
    const gl::HeadlessContext context;
    GlStep step(world.step, world.placed);
    step.upload(world.scene, neededScale(world.scene));
    GlSplatter splatter;
    DepthOrder inDepth;
    const glm::dvec3 eye = pixelRays(world.view).eye;
    const auto with = [&](const DrawList& list) {
        splatter.upload(world.scene, list, step);
        glFinish();
    };
    bench::alternate(
        state, [&] { with(SortWhenDrawn{eye}); }, [&] { with(inDepth(world.scene, eye)); });
    state.SetLabel(context.renderer());
}
BENCHMARK(glOrder)
    ->ArgName("splats")
    ->Args({100'000})
    ->Args({1'000'000})
    ->Args({8'000'000})
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);

// As many points, placed one by one.
void glMeshPoints(benchmark::State& state) {
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)), 8,
                                 bench::latticeOneByOne(256, false));
    colorAndOrder(world.scene, static_cast<What>(state.range(1)));
    glBesideProgram(state, world.scene, world.view);
}
BENCHMARK(glMeshPoints)
    ->ArgNames({"splats", "what"})
    ->Args({1'000'000, OneColor})
    ->Args({1'000'000, Ordered})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

// Lit where they are in order.
void glCells(benchmark::State& state) {
    bench::FireOrTurbulence cells(state.range(0), state.range(1) != 0);
    if (cells.scene.order == Order::BackToFront) cells.scene.light = Light::Soft;
    state.counters["cells"] = static_cast<double>(cellCount(cells.scene.layers[0]));
    glBesideProgram(state, cells.scene, cells.view);
}
BENCHMARK(glCells)
    ->ArgNames({"points", "lit"})
    ->ArgsProduct({{0, 96, 192}, {0, 1}})
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

// While a range is swept: each frame has another one, a little further.
void glCellsSwept(benchmark::State& state) {
    bench::FireOrTurbulence cells(state.range(0), true);
    cells.scene.light = Light::Soft;
    const gl::HeadlessContext context;
    const auto& step = cells.scene.step;
    PlainFrame onGpu(step, cells.scene.placed, glm::dvec3(0), SplatterChoice::Gl),
        here(step, cells.scene.placed, glm::dvec3(0));
    const auto [lo, hi] = cells.scene.layers[0].cells.ranges[0];
    int tick = 0;
    const auto draw = [&](PlainFrame& frame) {
        Scene scene = cells.scene;
        auto& swept = scene.layers[0].cells;
        const double by = 0.01 * (hi - lo) * (++tick / 2 % 10);
        swept.ranges = {{lo + by, hi + by}};
        swept.candidates = scene.cells->select(swept.ranges);
        frame.draw(scene, cells.view);
    };
    bench::alternate(
        state, [&] { draw(onGpu); }, [&] { draw(here); });
    state.counters["cells"] = static_cast<double>(cellCount(cells.scene.layers[0]));
    state.SetLabel(context.renderer());
}
BENCHMARK(glCellsSwept)
    ->ArgName("points")
    ->Arg(0)
    ->Arg(96)
    ->Arg(192)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

// Tetrahedra of a curvilinear grid, and of hexahedra.
void glCellsOfMesh(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    timeseries::Field field = bench::turbulence<float>(n);
    field.grid = bench::latticeOneByOne(n, state.range(1) != 0);
    CellsOfRange cells(std::move(field), 100, state.range(2) != 0);
    state.counters["cells"] = static_cast<double>(cellCount(cells.scene.layers[0]));
    glBesideProgram(state, cells.scene, cells.view);
}
BENCHMARK(glCellsOfMesh)
    ->ArgNames({"points", "hexahedra", "ordered"})
    ->Args({96, 0, 0})
    ->Args({96, 0, 1})
    ->Args({96, 1, 0})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

// Drawing: 100,000 splats of 8 pixels into 1024 x 1024, and what else a frame costs.
#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>

#include "render/frame.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/gl_list.h"
#include "render/gl_splatter.h"
#include "tests/support/scenes.h"

namespace {

using namespace render;

constexpr glm::ivec2 kSize{1024, 1024};

// 256^3 points of noise, of which a thin slice of values holds `count`: splats scattered over the
// volume, each of the wanted diameter in the middle of the picture.
struct World {
    World(std::uint64_t count, double diameterPixels)
        : step(tests::noise(tests::cube(256))), lattice(step.grid()) {
        const double share = static_cast<double>(count) / static_cast<double>(step.size());
        const timeseries::RangeSet range(std::vector{timeseries::Range{{0.4}, {0.4 + share}}});
        scene.layers.push_back({step.select(range), {Constant{{1, 0.5, 0.1}}, 0.3}});
        const double tangent = 0.25, focal = kSize.y / 2 / tangent;
        const double cellPixels = diameterPixels / 2 / 1.396;
        view = tests::lookFrom({0, -focal * lattice.unitLength() / cellPixels, 0}, kSize, tangent);
    }
    timeseries::SortedStep step;
    Lattice lattice;
    Scene scene{.step = step,
                .lattice = lattice,
                .layers = {},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
    View view;
};

// The splatter and its targets, without read-back.
void drawAndResolve(benchmark::State& state, Order order, bool byValue) {
    World world(static_cast<std::uint64_t>(state.range(0)), static_cast<double>(state.range(1)));
    const gl::HeadlessContext context;
    world.scene.order = order;
    if (byValue) world.scene.layers[0].style.color = ByValue{{}, 0.4, 0.41};
    GpuStep onGpu(world.step, world.lattice);
    FrameRenderer renderer;
    const std::array views{world.view};
    const FrameContent content{world.scene, world.step.grid(), {}, glm::dvec3(0)};
    std::uint64_t drawn = 0;
    for (const auto& run : world.scene.layers[0].runs) drawn += run.count;
    for (auto _ : state) {
        renderer.drawEye(renderer.prepare(content, onGpu, views), world.view);
        glFinish();
    }
    state.counters["splats"] = static_cast<double>(drawn);
    state.SetLabel(context.renderer());
}

void BM_DrawUnordered(benchmark::State& state) { drawAndResolve(state, Order::None, false); }
void BM_DrawByValue(benchmark::State& state) { drawAndResolve(state, Order::None, true); }
void BM_DrawOrdered(benchmark::State& state) { drawAndResolve(state, Order::BackToFront, true); }

void splatsAndDiameters(benchmark::internal::Benchmark* b) {
    b->Args({1, 8})
        ->Args({100'000, 8})
        ->Args({1'000'000, 8})
        ->Args({100'000, 16})
        ->Args({1'000'000, 3})
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}
BENCHMARK(BM_DrawUnordered)->Apply(splatsAndDiameters);
BENCHMARK(BM_DrawByValue)
    ->Args({100'000, 8})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(BM_DrawOrdered)
    ->Args({100'000, 8})
    ->Args({1'000'000, 8})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

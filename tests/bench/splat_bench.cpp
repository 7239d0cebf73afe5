// Drawing: 100,000 splats of 8 pixels into 1024 x 1024, and what else a frame costs.
#include <benchmark/benchmark.h>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/gl_targets.h"
#include "tests/bench/scattered_splats.h"
#include "tests/support/fragment_order.h"

namespace {

using namespace render;

// The splatter and its targets, without read-back.
void drawAndResolve(benchmark::State& state, Order order, bool byValue,
                    glm::ivec2 size = bench::ScatteredSplats::kSize) {
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)),
                                 static_cast<double>(state.range(1)), tests::cube(256), size);
    const gl::HeadlessContext context;
    world.scene.order = order;
    if (byValue) world.scene.layers[0].style.color = ByValue{{}, 0.4, 0.41};
    GlStep onGpu(world.step, world.placed);
    onGpu.upload(world.scene, neededScale(world.scene));
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
void BM_DrawEye(benchmark::State& state) {
    drawAndResolve(state, Order::BackToFront, true, {1440, 1600});
}

// How far a frame is from the truth, as counters; the time is the truth's own. Optical depth: the
// weights by GL against the CPU's in double. Light: linear RGB of the frame, with splats in both
// orders, against the truth's own order; what is lost by not ordering is the difference.
void BM_ErrorAgainstTruth(benchmark::State& state) {
    const auto step = tests::noise(tests::cube(64));
    const PlacedPoints placed(step.grid());
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{step.select(timeseries::RangeSet::parse("0.1:0.3")),
                            {ByValue{{}, 0.1, 0.3}, static_cast<double>(state.range(0)) / 1000}}},
                .footprint = {.kernel = state.range(1) != 0 ? Kernel::Quartic : Kernel::Point},
                .order = Order::BackToFront,
                .clip = {}};
    const View view = tests::lookFrom({1, -3, 1}, {512, 512});
    const glm::dvec3 eye = pixelRays(view).eye;
    const std::size_t pixels = std::size_t(view.size.x) * view.size.y;
    Accumulator<double> weights(view.size, {Channels::Weight}), over(view.size, {Channels::Over});
    for (auto _ : state) {
        splat(scene, Runs{}, view, {}, weights);
        splat(scene, orderExactly(scene, eye), view, {}, over);
    }
    std::vector<double> truth;
    for (std::size_t i = 0; i < pixels; ++i)
        for (int c = 0; c < 3; ++c) truth.push_back(over.planes[0][4 * i + c]);

    const gl::HeadlessContext context;
    GlStep onGpu(step, placed);
    GlSplatter splatter;
    GlTargets targets(view.size);
    gl::begin({.framebuffer = targets.lightFramebuffer(), .size = view.size, .clearDepth = 1.0f});
    const auto plane = [&](Channels channels) {
        const auto list = splatter.upload(scene, splatter.order(scene, eye), onGpu);
        splatter.draw(*list, view, channels, 0, targets.clearedPlane(0, channels));
        const bool scalar = channels == Channels::Weight;
        std::vector<float> read(pixels * (scalar ? 1 : 4));
        glGetTextureSubImage(targets.plane(0).id(), 0, 0, 0, 0, view.size.x, view.size.y, 1,
                             scalar ? GL_RED : GL_RGBA, GL_FLOAT,
                             static_cast<GLsizei>(read.size() * sizeof(float)), read.data());
        return read;
    };
    const auto light = [&](const auto& rgbAt) {
        std::vector<double> rgb;
        for (std::size_t i = 0; i < pixels; ++i) {
            const glm::dvec3 c = rgbAt(i);
            rgb.insert(rgb.end(), {c.r, c.g, c.b});
        }
        return compareScalars(rgb, truth).relativeL2;
    };
    const auto ordered = plane(Channels::Over);
    state.counters["ordered"] = light([&](std::size_t i) {
        return glm::dvec3(ordered[4 * i], ordered[4 * i + 1], ordered[4 * i + 2]);
    });
    scene.order = Order::None;
    onGpu.upload(scene, neededScale(scene));
    state.counters["depth"] = compareScalars(plane(Channels::Weight), weights.planes[0]).relativeL2;
    const auto colored = plane(Channels::WeightedColor);
    const double tau = opticalDepthPerWeight(scene.layers[0].style.opacity);
    double meanDepth = 0;
    std::size_t covered = 0;
    state.counters["unordered"] = light([&](std::size_t i) {
        const auto w = static_cast<double>(colored[4 * i + 3]);
        if (w <= 0) return glm::dvec3(0);
        meanDepth += tau * w;
        ++covered;
        return glm::dvec3(colored[4 * i], colored[4 * i + 1], colored[4 * i + 2]) *
               (-std::expm1(-tau * w) / w);
    });
    state.counters["meanTau"] = meanDepth / static_cast<double>(std::max<std::size_t>(covered, 1));
}
BENCHMARK(BM_ErrorAgainstTruth)
    ->ArgNames({"opacity/1000", "kernel"})
    ->Args({10, 1})
    ->Args({100, 1})
    ->Args({500, 1})
    ->Args({100, 0})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Splats in the order of their centres beside their fragments in order, pixel by pixel.
void BM_OffFragments(benchmark::State& state) {
    const tests::SmoothScene smooth(static_cast<double>(state.range(0)) / 1000);
    for (auto _ : state) {
        state.counters["outside"] = smooth.offFrom(smooth.fromOutside());
        state.counters["within"] = smooth.offFrom(smooth.within());
        state.counters["face"] = smooth.offFrom(smooth.alongAFace());
    }
}
BENCHMARK(BM_OffFragments)
    ->ArgNames({"opacity/1000"})
    ->Arg(20)
    ->Arg(100)
    ->Arg(500)
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void splatsAndDiameters(benchmark::internal::Benchmark* b) {
    b->Args({1, 8})
        ->Args({100'000, 8})
        ->Args({1'000'000, 8})
        ->Args({100'000, 16})
        ->Args({1'000'000, 3})
        ->Args({1'000'000, 1})
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}
BENCHMARK(BM_DrawUnordered)->Apply(splatsAndDiameters);
BENCHMARK(BM_DrawByValue)
    ->Args({100'000, 8})
    ->Args({1'000'000, 8})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(BM_DrawOrdered)
    ->Args({100'000, 8})
    ->Args({1'000'000, 8})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(BM_DrawEye)
    ->Args({1'000'000, 8})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

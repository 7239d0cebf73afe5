// What a window's frame costs: drawn whole and as a subset, with its axes and legend; a pick.
#include <benchmark/benchmark.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "app/drawing/canvas.h"
#include "render/frame/present.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/model/pick.h"
#include "render/reference/image_compare.h"
#include "tests/bench/alternate.h"
#include "tests/bench/noise_world.h"

namespace {

constexpr glm::ivec2 kSize{1024, 1024};

tests::ShownSteps world(std::uint64_t count) {
    tests::ShownSteps shown = bench::noiseWorld(256, count);
    shown.explorer.size = kSize;
    return shown;
}

// A window's frame, made by the program in memory, and with GL for all but its splats, as it was
// before and as it is beside a panel in a headset: a placard behind the eye changes nothing else.
void BM_CanvasFrame(benchmark::State& state) {
    const auto shown = world(static_cast<std::uint64_t>(state.range(0)));
    auto explorer = shown.explorer;
    // What has one colour needs no order.
    if (state.range(1) != 0) explorer.layers[0].color = app::MapChoice{{}, 0.4, 0.6};
    const app::Shown now{explorer, shown.dataset, 0, shown.steps[0]};
    const render::gl::HeadlessContext context;
    app::Canvas inMemory(render::SplatterChoice::Cpu, render::LightAs::Srgb8),
        withGl(render::SplatterChoice::Cpu);
    const render::Present present;
    render::KeptPicture window(kSize);
    const auto eyes = inMemory.eyesOf(now);
    const app::CanvasLimits limits{.splats = 100'000, .uploadBytes = ~std::uint64_t{0}};
    const render::Placard behind{glm::translate(glm::dmat4(1), pixelRays(eyes[0]).eye * 3.0),
                                 glm::vec3(1)};
    app::CanvasReport report;
    const auto with = [&](app::Canvas& canvas, std::span<const render::Placard> placards) {
        return [&, placards] {
            report = canvas.draw(
                now, eyes, limits, state.range(2) != 0,
                [&](std::size_t, render::Targets& light) { present.draw(light, window); },
                {.placards = placards});
            glFinish();
        };
    };
    bench::alternate(state, with(inMemory, {}), with(withGl, std::span(&behind, 1)));
    state.counters["drawn"] = static_cast<double>(report.drawn);
    state.SetLabel(context.renderer());
}
BENCHMARK(BM_CanvasFrame)
    ->ArgNames({"selected", "ordered", "moving"})
    ->Args({0, 0, 0})
    ->Args({100'000, 0, 1})
    ->Args({1'000'000, 0, 1})
    ->Args({1'000'000, 0, 0})
    ->Args({100'000, 1, 1})
    ->Args({1'000'000, 1, 1})
    ->Args({1'000'000, 1, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Light onto a window, alone: encoded by the program, as where the driver draws on the processor,
// and by a shader.
void BM_Present(benchmark::State& state) {
    const render::gl::HeadlessContext context;
    const render::Present here(true), shader(false);
    render::GlTargets light(kSize);
    render::gl::begin({.framebuffer = light.lightFramebuffer(),
                       .size = kSize,
                       .clearColor = glm::vec4(0.2f, 0.4f, 0.1f, 1)});
    render::KeptPicture window(kSize);
    const auto with = [&](const render::Present& present) {
        return [&] {
            present.draw(light, window);
            glFinish();
        };
    };
    bench::alternate(state, with(here), with(shader));
}
BENCHMARK(BM_Present)->Unit(benchmark::kMillisecond)->UseRealTime();

// A subset of waves' shells, a million points, against the whole: relative L2 of the light. The
// splats keep their size, or grow with what they stand for.
void BM_Subset(benchmark::State& state) {
    const auto stride = static_cast<std::uint32_t>(state.range(0));
    const auto step = tests::stepOf(tests::cube(200), [](std::size_t i) {
        const glm::dvec3 at = glm::dvec3(i % 200, i / 200 % 200, i / 40000) / 25.0;
        return std::sin(at.x) * std::cos(at.y) + std::sin(at.y) * std::cos(at.z) +
               std::sin(at.z) * std::cos(at.x);
    });
    const render::PlacedPoints placed(step.grid());
    render::Scene scene{.step = step,
                        .placed = placed,
                        .layers = {{step.select(timeseries::RangeSet::parse("0.5:0.75")),
                                    {render::Constant{{1, 0.5, 0.1}}, 0.2}}},
                        .footprint = {},
                        .order = render::Order::None,
                        .clip = {}};
    const render::gl::HeadlessContext context;
    render::FrameRenderer renderer;
    render::GlStep onGpu(step, placed);
    const std::array views{tests::lookFrom({1, -5, 1}, kSize, 0.25)};
    const auto light = [&] {
        const auto drawn =
            renderer.render({scene, step.grid(), {}, glm::dvec3(0)}, onGpu, views)[0].image;
        std::vector<float> rgb;
        for (const glm::vec4& p : drawn.pixels) rgb.insert(rgb.end(), {p.r, p.g, p.b});
        return rgb;
    };
    const auto whole = light();
    const auto count = render::pointCount(scene.layers[0]);
    scene.stride = stride;
    if (state.range(1) != 0) scene.footprint.size = std::cbrt(stride);
    const render::FrameContent content{scene, step.grid(), {}, glm::dvec3(0)};
    for (auto _ : state) {
        renderer.drawEye(renderer.prepare(content, onGpu, views), views[0]);
        glFinish();
    }
    state.counters["error"] = render::compareScalars(light(), whole).relativeL2;
    state.counters["points"] = static_cast<double>(count);
}
BENCHMARK(BM_Subset)
    ->ArgNames({"stride", "grown"})
    ->ArgsProduct({{1, 2, 8, 32, 128}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_AxesAndLegend(benchmark::State& state) {
    const auto shown = world(100'000);
    const render::PlacedPoints placed(shown.steps[0]->grid());
    const auto picture =
        app::makePicture(shown.explorer, shown.dataset.variable, 0, *shown.steps[0], placed);
    const render::Font font(std::array{render::labelStyle(kSize), render::titleStyle(kSize)});
    const auto view = tests::lookFrom({1, -3, 1}, kSize);
    const glm::dvec3 eye = render::pixelRays(view).eye;
    for (auto _ : state) {
        const auto legend = render::legendMesh(picture.legend, font, kSize);
        benchmark::DoNotOptimize(
            render::axesMeshes(shown.steps[0]->grid(), placed, view, {eye}, font, legend));
    }
}
BENCHMARK(BM_AxesAndLegend)->Unit(benchmark::kMillisecond);

void BM_Pick(benchmark::State& state) {
    const auto shown = world(static_cast<std::uint64_t>(state.range(0)));
    const render::PlacedPoints placed(shown.steps[0]->grid());
    const auto picture =
        app::makePicture(shown.explorer, shown.dataset.variable, 0, *shown.steps[0], placed);
    const auto view = tests::lookFrom({1, -3, 1}, kSize);
    for (auto _ : state)
        benchmark::DoNotOptimize(render::pick(picture.scene, view, {512.5, 512.5}));
}
BENCHMARK(BM_Pick)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace

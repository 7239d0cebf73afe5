// Cost follows the selection, not the volume: the points of 64^3 alone, and the same points as
// every eighth of 512^3 along each axis, drawn at the same places with the same footprints into the
// same picture, by turns.
#include <benchmark/benchmark.h>

#include <cmath>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "render/splat/gl_list.h"
#include "tests/bench/alternate.h"
#include "tests/bench/volumes.h"

namespace {

using namespace render;

// Everything else in the large volume lies outside the ranges that are asked for.
timeseries::SortedStep amongOthers(const std::vector<float>& small, std::size_t n,
                                   std::size_t stride) {
    const std::size_t wide = n * stride;
    std::vector<float> values(wide * wide * wide);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = 10 + static_cast<float>(bench::noise(i));
    for (std::size_t i = 0; i < small.size(); ++i) {
        const std::size_t x = i % n, y = i / n % n, z = i / n / n;
        values[stride * (x + wide * (y + wide * z))] = small[i];
    }
    const auto axis = tests::axis(wide);
    return timeseries::SortedStep::build(
        {std::make_shared<timeseries::Grid>(std::array{axis, axis, axis}), std::move(values), {}});
}

struct Side {
    Side(const timeseries::SortedStep& step, const timeseries::RangeSet& range, double size,
         double opticalDepth)
        : placed(step.grid()),
          scene{.step = step,
                .placed = placed,
                .layers = {{step.select(range),
                            {Constant{{1, 0.5, 0.1}}, -std::expm1(-opticalDepth)}}},
                .footprint = {.size = size},
                .order = Order::None,
                .clip = {}},
          onGpu(step, placed) {
        onGpu.upload(scene, {});
    }
    PlacedPoints placed;
    Scene scene;
    GlStep onGpu;
    FrameRenderer renderer;
    void frame(const View& view) {
        const FrameContent content{scene, scene.step.grid(), {}, glm::dvec3(0)};
        renderer.drawEye(renderer.prepare(content, onGpu, std::span(&view, 1)), view);
        glFinish();
    }
};

void costFollowsTheSelection(benchmark::State& state) {
    constexpr std::size_t kPoints = 64, kStride = 8;
    const bench::Volume& small = bench::volume(kPoints);
    static const timeseries::SortedStep large =
        amongOthers(small.values(), kPoints, kStride);  // made once: it is large
    const auto range = small.rangeSet(static_cast<double>(state.range(0)) / 1000);
    const gl::HeadlessContext context;
    // Of a cell, in which optical depth is counted, there is an eighth in length, and a point's
    // mass is a 512th on the same area: 64 times the depth makes the same picture.
    Side a(small.step, range, 1, 0.05), b(large, range, kStride, 0.05 * kStride * kStride);
    // The same world: the large grid's scale and middle are moved to the small one's.
    const View view = bench::outside();
    const glm::dvec3 scale = a.placed.scale() / (b.placed.scale() * double(kStride));
    const glm::dvec3 shift = a.placed.position(0) - scale.x * b.placed.position(0);
    View moved = view;
    moved.viewFromWorld = view.viewFromWorld * glm::translate(glm::dmat4(1), shift) *
                          glm::scale(glm::dmat4(1), scale);
    bench::alternate(
        state, [&] { a.frame(view); }, [&] { b.frame(moved); });
    const auto draws = [](const Side& side) {
        std::uint64_t sum = 0;
        for (const auto& run : side.scene.layers[0].runs) sum += run.count;
        return static_cast<double>(sum);
    };
    state.counters["splats"] = draws(a);
    state.counters["splatsLarge"] = draws(b);
    a.frame(view);
    const Image drawn = a.renderer.targets().readLight();
    b.frame(moved);
    const Image drawnLarge = b.renderer.targets().readLight();
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
        sum += drawn.pixels[i].r;
        difference += std::abs(drawn.pixels[i].r - drawnLarge.pixels[i].r);
    }
    state.counters["difference"] = difference / sum;  // axes differ: other numbers
}
BENCHMARK(costFollowsTheSelection)
    ->Arg(1000)
    ->Arg(100)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(25);

}  // namespace

// How well a frame's time is foretold, as a window learns it: from frames of other ranges and views
// of the same field in a picture of the same size, by what they cost.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "render/frame/frame_pace.h"
#include "render/frame/plain_frame.h"
#include "render/gl/headless_context.h"
#include "render/splat/splat_cost.h"
#include "tests/bench/median.h"
#include "tests/support/scenes.h"

namespace {

constexpr glm::ivec2 kForetoldSize{600, 600};
constexpr int kForetoldFrames = 50;  // whose median is foretold

timeseries::SortedStep foretoldStep(bool isNoise, std::size_t side) {
    if (isNoise) return tests::noise(tests::cube(side));
    return tests::stepOf(tests::cube(side), [side](std::size_t i) {
        const auto at = glm::dvec3(i % side, i / side % side, i / (side * side)) / 12.0;
        return 0.5 + 0.25 * (std::sin(at.x) * std::cos(at.y) + std::sin(at.y) * std::cos(at.z));
    });
}

struct Picture {
    render::Scene scene;
    render::View view;
    std::uint64_t cost = 0;
    double seconds = 0;  // the median of its frames
};

std::vector<Picture> picturesOf(const timeseries::SortedStep& step,
                                const render::PlacedPoints& placed, bool byCells, bool isOrdered) {
    std::vector<Picture> pictures;
    for (const double away : {3.0, 2.2, 1.7, 1.4})
        for (const char* range : {"0.5:0.51", "0.4:0.6", "0.3:1"}) {
            const auto ranges = timeseries::RangeSet::parse(range);
            render::Layer layer{step.select(ranges), {render::Constant{{1, 0.5, 0.1}}, 0.3}};
            if (isOrdered) layer.style.color = render::ByValue{{}, 0, 1};
            layer.cells.ranges = timeseries::betweenPoints(ranges, step.type());
            render::Scene scene{
                .step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = isOrdered ? render::Order::BackToFront : render::Order::None,
                .clip = {}};
            scene.opacityPer = render::OpacityPer::Crossing;
            if (byCells) {
                scene.cells = step.cells();
                layer.cells.candidates = scene.cells->select(layer.cells.ranges);
            }
            scene.layers.push_back(layer);
            pictures.push_back(
                {scene, tests::lookFrom(away * glm::dvec3(0.5, -1, 0.4), kForetoldSize)});
        }
    return pictures;
}

// Each picture from all others: what was foretold over what its frames took. Sorted by how far off.
std::vector<double> foretold(const std::vector<Picture>& pictures) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        render::FramePace pace(std::chrono::milliseconds(16));
        // The last eight are remembered, of all views.
        for (std::size_t k = 1; k < pictures.size(); ++k) {
            const Picture& other = pictures[(i + 5 * k) % pictures.size()];
            pace.took(other.cost, std::chrono::nanoseconds(std::llround(1e9 * other.seconds)));
        }
        ratios.push_back(static_cast<double>(pace.predicted(pictures[i].cost).count()) /
                         (1e9 * pictures[i].seconds));
    }
    std::ranges::sort(ratios, {}, [](double ratio) { return std::abs(std::log(ratio)); });
    return ratios;
}

void foretoldFrame(benchmark::State& state, render::SplatterChoice by) {
    using Clock = std::chrono::steady_clock;
    // As many as a frame of some milliseconds has.
    const auto step = foretoldStep(state.range(0) != 0, state.range(1) != 0 ? 40 : 96);
    const render::PlacedPoints placed(step.grid());
    auto pictures = picturesOf(step, placed, state.range(1) != 0, state.range(2) != 0);
    for (auto _ : state)
        for (Picture& picture : pictures) {
            picture.cost = static_cast<std::uint64_t>(
                render::sceneCost(picture.scene, picture.view,
                                  by == render::SplatterChoice::Cpu ? render::SummedBy::Program
                                                                    : render::SummedBy::Gl) +
                (by == render::SplatterChoice::Cpu ? render::planesCost(picture.scene, picture.view)
                                                   : 0));
            render::PlainFrame frame(step, placed, glm::dvec3(0), by);
            frame.draw(picture.scene, picture.view);  // makes room
            std::vector<double> times;
            for (int i = 0; i < kForetoldFrames; ++i) {
                const auto start = Clock::now();
                frame.draw(picture.scene, picture.view);
                times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
            }
            picture.seconds = bench::median(times);
        }
    const std::vector<double> ratios = foretold(pictures);
    const auto within =
        std::ranges::count_if(ratios, [](double ratio) { return std::abs(ratio - 1) <= 0.25; });
    state.counters["within25"] = static_cast<double>(within) / static_cast<double>(ratios.size());
    state.counters["middling"] = ratios[ratios.size() / 2];
    state.counters["worst"] = ratios.back();
}
void BM_ForetoldFrame(benchmark::State& state) {
    foretoldFrame(state, render::SplatterChoice::Cpu);
}
// On a GPU.
void glForetoldFrame(benchmark::State& state) {
    const render::gl::HeadlessContext context;
    foretoldFrame(state, render::SplatterChoice::Gl);
    state.SetLabel(context.renderer());
}
void everyKind(benchmark::internal::Benchmark* of) {
    of->ArgNames({"noise", "cells", "ordered"})
        ->ArgsProduct({{0, 1}, {0, 1}, {0, 1}})
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}
BENCHMARK(BM_ForetoldFrame)->Apply(everyKind);
BENCHMARK(glForetoldFrame)->Apply(everyKind);

}  // namespace

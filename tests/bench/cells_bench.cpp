// Interval volumes by cells: making the index, finding cells in it, and drawing them beside as many
// points of the same field, by tiles.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "render/frame/plain_frame.h"
#include "render/reference/cell_pick.h"
#include "render/splat/cell_splatter.h"
#include "render/splat/tile_splatter.h"
#include "tests/bench/alternate.h"
#include "tests/bench/cells_of_range.h"
#include "tests/bench/turbulence.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/unstructured.h"
#include "timeseries/index/cell_index.h"

namespace {

using namespace render;
using bench::CellsOfRange;
using bench::kMiddle;
using bench::kSpread;
using timeseries::CellIndex;
using timeseries::Interval;
using timeseries::SortedStep;

void cellIndex(benchmark::State& state) {
    const timeseries::Field field =
        bench::turbulence<float>(static_cast<std::size_t>(state.range(0)));
    std::uint64_t cells = 0;
    for (auto _ : state) {
        state.PauseTiming();
        timeseries::Field copy = field;
        state.ResumeTiming();
        const CellIndex index(std::move(copy));
        cells = index.count();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
}
BENCHMARK(cellIndex)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

// A range of so many thousandths of the spread. Counters: cells looked at, and those that it needs.
void cellSelect(benchmark::State& state) {
    const CellIndex index(bench::turbulence<float>(256));
    const double half = kSpread * static_cast<double>(state.range(0)) / 2000;
    const std::vector<Interval<double>> range = {{kMiddle - half, kMiddle + half}};
    for (auto _ : state) benchmark::DoNotOptimize(index.select(range));
    double looked = 0, needed = 0;
    for (const timeseries::Run& run : index.select(range))
        for (std::uint64_t i = 0; i < run.count; ++i) {
            const auto corners = index.cornersOf().values(
                timeseries::indicesOf(index.cell(run.first + i), index.size()));
            const auto [lo, hi] = std::ranges::minmax(corners);
            ++looked;
            needed += lo <= range[0].hi && hi >= range[0].lo ? 1 : 0;
        }
    state.counters["looked/needed"] = looked / needed;
    state.counters["cells"] = needed;
}
BENCHMARK(cellSelect)->Arg(1000)->Arg(100)->Arg(10)->Unit(benchmark::kMicrosecond);

void cellsBesidePoints(benchmark::State& state) {
    CellsOfRange cells(bench::turbulence<float>(static_cast<std::size_t>(state.range(0))),
                       state.range(1), state.range(2) != 0);
    const Scene& scene = cells.scene;
    const SortedStep& step = cells.step;
    const std::uint64_t count = cellCount(scene.layers[0]);
    const View& view = cells.view;
    const Channels channels = channelsFor(scene)[0];

    Scene points = scene;
    points.cells.reset();
    const timeseries::Run middle{step.size() / 2 - count / 2, count};
    points.layers[0].runs = {middle};
    DrawList list = Runs{};
    if (state.range(2)) {
        Sorted sorted;
        for (std::uint64_t i = 0; i < count; ++i)
            sorted.point.push_back(static_cast<std::uint32_t>(middle.first + i));
        sorted.layer.assign(count, 0);
        list = std::move(sorted);
    }
    constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
    TileMemory tiles;
    bench::alternate(
        state,
        [&] {
            TileSum sum(points, list, view, channels, 0, {}, sharingThreads(), std::move(tiles));
            while (!sum.done()) sum.add(kAll);
            tiles = sum.takeMemory();
        },
        [&] { cells.draw(channels); });
    state.counters["cells"] = static_cast<double>(count);
}
BENCHMARK(cellsBesidePoints)
    ->ArgNames({"points", "thousandths", "ordered"})
    ->Args({96, 100, 0})
    ->Args({96, 1000, 0})
    ->Args({96, 100, 1})
    ->Args({192, 100, 0})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

// Whole frames, the light resolved.
void litBesideUnlit(benchmark::State& state, CellsOfRange& cells) {
    PlainFrame frame(cells.scene.step, cells.scene.placed, glm::dvec3(0));
    const auto draw = [&](Light light) {
        cells.scene.light = light;
        frame.draw(cells.scene, cells.view);
    };
    bench::alternate(
        state, [&] { draw(Light::Off); }, [&] { draw(Light::Full); });
    state.counters["cells"] = static_cast<double>(cellCount(cells.scene.layers[0]));
}

// Coloured by value and in order, lit beside not.
void cellsLitBesideUnlit(benchmark::State& state) {
    bench::FireOrTurbulence cells(state.range(0), true);
    litBesideUnlit(state, cells);
}
BENCHMARK(cellsLitBesideUnlit)
    ->ArgName("points")
    ->Arg(0)
    ->Arg(96)
    ->Arg(192)
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);

// Cells that are tetrahedra, beside those of the upright grid.
void cellsOfMeshBesideUpright(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    timeseries::Field field = bench::turbulence<float>(n);
    timeseries::Field meshed = field;
    meshed.grid = bench::latticeOneByOne(n, state.range(3) != 0);
    CellsOfRange upright(std::move(field), state.range(1), state.range(2) != 0);
    CellsOfRange mesh(std::move(meshed), state.range(1), state.range(2) != 0);
    const Channels channels = channelsFor(upright.scene)[0];
    bench::alternate(
        state, [&] { upright.draw(channels); }, [&] { mesh.draw(channels); });
    state.counters["cells"] = static_cast<double>(cellCount(mesh.scene.layers[0]));
}
BENCHMARK(cellsOfMeshBesideUpright)
    ->ArgNames({"points", "thousandths", "ordered", "solids"})
    ->ArgsProduct({{96}, {100}, {0, 1}, {0, 1}})
    ->ArgsProduct({{96}, {1000}, {0}, {0, 1}})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

// Tetrahedra lit by the gradients of points, beside not lit.
void tetsLitBesideUnlit(benchmark::State& state) {
    timeseries::Field field = bench::turbulence<float>(96);
    field.grid = bench::latticeOneByOne(96, state.range(0) != 0);
    CellsOfRange mesh(std::move(field), 100, true);
    mesh.scene.gradients = mesh.step.gradients(mesh.placed.mesh());
    litBesideUnlit(state, mesh);
}
BENCHMARK(tetsLitBesideUnlit)
    ->ArgName("solids")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

// Whole frames of tetrahedra in the order of their cells' faces, beside that of their middles.
void tetsByFacesBesideMiddles(benchmark::State& state) {
    timeseries::Field field = bench::turbulence<float>(96);
    field.grid = bench::latticeOneByOne(96, state.range(0) != 0);
    CellsOfRange byFaces(field, 100, true), byMiddles(std::move(field), 100, true);
    byMiddles.scene.byMiddles = true;
    bench::alternate(
        state, [&] { byMiddles.draw(Channels::Over); }, [&] { byFaces.draw(Channels::Over); });
}
BENCHMARK(tetsByFacesBesideMiddles)
    ->ArgName("solids")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

// An eye among the cells, beside one that sees them all from outside. Of one layer of each grid a
// part is behind the eye.
void cellsFromWithin(benchmark::State& state) {
    timeseries::Field field = bench::turbulence<float>(96);
    if (state.range(0) > 0) field.grid = bench::latticeOneByOne(96, state.range(0) == 2);
    const bool isOrdered = state.range(1) != 0;
    CellsOfRange outside(field, 1000, isOrdered), within(std::move(field), 1000, isOrdered);
    within.view = tests::lookFrom({0.06, -0.11, 0.05}, {1024, 1024}, 0.36);
    const Channels channels = channelsFor(outside.scene)[0];
    bench::alternate(
        state, [&] { outside.draw(channels); }, [&] { within.draw(channels); });
}
BENCHMARK(cellsFromWithin)
    ->ArgNames({"kind", "ordered"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// How a field changes about the points of a mesh, beside the list of its cells by value.
void gradientsBesideCells(benchmark::State& state) {
    timeseries::Field made = bench::turbulence<float>(128);
    made.grid = bench::latticeOneByOne(128, state.range(0) != 0);
    const auto field = std::make_shared<const timeseries::Field>(std::move(made));
    bench::alternate(
        state, [&] { timeseries::CellIndex{field}; },
        [&] { timeseries::PointGradients(*field, field->grid->mesh()); });
}
BENCHMARK(gradientsBesideCells)
    ->ArgName("solids")
    ->Arg(0)
    ->Arg(1)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// What is under the cursor, in the middle of the picture.
void cellUnderCursorOfMesh(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    timeseries::Field field = bench::turbulence<float>(n);
    field.grid = bench::latticeOneByOne(n, state.range(2) != 0);
    const CellsOfRange mesh(std::move(field), state.range(1), true);
    for (auto _ : state)
        benchmark::DoNotOptimize(pickCell(mesh.scene, mesh.view, glm::dvec2(mesh.view.size) / 2.0));
    state.counters["cells"] = static_cast<double>(cellCount(mesh.scene.layers[0]));
}
BENCHMARK(cellUnderCursorOfMesh)
    ->ArgNames({"points", "thousandths", "solids"})
    ->ArgsProduct({{96}, {1000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

// The program itself on files: first pictures, a large step, a series of pictures.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tests/bench/program_run.h"
#include "tests/bench/turbulence.h"
#include "tests/ui/temporary_folder.h"
#include "timeseries/index/sorted_step.h"

namespace {

using bench::medianRun;
using bench::ProgramRun;
using bench::runProgram;
using ui::TemporaryFolder;

void tell(benchmark::State& state, const std::string& what, const ProgramRun& run) {
    state.counters[what + "_ms"] = run.ms;
    state.counters[what + "_MB"] = run.megabytes;
}

// The range of 1 % of the points about the median, as the command line has it.
std::string onePercent(const timeseries::Field& field) {
    const auto step = timeseries::SortedStep::build(field);
    const auto at = [&](double fraction) {
        return timeseries::toText(step.value(
            static_cast<std::uint64_t>(fraction * static_cast<double>(step.size() - 1))));
    };
    return at(0.495) + ":" + at(0.505);
}

// A file of n^3 floats with an index, of which 1 % about the median are drawn.
struct IndexedFile {
    TemporaryFolder folder;
    std::string file = folder.path() / "field.nrrd", cache = folder.path() / "cache",
                picture = folder.path() / "picture.png", range;
    ProgramRun index;

    explicit IndexedFile(std::size_t n) {
        const timeseries::Field field = bench::turbulence<float>(n);
        bench::writeField(file, "float", n, std::get<std::vector<float>>(field.values));
        range = onePercent(field);
        index = runProgram({"index", file, "--cache", cache});
    }
};

// The first picture by the program: without an index and with one.
void storePicture(benchmark::State& state) {
    const IndexedFile of(static_cast<std::size_t>(state.range(0)));
    const auto& [folder, file, cache, picture, range, index] = of;
    tell(state, "index", index);
    for (auto _ : state)
        for (const std::string model : {"cells", "points"})
            for (const std::string from : {"file", "index"})
                tell(state, model + "_" + from,
                     medianRun({"render", file, "--model", model, "--range", range, "--cache",
                                from == "index" ? cache : "off", "-o", picture}));
}
BENCHMARK(storePicture)->ArgNames({"points"})->Arg(512)->Unit(benchmark::kSecond)->Iterations(1);

// By points, as drawn by the program and by a former one (ISOCHRON_FORMER), which has no index, by
// turns.
void formerPicture(benchmark::State& state) {
    const char* const former = std::getenv("ISOCHRON_FORMER");
    if (!former) return state.SkipWithError("expected ISOCHRON_FORMER to name a program");
    const IndexedFile of(static_cast<std::size_t>(state.range(0)));
    std::vector<double> now, before;
    for (auto _ : state) {
        now.push_back(runProgram({"render", of.file, "--model", "points", "--range", of.range,
                                  "--cache", of.cache, "-o", of.picture})
                          .ms);
        before.push_back(
            runProgram({"render", of.file, "--range", of.range, "-o", of.picture}, former).ms);
    }
    state.counters["now_ms"] = bench::median(now);
    state.counters["former_ms"] = bench::median(before);
}
BENCHMARK(formerPicture)->ArgNames({"points"})->Arg(512)->Unit(benchmark::kSecond)->Iterations(5);

#ifdef VTK_FIRST_PICTURE
// From nothing to a PNG: the program, its error told, and one of VTK's, by turns; neither has an
// index. VTK draws through X.
void vtkFirstPicture(benchmark::State& state) {
    if (!std::getenv("DISPLAY"))
        return state.SkipWithError("VTK draws through X: run under xvfb-run");
    const auto n = static_cast<std::size_t>(state.range(0));
    const TemporaryFolder folder;
    const std::string file = folder.path() / "field.nrrd", picture = folder.path() / "picture.png";
    const timeseries::Field field = bench::turbulence<float>(n);
    bench::writeField(file, "float", n, std::get<std::vector<float>>(field.values));
    const std::string range = onePercent(field);
    const std::size_t colon = range.find(':');
    std::vector<double> now, vtk;
    for (auto _ : state) {
        now.push_back(runProgram({"render", file, "--model", "points", "--range", range, "--cache",
                                  "off", "-o", picture})
                          .ms);
        vtk.push_back(runProgram({file, range.substr(0, colon), range.substr(colon + 1), picture},
                                 VTK_FIRST_PICTURE)
                          .ms);
    }
    state.counters["now_ms"] = bench::median(now);
    state.counters["vtk_ms"] = bench::median(vtk);
}
BENCHMARK(vtkFirstPicture)
    ->ArgNames({"points"})
    ->Arg(256)
    ->Arg(512)
    ->Unit(benchmark::kSecond)
    ->Iterations(5);
#endif

// A step of 1024^3 bytes: sorted, counted and drawn by the program.
void storeLarge(benchmark::State& state) {
    const TemporaryFolder folder;
    const std::string file = folder.path() / "field.nrrd", cache = folder.path() / "cache";
    {
        const auto n = static_cast<std::size_t>(state.range(0));
        const timeseries::Field field = bench::turbulence<std::uint8_t>(n);
        const auto& values = std::get<std::vector<std::uint8_t>>(field.values);
        state.counters["selected"] =
            static_cast<double>(std::ranges::count(values, std::uint8_t{32}));
        bench::writeField(file, "uint8", n, values);
    }
    tell(state, "alone",
         runProgram(
             {"render", file, "--cache", "off", "--range", "32", "-o", folder.path() / "a.png"}));
    tell(state, "index", runProgram({"index", file, "--cache", cache}));
    for (auto _ : state) {
        tell(state, "count", medianRun({"count", file, "--cache", cache, "--range", "32"}));
        tell(state, "render",
             medianRun({"render", file, "--cache", cache, "--range", "32", "-o",
                        folder.path() / "b.png"}));
    }
}
BENCHMARK(storeLarge)->ArgNames({"points"})->Arg(1024)->Unit(benchmark::kSecond)->Iterations(1);

// Pictures of 1024 x 1024 of a series of n^3 floats, 1 % of each step. So many that what is done
// once, the error of one of them above all, is a small part.
void stageSeries(benchmark::State& state) {
    constexpr std::size_t kSteps = 120, kFields = 12;
    const TemporaryFolder folder;
    std::string range;
    {
        const auto n = static_cast<std::size_t>(state.range(0));
        timeseries::Field field = bench::turbulence<float>(n);
        range = onePercent(field);
        auto& values = std::get<std::vector<float>>(field.values);
        const auto fileOf = [&](std::size_t step) {
            return folder.path() / fmt::format("step_{:03}.nrrd", step);
        };
        for (std::size_t i = 0; i < kFields; ++i) {
            bench::writeField(fileOf(i), "float", n, values);
            std::ranges::rotate(values, values.begin() + 3 * n + 1);  // it drifts
        }
        for (std::size_t i = kFields; i < kSteps; ++i)
            std::filesystem::create_hard_link(fileOf(i % kFields), fileOf(i));
    }
    for (auto _ : state)
        for (const std::string model : {"cells", "points"})
            for (const std::string kind : {"png", "exr"}) {
                const ProgramRun run =
                    runProgram({"render", folder.path() / "step_000.nrrd", "--step", "all",
                                "--cache", "off", "--model", model, "--range", range, "--size",
                                "1024x1024", "-o", folder.path() / ("picture." + kind)});
                state.counters[model + "_" + kind + "_ms"] = run.ms / kSteps;
            }
}
BENCHMARK(stageSeries)->ArgNames({"points"})->Arg(128)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace

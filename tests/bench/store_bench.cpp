// Sorted steps on disk, beside reading and sorting the file.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/bench/alternate.h"
#include "tests/bench/program_run.h"
#include "tests/bench/turbulence.h"
#include "tests/support/built_paths.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/step_about.h"
#include "timeseries/series/step_maker.h"

namespace {

namespace fs = std::filesystem;
using timeseries::RangeSet;
using timeseries::SortedStep;
using timeseries::StepMaker;
using timeseries::StepStore;

// A file of n^3 floats and a store for it, removed when another is asked for.
struct World {
    explicit World(std::size_t n)
        : folder(fs::temp_directory_path() / ("isochron-store-" + std::to_string(::getpid()))),
          file(folder / "field.nrrd"),
          points(n * n * n) {
        fs::create_directories(folder);
        bench::writeField(file, "float", n,
                          std::get<std::vector<float>>(bench::turbulence<float>(n).values));
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;
    ~World() {
        std::error_code gone;
        fs::remove_all(folder, gone);
    }

    StepMaker maker(bool stored) const {
        auto reader = timeseries::openReader(std::span(&file, 1));
        timeseries::StepStores stores;
        if (stored) stores = {{store}, store, 1};
        return {std::move(reader), 0, RangeSet::everything(), stores};
    }
    std::shared_ptr<const timeseries::StepFile> index() {
        if (!written) {
            maker(true).keep(0);
            written = true;
        }
        const auto reader = timeseries::openReader(std::span(&file, 1));
        return store->look(*timeseries::originOf(*reader, 0, 0));
    }

    fs::path folder, file;
    std::uint64_t points;
    bool written = false;
    std::shared_ptr<StepStore> store =
        std::make_shared<StepStore>(folder / "steps", timeseries::StoreKind::Cache,
                                    StepStore::kNoBudget, std::chrono::milliseconds(0));
};

World& world(std::size_t n) {
    static std::unique_ptr<World> only;
    static std::size_t of = 0;
    if (of != n) {
        only.reset();
        only = std::make_unique<World>(n);
        of = n;
    }
    return *only;
}

// A range of this share of the points about the median.
RangeSet rangeOf(const SortedStep& step, double share) {
    const auto at = [&](double fraction) {
        return step.value(
            static_cast<std::uint64_t>(fraction * static_cast<double>(step.size() - 1)));
    };
    return RangeSet(std::vector<timeseries::Range>{{{at(.5 - share / 2)}, {at(.5 + share / 2)}}});
}

void show(StepMaker maker, const RangeSet& range) {
    const auto step = maker.make(0);
    const std::vector<timeseries::Run> runs = step->select(range);
    benchmark::DoNotOptimize(step->columns(runs).gridIndex.data());
}

// The points of a range, from nothing: opened and read by block; read and sorted.
void storeRange(benchmark::State& state) {
    World& w = world(static_cast<std::size_t>(state.range(0)));
    const auto index = w.index();
    const RangeSet range =
        rangeOf(*w.maker(true).make(0), static_cast<double>(state.range(1)) * 1e-3);
    std::uint64_t bytes = 0, ids = 0;
    const auto selected = w.maker(true).make(0)->select(range);
    for (const timeseries::StepBlock& block : index->blocks()) {
        ids += block.idsBytes;
        const auto first =
            static_cast<std::uint64_t>(&block - index->blocks().data()) * timeseries::kStepBlock;
        for (const timeseries::Run& run : selected)
            if (first < run.first + run.count && run.first < first + block.count)
                bytes += block.idsBytes + block.keysBytes;
    }
    bench::alternate(
        state, [&] { show(w.maker(true), range); }, [&] { show(w.maker(false), range); }, 10);
    // With the index out of the system's cache.
    bench::Cost cold;
    for (int i = 0; i < 7; ++i) {
        const int file = ::open(index->name().c_str(), O_RDONLY);
        ::fdatasync(file);
        ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
        ::close(file);
        bench::measure(cold, 1, [&] { show(w.maker(true), range); });
    }
    state.counters["cold_ms"] = bench::median(cold.ms);
    state.counters["read"] = static_cast<double>(bytes);
    state.counters["ids"] = static_cast<double>(ids) / static_cast<double>(w.points);
    state.counters["file"] = static_cast<double>(index->bytes()) / static_cast<double>(w.points);
}
BENCHMARK(storeRange)
    ->ArgNames({"points", "thousandths"})
    ->Args({256, 10})
    ->Args({512, 1})
    ->Args({512, 10})
    ->Args({512, 100})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

// A file read, sorted and written, on one thread and on all.
void storeWrite(benchmark::State& state) {
    World& w = world(static_cast<std::size_t>(state.range(0)));
    const auto keep = [&](unsigned threads) {
        timeseries::threadLimit = threads;
        w.store->clear();
        benchmark::DoNotOptimize(w.maker(true).keep(0));
        timeseries::threadLimit = 0;
    };
    bench::alternate(
        state, [&] { keep(0); }, [&] { keep(1); });
    w.written = true;
    state.counters["points"] = static_cast<double>(w.points);
}
BENCHMARK(storeWrite)->ArgNames({"points"})->Arg(256)->Unit(benchmark::kMillisecond)->Iterations(9);

// A series of sorted steps opened, to the points of its first: a name each for one file.
void storeSeries(benchmark::State& state) {
    const fs::path folder =
        fs::temp_directory_path() / ("isochron-series-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    std::vector<fs::path> paths;
    for (std::int64_t i = 0; i < state.range(0); ++i) {
        paths.push_back(folder / ("u_" + std::to_string(100'000 + i) + ".isostep"));
        if (i > 0) {
            fs::create_hard_link(paths.front(), paths.back());
            continue;
        }
        timeseries::WholeFile file(paths.back());
        writeStep(SortedStep::build(bench::turbulence<float>(64)),
                  textOf(timeseries::StepAbout{"u", "", 0, "", {}}), file);
        file.finish();
    }
    bench::Cost cost;
    for (auto _ : state)
        bench::measure(cost, 1, [&] {
            StepMaker maker(timeseries::openReader(paths), 0, RangeSet::everything());
            benchmark::DoNotOptimize(maker.make(0)->columns().gridIndex.data());
        });
    state.counters["picture_ms"] =
        bench::medianRun({"render", paths.front().string(), "--range", "0.1:0.2", "-o",
                          (folder / "picture.png").string()})
            .ms;
    fs::remove_all(folder);
    state.counters["first_ms"] = bench::median(cost.ms);
}
BENCHMARK(storeSeries)
    ->ArgNames({"steps"})
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

#ifdef MPIRUN
// A file read, sorted and written by the program, as two processes and as one, each on one thread.
void storeRanks(benchmark::State& state) {
    World& w = world(static_cast<std::size_t>(state.range(0)));
    const fs::path cache = w.folder / "ranks";
    const auto index = [&](int ranks) {
        fs::remove_all(cache);
        const std::string command = std::string(MPIRUN) + " " + std::to_string(ranks) + " " +
                                    tests::program().string() + " index " + w.file.string() +
                                    " --threads 1 --cache " + cache.string() + " >/dev/null";
        if (std::system(command.c_str()) != 0) state.SkipWithError("mpirun failed");
    };
    bench::alternate(
        state, [&] { index(2); }, [&] { index(1); });
    state.counters["points"] = static_cast<double>(w.points);
}
BENCHMARK(storeRanks)->ArgNames({"points"})->Arg(400)->Unit(benchmark::kMillisecond)->Iterations(5);
#endif

}  // namespace

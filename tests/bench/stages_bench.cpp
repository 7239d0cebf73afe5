// What each stage costs from a file to a picture: n^3 points, of which some per mille are selected.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <netcdf.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/model/footprint.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_targets.h"
#include "tests/bench/volumes.h"
#include "timeseries/readers/reader.h"

namespace {

using namespace render;
using bench::volume;

std::size_t points(const benchmark::State& state) {
    return static_cast<std::size_t>(state.range(0));
}
double share(const benchmark::State& state) { return static_cast<double>(state.range(1)) / 1000; }

// A file in the temporary folder while it is measured.
struct TemporaryFile {
    explicit TemporaryFile(const char* extension)
        : path(std::filesystem::temp_directory_path() /
               fmt::format("isochron-bench-{}{}", getpid(), extension)) {}
    ~TemporaryFile() { std::filesystem::remove(path); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::filesystem::path path;
};

void writeNrrd(const std::filesystem::path& path, const bench::Volume& v) {
    std::ofstream out(path, std::ios::binary);
    out << fmt::format(
        "NRRD0004\ntype: float\ndimension: 3\nsizes: {0} {0} {0}\nencoding: raw\nendian: "
        "little\n\n",
        v.points);
    const auto& values = v.values();
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof values[0]));
    if (!out.flush()) throw std::runtime_error("no room for " + path.string());
}

void writeNetcdf(const std::filesystem::path& path, const bench::Volume& v) {
    const auto check = [](int status) {
        if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
    };
    int file = 0, variable = 0;
    std::array<int, 3> dimensions{};
    check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file));
    for (std::size_t a = 0; a < 3; ++a)
        check(nc_def_dim(file, std::array{"z", "y", "x"}[a], v.points, &dimensions[a]));
    check(nc_def_var(file, "f", NC_FLOAT, 3, dimensions.data(), &variable));
    check(nc_put_var_float(file, variable, v.values().data()));
    check(nc_close(file));
}

// Opens the file and reads its one step; the file is in the system's cache.
void read(benchmark::State& state, const char* extension,
          void (*write)(const std::filesystem::path&, const bench::Volume&)) {
    const bench::Volume& v = volume(points(state));
    const TemporaryFile file(extension);
    write(file.path, v);
    for (auto _ : state) {
        const timeseries::Field field =
            timeseries::openReader(std::span(&file.path, 1))->read(0, 0);
        benchmark::DoNotOptimize(field.values.index());
    }
    state.SetBytesProcessed(state.iterations() *
                            static_cast<std::int64_t>(v.values().size() * sizeof(float)));
}
void stageReadNrrd(benchmark::State& state) { read(state, ".nrrd", writeNrrd); }
void stageReadNetcdf(benchmark::State& state) { read(state, ".nc", writeNetcdf); }

void stageBuild(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    for (auto _ : state) benchmark::DoNotOptimize(timeseries::SortedStep::build(v.field).size());
}

void stageSelect(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    const auto range = v.rangeSet(share(state));
    for (auto _ : state) benchmark::DoNotOptimize(v.step.select(range));
}

void stageCount(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    const auto range = v.rangeSet(share(state));
    for (auto _ : state) benchmark::DoNotOptimize(v.step.count(range));
}

// The selection's first picture: its blocks are brought into drawing order and uploaded.
void stageUpload(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    const Scene scene = v.scene(share(state));
    const gl::HeadlessContext context;
    GlSplatter splatter;
    for (auto _ : state) {
        GlStep onGpu(v.step, v.placed);
        onGpu.upload(scene, {});
        benchmark::DoNotOptimize(splatter.upload(scene, Runs{}, onGpu));
        glFinish();
    }
}

void stageOrder(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    Scene scene = v.scene(share(state));
    scene.order = Order::BackToFront;
    DepthOrder order;
    for (auto _ : state) benchmark::DoNotOptimize(order(scene, pixelRays(bench::outside()).eye));
}

// The splats alone, into a cleared plane.
void stageDraw(benchmark::State& state) {
    const bench::Volume& v = volume(points(state));
    const Scene scene = v.scene(share(state));
    const gl::HeadlessContext context;
    GlSplatter splatter;
    GlStep onGpu(v.step, v.placed);
    GlTargets targets(bench::kPicture);
    gl::begin(
        {.framebuffer = targets.lightFramebuffer(), .size = bench::kPicture, .clearDepth = 1.0f});
    onGpu.upload(scene, {});
    const auto list = splatter.upload(scene, Runs{}, onGpu);
    for (auto _ : state) {
        splatter.draw(*list, bench::outside(), Channels::Weight, 0,
                      targets.clearedPlane(0, Channels::Weight));
        glFinish();
    }
    state.counters["splats"] = static_cast<double>(v.step.count(v.rangeSet(share(state))));
    // The footprint in the middle of the picture.
    state.counters["diameter"] = 2 * kQuarticRadius * v.placed.unitLength() / std::sqrt(11.0) *
                                 pixelRays(bench::outside()).focal.y;
}

// All of a frame but splats: axes, clears, resolve.
void stageResolve(benchmark::State& state) {
    const bench::Volume& v = volume(64);
    Scene scene = v.scene(0.01);
    scene.layers[0].runs.clear();
    const gl::HeadlessContext context;
    GlStep onGpu(v.step, v.placed);
    FrameRenderer renderer;
    const std::array views{bench::outside()};
    const FrameContent content{scene, v.step.grid(), {}, glm::dvec3(0)};
    for (auto _ : state) {
        renderer.drawEye(renderer.prepare(content, onGpu, views), views[0]);
        glFinish();
    }
    state.SetLabel(context.renderer());
}

using Stage = void (*)(benchmark::State&);

benchmark::internal::Benchmark* add(const char* name, Stage stage) {
    return benchmark::RegisterBenchmark(name, stage)->Unit(benchmark::kMillisecond)->UseRealTime();
}

bool registerStages() {
    add("stageResolve", stageResolve);
    // Size by size, as one volume is held at a time.
    for (const int n : {64, 128, 256, 512}) {
        add("stageReadNrrd", stageReadNrrd)->Arg(n);
        add("stageReadNetcdf", stageReadNetcdf)->Arg(n);
        add("stageBuild", stageBuild)->Arg(n);
        for (const int perMille : {100, 10, 1}) {
            add("stageSelect", stageSelect)->Args({n, perMille})->Unit(benchmark::kNanosecond);
            add("stageCount", stageCount)->Args({n, perMille})->Unit(benchmark::kNanosecond);
            add("stageUpload", stageUpload)->Args({n, perMille});
            add("stageOrder", stageOrder)->Args({n, perMille});
            add("stageDraw", stageDraw)->Args({n, perMille});
        }
    }
    return true;
}
[[maybe_unused]] const bool registered = registerStages();

}  // namespace

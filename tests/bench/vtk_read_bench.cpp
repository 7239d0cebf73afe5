// Opening an unstructured grid and reading a step of it (second), beside VTK's own reader (first),
// which measures no cell; and a series of many small ones.
#include <benchmark/benchmark.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <filesystem>

#include "app/files/dataset.h"
#include "tests/bench/alternate.h"
#include "tests/bench/median.h"
#include "tests/support/unstructured.h"
#include "timeseries/readers/reader.h"

namespace {

// So many hexahedra along each side, bent or not, with one value each, at this time.
void write(const std::filesystem::path& path, std::uint32_t side, bool isBent, double time = 0) {
    const auto grid = tests::bricks(
        {side + 1, side + 1, side + 1}, tests::Cut::Hexahedra, [&](double i, double j, double k) {
            return glm::dvec3(i, j, isBent ? k + 0.2 * std::sin(0.3 * i) * std::cos(0.4 * j) : k);
        });
    const vtkNew<vtkPoints> points;
    for (const glm::dvec3& at : grid.points) points->InsertNextPoint(at.x, at.y, at.z);
    const vtkNew<vtkUnstructuredGrid> data;
    data->SetPoints(points);
    const vtkNew<vtkFloatArray> values;
    values->SetName("f");
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        vtkIdType corners[8];
        std::copy_n(&grid.corners[8 * cell], 8, corners);
        data->InsertNextCell(grid.types[cell], 8, corners);
        values->InsertNextValue(static_cast<float>(cell));
    }
    data->GetCellData()->AddArray(values);
    const vtkNew<vtkDoubleArray> at;
    at->SetName("TimeValue");
    at->InsertNextValue(time);
    data->GetFieldData()->AddArray(at);
    const vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->Write();
}

void meshOpen(benchmark::State& state) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "mesh_open.vtu";
    write(path, static_cast<std::uint32_t>(state.range(0)), state.range(1) != 0);
    bench::alternate(
        state,
        [&] {
            const vtkNew<vtkXMLUnstructuredGridReader> reader;
            reader->SetFileName(path.c_str());
            reader->Update();
            benchmark::DoNotOptimize(reader->GetOutput());
        },
        [&] {
            const auto reader = timeseries::openReader(std::span(&path, 1));
            benchmark::DoNotOptimize(reader->read(0, 0));
        });
    std::filesystem::remove(path);
}
BENCHMARK(meshOpen)
    ->ArgNames({"side", "bent"})
    ->ArgsProduct({{100, 170}, {0, 1}})
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

// A numbered series opened by one of its names, to the values of its first step.
void meshSeries(benchmark::State& state) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("isochron-meshes-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const auto pathOf = [&](std::int64_t i) {
        return folder / ("run_" + std::to_string(1000 + i) + ".vtu");
    };
    for (std::int64_t i = 0; i < state.range(0); ++i)
        write(pathOf(i), 10, true, 0.1 * static_cast<double>(i));
    const auto first = pathOf(0);
    bench::Cost cost;
    for (auto _ : state)
        bench::measure(cost, 1, [&] {
            const auto dataset = app::openDataset(std::span(&first, 1), "");
            benchmark::DoNotOptimize(dataset.reader->read(dataset.variableIndex, 0));
        });
    std::filesystem::remove_all(folder);
    state.counters["first_ms"] = bench::median(cost.ms);
}
BENCHMARK(meshSeries)->ArgNames({"steps"})->Arg(4500)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

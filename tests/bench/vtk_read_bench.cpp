// Opening an unstructured grid and reading a step of it (second), beside VTK's own reader (first),
// which measures no cell.
#include <benchmark/benchmark.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <filesystem>

#include "tests/bench/alternate.h"
#include "tests/support/unstructured.h"
#include "timeseries/readers/reader.h"

namespace {

// So many hexahedra along each side, bent or not, with one value each.
void write(const std::filesystem::path& path, std::uint32_t side, bool isBent) {
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

}  // namespace

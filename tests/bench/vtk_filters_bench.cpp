// Ours (first) and VTK's (second) way to the points of a range, to a first look, and to an order,
// by turns. VTK gets the same values without a copy; one thread where it does not say otherwise.
#include <benchmark/benchmark.h>
#include <vtkCamera.h>
#include <vtkDepthSortPolyData.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkThresholdPoints.h>

#include "render/gl/headless_context.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_list.h"
#include "tests/bench/alternate.h"
#include "tests/bench/volumes.h"

namespace {

using namespace render;

// The volume's values as VTK's image, not copied.
void share(const bench::Volume& v, vtkImageData* image) {
    vtkNew<vtkFloatArray> values;
    values->SetArray(const_cast<float*>(v.values().data()),
                     static_cast<vtkIdType>(v.values().size()), 1);
    values->SetName("f");
    const int n = static_cast<int>(v.points);
    image->SetDimensions(n, n, n);
    image->GetPointData()->SetScalars(values);
}

const bench::Volume& volume(const benchmark::State& state) {
    return bench::volume(static_cast<std::size_t>(state.range(0)));
}
double selectedShare(const benchmark::State& state) {
    return static_cast<double>(state.range(1)) / 1000;
}

void threshold(vtkThresholdPoints* filter, const timeseries::Range& range) {
    filter->ThresholdBetween(std::get<double>(range.lo.value), std::get<double>(range.hi.value));
    filter->Modified();  // or nothing would be done the second time
    filter->Update();
}

void vtkSelect(benchmark::State& state) {
    const bench::Volume& v = volume(state);
    const auto range = v.range(selectedShare(state));
    const auto ranges = v.rangeSet(selectedShare(state));
    vtkNew<vtkImageData> image;
    share(v, image);
    vtkNew<vtkThresholdPoints> filter;
    filter->SetInputData(image);
    bench::alternate(
        state,
        [&] {
            benchmark::DoNotOptimize(v.step.select(ranges));
            benchmark::DoNotOptimize(v.step.count(ranges));
        },
        [&] { threshold(filter, range); }, 1000);
    state.counters["points"] = static_cast<double>(v.step.count(ranges));
    state.counters["points2"] = static_cast<double>(filter->GetOutput()->GetNumberOfPoints());
}

// A selection until it can be drawn: found, and sent to the GPU in drawing order.
void makeReady(const bench::Volume& v, double share, GlSplatter& splatter) {
    const Scene scene = v.scene(share);
    GlStep onGpu(v.step, v.placed);
    onGpu.upload(scene, {});
    benchmark::DoNotOptimize(splatter.upload(scene, Runs{}, onGpu));
    glFinish();
}

// Until the points can be drawn: ours lie on the GPU, in drawing order; VTK's in main memory.
void vtkSelectToDraw(benchmark::State& state) {
    const bench::Volume& v = volume(state);
    const auto range = v.range(selectedShare(state));
    vtkNew<vtkImageData> image;
    share(v, image);
    vtkNew<vtkThresholdPoints> filter;
    filter->SetInputData(image);
    const gl::HeadlessContext context;
    GlSplatter splatter;
    bench::alternate(
        state, [&] { makeReady(v, share(state), splatter); }, [&] { threshold(filter, range); });
}

// The contour of the median, the usual first look, beside a range about it made ready to draw.
void vtkContour(benchmark::State& state) {
    const bench::Volume& v = volume(state);
    vtkNew<vtkImageData> image;
    share(v, image);
    vtkNew<vtkFlyingEdges3D> contour;
    contour->SetInputData(image);
    contour->SetValue(0, timeseries::toDouble(v.step.value(v.step.size() / 2)));
    contour->ComputeNormalsOff();
    contour->ComputeScalarsOff();
    const gl::HeadlessContext context;
    GlSplatter splatter;
    bench::alternate(
        state, [&] { makeReady(v, share(state), splatter); },
        [&] {
            contour->Modified();
            contour->Update();
        });
    state.counters["triangles"] = static_cast<double>(contour->GetOutput()->GetNumberOfCells());
}

void vtkOrder(benchmark::State& state) {
    const bench::Volume& v = volume(state);
    Scene scene = v.scene(selectedShare(state));
    scene.order = Order::BackToFront;
    const glm::dvec3 eye = pixelRays(bench::outside()).eye;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (const auto& run : scene.layers[0].runs)
        for (std::uint64_t p = run.first; p < run.first + run.count; ++p) {
            const glm::dvec3 at = v.placed.position(v.step.gridIndex()[p]);
            const vtkIdType id = points->InsertNextPoint(at.x, at.y, at.z);
            cells->InsertNextCell(1, &id);
        }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    cloud->SetVerts(cells);
    vtkNew<vtkCamera> camera;
    camera->SetPosition(eye.x, eye.y, eye.z);
    camera->SetFocalPoint(0, 0, 0);
    vtkNew<vtkDepthSortPolyData> sort;
    sort->SetInputData(cloud);
    sort->SetCamera(camera);
    sort->SetDirectionToBackToFront();
    sort->SetDepthSortModeToFirstPoint();  // the quickest
    bench::alternate(
        state, [&] { benchmark::DoNotOptimize(order(scene, eye)); },
        [&] {
            sort->Modified();
            sort->Update();
        });
    state.counters["points"] = static_cast<double>(points->GetNumberOfPoints());
}

void shares(benchmark::internal::Benchmark* b) {
    b->Args({128, 10})->Args({256, 100})->Args({256, 10})->Args({256, 1});
    b->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(7);
}
BENCHMARK(vtkSelect)->Apply(shares);
BENCHMARK(vtkSelectToDraw)->Apply(shares);
BENCHMARK(vtkContour)->Args({128, 10})->Args({256, 10})->UseRealTime()->Iterations(7);
BENCHMARK(vtkOrder)->Args({256, 60})->Args({256, 6})->UseRealTime()->Iterations(5);
BENCHMARK(vtkSelect)->Args({512, 10})->UseRealTime()->Iterations(3);
BENCHMARK(vtkSelectToDraw)->Args({512, 10})->UseRealTime()->Iterations(3);

}  // namespace

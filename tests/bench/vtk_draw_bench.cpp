// Ours (first) and vtkPointGaussianMapper (second) draw the same points, by turns, into pictures of
// the same size from the same view. VTK of Debian draws through X only, so it needs a display (Xvfb
// will do) and has a thread and a context of its own; both are drawn by the same driver. Each frame
// is waited for by glFinish; VTK's points are on the GPU before, in the order of the grid, as a
// filter would give them. Ours has axes, sums in 32-bit floats and a resolve; VTK's blends into 8
// bits.
#include <benchmark/benchmark.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <semaphore>
#include <string>
#include <thread>

#include "render/frame/frame.h"
#include "render/gl/headless_context.h"
#include "render/splat/gl_list.h"
#include "tests/bench/alternate.h"
#include "tests/bench/scattered_splats.h"

namespace {

using namespace render;

// Does one thing at a time on a thread of its own, and waits for it.
class OtherThread {
 public:
    ~OtherThread() { run({}); }
    void run(std::function<void()> what) {
        what_ = std::move(what);
        wanted_.release();
        done_.acquire();
    }

 private:
    std::function<void()> what_;
    std::binary_semaphore wanted_{0}, done_{0};
    std::jthread thread_{[this] {
        for (bool go = true; go; done_.release()) {
            wanted_.acquire();
            go = static_cast<bool>(what_);
            if (go) what_();
        }
    }};
};

struct VtkPicture {
    // The same points; splats that end three standard deviations from their centre, of the same
    // diameter, or points of a pixel.
    VtkPicture(const bench::ScatteredSplats& world, bool splats) {
        std::vector<std::uint32_t> selected;
        for (const auto& run : world.scene.layers[0].runs) {
            const auto index = world.step.gridIndex().subspan(run.first, run.count);
            selected.insert(selected.end(), index.begin(), index.end());
        }
        std::sort(selected.begin(), selected.end());
        vtkNew<vtkPoints> points;
        for (const std::uint32_t i : selected) {
            const glm::dvec3 at = world.placed.position(i);
            points->InsertNextPoint(at.x, at.y, at.z);
        }
        vtkNew<vtkPolyData> cloud;
        cloud->SetPoints(points);
        vtkNew<vtkPointGaussianMapper> mapper;
        mapper->SetInputData(cloud);
        mapper->SetScaleFactor(splats ? kQuarticRadius * world.placed.unitLength() / 3 : 0);
        mapper->EmissiveOn();
        mapper->ScalarVisibilityOff();
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        actor->GetProperty()->SetColor(1, 0.5, 0.1);
        actor->GetProperty()->SetOpacity(0.3);
        actor->ForceOpaqueOn();
        renderer->AddActor(actor);
        window->SetMultiSamples(0);
        window->SetOffScreenRendering(1);
        window->SetSize(bench::ScatteredSplats::kSize.x, bench::ScatteredSplats::kSize.y);
        window->AddRenderer(renderer);
        const glm::dvec3 eye = pixelRays(world.view).eye;
        vtkCamera* camera = renderer->GetActiveCamera();
        camera->SetPosition(eye.x, eye.y, eye.z);
        camera->SetFocalPoint(0, 0, 0);
        camera->SetViewUp(0, 0, 1);
        camera->SetViewAngle(2 * std::atan(bench::ScatteredSplats::kTangent) * 180 /
                             std::numbers::pi);
        renderer->ResetCameraClippingRange();
    }
    void frame() {
        window->Render();
        window->WaitForCompletion();
    }
    double litPixels() {
        vtkNew<vtkUnsignedCharArray> pixels;
        window->GetRGBACharPixelData(0, 0, bench::ScatteredSplats::kSize.x - 1,
                                     bench::ScatteredSplats::kSize.y - 1, 0, pixels);
        double lit = 0;
        for (vtkIdType i = 0; i < pixels->GetNumberOfValues(); i += 4)
            lit += pixels->GetValue(i) > 0;
        return lit;
    }
    std::string driver() {
        const std::string all = window->ReportCapabilities();
        const auto at = all.find("OpenGL renderer string:");
        return at == std::string::npos ? "?" : all.substr(at, all.find('\n', at) - at);
    }

    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkRenderWindow> window;
};

void vtkDraw(benchmark::State& state) {
    if (std::getenv("DISPLAY") == nullptr) {
        state.SkipWithError("VTK draws through X: run under xvfb-run");
        return;
    }
    const bool splats = state.range(1) > 0;
    bench::ScatteredSplats world(static_cast<std::uint64_t>(state.range(0)), 8);
    if (!splats) world.scene.footprint = {.kernel = Kernel::Point};
    OtherThread thread;
    std::unique_ptr<VtkPicture> theirs;
    std::string driver;
    double lit = 0;
    thread.run([&] {
        theirs = std::make_unique<VtkPicture>(world, splats);
        theirs->frame();
        driver = theirs->driver();
        lit = theirs->litPixels();
    });
    const gl::HeadlessContext context;
    GlStep onGpu(world.step, world.placed);
    onGpu.upload(world.scene, {});
    FrameRenderer renderer;
    const std::array views{world.view};
    const FrameContent content{world.scene, world.step.grid(), {}, glm::dvec3(0)};
    bench::alternate(
        state,
        [&] {
            renderer.drawEye(renderer.prepare(content, onGpu, views), world.view);
            glFinish();
        },
        [&] { thread.run([&] { theirs->frame(); }); });
    const auto& plane = renderer.targets().readScalarPlane(0);
    state.counters["lit"] = static_cast<double>(
        std::count_if(plane.begin(), plane.end(), [](float w) { return w > 0; }));
    state.counters["lit2"] = lit;
    state.SetLabel(context.renderer() + "; " + driver);
    thread.run([&] { theirs.reset(); });
}
BENCHMARK(vtkDraw)
    ->ArgNames({"points", "diameter"})
    ->Args({100'000, 8})
    ->Args({1'000'000, 8})
    ->Args({100'000, 0})
    ->Args({1'000'000, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(15);

}  // namespace

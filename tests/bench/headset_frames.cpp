// Frames against a real runtime: what the XR layer costs by itself, and how many frames are missed.
// tests/xr/monado_root.sh bench
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>

#include "app/headset/eyes.h"
#include "app/headset/standing.h"
#include "render/gl/headless_context.h"
#include "tests/bench/median.h"
#include "tests/bench/noise_world.h"
#include "tests/support/monado_service.h"

namespace {

using namespace app::headset;
using Clock = std::chrono::steady_clock;

double millisecondsOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}
double milliseconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

std::unique_ptr<xr::Session> openSession(const render::gl::HeadlessContext& context) {
    const auto egl = context.eglNames();
    auto opened = xr::Session::open(xr::EglBinding{egl.display, nullptr, egl.context});
    if (auto* none = std::get_if<xr::NoHeadset>(&opened)) throw std::runtime_error(none->why);
    return std::get<0>(std::move(opened));
}

// The next frame that is to be drawn; those before it are ended without any layer.
std::unique_ptr<xr::Session::Frame> nextFrame(xr::Session& session) {
    while (true) {
        auto frame = session.beginFrame();
        if (session.ended()) throw std::runtime_error("the runtime has ended the session");
        if (frame && frame->shouldRender() && frame->head()) return frame;
    }
}

constexpr int kFrames = 1000;

// Frames in which nothing is drawn: all that is left is Session's and Frame's, and the runtime's.
void measureLayer(tests::Monado mode, const char* name) {
    const tests::MonadoService service(mode);
    const render::gl::HeadlessContext context;
    const auto session = openSession(context);
    std::vector<double> begin, eyes, submit, process, wall;
    for (int i = 0; i < kFrames; ++i) {
        const double all = millisecondsOf(CLOCK_PROCESS_CPUTIME_ID);
        const double atBegin = millisecondsOf(CLOCK_THREAD_CPUTIME_ID);
        const auto frame = nextFrame(*session);
        const double atEyes = millisecondsOf(CLOCK_THREAD_CPUTIME_ID);
        const Clock::time_point begun = Clock::now();
        frame->eyes(1);
        const double atSubmit = millisecondsOf(CLOCK_THREAD_CPUTIME_ID);
        frame->submit(kNear, kFar);
        wall.push_back(milliseconds(Clock::now() - begun));
        submit.push_back(millisecondsOf(CLOCK_THREAD_CPUTIME_ID) - atSubmit);
        eyes.push_back(atSubmit - atEyes);
        begin.push_back(atEyes - atBegin);
        process.push_back(millisecondsOf(CLOCK_PROCESS_CPUTIME_ID) - all);
    }
    fmt::print("| {} | {:.3f} ms | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", name,
               bench::median(begin), bench::median(eyes), bench::median(submit),
               bench::median(process), bench::median(wall));
}

struct Load {
    const char* name;
    std::size_t side;  // of a cube of points
    std::uint64_t splats;
};

// Headset's frame without panel and hands. The governors have some frames to settle; then a
// thousand periods of the runtime's clock are counted.
void measureMissed(tests::Monado mode, const char* name, const Load& load) {
    const auto world = bench::noiseWorld(load.side, load.splats);
    const app::Shown shown = world.shown();
    const tests::MonadoService service(mode);
    const render::gl::HeadlessContext context;
    const auto session = openSession(context);
    Eyes eyes;
    std::optional<xr::Placement> placement;
    std::chrono::nanoseconds last{0}, period{0};
    std::vector<double> took;
    int settling = 60, periods = 0;
    while (periods < kFrames) {
        const auto frame = nextFrame(*session);
        const Clock::time_point began = Clock::now();
        period = frame->period();
        const auto passed = static_cast<int>(
            std::lround(milliseconds(frame->displayTime() - last) / milliseconds(period)));
        last = frame->displayTime();
        if (!placement)
            placement =
                volumeBefore(*frame->head(), render::Lattice(shown.sorted->grid()).boxHalfEdges());
        eyes.draw(&shown, frame->eyes(eyes.scale()), *placement, {}, period);
        eyes.took(Clock::now() - began, period);
        frame->submit(kNear, kFar);
        if (--settling >= 0) continue;
        took.push_back(milliseconds(Clock::now() - began));
        periods += passed;
    }
    const auto shownFrames = static_cast<int>(took.size());
    fmt::print("| {}, {:.1f} ms | {} | {} | {} | {} | {:.1f} ms | {:.0f} % |\n", name,
               milliseconds(period), load.name, shownFrames, periods - shownFrames,
               eyes.report().drawn, bench::median(took), 100 * eyes.scale());
    std::fflush(stdout);
}

}  // namespace

int main() try {
    struct Runtime {
        tests::Monado mode;
        const char* name;
    };
    const std::array runtimes{Runtime{tests::Monado::Null, "null"},
                              Runtime{tests::Monado::Window, "window"}};
    std::puts("| compositor | beginFrame | eyes | submit | all threads | eyes and submit, wall |");
    std::puts("|---|---|---|---|---|---|");
    for (const Runtime& runtime : runtimes) measureLayer(runtime.mode, runtime.name);
    std::puts("\n| compositor, period | scene | frames | missed | splats | frame | resolution |");
    std::puts("|---|---|---|---|---|---|---|");
    for (const Runtime& runtime : runtimes)
        for (const Load& load :
             {Load{"10,000 splats", 64, 10'000}, Load{"1,000,000 splats", 256, 1'000'000}})
            measureMissed(runtime.mode, runtime.name, load);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

// Frames against a real runtime: what the XR layer costs by itself, and how many frames are missed.
// tests/xr/monado_root.sh bench
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>

#include "app/headset/headset.h"
#include "render/gl/headless_context.h"
#include "tests/bench/median.h"
#include "tests/support/built_paths.h"
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

// What is looked at: a file, and the values of it.
struct Load {
    const char* name;
    std::filesystem::path file;
    const char* ranges;
};

// A cube of noise between 0 and 1, about half of whose points lie in 0:0.477.
std::filesystem::path writeNoise(std::size_t side) {
    const auto file = std::filesystem::temp_directory_path() / "isochron_headset_frames.nrrd";
    std::ofstream out(file, std::ios::binary);
    out << fmt::format(
        "NRRD0004\ntype: float\ndimension: 3\nsizes: {0} {0} {0}\nencoding: raw\n"
        "endian: little\n\n",
        side);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(0, 1);
    std::vector<float> values(side * side * side);
    for (float& value : values) value = noise(random);
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof values[0]));
    return file;
}

// The program's own frames, its panel shown and the hands where the devices hold them.
class InHeadset {
 public:
    explicit InHeadset(const Load& load) {
        app::Explorer session;
        session.files = {load.file};
        session.layers = {{.ranges = timeseries::RangeSet::parse(load.ranges),
                           .color = glm::dvec3(1, 0.5, 0),
                           .opacity = 0.5}};
        auto opened = Headset::open(exploration_, exporting_);
        if (auto* none = std::get_if<xr::NoHeadset>(&opened)) throw std::runtime_error(none->why);
        headset_ = std::get<0>(std::move(opened));
        exploration_.open(std::move(session));
    }

    struct Count {
        int frames = 0, periods = 0;
        std::vector<double> work;  // ms
        std::set<std::uint64_t> splats;
        double missed() const { return 100.0 * (periods - frames) / periods; }
    };
    // Frames for so long, by the display's clock.
    Count run(std::chrono::nanoseconds duration) {
        Count count;
        std::optional<std::chrono::nanoseconds> first, last;
        while (!first || *last - *first < duration) {
            if (!headset_->frame()) throw std::runtime_error("the runtime has ended the session");
            const Headset::Timing timing = headset_->timing();
            if (!timing.drawn || timing.displayTime == last) continue;
            if (last) {
                ++count.frames;
                count.periods += static_cast<int>(std::lround(
                    milliseconds(timing.displayTime - *last) / milliseconds(timing.period)));
                count.work.push_back(milliseconds(headset_->eyes().work()));
                count.splats.insert(headset_->eyes().report().drawn);
            } else {
                first = timing.displayTime;
            }
            last = timing.displayTime;
        }
        return count;
    }
    const Headset& headset() const { return *headset_; }

 private:
    app::Exploration exploration_{{}};
    std::optional<app::ExportJob> exporting_;
    std::unique_ptr<Headset> headset_;
};

void print(const char* compositor, const char* scene, const InHeadset::Count& count,
           const InHeadset& in) {
    fmt::print("| {}, {:.1f} ms | {} | {} | {:.1f} % | {} to {} | {:.1f} ms | {:.0f} % |\n",
               compositor, milliseconds(in.headset().timing().period), scene, count.frames,
               count.missed(), *count.splats.begin(), *count.splats.rbegin(),
               bench::median(count.work), 100 * in.headset().eyes().scale());
    std::fflush(stdout);
}

constexpr std::chrono::seconds kSettling(10), kMeasured(60), kLoaded(8), kBack(5), kAfter(20);

void measureMissed(tests::Monado mode, const char* name, const Load& load) {
    const tests::MonadoService service(mode);
    InHeadset in(load);
    in.run(kSettling);
    print(name, load.name, in.run(kMeasured), in);
}

// Other programs on all cores for a while: what is missed from five seconds later on.
void measureReturn(tests::Monado mode, const char* name, const Load& load) {
    const tests::MonadoService service(mode);
    InHeadset in(load);
    in.run(kSettling);
    std::vector<pid_t> others;
    for (unsigned i = 0; i < 2 * std::thread::hardware_concurrency(); ++i)
        if (const pid_t other = fork(); other == 0)
            for (volatile unsigned n = 0;;) n = n + 1;
        else
            others.push_back(other);
    print(name, fmt::format("{}, others on all cores", load.name).c_str(), in.run(kLoaded), in);
    for (const pid_t other : others) {
        kill(other, SIGKILL);
        waitpid(other, nullptr, 0);
    }
    in.run(kBack);
    print(name, fmt::format("{}, from 5 s after that", load.name).c_str(), in.run(kAfter), in);
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
    const std::array loads{Load{"pool fire, 600:max", tests::demo(), "600:max"},
                           Load{"1,000,000 of 128^3", writeNoise(128), "0:0.477"}};
    std::puts(
        "\n| compositor, period | scene | frames | missed | splats an eye | work | resolution |");
    std::puts("|---|---|---|---|---|---|---|");
    for (const Runtime& runtime : runtimes)
        for (const Load& load : loads) measureMissed(runtime.mode, runtime.name, load);
    for (const Load& load : loads) measureReturn(tests::Monado::Null, "null", load);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

// ui_bench: how long the window of `isochron FILE` lets its user wait (the demo, where no file is
// named): from its start to the first picture, from a drag to the changed picture, and between two
// frames, turning, while another file loads, and while a million points come to rest.
// ui_bench --beside PROGRAM: from the start to a picture, by turns with another build of it.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <utility>

#include "tests/bench/program_run.h"
#include "tests/support/built_paths.h"
#include "tests/ui/bench_figures.h"
#include "tests/ui/bench_series.h"
#include "tests/ui/places.h"
#include "tests/ui/slow_file.h"
#include "tests/ui/temporary_folder.h"
#include "tests/ui/waiting.h"

namespace {

using ui::Clock;
using ui::Milliseconds;
using ui::noise;
using ui::tell;

constexpr int kDrags = 40;

// Through the middle: to read all of a window would take the processor from the program.
app::panels::Rect stripOf(const ui::Places& at) {
    app::panels::Rect strip = at.clear;
    strip.min.y = at.clear.centre().y - 20;
    strip.max.y = strip.min.y + 40;
    return strip;
}

// From a movement of the mouse to a picture that is another.
std::vector<double> drags(ui::Driver& desk, const ui::Places& at) {
    const app::panels::Rect strip = stripOf(at);
    std::vector<double> out;
    desk.move(at.clear.centre());
    desk.down();
    for (int i = 1; i <= kDrags; ++i) {
        const ui::Shot before = desk.shot(strip);
        const Clock::time_point begin = Clock::now();
        desk.moveOnly(at.clear.centre() + glm::vec2(4 * i, 0));
        ui::waitUntil("the picture changes", [&] { return desk.shot(strip) != before; });
        out.push_back(Milliseconds(Clock::now() - begin).count());
        desk.sync();
    }
    desk.up();
    return out;
}

// While the mouse turns the picture all the time.
template <typename Condition>
std::vector<double> gaps(ui::Driver& desk, const ui::Places& at, const Condition& goesOn) {
    std::vector<double> out;
    desk.move(at.clear.centre());
    desk.down();
    for (int i = 0; goesOn(i); ++i) {
        desk.moveOnly(at.clear.centre() + glm::vec2(4 * (i % 50), 0));
        out.push_back(Milliseconds(desk.ping()).count());
    }
    desk.up();
    return out;
}

// Columns of a place, none farther from the next than tiles are wide.
std::vector<ui::Shot> columnsOf(ui::Driver& desk, const app::panels::Rect& place) {
    constexpr float kApart = 60, kWidth = 4;
    std::vector<ui::Shot> out;
    for (float x = place.min.x; x + kWidth <= place.max.x; x += kApart)
        out.push_back(desk.shot({{x, place.min.y}, {x + kWidth, place.max.y}}));
    return out;
}

// From where the button is let go to the last change of the picture before it is still for a while,
// that is, until all points are seen. Their error is told beside it, and later. Meanwhile the
// window is asked for an answer again and again, or left alone, for each answer takes a frame.
struct Rests {
    std::vector<double> gaps, times;
};
Rests rests(ui::Driver& desk, const ui::Places& at, bool asks) {
    constexpr int kRests = 5, kMoves = 10;
    constexpr std::chrono::milliseconds kQuiet{2000}, kBetween{2};
    // What is said of a point stands to the right of the pointer, and comes later.
    app::panels::Rect left = at.clear;
    left.max.x = at.clear.centre().x - 50;
    Rests out;
    for (int i = 0; i < kRests; ++i) {
        desk.move(at.clear.centre());
        desk.down();
        for (int moved = 1; moved <= kMoves; ++moved) {
            desk.moveOnly(at.clear.centre() + glm::vec2(4 * moved, 0));
            desk.ping();
        }
        const Clock::time_point begin = Clock::now();
        Clock::time_point changed = begin;
        desk.up();
        std::vector<ui::Shot> last;
        while (Clock::now() - changed < kQuiet) {
            if (asks)
                out.gaps.push_back(Milliseconds(desk.ping()).count());
            else
                std::this_thread::sleep_for(kBetween);
            std::vector<ui::Shot> now = columnsOf(desk, left);
            if (now != last) changed = Clock::now();
            last = std::move(now);
        }
        out.times.push_back(Milliseconds(changed - begin).count());
        desk.settled();
    }
    return out;
}

void runTurning(const ui::Screen& screen, const std::filesystem::path& home, const char* what,
                const std::vector<std::string>& arguments) {
    ui::Driver desk(screen, home, arguments);
    desk.waitForTitle(" points");
    const ui::Places at = ui::placesOf(desk.size(), false);
    desk.settled();
    tell(what, gaps(desk, at, [](int i) { return i < 200; }));
}

// While pictures that move keep all that they have at rest, whatever the pace.
void runTurningAll(const ui::Screen& screen, const std::filesystem::path& home, const char* what,
                   const std::vector<std::string>& arguments) {
    const auto preferences = home / ".config/isochron/preferences.json";
    std::filesystem::create_directories(preferences.parent_path());
    std::ofstream(preferences) << nlohmann::json{{"moving", "all"}};
    runTurning(screen, home, what, arguments);
    std::filesystem::remove(preferences);
}

// From the program's start to splats in its window.
double opening(const ui::Screen& screen, const std::filesystem::path& home,
               const std::vector<std::string>& arguments,
               const std::filesystem::path& program = tests::program()) {
    const Clock::time_point begin = Clock::now();
    ui::Driver desk(screen, home, arguments, {}, program);
    const app::panels::Rect at = ui::placesOf(desk.size(), false).clear;
    ui::waitUntil("splats are seen",
                  [&] { return std::ranges::any_of(desk.shot(at).pixels, ui::isColored); });
    return Milliseconds(Clock::now() - begin).count();
}
void runOpening(const ui::Screen& screen, const std::filesystem::path& home, const char* what,
                const std::vector<std::string>& arguments) {
    constexpr int kStarts = 5;
    std::vector<double> out;
    for (int i = 0; i < kStarts; ++i) out.push_back(opening(screen, home, arguments));
    tell(what, std::move(out));
}

// 1 % of 512^3, from an index; by the other program, which need not know of any, from the file.
void runBeside(const std::filesystem::path& program) {
    constexpr int kStarts = 5;
    const ui::TemporaryFolder home;
    const ui::Screen screen(home.path());
    const std::string large = (home.path() / "large.nrrd").string();
    const std::string cache = (home.path() / "cache").string();
    bench::writeField(large, "float", 512, noise(std::size_t{1} << 27));
    bench::runProgram({"index", large, "--cache", cache});
    std::vector<double> now, other;
    for (int i = 0; i < kStarts; ++i) {
        now.push_back(
            opening(screen, home.path(),
                    {large, "--range", "0.5:0.51", "--model", "points", "--cache", cache}));
        other.push_back(opening(screen, home.path(), {large, "--range", "0.5:0.51"}, program));
    }
    tell("from the start to 1 % of 512^3, from an index", std::move(now));
    tell("from the start to 1 % of 512^3, by the other program", std::move(other));
}

// 0.25 to 0.75 of noise on 128^3 points are a million.
void runResting(const ui::Screen& screen, const std::filesystem::path& home) {
    const auto file = home / "noise.nrrd";
    bench::writeField(file, "float", 128, noise(std::size_t{128} * 128 * 128));
    runTurning(screen, home, "between frames, turning, a million points",
               {file.string(), "--range", "0.25:0.75", "--model", "points"});
    runTurningAll(screen, home, "between frames, turning, all of a million points",
                  {file.string(), "--range", "0.25:0.75", "--model", "points"});
    const auto restBy = [&](const char* model, const char* gaps, const char* times) {
        ui::Driver desk(screen, home, {file.string(), "--range", "0.25:0.75", "--model", model});
        desk.waitForTitle(" points");
        const ui::Places at = ui::placesOf(desk.size(), false);
        desk.settled();
        tell(gaps, rests(desk, at, true).gaps);
        tell(times, rests(desk, at, false).times);
    };
    restBy("points", "between frames, a million points come to rest",
           "from a drag's end to all of a million points");
    restBy("cells", "between frames, their cells come to rest",
           "from a drag's end to all of their cells");
}

void run(const std::filesystem::path& file) {
    const ui::TemporaryFolder home;
    const auto slow = ui::writeSlowFile(home.path() / "slow.nrrd");
    const ui::Screen screen(home.path());
    runResting(screen, home.path());
    runTurning(screen, home.path(), "between frames, turning, the pool fire",
               {tests::demo().string(), "--range", "600:max", "--model", "points"});
    {
        const auto large = home.path() / "large.nrrd";
        bench::writeField(large, "float", 512, noise(std::size_t{1} << 27));
        const std::vector<std::string> onePercent = {large.string(), "--range", "0.5:0.51",
                                                     "--model",      "points",  "--cache"};
        const auto with = [&](const std::string& cache) {
            std::vector<std::string> arguments = onePercent;
            arguments.push_back(cache);
            return arguments;
        };
        const std::string cache = (home.path() / "cache").string();
        runTurning(screen, home.path(), "between frames, turning, 1 % of 512^3", with("off"));
        runOpening(screen, home.path(), "from the start to 1 % of 512^3", with("off"));
        bench::runProgram({"index", large.string(), "--cache", cache});
        runOpening(screen, home.path(), "from the start to 1 % of 512^3, from an index",
                   with(cache));
        std::filesystem::remove_all(cache);
        ui::runPlayingCold(screen, home.path(), "between steps, 1 % of 512^3, from a cold disk",
                           large, 10, "0.5:0.51");
        std::filesystem::remove(large);
    }
    {
        const auto huge = home.path() / "huge.nrrd";
        std::vector<std::uint8_t> bytes(std::size_t{1} << 30);
        std::mt19937 random(7);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 100);
        bench::writeField(huge, "uint8", 1024, bytes);
        bytes = {};
        ui::runPlayingCold(screen, home.path(),
                           "between steps, 1 % of 1024^3 bytes, from a cold disk", huge, 4, "50");
        std::filesystem::remove(huge);
    }
    ui::runPlaying(screen, home.path());
    ui::runSweeping(screen, home.path());
    ui::Driver desk(screen, home.path(), {file.string()});
    desk.waitForTitle(" points");
    const ui::Places at = ui::placesOf(desk.size());
    desk.settled();
    tell("from a drag to the changed picture", drags(desk, at));
    tell("between frames, turning", gaps(desk, at, [](int i) { return i < 100; }));
    desk.drop({slow}, at.clear.centre());
    tell("between frames, turning while a file loads", gaps(desk, at, [&](int i) {
             return i < 100 || desk.title().find("opening") != std::string::npos;
         }));
}

}  // namespace

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);  // each figure as it is known, also into a file
    try {
        if (argc > 2 && std::string_view(argv[1]) == "--beside")
            runBeside(std::filesystem::absolute(argv[2]));
        else
            run(argc > 1 ? std::filesystem::absolute(argv[1]) : tests::demo());
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "ui_bench: {}\n", error.what());
        return 1;
    }
}

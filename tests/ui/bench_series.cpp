#include "tests/ui/bench_series.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/bench/program_run.h"
#include "tests/support/built_paths.h"
#include "tests/ui/bench_figures.h"
#include "tests/ui/places.h"

namespace ui {
namespace {

// As long as `seconds` of playing, the times between steps that the window's title names.
std::vector<double> steps(Driver& desk, double seconds) {
    std::vector<double> out;
    desk.press("space");
    const Clock::time_point begin = Clock::now();
    std::string last = desk.title();
    for (Clock::time_point since = begin;
         Clock::now() - begin < std::chrono::duration<double>(seconds);
         std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
        const std::string now = desk.title();
        if (now == last) continue;
        out.push_back(Milliseconds(Clock::now() - since).count());
        since = Clock::now();
        last = now;
    }
    desk.press("space");
    return out;
}

// Nothing of these files is in the system's memory after this.
void forget(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const int file = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0 || ::fsync(file) != 0 || ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) != 0)
            throw std::runtime_error(entry.path().string() + " stays in memory");
        ::close(file);
    }
}

double coloredPixels(Driver& desk) {
    const Shot shot = desk.shot(placesOf(desk.size(), false).clear);
    return static_cast<double>(std::ranges::count_if(shot.pixels, isColored));
}

// How many pixels a sweep has while it plays, beside those of nearly the same window at rest: of a
// closed shell as many, of dots in its place few.
void tellShellPixels(Driver& desk) {
    constexpr int kTimes = 9;
    std::vector<double> shares;
    for (int i = 0; i < kTimes; ++i) {
        desk.press("space");
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        const double moving = coloredPixels(desk);
        desk.press("space");
        desk.settled();
        shares.push_back(moving / std::max(coloredPixels(desk), 1.0));
    }
    std::ranges::sort(shares);
    fmt::print(
        "a shell swept through the fire has while it moves {:.2f} of its pixels at rest, at "
        "least {:.2f}\n",
        shares[kTimes / 2], shares.front());
}

// The most memory that it had, in MB.
double mostMemory(Driver& desk) {
    std::ifstream status(fmt::format("/proc/{}/status", desk.process().id()));
    for (std::string word; status >> word;)
        if (word == "VmHWM:" && status >> word) return std::stod(word) * 1024 / 1e6;
    throw std::runtime_error("the program tells no VmHWM");
}

}  // namespace

void runPlaying(const Screen& screen, const std::filesystem::path& home) {
    constexpr std::size_t kEdge = 256;
    constexpr int kSteps = 12;
    std::vector<float> values = noise(kEdge * kEdge * kEdge);
    std::vector<std::string> files;
    for (int i = 0; i < kSteps; ++i) {
        files.push_back((home / fmt::format("step_{:02}.nrrd", i)).string());
        bench::writeField(files.back(), "float", kEdge, values);
        std::rotate(values.begin(), values.begin() + 12345, values.end());
    }
    const auto session = home / "play.json";
    std::ofstream(session) << nlohmann::json{
        {"isochron", 1},
        {"files", files},
        {"steps", "0"},
        {"model", "points"},
        {"layers", {{{"range", "0.5:0.51"}}}},
        {"play", {{"stepsPerSecond", 60}, {"ending", "loop"}}}};
    Driver desk(screen, home, {session.string(), "--cache", "off"});
    desk.waitForTitle(" points");
    std::vector<double> first = steps(desk, 0.5 * kSteps);
    first.resize(std::min<std::size_t>(first.size(), kSteps - 1));  // those after are there again
    tell("between steps, 256^3, read on the way", first);
    steps(desk, 10);  // until all are in memory
    tell("between steps, 256^3, from memory", steps(desk, 6));
}

void runPlayingCold(const Screen& screen, const std::filesystem::path& home, const char* what,
                    const std::filesystem::path& file, int count, const std::string& range) {
    const auto folder = home / "series", cache = home / "series_cache";
    std::filesystem::create_directory(folder);
    std::vector<std::string> files;
    for (int i = 0; i < count; ++i) {
        files.push_back((folder / fmt::format("step_{:02}.nrrd", i)).string());
        std::filesystem::create_hard_link(file, files.back());
    }
    std::vector<std::string> arguments = {"index", "--cache", cache.string()};
    arguments.insert(arguments.end(), files.begin(), files.end());
    bench::runProgram(arguments);
    forget(cache);
    const auto session = home / "cold.json";
    std::ofstream(session) << nlohmann::json{
        {"isochron", 1},
        {"files", files},
        {"steps", "0"},
        {"model", "points"},
        {"layers", {{{"range", range}}}},
        {"play", {{"stepsPerSecond", 10}, {"ending", "once"}}}};
    {
        Driver desk(screen, home, {session.string(), "--cache", cache.string()});
        desk.waitForTitle(" points");
        std::vector<double> played = steps(desk, 2 + 0.3 * count);
        const std::size_t shown = played.size() + 1;
        tell(what, std::move(played));
        fmt::print("{}, {} of {} shown, most memory {:.0f} MB\n", what, shown, count,
                   mostMemory(desk));
    }
    std::filesystem::remove_all(folder);
    std::filesystem::remove_all(cache);
}

void runSweeping(const Screen& screen, const std::filesystem::path& home) {
    const auto session = home / "sweep.json";
    std::ofstream(session) << nlohmann::json{
        {"isochron", 1},
        {"files", {tests::demo().string()}},
        {"steps", "15"},
        {"model", "cells"},
        {"light", "full"},
        {"sweep", {{"animation", "400:1400"}, {"delta", 5}, {"timerSteps", 500}}},
        {"play", {{"stepsPerSecond", 60}, {"timeMoves", false}}}};
    Driver desk(screen, home, {session.string()});
    desk.waitForTitle(" points");
    desk.settled();
    tell("between windows, a shell swept through the fire", steps(desk, 8));
    tellShellPixels(desk);
}

}  // namespace ui

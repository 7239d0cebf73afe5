// ui_bench: how long the window of `isochron FILE` lets its user wait (the demo, where no file is
// named): from a drag to the changed picture, and between two frames, turning, while another file
// loads, and while a million points come to rest.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <random>
#include <utility>

#include "tests/support/built_paths.h"
#include "tests/ui/places.h"
#include "tests/ui/slow_file.h"
#include "tests/ui/temporary_folder.h"
#include "tests/ui/waiting.h"

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr int kDrags = 40;

void tell(const char* what, std::vector<double> milliseconds) {
    std::ranges::sort(milliseconds);
    fmt::print("{:<46} {:>4} times  median {:7.1f} ms  longest {:7.1f} ms\n", what,
               milliseconds.size(), milliseconds[milliseconds.size() / 2], milliseconds.back());
}

// From a movement of the mouse to a picture that is another.
std::vector<double> drags(ui::Driver& desk, const ui::Places& at) {
    // A strip through the middle is read faster than all of it.
    app::panels::Rect strip = at.clear;
    strip.min.y = at.clear.centre().y - 20;
    strip.max.y = strip.min.y + 40;
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

// Noise on 128^3 points, of which 0.25 to 0.75 are a million.
std::filesystem::path writeNoise(const std::filesystem::path& file) {
    std::mt19937 random(7);
    std::vector<float> values(std::size_t{128} * 128 * 128);
    for (float& value : values) value = static_cast<float>(random() >> 8) / (1 << 24);
    std::ofstream(file, std::ios::binary) << tests::nrrd(
        "type: float\ndimension: 3\nsizes: 128 128 128\nendian: little\n"
        "encoding: raw\n",
        tests::bytesOf(values));
    return file;
}

// From the last movement of a drag until nothing in the window has changed for a while, that is,
// until all points are seen.
struct Rests {
    std::vector<double> gaps, times;
};
Rests rests(ui::Driver& desk, const ui::Places& at) {
    constexpr int kRests = 5;
    constexpr std::chrono::milliseconds kQuiet{500};
    Rests out;
    desk.move(at.clear.centre());
    desk.down();
    for (int i = 1; i <= kRests; ++i) {
        const Clock::time_point begin = Clock::now();
        Clock::time_point changed = begin;
        desk.moveOnly(at.clear.centre() + glm::vec2(20 * i, 0));
        for (ui::Shot last; Clock::now() - changed < kQuiet;) {
            out.gaps.push_back(Milliseconds(desk.ping()).count());
            ui::Shot now = desk.shot();
            if (now != last) changed = Clock::now();
            last = std::move(now);
        }
        out.times.push_back(Milliseconds(changed - begin).count());
    }
    desk.up();
    return out;
}

void runResting(const ui::Screen& screen, const std::filesystem::path& home) {
    ui::Driver desk(screen, home,
                    {writeNoise(home / "noise.nrrd").string(), "--range", "0.25:0.75"});
    desk.waitForTitle(" points");
    const ui::Places at = ui::placesOf(desk.size(), false);
    desk.settled();
    const Rests figures = rests(desk, at);
    tell("between frames, a million points come to rest", figures.gaps);
    tell("from a drag's end to all of a million points", figures.times);
}

void run(const std::filesystem::path& file) {
    const ui::TemporaryFolder home;
    const auto slow = ui::writeSlowFile(home.path() / "slow.nrrd");
    const ui::Screen screen(home.path());
    runResting(screen, home.path());
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
        run(argc > 1 ? std::filesystem::absolute(argv[1]) : tests::demo());
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "ui_bench: {}\n", error.what());
        return 1;
    }
}

// ui_bench: how long the window of `isochron FILE` lets its user wait (the demo, where no file is
// named): from a drag to the changed picture, and between two frames, at rest, turning, and while
// another file loads.
#include <fmt/core.h>

#include <algorithm>
#include <exception>

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
    fmt::print("{:<44} {:>4} times  median {:7.1f} ms  longest {:7.1f} ms\n", what,
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

void run(const std::filesystem::path& file) {
    const ui::TemporaryFolder home;
    const auto slow = ui::writeSlowFile(home.path() / "slow.nrrd");
    const ui::Screen screen(home.path());
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
    try {
        run(std::filesystem::absolute(argc > 1 ? argv[1] : SOURCE_DIR "/datasets/pool_fire_T.nc"));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "ui_bench: {}\n", error.what());
        return 1;
    }
}

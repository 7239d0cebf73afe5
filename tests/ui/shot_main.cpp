// ui_shot OUT.png ARGUMENTS... : what the window shows that `isochron ARGUMENTS...` opens, once all
// of it is there, with nobody's settings.
#include <fmt/core.h>

#include <cstdlib>
#include <exception>

#include "tests/ui/driver.h"
#include "tests/ui/temporary_folder.h"

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "ui_shot OUT.png ARGUMENTS...\n");
        return 2;
    }
    try {
        const ui::TemporaryFolder home;
        const ui::Screen screen(home.path());
        std::vector<std::string> arguments(argv + 2, argv + argc);
        // The program runs elsewhere.
        for (std::string& argument : arguments)
            if (std::filesystem::exists(argument)) argument = std::filesystem::absolute(argument);
        ui::Driver desk(screen, home.path(), arguments);
        if (!arguments.empty()) desk.waitForTitle(" points");
        ui::writeShot(argv[1], desk.settled());
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "ui_shot: {}\n", error.what());
        return 1;
    }
}

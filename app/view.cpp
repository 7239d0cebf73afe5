// `isochron view`: an exploration in a headset where one answers, else in a window.
#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/commands.h"
#include "app/desktop/desktop.h"
#include "app/headset/headset.h"

namespace app {
namespace {

// An exploration that goes from one front end to the next as it is.
class Viewing {
 public:
    explicit Viewing(const ViewOptions& options) : options_(options) {}

    void run() {
        if (options_.display == Display::Desktop) return inWindow();
        const auto why = inHeadset();
        if (!why) return;
        if (options_.display == Display::Headset && !begun_) throw std::runtime_error(*why);
        try {
            inWindow(*why);
        } catch (const NoWindow& none) {
            throw std::runtime_error(fmt::format("{}; no headset: {}", none.what(), *why));
        }
    }

 private:
    struct NoWindow : std::runtime_error {
        using std::runtime_error::runtime_error;
    };

    // One sentence why there is no headset, or none any more; none when the user is done.
    std::optional<std::string> inHeadset() {
        // Cheap, and no window comes up for it.
        if (auto none = xr::Session::whyNone()) return std::move(none->why);
        try {
            auto opened = headset::Headset::open(exploration_);
            if (auto* none = std::get_if<xr::NoHeadset>(&opened)) return std::move(none->why);
            begin();
            std::get<std::unique_ptr<headset::Headset>>(opened)->run();
            return std::nullopt;
        } catch (const xr::LostError& lost) {
            return lost.what();
        }
    }

    void inWindow(const std::string& noHeadset = {}) {
        std::optional<desktop::Desktop> desktop;
        try {
            desktop.emplace(exploration_);
        } catch (const std::runtime_error& error) {
            throw NoWindow(error.what());
        }
        // Most machines have no headset: only who was in one is told in the window, too.
        if (!noHeadset.empty())
            fmt::print(stderr, "isochron: in a window, because {}\n", noHeadset);
        if (begun_) exploration_.tell("No headset any more: " + noHeadset);
        begin();
        desktop->run();
    }

    // Not before there is somebody to see it.
    void begin() {
        if (std::exchange(begun_, true) || options_.explorer.files.empty()) return;
        exploration_.open(options_.explorer);
    }

    const ViewOptions& options_;
    Exploration exploration_{{.wake = [] { desktop::Window::wake(); }}};
    bool begun_ = false;
};

}  // namespace

int view(const ViewOptions& options) {
    int code = EXIT_SUCCESS;
    try {
        Viewing(options).run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "isochron: {}\n", error.what());
        code = EXIT_FAILURE;
    }
    // A read that nobody waits for may still run: see exploration.h.
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace app

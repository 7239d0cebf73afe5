// `isochron view`: an exploration in a headset where one answers, else in a window.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/command/commands.h"
#include "app/desktop/desktop.h"
#include "app/headset/headset.h"
#include "app/say.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_files.h"
#include "timeseries/sentence.h"

namespace app {
namespace {

// An exploration that goes from one front end to the next as it is.
class Viewing {
 public:
    explicit Viewing(const ViewOptions& options) : options_(options) {}

    void run() {
        // Beside the start of whoever shows it.
        if (!options_.explorer.files.empty()) exploration_.open(options_.explorer);
        goThrough();
        // Nobody sees the window's word of it any more.
        if (exporting_) sayTo(stderr, "isochron: {}\n", exporting_->end());
    }

 private:
    // One front end after the other, until the user is done.
    void goThrough() {
        std::optional<std::string> why;  // there is no headset; none when none was asked for
        if (options_.display != Display::Desktop) {
            why = inHeadset();
            if (!why) return;
            if (options_.display == Display::Headset && !seen_) throw std::runtime_error(*why);
        }
        while (inWindow(why) == desktop::Desktop::End::ToHeadset) {
            why = inHeadset();
            if (!why) return;
        }
    }

    // One sentence why there is no headset, or none any more; none when the user is done.
    std::optional<std::string> inHeadset() {
        std::unique_ptr<headset::Headset> headset;
        try {
            auto opened = headset::Headset::open(exploration_, exporting_);
            if (auto* none = std::get_if<xr::NoHeadset>(&opened)) return std::move(none->why);
            headset = std::get<0>(std::move(opened));
        } catch (const std::exception& error) {
            return timeseries::sentenceOf(
                error);  // before there is a session, a window does as well
        }
        seen_ = true;
        try {
            headset->run();
            return std::nullopt;
        } catch (const xr::LostError& lost) {
            return lost.what();
        }
    }

    desktop::Desktop::End inWindow(const std::optional<std::string>& noHeadset) {
        std::optional<desktop::Desktop> desktop;
        try {
            desktop.emplace(exploration_, exporting_);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(error.what() + lost(noHeadset));
        }
        // Most machines have no headset: only who was in one is told in the window, too.
        if (noHeadset) sayTo(stderr, "isochron: in a window, because {}\n", *noHeadset);
        if (noHeadset && seen_)
            exploration_.tell("No headset any more: " + *noHeadset + ". Ctrl+H leads back into it");
        seen_ = true;
        return desktop->run();
    }

    // What else is to be said where there is no window either.
    std::string lost(const std::optional<std::string>& noHeadset) {
        std::string text = noHeadset ? "; no headset: " + *noHeadset : "";
        return exporting_ ? text + ". " + exporting_->end() : text;
    }

    const ViewOptions& options_;
    Exploration exploration_{{.wake = [] { desktop::Window::wake(); }}};
    std::optional<ExportJob> exporting_;  // goes on from one front end to the next
    bool seen_ = false;                   // a front end was there
};

// What is not there is told where it was asked for, not in a window that shows nothing.
void requireThere(const std::vector<std::filesystem::path>& named) {
    for (const std::filesystem::path& each : named) {
        // A pattern that fits nothing throws.
        const auto found = timeseries::expandSeries(std::span(&each, 1)).files;
        std::error_code unknown;
        if (!std::filesystem::exists(found.front(), unknown))
            throw timeseries::FileError(fmt::format("{}: {}", found.front().string(),
                                                    timeseries::flawOfFile(found.front())));
    }
}

}  // namespace

int view(const ViewOptions& options) {
    int code = EXIT_SUCCESS;
    try {
        requireThere(options.explorer.files);
        Viewing(options).run();
    } catch (const std::exception& error) {
        sayTo(stderr, "isochron: {}\n", timeseries::sentenceOf(error));
        code = EXIT_FAILURE;
    }
    // A read that nobody waits for may still run: see exploration.h.
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace app

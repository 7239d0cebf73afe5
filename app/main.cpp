// isochron: parses the command line, runs one command, and turns failures into one sentence.
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "app/choices/choice_text.h"
#include "app/command/commands.h"
#include "app/files/memory_budget.h"
#include "app/files/step_cache.h"
#include "app/say.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/sentence.h"
#include "timeseries/together.h"

namespace {

struct Run {
    int operator()(const app::InfoOptions& options) const { return app::info(options); }
    int operator()(const app::CountOptions& options) const { return app::count(options); }
    int operator()(const app::RenderOptions& options) const { return app::renderHeadless(options); }
    int operator()(const app::MeasureOptions& options) const { return app::measureModes(options); }
    int operator()(const app::ViewOptions& options) const { return app::view(options); }
    int operator()(const app::IndexOptions& options) const { return app::index(options); }
    int operator()(const app::CacheOptions& options) const { return app::cache(options); }
    int operator()(const app::Exit& exit) const {
        if (exit.code == 0)
            app::say("{}\n", exit.text);
        else
            app::sayTo(stderr, "isochron: {}\n", exit.text);
        return exit.code;
    }
};

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is one that cannot be written
    try {
        const app::Command command =
            app::parse(std::span<const char* const>(argv + 1, argv + argc));
        const app::CommonOptions common = app::commonOf(command);
        timeseries::threadLimit = common.threads;
        app::chooseStepCache(common.cache, common.cacheSize);
        app::chosenMemory = common.memory;
        const int code = std::visit(Run{}, command);
        // A full disk behind a redirection shows only now.
        if (std::fflush(stdout) != 0) throw std::runtime_error("standard output cannot be written");
        return code;
    } catch (const timeseries::OutsideKeptError& error) {  // --range and --keep contradict
        app::sayTo(stderr, "isochron: {}\n", error.what());
        return 2;
    } catch (const app::ChoiceError& error) {  // what only the data tell to be wrong
        app::sayTo(stderr, "isochron: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        app::sayTo(stderr, "isochron: {}\n", timeseries::sentenceOf(error));
        return 1;
    }
}

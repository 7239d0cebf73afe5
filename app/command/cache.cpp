// `isochron cache`: the sorted steps that are kept on disk.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/command/commands.h"
#include "app/files/dataset.h"
#include "app/files/step_cache.h"
#include "app/say.h"

namespace app {
namespace {

using timeseries::StepStore;

// "T, step 3 of fire.nc": of what an index was made, as it says itself.
std::string originOf(const std::string& about) {
    const auto json = nlohmann::json::parse(about, nullptr, false);
    if (!json.is_object()) return "of something else";
    const auto files = json.value("files", nlohmann::json::array());
    const std::string file = files.empty() || !files.back().is_object()
                                 ? std::string()
                                 : files.back().value("file", std::string());
    return fmt::format("{}, step {} of {}", json.value("variable", std::string()),
                       json.value("step", std::uint64_t{0}), file);
}

void list(const StepStore& store) {
    std::uint64_t bytes = 0;
    const std::vector<timeseries::StoredFile> entries = store.list();
    for (const timeseries::StoredFile& entry : entries) {
        bytes += entry.bytes;
        const std::string about = StepStore::aboutOf(entry.path);
        say("{:>12}  {:%Y-%m-%d %H:%M}  {}\n", megabytesText(entry.bytes),
            fmt::localtime(std::chrono::system_clock::to_time_t(entry.used)),
            about.empty() ? entry.path.filename().string() + ", which cannot be read"
                          : originOf(about));
    }
    say("{} step{} in {}: {}\n", withCommas(entries.size()), entries.size() == 1 ? "" : "s",
        store.folder().string(), megabytesText(bytes));
}

}  // namespace

int cache(const CacheOptions& options) {
    const auto store = stepCache();
    if (!store) {
        say("No sorted steps are kept: {}\n",
            options.cache == "off" ? "the cache is off" : whyNoStepCache());
        return 0;
    }
    if (options.action == CacheOptions::Action::List)
        list(*store);
    else
        say("{} removed from {}\n", megabytesText(store->clear()), store->folder().string());
    return 0;
}

}  // namespace app

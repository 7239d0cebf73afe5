#include "app/files/step_cache.h"

#include <fmt/format.h>

#include <cstdio>
#include <mutex>

#include "app/choices/user_files.h"
#include "app/say.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using timeseries::StepStore;
using timeseries::StoreKind;

struct Chosen {
    std::mutex mutex;
    std::string choice;
    std::optional<std::uint64_t> budget;
    std::shared_ptr<StepStore> store;  // once asked for
};

Chosen& chosen() {
    static Chosen only;
    return only;
}

}  // namespace

void chooseStepCache(const std::string& choice, std::optional<std::uint64_t> budget) {
    const std::lock_guard lock(chosen().mutex);
    chosen().choice = choice;
    chosen().budget = budget;
    chosen().store = nullptr;
}

std::shared_ptr<StepStore> stepCache() {
    const std::lock_guard lock(chosen().mutex);
    if (chosen().store || chosen().choice == "off") return chosen().store;
    fs::path folder = chosen().choice;
    if (folder.empty() && !cacheFolder().empty()) folder = cacheFolder() / "steps";
    if (!folder.empty())
        chosen().store = std::make_shared<StepStore>(
            folder, StoreKind::Cache,
            chosen().budget ? *chosen().budget : timeseries::defaultCacheBudget(folder));
    return chosen().store;
}

std::string whyNoStepCache() {
    const bool isOff = [] {
        const std::lock_guard lock(chosen().mutex);
        return chosen().choice == "off";
    }();
    if (isOff || stepCache()) return "";
    return "neither XDG_CACHE_HOME nor HOME names a folder; --cache DIR does";
}

fs::path folderBeside(std::span<const fs::path> files) {
    return fs::absolute(files.front()).parent_path() / "isochron-index";
}

std::shared_ptr<StepStore> storeBeside(std::span<const fs::path> files) {
    return std::make_shared<StepStore>(folderBeside(files), StoreKind::Beside);
}

timeseries::StepStores storesFor(std::span<const fs::path> files) {
    timeseries::StepStores stores;
    if (files.empty()) return stores;
    std::error_code gone;
    if (fs::is_directory(folderBeside(files), gone)) stores.read.push_back(storeBeside(files));
    if (auto cache = stepCache()) stores.read.push_back(std::move(cache));
    return stores;
}

std::string megabytesText(std::uint64_t bytes) {
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}

void tellNotes(const timeseries::StepStores& stores) {
    for (const auto& store : stores.read)
        for (const std::string& note : store->takeNotes()) sayTo(stderr, "note: {}\n", note);
}

}  // namespace app

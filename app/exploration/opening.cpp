#include "app/exploration/opening.h"

#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

#include "timeseries/sentence.h"

namespace app {

struct Opening::Shared {
    std::mutex mutex;
    std::optional<std::variant<OpenDataset, std::string>> result;
};

namespace {

std::variant<OpenDataset, std::string> opened(const std::vector<std::filesystem::path>& named,
                                              const std::string& variable,
                                              const DatasetOpener& open) {
    try {
        return open(named, variable);
    } catch (const std::bad_alloc&) {
        return named.front().string() + ": there is not enough memory to open it";
    } catch (const std::exception& error) {
        return timeseries::sentenceOf(error);
    }
}

}  // namespace

Opening::Opening(std::vector<std::filesystem::path> named, std::string variable, DatasetOpener open,
                 std::function<void()> wake)
    : named_(std::move(named)), shared_(std::make_shared<Shared>()) {
    std::thread([shared = shared_, named = named_, variable = std::move(variable),
                 open = std::move(open), wake = std::move(wake)] {
        auto result = opened(named, variable, open);
        {
            const std::lock_guard lock(shared->mutex);
            shared->result = std::move(result);
        }
        wake();
    }).detach();
}

std::optional<std::variant<OpenDataset, std::string>> Opening::poll() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->result, std::nullopt);
}

}  // namespace app

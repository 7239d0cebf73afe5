// A file being opened beside the interface: its headers are read on a thread of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "app/files/dataset.h"

namespace app {

// As openDataset() (dataset.h) does it; a test has one of its own. Called from other threads.
using DatasetOpener =
    std::function<OpenDataset(std::span<const std::filesystem::path>, const std::string& variable)>;

// Dropping it cancels: nothing waits for the thread, whose result is thrown away. A library's call
// cannot be interrupted, so the thread may still run when the program ends: see exploration.h.
class Opening {
 public:
    // `wake` is called from the other thread when the result is there, also after this is gone.
    Opening(std::vector<std::filesystem::path> named, std::string variable, DatasetOpener open,
            std::function<void()> wake);

    const std::vector<std::filesystem::path>& named() const { return named_; }
    // Once: the dataset, or the sentence that says why there is none.
    std::optional<std::variant<OpenDataset, std::string>> poll();

 private:
    struct Shared;
    std::vector<std::filesystem::path> named_;
    std::shared_ptr<Shared> shared_;
};

}  // namespace app

// A file being opened beside the interface: its headers are read on a thread of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/dataset.h"

namespace app {

// Dropping it cancels: nothing waits for the thread, whose result is thrown away. (A library's call
// cannot be interrupted; at the program's end such a thread is left to the system.)
class Opening {
 public:
    // `wake` is called from the other thread when the result is there; it must be thread-safe.
    Opening(std::vector<std::filesystem::path> named, std::string variable,
            std::function<void()> wake);

    const std::vector<std::filesystem::path>& named() const { return named_; }
    // Once: the dataset, or the sentence that says why there is none.
    std::optional<std::variant<Dataset, std::string>> poll();

 private:
    struct Shared;
    std::vector<std::filesystem::path> named_;
    std::shared_ptr<Shared> shared_;
};

}  // namespace app

// The options that choose what is looked at and how: those of `render` and of `view`.
#pragma once

#include <string>
#include <vector>

#include "app/choices/explorer.h"

namespace CLI {
class App;
}

namespace app {

// What CLI11 collects as text, before it becomes an Explorer.
class ExplorerOptions {
 public:
    // The command refers to this, which must stay where it is.
    void addTo(CLI::App& command);
    // The session's, where one is named (by --session or in a file's place), but for what is given
    // beside it. Throws std::invalid_argument (one sentence), timeseries::FileError for the
    // session.
    Explorer explorer(const CLI::App& command) const;

 private:
    std::vector<std::variant<glm::dvec3, MapChoice>> colorsInOrder(const CLI::App& command) const;
    void applyLayers(const CLI::App& command, Explorer& explorer) const;

    std::vector<std::string> texts_;  // of each of choices(), where its option takes one
    std::vector<std::string> files_, ranges_, colors_, colormaps_, opacities_, axisNames_, models_;
    std::vector<std::size_t> hidden_;
    std::string session_;
};

}  // namespace app

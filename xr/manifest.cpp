#include "xr/manifest.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace xr {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string() : value;
}

std::vector<fs::path> configurationFolders() {
    std::vector<fs::path> folders;
    if (const std::string own = environment("XDG_CONFIG_HOME"); !own.empty()) {
        folders.emplace_back(own);
    } else if (const std::string home = environment("HOME"); !home.empty()) {
        folders.push_back(fs::path(home) / ".config");
    }
    const std::string shared = environment("XDG_CONFIG_DIRS");
    std::istringstream list(shared.empty() ? "/etc/xdg" : shared);
    for (std::string folder; std::getline(list, folder, ':');) folders.emplace_back(folder);
    folders.emplace_back("/etc");
    return folders;
}

}  // namespace

std::optional<fs::path> runtimeManifest() {
    if (const std::string chosen = environment("XR_RUNTIME_JSON"); !chosen.empty()) return chosen;
    for (const fs::path& folder : configurationFolders()) {
        fs::path manifest = folder / "openxr" / "1" / "active_runtime.json";
        std::error_code unreadable;
        if (fs::exists(manifest, unreadable)) return manifest;
    }
    return std::nullopt;
}

}  // namespace xr

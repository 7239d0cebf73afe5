// Paths as they are written down, and what they lead to.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace app {

// The path that leads from `folder` to `file`; both may be relative to the current folder. The
// file's own where there is none.
inline std::filesystem::path relativeTo(const std::filesystem::path& folder,
                                        const std::filesystem::path& file) {
    const auto normal = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path.empty() ? "." : path).lexically_normal();
    };
    const auto near = normal(file).lexically_relative(normal(folder));
    return near.empty() ? file : near;
}

// As it is named from the folder where it lies below it, else whole: no way up, which leads
// elsewhere from the next folder.
inline std::filesystem::path namedFrom(const std::filesystem::path& folder,
                                       const std::filesystem::path& file) {
    const std::filesystem::path near = relativeTo(folder, file);
    return *near.begin() == ".." ? std::filesystem::absolute(file).lexically_normal() : near;
}

// A pattern is there while the folder is in which its names are looked for.
inline bool isThere(std::filesystem::path path) {
    std::error_code gone;
    while (!std::filesystem::exists(path.empty() ? "." : path, gone)) {
        if (path.string().find_first_of("*?[") == std::string::npos) return false;
        path = path.parent_path();
    }
    return true;
}

}  // namespace app

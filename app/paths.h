// Paths as they are written down: from the folder that they are read in.
#pragma once

#include <filesystem>

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

}  // namespace app

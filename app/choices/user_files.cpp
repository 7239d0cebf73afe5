#include "app/choices/user_files.h"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

#include "render/image/image.h"
#include "render/image/picture_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

fs::path absoluteFrom(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : fs::path();
}

fs::path folder(const char* variable, const char* underHome) {
    if (const fs::path base = absoluteFrom(variable); !base.empty()) return base / "isochron";
    const fs::path home = absoluteFrom("HOME");
    return home.empty() ? home : home / underHome / "isochron";
}

}  // namespace

fs::path configFolder() { return folder("XDG_CONFIG_HOME", ".config"); }
fs::path stateFolder() { return folder("XDG_STATE_HOME", ".local/state"); }
fs::path cacheFolder() { return folder("XDG_CACHE_HOME", ".cache"); }

void makeFoldersOf(const fs::path& file) {
    const fs::path folder = file.parent_path();
    std::error_code failed;
    if (folder.empty() || fs::is_directory(folder, failed)) return;
    fs::create_directories(folder, failed);
    if (failed)
        throw render::ImageError(file, fmt::format("cannot be created: its folder {} is not there "
                                                   "and cannot be made: {}",
                                                   folder.string(), failed.message()));
}

void writeWhole(const fs::path& file, const std::string& text) {
    makeFoldersOf(file);
    render::PartialFile partial(file);
    std::fwrite(text.data(), 1, text.size(), partial.stream());
    partial.commit();  // tells of a write that failed
}

}  // namespace app

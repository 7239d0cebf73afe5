// Where the program keeps what is the user's, and how: whole files or none.
#pragma once

#include <filesystem>
#include <string>

namespace app {

// $XDG_CONFIG_HOME/isochron or ~/.config/isochron, $XDG_STATE_HOME/isochron or
// ~/.local/state/isochron, $XDG_CACHE_HOME/isochron or ~/.cache/isochron (XDG Base Directory
// Specification 0.8: what is not absolute counts as unset). Empty where there is no home either:
// then nothing can be kept.
std::filesystem::path configFolder();
std::filesystem::path stateFolder();
std::filesystem::path cacheFolder();

// The folders that a file is to be in. Throws std::runtime_error, one sentence that names the file.
void makeFoldersOf(const std::filesystem::path& file);

// Makes the folders too. A file that appears under its name is complete. Throws std::runtime_error,
// one sentence that names the file.
void writeWhole(const std::filesystem::path& file, const std::string& text);

}  // namespace app

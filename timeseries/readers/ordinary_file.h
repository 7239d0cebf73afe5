// What keeps a path from being read as a file. Asked before anything is opened: opening a pipe
// waits for its writer, a device may have no end. Names of files stand inside files (NRRD headers,
// VTK collections), so that whoever wrote one chooses what is opened.
#pragma once

#include <filesystem>
#include <string>

namespace timeseries {

// "expected a file, but there is none", or what the system says against it; "" for an ordinary file
// that may be read, or a link to one.
std::string flawOfFile(const std::filesystem::path& path);
// Throws FileError where it has such a flaw.
void expectFile(const std::filesystem::path& path);

}  // namespace timeseries

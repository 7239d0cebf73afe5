// Where rendered eyes go: one file or two, PNG or OpenEXR, one picture or both eyes in one.
#pragma once

#include <filesystem>
#include <vector>

#include "app/choices/explorer.h"
#include "render/frame/frame.h"

namespace app {

// The files that write() makes of `file`: itself, or its _left and _right.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& file, Stereo stereo);

// By the file's ending. REQUIRES: one eye without stereo, else left and right. Throws ImageError.
void write(const std::filesystem::path& file, Stereo stereo, std::vector<render::EyePicture> eyes,
           const render::Metadata& metadata);

}  // namespace app

// Several files of one format as one series, for formats whose files are opened one by one.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/reader.h"

namespace timeseries {

using OpenOne = std::function<std::unique_ptr<Reader>(const std::filesystem::path&)>;

// What a file of one step tells before it is opened.
struct Glance {
    std::shared_ptr<const TimeAxis> time;  // of one point; counted where it tells none
    std::vector<std::string> variables;    // their names
    std::string flaw;  // the FileError's sentence that opening it would meet; "" where none is seen
};
// Nothing of a file that has to be opened for its steps. Called on several threads at once.
using GlanceAt = std::function<std::optional<Glance>(const std::filesystem::path&)>;

// How the grids of the steps are to this, the first file's, where files were glanced at alone.
using GridsOf =
    std::function<StepGrids(std::span<const std::filesystem::path> paths, const Grid& first)>;

// Whether files may be opened on several threads at once.
enum class OpenedOn { OneThread, AllThreads };

// The steps of all files, in the order of the paths. Each file is opened once here, for what it
// says of itself, and again when a step of it is read; few stay open. With `glanceAt` only the
// first is opened here, and each other when a step of it is read: one that does not fit then, or
// cannot be read, is refused each time, and the other steps are none the worse for it; a note tells
// those of which a glance shows it.
// Times are the files' own where all files have them, in the same units, and no two of one step a
// file have the same (openReader() puts steps in their order); else, with one step a file, the
// numbers in which the names differ; else steps are counted. Why the files' own are not taken is a
// note. REQUIRES: paths is not empty. Throws FileError, naming two files, where variables, types,
// units or grids differ, and where times of files of several steps overlap.
std::unique_ptr<Reader> openSequence(std::span<const std::filesystem::path> paths, OpenOne openOne,
                                     const GlanceAt& glanceAt = {}, GridsOf gridsOf = {},
                                     OpenedOn on = OpenedOn::OneThread);

}  // namespace timeseries

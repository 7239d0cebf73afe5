// Where this program finds sorted steps on disk, and where it keeps them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "timeseries/series/step_maker.h"

namespace app {

// `choice`: of --cache: a folder, "off", or "" for the user's own; it may take so many bytes
// (without it a tenth of its disk, 64 GiB at most). Once, before the stores are asked for: it is
// the whole program's.
void chooseStepCache(const std::string& choice, std::optional<std::uint64_t> budget = {});

// Null where it is off, or nothing can be kept.
std::shared_ptr<timeseries::StepStore> stepCache();
// Why there is none, though nobody has switched it off; empty where there is one.
std::string whyNoStepCache();
// The folder of indices that lies beside these files and moves with them. REQUIRES: one at least.
std::filesystem::path folderBeside(std::span<const std::filesystem::path> files);
std::shared_ptr<timeseries::StepStore> storeBeside(std::span<const std::filesystem::path> files);

// What is read: beside these files, then in the cache. Nothing is written: that would be waited
// for.
timeseries::StepStores storesFor(std::span<const std::filesystem::path> files);

std::string megabytesText(std::uint64_t bytes);  // "62.1 MB"

// What the stores have to tell, in one line each, on stderr.
void tellNotes(const timeseries::StepStores& stores);

}  // namespace app

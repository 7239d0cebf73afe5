// An Explorer as JSON, so that a picture can be made again. File paths are kept relative to the
// session file.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/choices/explorer.h"

namespace app {

// Which paths a session keeps: those from its own folder, so that it moves with its data, and the
// absolute ones, so that it finds them when it moves alone. What is to be published keeps only the
// former, which say nothing of the machine.
enum class Paths { Both, Relative };

// `folder`: what paths are relative to.
nlohmann::json toJson(const Explorer& explorer, const std::filesystem::path& folder,
                      Paths paths = Paths::Both);
// A file is where it was when the session was written, else as far from `folder` as it was then.
// Where it is in neither place, its path is the former. Unknown keys are refused: a misspelt one
// would be a silent default. Throws ChoiceError naming the key and what was expected there.
Explorer fromJson(const nlohmann::json& json, const std::filesystem::path& folder);

// Under which name a picture carries its session, as JSON text.
inline constexpr const char* kSessionKey = "isochronSession";

// What a session file may tell beside the choices: the error of the picture that it was saved of
// (app/picture/depth_error.h). Read over, for whoever draws it works it out.
inline constexpr const char* kSessionErrorKey = "opticalDepthError";

// Whether a file's name says that it is one that readSession() takes.
bool holdsSession(const std::filesystem::path& file);
// A session file, or a picture (.png, .exr) that carries its session; paths are relative to its
// folder. Throws timeseries::FileError naming the file and, where it is JSON, the key.
Explorer readSession(const std::filesystem::path& file);
// Of a session's data, the first that is not there any more.
std::optional<std::filesystem::path> missingFile(const Explorer& session);

}  // namespace app

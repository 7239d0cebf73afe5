// Which file tells the loader of the active runtime, for the sentence that says why there is none.
#pragma once

#include <filesystem>
#include <optional>

namespace xr {

// By the loader's rules: $XR_RUNTIME_JSON, whether it exists or not, else the first
// active_runtime.json below the user's and the system's configuration folders (OpenXR loader,
// "Active Runtime Discovery").
std::optional<std::filesystem::path> runtimeManifest();

}  // namespace xr

#include "timeseries/readers/file_pattern.h"

#include <fmt/format.h>
#include <glob.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <optional>
#include <string>

#include "timeseries/readers/amrex/amrex_header.h"
#include "timeseries/readers/foam/foam_case.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_files.h"
#include "timeseries/readers/text/cut_name.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

bool hasWildcards(const Path& path) {
    return path.string().find_first_of("*?[") != std::string::npos;
}

// None where some folder cannot be listed; one that is not there, as where a link leads nowhere,
// has no files.
std::optional<Paths> globbed(const Path& pattern) {
    const auto isRefused = [](const char*, int error) {
        return static_cast<int>(error != ENOENT && error != ENOTDIR && error != ELOOP);
    };
    glob_t found{};
    const int code = glob(pattern.c_str(), GLOB_NOSORT, isRefused, &found);
    const std::unique_ptr<glob_t, void (*)(glob_t*)> release(&found, globfree);
    if (code != 0 && code != GLOB_NOMATCH) return std::nullopt;
    return Paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
}

// Whether what is in the pattern's folders can be asked for: a name without wildcards is not looked
// for in a list of all, and where it cannot be seen it is not there for glob().
bool canBeSought(const Path& pattern) {
    for (Path folders = pattern.parent_path(); hasWildcards(folders);
         folders = folders.parent_path()) {
        const auto found = globbed(folders);
        if (!found || std::ranges::any_of(*found, [](const Path& each) {
                std::error_code ignored;
                return std::filesystem::is_directory(each, ignored) &&
                       access(each.c_str(), X_OK) != 0;
            }))
            return false;
    }
    return true;
}

}  // namespace

bool isPattern(const Path& path) {
    std::error_code ignored;
    return hasWildcards(path) && !std::filesystem::exists(path, ignored);
}

Paths filesOfPattern(const Path& pattern) {
    std::optional<Paths> found = globbed(pattern);
    if (!found || !canBeSought(pattern))
        throw FileError(
            fmt::format("{}: expected a pattern whose folders can be listed", pattern.string()));
    if (found->size() > kMaxSeriesFiles)
        throw FileError(fmt::format("{}: expected a pattern of at most {} files, found {}",
                                    pattern.string(), kMaxSeriesFiles, found->size()));
    Paths& files = *found;
    std::erase_if(files, [](const Path& path) {
        std::error_code ignored;
        return std::filesystem::is_directory(path, ignored) && !isZarr(path) && !isFoamCase(path) &&
               !isAmrex(path);
    });
    if (files.empty())
        throw FileError(fmt::format("{}: no file has such a name", pattern.string()));
    std::ranges::sort(files, [](const Path& a, const Path& b) {
        return a.parent_path() == b.parent_path() ? nameLess(a, b)
                                                  : a.parent_path() < b.parent_path();
    });
    return files;
}

}  // namespace timeseries

#include "timeseries/series/replaced_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace timeseries {

namespace fs = std::filesystem;

ReplacedFile::ReplacedFile(const fs::path& name) : target(name) {
    std::error_code none;
    if (fs::is_symlink(name, none))
        if (auto led = fs::canonical(name, none); !none) target = std::move(led);
    struct stat there {};
    if (::stat(target.c_str(), &there) != 0) return;
    const int failed = ::access(target.c_str(), W_OK) == 0 ? 0 : errno;
    if (failed == ENOENT) return;  // meanwhile it has been removed
    mode = there.st_mode;
    refusal = failed;
}

bool ReplacedFile::isFile() const { return !mode || S_ISREG(*mode); }
bool ReplacedFile::isFolder() const { return mode && S_ISDIR(*mode); }

void ReplacedFile::keepMode(int file) const {
    if (mode) (void)::fchmod(file, *mode & 0777);
}

}  // namespace timeseries

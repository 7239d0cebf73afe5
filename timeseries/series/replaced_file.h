// What stands where a file is to appear whole: for those who write it under another name first.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

namespace timeseries {

struct ReplacedFile {
    // A link stays, and what it leads to is replaced; one that leads nowhere is replaced itself.
    explicit ReplacedFile(const std::filesystem::path& name);

    std::filesystem::path target;
    std::optional<mode_t> mode;  // of what is there
    // Why what is there is not to be replaced, as errno has it: it is not to be written. 0: it is.
    int refusal = 0;

    bool isFile() const;  // or nothing is there
    bool isFolder() const;
    // Who may read what is there may read what is written into this descriptor in its place.
    void keepMode(int file) const;
};

}  // namespace timeseries

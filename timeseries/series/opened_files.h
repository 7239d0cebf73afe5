// Whether files are still what they were when they were opened: a library that has read a header
// takes other bytes for values, or the memory that it had for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "timeseries/readers/file_stamp.h"

namespace timeseries {

class OpenedFiles {
 public:
    // Few files may grow while they are open, as those of a simulation that runs do: some of their
    // bytes are looked at again then.
    static constexpr std::size_t kFew = 16;
    explicit OpenedFiles(std::span<const std::filesystem::path> files);
    // Throws FileError when one of them is another, or of another size or time, than when it was
    // seen first, unless it has but grown. Folders gain files, and what is gone its reader tells.
    void expectSame(std::span<const std::filesystem::path> files);
    void expectSame();  // those that it was made with

 private:
    struct First {
        FileStamp seen;
        std::uint64_t bytes;  // then
        std::string sample;   // of these; "" of one that may not grow
    };
    std::map<std::filesystem::path, First> files_;
};

}  // namespace timeseries

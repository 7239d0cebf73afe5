// Readers of some of a series' files, of which it may have more than there are handles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>

#include "timeseries/readers/reader.h"

namespace timeseries {

// By which a file that was written anew is told from the one that was opened.
struct WrittenAt {
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type time = {};
    friend bool operator==(const WrittenAt&, const WrittenAt&) = default;
};
// All 0 of one that is not there.
WrittenAt writtenAt(const std::filesystem::path& path);

class KeptReaders {
 public:
    // The one of this file that was written then, now the last used. Where it is none there is room
    // for it afterwards.
    Reader* find(std::size_t file, const WrittenAt& at);
    Reader& keep(std::size_t file, const WrittenAt& at, std::unique_ptr<Reader> reader);

 private:
    struct Open {
        std::size_t file;
        WrittenAt at;
        std::unique_ptr<Reader> reader;
    };
    std::list<Open> open_;  // the last used first
};

}  // namespace timeseries

// An OpenVDB file: its grids, and their values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "timeseries/readers/arrays/vdb_library.h"

namespace timeseries {

class VdbFile {
 public:
    // OpenVDB crashes on some damaged files, so that a new one's header is read in a copy of this
    // process first, as are voxels; a known one was read before. Throws FileError.
    enum class Header { New, Known };
    VdbFile(const std::filesystem::path& path, Header header);

    const std::vector<VdbGrid>& grids() const { return contents_.grids; }
    const std::vector<DamagedVariable>& damaged() const { return contents_.damaged; }
    // As VdbLibrary::read.
    Values read(const VdbGrid& grid, const VdbBox& box) const;

 private:
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    // In a copy of this process, which may take as much memory as the file's bytes account for and
    // so many bytes more.
    void tryInCopy(std::string_view place, std::uint64_t more,
                   const std::function<void()>& work) const;

    // Where memory does not suffice, that is a FileError.
    void told(std::string_view place, const std::function<void()>& work) const;

    std::filesystem::path path_;
    const VdbLibrary* library_;
    VdbContents contents_;
};

}  // namespace timeseries

// The files of one snapshot of particles. Large ones are in several, "snap_010.0.hdf5" and so on,
// each with some of the particles (Springel, "User guide for GADGET-2", 6.5,
// NumFilesPerSnapshot); SWIFT writes "snap_0010.hdf5" beside these, which refers to them (SWIFT's
// documentation, "Parameter Files", distributed snapshots: attribute Virtual).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

// PartType0 to PartType6.
constexpr std::size_t kSnapshotTypes = 7;

bool isSnapshot(const NcHeader& header);

class SnapshotFiles {
 public:
    // `opened` is any of them. Throws FileError, which names a file that is missing.
    explicit SnapshotFiles(std::unique_ptr<NetcdfFile> opened);

    // In the order of their numbers. At least one.
    std::span<const std::filesystem::path> paths() const { return paths_; }
    // Only one is open at a time: the reference holds until another is asked for.
    const NetcdfFile& at(std::size_t index) const;

 private:
    std::vector<std::filesystem::path> paths_;
    mutable std::unique_ptr<NetcdfFile> open_;
    mutable std::size_t openIndex_ = 0;
    mutable std::vector<bool> known_;  // those whose headers were read
};

// Of files that are parts of snapshots, told by their names and by the header of one of each kind
// that can be read, the first alone of each snapshot; nor what SWIFT writes beside them. The others
// as they are, in the order in which they are given.
std::vector<std::filesystem::path> firstPartsOf(std::vector<std::filesystem::path> files);

// Which of firstPartsOf() stands for a file, or the file itself.
std::filesystem::path firstPartOf(const std::filesystem::path& file,
                                  std::span<const std::filesystem::path> firstParts);

}  // namespace timeseries

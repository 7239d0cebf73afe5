// What the header of an NRRD file declares, as plain values. teem reads the fields; the line that
// names data files is read here (nrrd_files), for teem hands its pattern to printf.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "timeseries/grid/field.h"

namespace timeseries {

enum class NrrdEncoding { Raw, Gzip, Bzip2, Ascii };

// What an axis runs along, by its kind.
enum class NrrdKind { Unknown, Space, Time, List, Components };

struct NrrdAxis {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t size = 0;
    double spacing = kNone, min = kNone, max = kNone;  // NaN when not told
    std::optional<std::array<double, 4>> direction;    // in space; nothing for "none"
    std::optional<bool> cell;                          // cell-centred, or node-centred
    NrrdKind kind = NrrdKind::Unknown;
    std::string kindName, label, units;
};

struct NrrdHeader {
    std::filesystem::path path;
    std::string magic;  // "NRRD0004"
    ValueType type{};
    NrrdEncoding encoding{};
    bool swapped = false;        // not of this machine's byte order
    std::vector<NrrdAxis> axes;  // fastest first, at least one, none of size 0

    std::size_t spaceDimension = 0;  // 0: no space
    bool timeInSpace = false;        // the last coordinate of space is time
    bool leftHanded = false;
    std::string space;                            // "left-posterior-superior"; "" for none
    std::optional<std::array<double, 4>> origin;  // of the first sample
    std::array<std::string, 4> spaceUnits;

    std::string content, sampleUnits;
    std::vector<std::pair<std::string, std::string>> keyValues;

    std::optional<std::string> dataFile;    // of the field `data file`; nothing when attached
    std::vector<std::string> dataFileList;  // the lines after `data file: LIST`
    std::uint64_t headerBytes = 0;          // where attached data begin
    std::uint64_t lineSkip = 0;
    std::int64_t byteSkip = 0;  // -1: the values are the end of the file

    std::uint64_t pointCount() const;  // of all steps
    std::size_t valueBytes() const;
    std::string_view keyValue(std::string_view key) const;  // "" when absent

    // "path: place: what", on one line.
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
};

// Throws FileError. Reads the header only.
NrrdHeader readNrrdHeader(const std::filesystem::path& path);

}  // namespace timeseries

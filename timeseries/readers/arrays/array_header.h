// What a file declares of one array of numbers that lies in it or beside it: formats that are a
// header and values fill this in, and ArrayReader does the rest.
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

enum class ArrayEncoding { Raw, Gzip, Bzip2, Ascii };

// What an axis runs along, by its kind.
enum class ArrayKind { Unknown, Space, Time, List, Components };

struct ArrayAxis {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t size = 0;
    double spacing = kNone, min = kNone, max = kNone;  // NaN when not told
    std::optional<std::array<double, 4>> direction;    // in space; nothing for "none"
    std::optional<bool> cell;                          // cell-centred, or node-centred
    ArrayKind kind = ArrayKind::Unknown;
    std::string kindName, label, units;
};

struct ArrayHeader {
    std::filesystem::path path;
    std::string format;  // "NRRD0004"
    ValueType type{};    // as stored
    // What a point has for a stored value s: slope s + offset, in double.
    struct Scaling {
        double slope, offset;
    };
    std::optional<Scaling> scaling;
    ArrayEncoding encoding{};
    bool swapped = false;         // not of this machine's byte order
    std::vector<ArrayAxis> axes;  // fastest first, at least one, none of size 0

    std::size_t spaceDimension = 0;  // 0: no space
    bool timeInSpace = false;        // the last coordinate of space is time
    bool leftHanded = false;
    std::string space;                            // "left-posterior-superior"; "" for none
    std::optional<std::array<double, 4>> origin;  // of the first sample
    std::array<std::string, 4> spaceUnits;

    std::string name, longName, units;  // of the values; "" when not told
    bool categories = false;            // as Field::categories
    std::vector<std::pair<std::string, std::string>> keyValues;
    std::vector<std::string> notes;

    // Each holds as many values, one after the other; from the header's folder. None: they are in
    // the file itself.
    std::vector<std::string> dataFiles;
    std::uint64_t headerBytes = 0;  // where values in the file itself begin
    std::uint64_t lineSkip = 0;
    std::int64_t byteSkip = 0;  // -1: the values are the end of the file

    std::uint64_t pointCount() const;  // of all steps
    std::size_t valueBytes() const;
    std::string_view keyValue(std::string_view key) const;  // "" when absent

    // "path: place: what", on one line.
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
};

}  // namespace timeseries

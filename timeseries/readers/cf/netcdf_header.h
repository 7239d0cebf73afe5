// What a netCDF file declares, as plain values: dimensions, variables, attributes. Everything that
// interprets the CF conventions works on these and is tested without a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/number.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {

struct NcAttribute {
    std::string name;
    std::variant<std::string, std::vector<Number>> value;
    std::optional<ValueType> type;  // of numbers; nothing for text
};

struct NcDimension {
    std::string name;
    std::uint64_t length = 0;
    bool unlimited = false;
    // HDF5 that no netCDF wrote may have no names for its dimensions. The library then makes them
    // up, one for each length, so that the same one may mean several things.
    bool isNamed() const { return !name.starts_with("phony_dim_"); }
};

// What a variable or a group says of itself.
struct NcAttributes {
    std::vector<NcAttribute> attributes;

    const NcAttribute* find(std::string_view attribute) const;
    std::string text(std::string_view attribute) const;  // oneLine(); "" when absent or not text
    // None when absent or text.
    std::vector<double> numbers(std::string_view attribute) const;
};

struct NcGroup : NcAttributes {
    std::string name;  // "" for the root, else "a/b"
};

struct NcVariable : NcAttributes {
    std::string name;                     // "T"; in a group "a/b/T"
    std::string group;                    // "" for the root, else "a/b"
    std::optional<ValueType> type;        // as stored; nothing for text, strings, compound types
    std::vector<std::size_t> dimensions;  // positions in NcHeader::dimensions, slowest first
    bool filled = true;                   // the library fills what was never written
    std::uint64_t chunkBytes = 0;         // of one chunk, 0 when not chunked
    int groupId = 0, id = 0;              // the library's, while the file is open

    std::string_view baseName() const;
    // Of a dimension among its own, the slowest first; nothing where it has no such one.
    std::optional<std::size_t> positionOf(std::optional<std::size_t> dimension) const;
    // Whether it is numbers, one for each place along that dimension.
    bool isAlong(std::size_t dimension) const {
        return type && dimensions.size() == 1 && dimensions[0] == dimension;
    }
};

// What a name in a file's attributes may mean as seen from `group`, the likeliest first: what is
// there, then in the groups around it; of "/a/b", "./b" and "../b" what that says alone (CF 1.10,
// section 2.7).
std::vector<std::string> namesMeant(std::string_view name, std::string_view group);

// The format of files whose dimensions have no names.
constexpr std::string_view kPlainHdf5 = "HDF5";

struct NcHeader {
    std::string format;  // "NetCDF-4"
    std::vector<NcDimension> dimensions;
    std::vector<NcVariable> variables;
    std::vector<NcGroup> groups;  // the root is the first

    // By the name as written in a file's attributes, seen from `group`. Null when there is none.
    const NcVariable* find(std::string_view name, std::string_view group) const;
    // Null when there is none of this name.
    const NcGroup* findGroup(std::string_view name) const;
    // "T(time, z, y, x)"
    std::string declaration(const NcVariable& variable) const;
    const NcDimension& dimension(const NcVariable& variable, std::size_t position) const {
        return dimensions[variable.dimensions[position]];
    }
};

}  // namespace timeseries

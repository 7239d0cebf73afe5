// A file of netCDF's data model, whatever its format: variables over named dimensions, which the CF
// conventions give a meaning. What interprets these asks nothing else of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/readers/cf/netcdf_header.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// An attribute that is not what it must be, which costs only the variables that need it.
struct AttributeError : FileError {
    using FileError::FileError;
};

class CfFile {
 public:
    virtual ~CfFile() = default;
    CfFile(const CfFile&) = delete;
    CfFile& operator=(const CfFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const NcHeader& header() const { return header_; }
    // Those of the file that are no part of its header for what it says of them.
    virtual std::span<const DamagedVariable> damaged() const { return {}; }
    // All files that it is made of; none where their sizes and times do not tell that no value has
    // changed.
    virtual std::vector<std::filesystem::path> sources() const { return {path_}; }

    // Why so many points of a variable are not read, as a sentence's end; "" when they are. A
    // damaged or hostile header may declare any size, so what is asked for is held against the
    // file's own.
    virtual std::string tooLarge(const NcVariable& variable, std::uint64_t points) const = 0;
    // Every value, exact, in the file's order. REQUIRES: a numeric type. Throws FileError.
    virtual std::vector<Number> numbers(const NcVariable& variable) const = 0;
    // Of a variable of texts, one for each place along its first dimension, as many from `first`
    // on, each up to where it ends: strings, or rows of characters. Nothing of any other, and where
    // the format's are not read. Throws FileError.
    virtual std::optional<std::vector<std::string>> texts(const NcVariable& /*variable*/,
                                                          std::size_t /*first*/,
                                                          std::size_t /*count*/) const {
        return std::nullopt;
    }
    // A block of values as stored. REQUIRES: `values` holds the product of `count` values of the
    // variable's type. Throws FileError.
    virtual void read(const NcVariable& variable, std::span<const std::size_t> start,
                      std::span<const std::size_t> count, void* values) const = 0;

    // "path: place: what", on one line.
    std::string sentence(std::string_view place, std::string_view what) const;
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    // As an AttributeError.
    [[noreturn]] void failAttribute(const NcVariable& variable, std::string_view what) const;

 protected:
    explicit CfFile(std::filesystem::path path) : path_(std::move(path)) {}

    std::filesystem::path path_;
    NcHeader header_;
};

}  // namespace timeseries

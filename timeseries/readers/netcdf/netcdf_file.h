// One open netCDF file. All calls of the netCDF library are made here, under one lock: neither it
// nor HDF5 below it may be used by two threads at once, even on different files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/file_stamp.h"
#include "timeseries/readers/netcdf/hdf5_elsewhere.h"
#include "timeseries/readers/netcdf/hdf5_enums.h"

namespace timeseries {

class NetcdfFile final : public CfFile {
 public:
    // A new file's header may crash HDF5 or keep it forever, so that it is read in a copy of this
    // process first; a known one was read before.
    enum class Header { New, Known };
    // Reads the header. Throws FileError, also when a classic file lacks values it declares. Those
    // that are open of the same file, which has changed since, are closed: HDF5 has one of all that
    // have it open, and would give what it knows of it. Whoever reads from them is told.
    NetcdfFile(const std::filesystem::path& path, Header header);
    ~NetcdfFile() override;
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;
    // Of each of these whether its header need not be New: copies of this process have read those
    // of many one after the other, or refused them. A copy for each takes 30 ms.
    static std::vector<bool> triedTogether(std::span<const std::filesystem::path> paths);

    // A compressed file unpacks to at most about 1032 times its bytes (the limit of deflate; its
    // format, RFC 1951, spends at least two bits on 258 bytes). Of HDF5 some may be in other files,
    // or not written.
    std::string tooLarge(const NcVariable& variable, std::uint64_t points) const override;
    // The same of values of a type for which the file has no array.
    std::string tooLarge(ValueType type, std::uint64_t points) const {
        return tooLarge(type, points, 0);
    }
    std::vector<std::filesystem::path> sources() const override;
    std::vector<Number> numbers(const NcVariable& variable) const override;
    // Of strings those alone that may be times, read with the header.
    std::optional<std::vector<std::string>> texts(const NcVariable& variable, std::size_t first,
                                                  std::size_t count) const override;
    void read(const NcVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, void* values) const override;

    // The rows of characters of the variable of that name, each up to where it ends; none when
    // there is none. Throws FileError.
    std::vector<std::string> lines(std::string_view name) const;

 private:
    // Opens nothing.
    explicit NetcdfFile(const std::filesystem::path& path) : CfFile(path) {}
    std::string tooLarge(ValueType type, std::uint64_t points, std::uint64_t chunkBytes) const;
    std::vector<Number> numbersOfEnum(const NcVariable& variable, std::uint64_t count) const;
    void open();
    void close();
    // What is open of such a file as it was before.
    static void closeFormer(const std::optional<FileStamp>& now);
    // Numbers of a file that was closed are those of others then.
    void expectOpen() const;
    void readHeader();
    void addEnums();
    void readStrings();
    std::vector<std::string> stringsOf(const NcVariable& variable) const;
    void readGroup(int group, const std::string& name, int depth);
    void readVariable(int group, const std::string& groupName, int id);
    void readGroupAttributes(int group, const std::string& name);
    std::optional<NcAttribute> readAttribute(int group, int variable, int number,
                                             const std::string& place) const;
    // Of a variable that is read, for errors. Throws where values that belong to it are not there.
    std::string placeOf(const NcVariable& variable) const;
    void check(int status, std::string_view place, std::string_view expected) const;

    std::uint64_t fileBytes_ = 0;
    double freeBytes_ = 1 << 20;  // of values that the file need not have
    int id_ = -1;                 // -1: closed
    std::optional<FileStamp> stamp_;
    Hdf5Elsewhere elsewhere_;
    Hdf5Enums enums_;
    std::vector<int> dimensionIds_;  // the library's, beside header_.dimensions
    std::map<std::string, std::vector<std::string>> strings_;  // [variable]
};

}  // namespace timeseries

// Writes small netCDF files for tests, by the library's C API.
#pragma once

#include <gtest/gtest.h>
#include <netcdf.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/files.h"

namespace tests {

template <typename T>
constexpr nc_type ncType() {
    if constexpr (std::is_same_v<T, std::int8_t>) return NC_BYTE;
    if constexpr (std::is_same_v<T, std::uint8_t>) return NC_UBYTE;
    if constexpr (std::is_same_v<T, std::int16_t>) return NC_SHORT;
    if constexpr (std::is_same_v<T, std::uint16_t>) return NC_USHORT;
    if constexpr (std::is_same_v<T, std::int32_t>) return NC_INT;
    if constexpr (std::is_same_v<T, std::uint32_t>) return NC_UINT;
    if constexpr (std::is_same_v<T, std::int64_t>) return NC_INT64;
    if constexpr (std::is_same_v<T, std::uint64_t>) return NC_UINT64;
    if constexpr (std::is_same_v<T, float>) return NC_FLOAT;
    if constexpr (std::is_same_v<T, double>) return NC_DOUBLE;
}

// Declare dimensions, variables and attributes, then write; the file is whole after close().
class NetcdfBuilder {
 public:
    // In the test's own folder.
    explicit NetcdfBuilder(const std::string& name, int mode = NC_NETCDF4) {
        path_ = tests::testFolder() / name;
        check(nc_create(path_.c_str(), mode | NC_CLOBBER, &id_));
    }
    ~NetcdfBuilder() {
        if (id_ >= 0) nc_close(id_);
    }
    NetcdfBuilder(const NetcdfBuilder&) = delete;
    NetcdfBuilder& operator=(const NetcdfBuilder&) = delete;

    int dimension(const std::string& name, std::size_t length) {
        int id = 0;
        check(nc_def_dim(id_, name.c_str(), length, &id));
        return id;
    }
    int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) {
        int id = 0;
        check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()),
                         dimensions.data(), &id));
        return id;
    }
    void text(int variable, const std::string& name, const std::string& value) {
        check(nc_put_att_text(id_, variable, name.c_str(), value.size(), value.data()));
    }
    template <typename T>
    void number(int variable, const std::string& name, const std::vector<T>& values) {
        check(nc_put_att(id_, variable, name.c_str(), ncType<T>(), values.size(), values.data()));
    }
    template <typename T>
    void number(int variable, const std::string& name, T value) {
        number(variable, name, std::vector<T>{value});
    }
    template <typename T>
    void write(int variable, const std::vector<T>& values) {
        end();
        check(nc_put_var(id_, variable, values.data()));
    }
    template <typename T>
    void write(int variable, const std::vector<std::size_t>& start,
               const std::vector<std::size_t>& count, const std::vector<T>& values) {
        end();
        check(nc_put_vara(id_, variable, start.data(), count.data(), values.data()));
    }
    void writeText(int variable, const std::string& characters) {
        end();
        check(nc_put_var_text(id_, variable, characters.data()));
    }
    // A dimension with its coordinate variable; write the coordinates with write().
    struct Coordinate {
        int dimension, variable;
    };
    Coordinate coordinate(const std::string& name, std::size_t length, const std::string& units) {
        const int d = dimension(name, length);
        const int v = variable(name, NC_DOUBLE, {d});
        if (!units.empty()) text(v, "units", units);
        return {d, v};
    }
    void end() {
        if (!ended_) check(nc_enddef(id_));
        ended_ = true;
    }
    int id() const { return id_; }
    std::filesystem::path close() {
        end();
        check(nc_close(id_));
        id_ = -1;
        return path_;
    }

    static void check(int status) {
        if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
    }

 private:
    std::filesystem::path path_;
    int id_ = -1;
    bool ended_ = false;
};

}  // namespace tests

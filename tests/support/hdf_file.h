// Small HDF5 files of arrays in groups, which netCDF writes.
#pragma once

#include <string>
#include <vector>

#include "tests/support/netcdf_builder.h"

namespace tests {

class HdfFile {
 public:
    // In the test's own folder.
    explicit HdfFile(const std::string& name = "file.vtkhdf") : file_(name) {
        file_.end();  // netCDF-4 goes back and forth by itself
    }
    // `name` may have slashes; each array has dimensions of its own, of these lengths.
    template <typename T>
    void put(const std::string& name, const std::vector<T>& values,
             const std::vector<std::size_t>& lengths) {
        const auto slash = name.rfind('/');
        const int group = groupOf(slash == name.npos ? "" : name.substr(0, slash));
        const std::string own = name.substr(slash + 1);
        std::vector<int> dimensions;
        for (const std::size_t length : lengths)
            NetcdfBuilder::check(nc_def_dim(group,
                                            (own + "_" + std::to_string(dimensions.size())).c_str(),
                                            length, &dimensions.emplace_back()));
        int variable = 0;
        NetcdfBuilder::check(nc_def_var(group, own.c_str(), ncType<T>(), int(dimensions.size()),
                                        dimensions.data(), &variable));
        NetcdfBuilder::check(nc_put_var(group, variable, values.data()));
    }
    template <typename T>
    void put(const std::string& name, const std::vector<T>& values, std::size_t columns = 1) {
        if (columns > 1)
            put(name, values, std::vector{values.size() / columns, columns});
        else
            put(name, values, std::vector{values.size()});
    }
    // What a group says, "" being the root, or an array that stands there already.
    template <typename T>
    void say(const std::string& of, const std::string& attribute, const std::vector<T>& values) {
        const Place at = placeOf(of);
        NetcdfBuilder::check(nc_put_att(at.group, at.variable, attribute.c_str(), ncType<T>(),
                                        values.size(), values.data()));
    }
    void say(const std::string& of, const std::string& attribute, double value) {
        say(of, attribute, std::vector{value});
    }
    void say(const std::string& of, const std::string& attribute, const std::string& text) {
        const Place at = placeOf(of);
        NetcdfBuilder::check(
            nc_put_att_text(at.group, at.variable, attribute.c_str(), text.size(), text.data()));
    }
    void say(const std::string& of, const std::string& attribute,
             const std::vector<std::string>& texts) {
        const Place at = placeOf(of);
        std::vector<const char*> all;
        for (const std::string& text : texts) all.push_back(text.c_str());
        NetcdfBuilder::check(
            nc_put_att_string(at.group, at.variable, attribute.c_str(), all.size(), all.data()));
    }
    std::filesystem::path close() { return file_.close(); }

 private:
    struct Place {
        int group, variable;
    };
    Place placeOf(const std::string& name) {
        const auto slash = name.rfind('/');
        const int around = groupOf(slash == name.npos ? "" : name.substr(0, slash));
        int variable = 0;
        if (nc_inq_varid(around, name.substr(slash + 1).c_str(), &variable) == NC_NOERR)
            return {around, variable};
        return {groupOf(name), NC_GLOBAL};
    }
    int groupOf(const std::string& path) {
        int id = file_.id();
        std::string rest = path;
        while (!rest.empty()) {
            const std::string one = rest.substr(0, rest.find('/'));
            rest = one.size() < rest.size() ? rest.substr(one.size() + 1) : "";
            int next = 0;
            if (nc_inq_grp_ncid(id, one.c_str(), &next) != NC_NOERR)
                NetcdfBuilder::check(nc_def_grp(id, one.c_str(), &next));
            id = next;
        }
        return id;
    }
    NetcdfBuilder file_;
};

}  // namespace tests

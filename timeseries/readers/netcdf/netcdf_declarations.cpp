// What a netCDF file declares, read into its header.
#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/cf/cf_packing.h"
#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/netcdf/netcdf_types.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr int kMaxGroupDepth = 64;
constexpr std::size_t kMaxAttributeBytes = 1 << 20;
constexpr std::size_t kMaxVariables = NC_MAX_VARS;  // each is looked for among the others

std::string formatName(int format) {
    switch (format) {
        case NC_FORMAT_CLASSIC:
            return "NetCDF classic";
        case NC_FORMAT_64BIT_OFFSET:
            return "NetCDF 64-bit offset";
        case NC_FORMAT_64BIT_DATA:
            return "NetCDF-5 (CDF-5)";
        case NC_FORMAT_NETCDF4_CLASSIC:
            return "NetCDF-4 classic model";
        default:
            return "NetCDF-4";
    }
}

// Also of whole numbers that have names.
std::optional<ValueType> numberType(int group, nc_type type) {
    nc_type base = NC_NAT;
    int kind = 0;
    const bool isEnum =
        type > NC_MAX_ATOMIC_TYPE &&
        nc_inq_user_type(group, type, nullptr, nullptr, &base, nullptr, &kind) == NC_NOERR &&
        kind == NC_ENUM;
    return valueType(isEnum ? base : type);
}

// Whether the library fills with its own number what was never written: arrays of HDF5 that no
// netCDF wrote may say another, which is a value as others are.
bool isFilledByDefault(int group, int id, std::optional<ValueType> type) {
    int noFill = 0;
    std::size_t length = 0;
    // Of classic files the library would give that as it stands, of any type and length.
    if (!type || nc_inq_attlen(group, id, "_FillValue", &length) == NC_NOERR) return false;
    return withType(*type, [&](auto value) {
        if (nc_inq_var_fill(group, id, &noFill, &value) != NC_NOERR) return true;
        const auto fill = defaultFill(*type);
        return noFill == 0 && (!fill || compare(numberOf(value), *fill) == 0);
    });
}

}  // namespace

void NetcdfFile::readHeader() {
    int format = 0;
    check(nc_inq_format(id_, &format), "", "a netCDF file");
    header_.format = formatName(format);
    readGroup(id_, "", 0);
    addEnums();
    const auto& all = header_.dimensions;
    if (!all.empty() && std::ranges::none_of(all, &NcDimension::isNamed))
        header_.format = kPlainHdf5;
}

void NetcdfFile::readGroup(int group, const std::string& name, int depth) {
    if (depth > kMaxGroupDepth) fail(name, "expected groups that end");
    const std::string place = name.empty() ? "header" : "group '" + name + "'";
    int count = 0;
    check(nc_inq_dimids(group, &count, nullptr, 0), place, "its dimensions");
    std::vector<int> ids(static_cast<std::size_t>(count));
    check(nc_inq_dimids(group, &count, ids.data(), 0), place, "its dimensions");
    int unlimitedCount = 0;
    check(nc_inq_unlimdims(group, &unlimitedCount, nullptr), place, "its dimensions");
    std::vector<int> unlimited(static_cast<std::size_t>(unlimitedCount));
    check(nc_inq_unlimdims(group, &unlimitedCount, unlimited.data()), place, "its dimensions");
    for (const int id : ids) {
        std::array<char, NC_MAX_NAME + 1> text{};
        std::size_t length = 0;
        check(nc_inq_dim(group, id, text.data(), &length), place, "its dimensions");
        header_.dimensions.push_back(
            {text.data(), length, std::ranges::find(unlimited, id) != unlimited.end()});
        dimensionIds_.push_back(id);
    }

    check(nc_inq_varids(group, &count, nullptr), place, "its variables");
    ids.resize(static_cast<std::size_t>(count));
    if (header_.variables.size() + ids.size() > kMaxVariables)
        fail(place, fmt::format("expected at most {} variables, found {}", kMaxVariables,
                                header_.variables.size() + ids.size()));
    check(nc_inq_varids(group, &count, ids.data()), place, "its variables");
    for (const int id : ids) readVariable(group, name, id);
    readGroupAttributes(group, name);

    check(nc_inq_grps(group, &count, nullptr), place, "its groups");
    ids.resize(static_cast<std::size_t>(count));
    check(nc_inq_grps(group, &count, ids.data()), place, "its groups");
    for (const int id : ids) {
        std::array<char, NC_MAX_NAME + 1> text{};
        check(nc_inq_grpname(id, text.data()), place, "its groups");
        readGroup(id, name.empty() ? text.data() : name + '/' + text.data(), depth + 1);
    }
}

// Those that the library passes over have dimensions as it makes them up: one for each length, and
// none twice of one variable.
void NetcdfFile::addEnums() {
    for (const auto& [name, found] : enums_) {
        const auto same = std::ranges::find(header_.variables, name, &NcVariable::name);
        if (same != header_.variables.end()) {
            same->type = found.type;
            continue;
        }
        NcVariable variable;
        variable.name = name;
        if (const auto slash = name.rfind('/'); slash != name.npos)
            variable.group = name.substr(0, slash);
        variable.type = found.type;
        variable.filled = false;
        variable.chunkBytes = found.chunkBytes;
        auto& all = header_.dimensions;
        for (const std::uint64_t length : found.lengths) {
            std::size_t at = 0;
            while (at < all.size() &&
                   (all[at].isNamed() || all[at].length != length || variable.positionOf(at)))
                ++at;
            if (at == all.size()) {
                all.push_back({fmt::format("phony_dim_{}", at), length, false});
                dimensionIds_.push_back(-1);
            }
            variable.dimensions.push_back(at);
        }
        header_.variables.push_back(std::move(variable));
    }
}

void NetcdfFile::readVariable(int group, const std::string& groupName, int id) {
    NcVariable variable;
    variable.group = groupName;
    variable.groupId = group;
    variable.id = id;
    std::array<char, NC_MAX_NAME + 1> text{};
    nc_type type = NC_NAT;
    int rank = 0, attributeCount = 0;
    check(nc_inq_varname(group, id, text.data()), "header", "a variable's name");
    variable.name = groupName.empty() ? text.data() : groupName + '/' + text.data();
    const std::string place = "variable '" + variable.name + "'";
    check(nc_inq_varndims(group, id, &rank), place, "its dimensions");
    std::vector<int> dimensions(static_cast<std::size_t>(rank));
    check(nc_inq_var(group, id, nullptr, &type, nullptr, dimensions.data(), &attributeCount), place,
          "its declaration");
    variable.type = valueType(type);
    for (const int dimension : dimensions) {
        const auto at = std::ranges::find(dimensionIds_, dimension);
        if (at == dimensionIds_.end())
            fail(place,
                 "expected dimension scales along all of its dimensions, or none: the "
                 "library takes no others");
        variable.dimensions.push_back(static_cast<std::size_t>(at - dimensionIds_.begin()));
    }
    for (int i = 0; i < attributeCount; ++i)
        if (auto attribute = readAttribute(group, id, i, place))
            variable.attributes.push_back(std::move(*attribute));

    int storage = NC_CONTIGUOUS;
    variable.filled = isFilledByDefault(group, id, variable.type);
    std::vector<std::size_t> chunk(std::max<std::size_t>(variable.dimensions.size(), 1), 0);
    if (rank > 0 && nc_inq_var_chunking(group, id, &storage, chunk.data()) == NC_NOERR &&
        storage == NC_CHUNKED) {
        double bytes = variable.type ? static_cast<double>(typeBytes(*variable.type)) : 1;
        for (const std::size_t n : chunk) bytes *= static_cast<double>(n);
        variable.chunkBytes = static_cast<std::uint64_t>(std::min(bytes, 1e18));
    }
    header_.variables.push_back(std::move(variable));
}

// One that cannot be read costs no variable: most formats ask no group for anything.
void NetcdfFile::readGroupAttributes(int group, const std::string& name) {
    NcGroup& read = header_.groups.emplace_back();
    read.name = name;
    int count = 0;
    if (nc_inq_varnatts(group, NC_GLOBAL, &count) != NC_NOERR) return;
    for (int i = 0; i < count; ++i) {
        try {
            if (auto attribute = readAttribute(group, NC_GLOBAL, i, "group '" + name + "'"))
                read.attributes.push_back(std::move(*attribute));
        } catch (const FileError&) {
            continue;
        }
    }
}

// Nothing of what is too long, or no text nor numbers.
std::optional<NcAttribute> NetcdfFile::readAttribute(int group, int id, int number,
                                                     const std::string& place) const {
    std::array<char, NC_MAX_NAME + 1> name{};
    nc_type type = NC_NAT;
    std::size_t length = 0;
    check(nc_inq_attname(group, id, number, name.data()), place, "its attributes");
    check(nc_inq_att(group, id, name.data(), &type, &length), place, "its attributes");
    if (length > kMaxAttributeBytes) return std::nullopt;
    const std::string what = fmt::format("its attribute '{}'", name.data());
    NcAttribute attribute{name.data(), {}, numberType(group, type)};
    if (type == NC_CHAR) {
        std::string text(length, '\0');
        check(nc_get_att_text(group, id, name.data(), text.data()), place, what);
        while (!text.empty() && text.back() == '\0') text.pop_back();
        attribute.value = std::move(text);
    } else if (type == NC_STRING) {
        std::vector<char*> strings(length, nullptr);
        check(nc_get_att_string(group, id, name.data(), strings.data()), place, what);
        std::string text;
        for (const char* one : strings)
            text += (text.empty() ? "" : " ") + std::string(one ? one : "");
        nc_free_string(length, strings.data());
        attribute.value = std::move(text);
    } else if (attribute.type) {
        withType(*attribute.type, [&]<typename T>(T) {
            std::vector<T> values(length);
            check(nc_get_att(group, id, name.data(), values.data()), place, what);
            std::vector<Number> numbers;
            for (const T value : values) numbers.push_back(numberOf(value));
            attribute.value = std::move(numbers);
        });
    } else {
        return std::nullopt;  // compound and other user types tell nothing here
    }
    return attribute;
}

}  // namespace timeseries

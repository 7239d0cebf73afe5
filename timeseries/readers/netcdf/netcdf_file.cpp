#include "timeseries/readers/netcdf/netcdf_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/cf/cf_packing.h"
#include "timeseries/readers/forked_call.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/classic_layout.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr int kMaxGroupDepth = 64;
constexpr std::size_t kMaxAttributeBytes = 1 << 20;
constexpr std::size_t kMaxVariables = NC_MAX_VARS;  // each is looked for among the others
constexpr std::chrono::seconds kMaxHeaderTime{10};  // that of 8000 variables takes one

// Held during every call of the library. HDF5 prints its errors unless told not to, and keeps that
// setting per thread: netCDF sets it on the first thread alone.
class LibraryLock {
 public:
    LibraryLock() : lock_(mutex()) {
        thread_local const herr_t quiet = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        static_cast<void>(quiet);
    }

 private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
};

// HDF5 would keep a file locked as long as it is open, and whoever writes it could not go on while
// somebody looks. Before the library is called first, and any thread begun; a user's own word
// stays.
const bool kNeverLocked = std::getenv("HDF5_USE_FILE_LOCKING") == nullptr &&
                          setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1) == 0;

// By a program that writes it: what it has written by now may be no file yet.
bool isLocked(const std::filesystem::path& path) {
    if (!kNeverLocked) return false;  // HDF5 does as its user says
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool is = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    flock(file, LOCK_UN);  // also of copies of this process that begin just now
    ::close(file);
    return is;
}

std::optional<ValueType> valueType(nc_type type) {
    switch (type) {
        case NC_BYTE:
            return ValueType::I8;
        case NC_UBYTE:
            return ValueType::U8;
        case NC_SHORT:
            return ValueType::I16;
        case NC_USHORT:
            return ValueType::U16;
        case NC_INT:
            return ValueType::I32;
        case NC_UINT:
            return ValueType::U32;
        case NC_INT64:
            return ValueType::I64;
        case NC_UINT64:
            return ValueType::U64;
        case NC_FLOAT:
            return ValueType::F32;
        case NC_DOUBLE:
            return ValueType::F64;
        default:
            return std::nullopt;
    }
}

std::uint64_t typeBytes(ValueType type) {
    constexpr std::array<std::uint64_t, 10> kBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

bool floating(ValueType type) { return type == ValueType::F32 || type == ValueType::F64; }

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

template <typename T>
std::vector<Number> asNumbers(const std::vector<T>& values) {
    return {values.begin(), values.end()};
}

}  // namespace

void NetcdfFile::check(int status, std::string_view place, std::string_view expected) const {
    if (status != NC_NOERR)
        fail(place, fmt::format("expected {}, but the library says \"{}\"", expected,
                                nc_strerror(status)));
}

NetcdfFile::NetcdfFile(const std::filesystem::path& path, Header header) : CfFile(path) {
    std::error_code error;
    fileBytes_ = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    char first = 0;
    if (error || !file.get(first)) fail("", "expected a netCDF file, but it cannot be read");
    file.seekg(0);
    if (first == 'C') checkClassicLayout(path, file, fileBytes_);
    file.close();

    const LibraryLock lock;
    if (first != 'C' && isLocked(path))
        fail("", "expected a file that nobody writes, but a program has it locked");
    if (first != 'C' && header == Header::New) {
        const std::string end = endOfForked([this] { open(); }, kMaxHeaderTime);
        if (!end.empty()) fail("header", "expected one that HDF5 can read, but HDF5 " + end);
    }
    open();
}

std::vector<bool> NetcdfFile::triedTogether(std::span<const std::filesystem::path> paths) {
    constexpr std::size_t kAtATime = 64;
    const auto isClassic = [](const std::filesystem::path& path) {
        return std::ifstream(path, std::ios::binary).get() == 'C';
    };
    std::vector<bool> tried;
    while (tried.size() < paths.size()) {
        const auto some =
            paths.subspan(tried.size(), std::min(kAtATime, paths.size() - tried.size()));
        const auto readAll = [&] {
            for (const std::filesystem::path& path : some) {
                if (isClassic(path)) continue;
                // Not closed, which would want the lock: the copy ends with it.
                auto* const file = new NetcdfFile(path);
                try {
                    file->open();
                } catch (...) {
                    // Told when it is opened in earnest.
                }
            }
        };
        const LibraryLock lock;
        const bool areRead =
            std::ranges::all_of(some, isClassic) || endOfForked(readAll, kMaxHeaderTime).empty();
        tried.resize(tried.size() + some.size(), areRead);
    }
    return tried;
}

void NetcdfFile::open() {
    // Absolute: the library takes what looks like a URL for one.
    check(nc_open(std::filesystem::absolute(path_).c_str(), NC_NOWRITE, &id_), "",
          "a whole netCDF file, whose links lead somewhere");
    try {
        readHeader();
    } catch (...) {
        nc_close(id_);
        throw;
    }
}

NetcdfFile::~NetcdfFile() {
    const LibraryLock lock;
    nc_close(id_);
}

void NetcdfFile::readHeader() {
    int format = 0;
    check(nc_inq_format(id_, &format), "", "a netCDF file");
    header_.format = formatName(format);
    readGroup(id_, "", 0);
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

namespace {

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
    NcAttribute attribute{name.data(), {}, valueType(type)};
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
    } else if (attribute.type && floating(*attribute.type)) {
        std::vector<double> values(length);
        check(nc_get_att_double(group, id, name.data(), values.data()), place, what);
        attribute.value = asNumbers(values);
    } else if (attribute.type == ValueType::U64) {
        std::vector<unsigned long long> values(length);
        check(nc_get_att_ulonglong(group, id, name.data(), values.data()), place, what);
        attribute.value = std::vector<Number>(values.size());
        for (std::size_t i = 0; i < length; ++i)
            std::get<1>(attribute.value)[i] = std::uint64_t{values[i]};
    } else if (attribute.type) {
        std::vector<long long> values(length);
        check(nc_get_att_longlong(group, id, name.data(), values.data()), place, what);
        attribute.value = std::vector<Number>(values.size());
        for (std::size_t i = 0; i < length; ++i)
            std::get<1>(attribute.value)[i] = std::int64_t{values[i]};
    } else {
        return std::nullopt;  // compound and other user types tell nothing here
    }
    return attribute;
}

std::string NetcdfFile::tooLarge(const NcVariable& variable, std::uint64_t points) const {
    return tooLarge(variable.type.value_or(ValueType::U8), points, variable.chunkBytes);
}

std::string NetcdfFile::tooLarge(ValueType type, std::uint64_t points,
                                 std::uint64_t chunkBytes) const {
    const double limit = kMaxInflated * static_cast<double>(fileBytes_) + 1048576.0;
    const double bytes = static_cast<double>(points) * static_cast<double>(typeBytes(type));
    if (points > kMaxPoints) return fmt::format("expected at most 2^32 points, found {}", points);
    if (std::max(bytes, static_cast<double>(chunkBytes)) > limit)
        return fmt::format(
            "expected values that a file of {} bytes can hold, found {:.0f} bytes "
            "of them (chunks of {})",
            fileBytes_, bytes, chunkBytes);
    return "";
}

std::vector<Number> NetcdfFile::numbers(const NcVariable& variable) const {
    const std::string place = "variable '" + variable.name + "'";
    double points = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        points *= static_cast<double>(header_.dimension(variable, i).length);
    const auto count = static_cast<std::uint64_t>(std::min(points, 1e18));
    if (const std::string why = tooLarge(variable, count); !why.empty()) fail(place, why);
    std::vector<Number> values(count);
    const LibraryLock lock;
    const auto fill = [&](auto get, auto zero, auto number) {
        std::vector<decltype(zero)> stored(count);
        check(get(variable.groupId, variable.id, stored.data()), place, "values that can be read");
        for (std::size_t i = 0; i < count; ++i)
            values[i] = static_cast<decltype(number)>(stored[i]);
    };
    if (floating(*variable.type))
        fill(nc_get_var_double, 0.0, 0.0);
    else if (variable.type == ValueType::U64)
        fill(nc_get_var_ulonglong, 0ULL, std::uint64_t{});
    else
        fill(nc_get_var_longlong, 0LL, std::int64_t{});
    return values;
}

void NetcdfFile::read(const NcVariable& variable, std::span<const std::size_t> start,
                      std::span<const std::size_t> count, void* values) const {
    const LibraryLock lock;
    check(nc_get_vara(variable.groupId, variable.id, start.data(), count.data(), values),
          "variable '" + variable.name + "'", "values that can be read");
}

std::vector<std::string> NetcdfFile::lines(std::string_view name) const {
    const NcVariable* found = header_.find(name, "");
    if (!found) return {};
    const std::string place = fmt::format("variable '{}'", name);
    if (found->type || found->dimensions.size() != 2) fail(place, "expected rows of characters");
    const std::uint64_t rows = header_.dimension(*found, 0).length,
                        length = header_.dimension(*found, 1).length;
    const auto points = static_cast<std::uint64_t>(
        std::min(static_cast<double>(rows) * static_cast<double>(length), 1e18));
    if (const std::string why = tooLarge(*found, points); !why.empty()) fail(place, why);
    std::string text(points, '\0');
    if (points > 0) {
        const LibraryLock lock;
        nc_type type = NC_NAT;
        check(nc_inq_vartype(found->groupId, found->id, &type), place, "a type");
        if (type != NC_CHAR) fail(place, "expected rows of characters");
        check(nc_get_var_text(found->groupId, found->id, text.data()), place,
              "text that can be read");
    }
    std::vector<std::string> lines;
    for (std::uint64_t row = 0; row < rows; ++row) {
        std::string line = text.substr(row * length, length);
        line.resize(std::min(line.size(), line.find('\0')));
        while (line.ends_with(' ')) line.pop_back();
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace timeseries

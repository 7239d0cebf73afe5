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
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_packing.h"
#include "timeseries/readers/forked_call.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/classic_layout.h"
#include "timeseries/readers/netcdf/kept_chunks.h"
#include "timeseries/readers/netcdf/netcdf_types.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr std::chrono::seconds kMaxHeaderTime{10};  // that of 8000 variables takes one
constexpr std::size_t kMaxStrings = 1'000'000;      // hours of a century
constexpr std::size_t kMaxStringBytes = 256;        // no date is as long
constexpr double kFreeBytes = 1 << 28;  // of HDF5, which keeps no chunk that nobody wrote

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

// Those that are open. Under the lock.
std::vector<NetcdfFile*>& openFiles() {
    static std::vector<NetcdfFile*> all;
    return all;
}

// A text up to where it ends.
std::string ended(std::string text) {
    text.resize(std::min(text.size(), text.find('\0')));
    while (text.ends_with(' ')) text.pop_back();
    return text;
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
    stamp_ = stampOf(path);
    std::ifstream file(path, std::ios::binary);
    char first = 0;
    if (error || !file.get(first)) {
        expectFile(path);  // of a series that is being written, one may be gone
        fail("", "expected a netCDF file, but it cannot be read");
    }
    file.seekg(0);
    if (first == 'C')
        checkClassicLayout(path, file, fileBytes_);
    else
        freeBytes_ = kFreeBytes;
    file.close();

    const LibraryLock lock;
    closeFormer(stamp_);
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
        for (const std::filesystem::path& path : some) closeFormer(stampOf(path));
        const bool areRead =
            std::ranges::all_of(some, isClassic) || endOfForked(readAll, kMaxHeaderTime).empty();
        tried.resize(tried.size() + some.size(), areRead);
    }
    return tried;
}

void NetcdfFile::open() {
    // Absolute: the library takes what looks like a URL for one. And a backslash for a slash.
    std::filesystem::path named = std::filesystem::absolute(path_);
    int file = -1;
    if (named.string().find('\\') != std::string::npos) {
        file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
        named = fmt::format("/proc/self/fd/{}", file);
    }
    const int status = nc_open(named.c_str(), NC_NOWRITE, &id_);
    if (file >= 0) ::close(file);
    if (status != NC_NOERR)
        if (const std::string link = deadHdf5Link(path_); !link.empty())
            fail("link " + link, "expected something there, but there is nothing");
    check(status, "", "a whole netCDF file");
    try {
        // While it shares what is read of it.
        elsewhere_ = hdf5Elsewhere(path_, [&](std::int64_t dataset, const char* name) {
            takeHdf5Enum(dataset, name, enums_);
        });
        readHeader();
        readStrings();
        openFiles().push_back(this);
    } catch (...) {
        nc_close(id_);
        throw;
    }
}

NetcdfFile::~NetcdfFile() {
    const LibraryLock lock;
    close();
}

void NetcdfFile::close() {
    if (id_ >= 0) nc_close(id_);
    id_ = -1;
    std::erase(openFiles(), this);
}

void NetcdfFile::closeFormer(const std::optional<FileStamp>& now) {
    for (NetcdfFile* const file : std::vector(openFiles()))
        if (now && file->stamp_ && file->stamp_->isOfSameFile(*now) && file->stamp_ != now)
            file->close();
}

void NetcdfFile::expectOpen() const {
    if (id_ < 0) throw FileError(fmt::format("{}: {}", path_.string(), kHasChanged));
}

std::vector<std::filesystem::path> NetcdfFile::sources() const {
    return elsewhere_.any ? std::vector<std::filesystem::path>() : CfFile::sources();
}

std::string NetcdfFile::tooLarge(const NcVariable& variable, std::uint64_t points) const {
    return tooLarge(variable.type.value_or(ValueType::U8), points, variable.chunkBytes);
}

std::string NetcdfFile::tooLarge(ValueType type, std::uint64_t points,
                                 std::uint64_t chunkBytes) const {
    const double limit =
        kMaxInflated * (static_cast<double>(fileBytes_) + elsewhere_.bytes) + freeBytes_;
    const double bytes = static_cast<double>(points) * static_cast<double>(typeBytes(type));
    if (points > kMaxPoints) return fmt::format("expected at most 2^32 points, found {}", points);
    if (std::max(bytes, static_cast<double>(chunkBytes)) > limit)
        return fmt::format(
            "expected values that a file of {} bytes can hold, found {:.0f} bytes "
            "of them (chunks of {})",
            fileBytes_, bytes, chunkBytes);
    return "";
}

std::string NetcdfFile::placeOf(const NcVariable& variable) const {
    std::string place = "variable '" + variable.name + "'";
    if (const auto missing = elsewhere_.missing.find(variable.name);
        missing != elsewhere_.missing.end())
        fail(place, "expected values of " + missing->second + ", which is not there");
    return place;
}

std::vector<Number> NetcdfFile::numbers(const NcVariable& variable) const {
    const std::string place = placeOf(variable);
    double points = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        points *= static_cast<double>(header_.dimension(variable, i).length);
    const auto count = static_cast<std::uint64_t>(std::min(points, 1e18));
    if (const std::string why = tooLarge(variable, count); !why.empty()) fail(place, why);
    if (enums_.contains(variable.name)) return numbersOfEnum(variable, count);
    std::vector<Number> values(count);
    const LibraryLock lock;
    expectOpen();
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

std::vector<Number> NetcdfFile::numbersOfEnum(const NcVariable& variable,
                                              std::uint64_t count) const {
    const std::size_t rank = variable.dimensions.size();
    std::vector<std::size_t> start(rank, 0), lengths;
    for (std::size_t i = 0; i < rank; ++i) lengths.push_back(header_.dimension(variable, i).length);
    return withType(*variable.type, [&]<typename T>(T) {
        std::vector<T> values(count);
        read(variable, start, lengths, values.data());
        std::vector<Number> numbers;
        for (const T value : values) numbers.push_back(numberOf(value));
        return numbers;
    });
}

void NetcdfFile::read(const NcVariable& variable, std::span<const std::size_t> start,
                      std::span<const std::size_t> count, void* values) const {
    const std::string place = placeOf(variable);
    const LibraryLock lock;
    expectOpen();
    if (enums_.contains(variable.name)) {
        if (!readHdf5Enum(path_, variable.name, *variable.type, start, count, values))
            fail(place, "expected numbers that can be read, but HDF5 reads none");
        return;
    }
    keepChunks(variable, start, count);
    check(nc_get_vara(variable.groupId, variable.id, start.data(), count.data(), values), place,
          "values that can be read");
}

std::vector<std::string> NetcdfFile::lines(std::string_view name) const {
    const NcVariable* found = header_.find(name, "");
    if (!found) return {};
    auto lines = found->dimensions.size() == 2
                     ? texts(*found, 0, header_.dimension(*found, 0).length)
                     : std::nullopt;
    if (!lines) fail(fmt::format("variable '{}'", name), "expected rows of characters");
    return std::move(*lines);
}

std::optional<std::vector<std::string>> NetcdfFile::texts(const NcVariable& variable,
                                                          std::size_t first,
                                                          std::size_t count) const {
    if (const auto found = strings_.find(variable.name); found != strings_.end()) {
        const auto from = found->second.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector(from, from + static_cast<std::ptrdiff_t>(count));
    }
    if (variable.type || variable.dimensions.size() != 2) return std::nullopt;
    const std::string place = placeOf(variable);
    const std::uint64_t length = header_.dimension(variable, 1).length;
    const auto points = static_cast<std::uint64_t>(std::min(
        static_cast<double>(count) * static_cast<double>(std::max<std::uint64_t>(length, 1)),
        1e18));  // of rows of nothing the rows
    if (const std::string why = tooLarge(variable, points); !why.empty()) fail(place, why);
    std::string text(count * length, '\0');
    if (!text.empty()) {
        const LibraryLock lock;
        expectOpen();
        nc_type type = NC_NAT;
        check(nc_inq_vartype(variable.groupId, variable.id, &type), place, "a type");
        if (type != NC_CHAR) return std::nullopt;
        const std::array start{first, std::size_t{0}}, counts{count, std::size_t{length}};
        check(nc_get_vara_text(variable.groupId, variable.id, start.data(), counts.data(),
                               text.data()),
              place, "text that can be read");
    }
    std::vector<std::string> rows;
    rows.reserve(count);
    for (std::size_t row = 0; row < count; ++row)
        rows.push_back(ended(text.substr(row * length, length)));
    return rows;
}

// Strings lie in a heap of the file, of which a damaged one may crash HDF5: they are read where the
// header is, in a copy of this process first.
void NetcdfFile::readStrings() {
    for (const NcVariable& variable : header_.variables) {
        if (variable.type || variable.dimensions.size() != 1) continue;
        const NcDimension& along = header_.dimension(variable, 0);
        const std::string_view name = variable.baseName();
        if (name != along.name && std::ranges::count(kTextTimes, name) == 0) continue;
        nc_type type = NC_NAT;
        if (along.length > kMaxStrings || variable.chunkBytes > kMaxStrings ||
            nc_inq_vartype(variable.groupId, variable.id, &type) != NC_NOERR || type != NC_STRING)
            continue;
        auto strings = stringsOf(variable);
        if (strings.size() == along.length) strings_[variable.name] = std::move(strings);
    }
}

// As many as can be read. A few at a time: each may be as long as the file.
std::vector<std::string> NetcdfFile::stringsOf(const NcVariable& variable) const {
    constexpr std::size_t kAtATime = 64;
    std::vector<std::string> strings;
    const std::size_t length = header_.dimension(variable, 0).length;
    while (strings.size() < length) {
        std::vector<char*> some(std::min(kAtATime, length - strings.size()), nullptr);
        const std::size_t start = strings.size(), count = some.size();
        if (nc_get_vara_string(variable.groupId, variable.id, &start, &count, some.data()) !=
            NC_NOERR)
            return strings;
        bool areShort = true;
        for (const char* one : some) {
            const std::string_view text = one ? one : "";
            areShort = areShort && text.size() <= kMaxStringBytes;
            strings.push_back(ended(std::string(text.substr(0, kMaxStringBytes))));
        }
        nc_free_string(count, some.data());
        if (!areShort) strings.resize(length);  // no dates: what follows is not looked at
    }
    return strings;
}

}  // namespace timeseries

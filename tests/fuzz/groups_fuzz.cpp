// Formats that are groups, attributes and arrays in HDF5: openPMD, snapshots of particles, VTKHDF.
// HDF5 itself crashes on damaged files (KNOWN.md), so that inputs are text that says what a whole
// file holds, a line each; what no file can hold is passed over:
//   text GROUP_OR_ARRAY ATTRIBUTE words
//   say GROUP_OR_ARRAY ATTRIBUTE TYPE numbers
//   put ARRAY TYPE LENGTH,LENGTH numbers, again from the first until there are enough
// TYPE is i (int32), u (uint64), f (float32) or d (float64); "/" is the root.
#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <type_traits>
#include <vector>

#include "tests/fuzz/read_all.h"

namespace {

constexpr std::size_t kMostLines = 200, kMostNumbers = 4096;

// The numbers that follow, as far as they are some.
std::vector<double> numbersOf(std::istringstream& line) {
    std::vector<double> numbers;
    for (std::string word; numbers.size() < kMostNumbers && line >> word;)
        numbers.push_back(std::strtod(word.c_str(), nullptr));
    return numbers;
}

template <typename T>
std::vector<T> as(const std::vector<double>& numbers) {
    std::vector<T> all;
    for (const double number : numbers)
        all.push_back(std::is_floating_point_v<T> ? static_cast<T>(number)
                      : number > -2e9 && number < 2e9
                          ? static_cast<T>(static_cast<std::int64_t>(number))
                          : static_cast<T>(~std::uint64_t{0} >> 1));
    return all;
}

class File {
 public:
    explicit File(const std::filesystem::path& path)
        : made_(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_) == NC_NOERR) {}
    ~File() { close(); }
    // Whether it is whole: netCDF finds only now that it cannot write some names.
    bool close() {
        if (!made_) return false;
        made_ = false;
        if (nc_close(id_) == NC_NOERR) return true;
        nc_abort(id_);
        return false;
    }
    void take(const std::string& text) {
        std::istringstream line(text);
        std::string kind, of, name, type;
        line >> kind >> of;
        if (kind == "put") {
            std::string lengths;
            line >> type >> lengths;
            put(of, type, lengths, numbersOf(line));
            return;
        }
        line >> name;
        const auto [group, variable] = placeOf(of);
        if (kind == "text") {
            std::string words;
            std::getline(line >> std::ws, words);
            nc_put_att_text(group, variable, name.c_str(), words.size(), words.data());
        } else if (kind == "say") {
            line >> type;
            withType(type, numbersOf(line), [&, at = group, of_ = variable](auto values, int t) {
                nc_put_att(at, of_, name.c_str(), t, values.size(), values.data());
            });
        }
    }

 private:
    template <typename Use>
    static void withType(const std::string& type, const std::vector<double>& numbers, Use use) {
        if (type == "i") use(as<std::int32_t>(numbers), NC_INT);
        if (type == "u") use(as<std::uint64_t>(numbers), NC_UINT64);
        if (type == "f") use(as<float>(numbers), NC_FLOAT);
        if (type == "d") use(numbers, NC_DOUBLE);
    }
    int groupOf(const std::string& path) const {
        int id = id_;
        std::istringstream parts(path);
        for (std::string part; std::getline(parts, part, '/');) {
            int next = 0;
            if (part.empty()) continue;
            if (nc_inq_grp_ncid(id, part.c_str(), &next) != NC_NOERR &&
                nc_def_grp(id, part.c_str(), &next) != NC_NOERR)
                return id;
            id = next;
        }
        return id;
    }
    struct Place {
        int group, variable;
    };
    Place placeOf(const std::string& name) const {
        const auto slash = name.rfind('/');
        const int around = groupOf(slash == name.npos ? "" : name.substr(0, slash));
        int variable = 0;
        const bool isArray =
            nc_inq_varid(around, name.substr(slash + 1).c_str(), &variable) == NC_NOERR;
        return isArray ? Place{around, variable} : Place{groupOf(name), NC_GLOBAL};
    }
    void put(const std::string& name, const std::string& type, const std::string& lengths,
             std::vector<double> numbers) {
        const auto slash = name.rfind('/');
        const int group = groupOf(slash == name.npos ? "" : name.substr(0, slash));
        const std::string own = name.substr(slash + 1);
        std::vector<int> dimensions;
        std::size_t count = 1;
        std::istringstream all(lengths);
        for (std::string word; std::getline(all, word, ',') && dimensions.size() < 4;) {
            const auto length = std::strtoull(word.c_str(), nullptr, 10);
            if (length == 0 || length > kMostNumbers || count * length > kMostNumbers) return;
            count *= length;
            const std::string dimension = own + "_" + std::to_string(dimensions.size());
            if (nc_def_dim(group, dimension.c_str(), length, &dimensions.emplace_back()) !=
                NC_NOERR)
                return;
        }
        if (numbers.empty()) numbers.push_back(0);
        const std::size_t given = numbers.size();
        for (std::size_t i = given; i < count; ++i) numbers.push_back(numbers[i % given]);
        withType(type, numbers, [&](auto values, int t) {
            int id = 0;
            if (nc_def_var(group, own.c_str(), t, int(dimensions.size()), dimensions.data(), &id) ==
                NC_NOERR)
                nc_put_var(group, id, values.data());
        });
    }
    int id_ = 0;
    bool made_;
};

}  // namespace

// These headers are whole: a trial in a copy of the process, which takes ten times as long as all
// else where addresses are sanitized, is left out.
extern "C" pid_t fork() {
    errno = EAGAIN;
    return -1;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // What could not be closed may stay locked.
    static int number = 0;
    const auto path = fuzz::folder() / ("file" + std::to_string(number) + ".h5");
    File file(path);
    std::istringstream lines{std::string(fuzz::text(data, size))};
    const auto isControl = [](unsigned char c) { return c < ' ' || c > '~'; };
    std::size_t count = 0;
    for (std::string line; count < kMostLines && std::getline(lines, line); ++count)
        if (std::ranges::none_of(line, isControl)) file.take(line);
    if (file.close())
        fuzz::readAll(path);
    else
        ++number;
    std::filesystem::remove(path);
    return 0;
}

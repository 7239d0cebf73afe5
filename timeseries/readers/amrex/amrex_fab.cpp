#include "timeseries/readers/amrex/amrex_fab.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>

#include "timeseries/readers/amrex/amrex_text.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

// (8, (64 11 52 0 1 12 0 1023)): a count and as many numbers.
std::vector<std::int64_t> numbersIn(AmrexText& text) {
    text.expect('(');
    const std::int64_t count = text.integer("a number of numbers", 1, 16);
    text.expect(',');
    text.expect('(');
    std::vector<std::int64_t> list;
    for (std::int64_t i = 0; i < count; ++i)
        list.push_back(text.integer("a number of a format", 0, 1 << 20));
    text.expect(')');
    text.expect(')');
    return list;
}

AmrexFabHeader headerOf(AmrexText& text, std::size_t dimensions) {
    // Bits: of all, the exponent, the mantissa; where the sign and these begin; whether the highest
    // bit of the mantissa is there; what is added to the exponent. IEEE 754's.
    static const std::vector<std::int64_t> kSingle{32, 8, 23, 0, 1, 9, 0, 127},
        kDouble{64, 11, 52, 0, 1, 12, 0, 1023};
    for (const char c : {'F', 'A', 'B'}) text.expect(c);
    AmrexFabHeader header;
    text.expect('(');
    const auto format = numbersIn(text);
    if (format != kSingle && format != kDouble) text.fail("IEEE numbers of 32 or 64 bits");
    header.type = format == kDouble ? ValueType::F64 : ValueType::F32;
    text.expect(',');
    const auto order = numbersIn(text);
    text.expect(')');
    std::vector<std::int64_t> sorted = order;
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (sorted[i] != static_cast<std::int64_t>(i) + 1) sorted.clear();
    if (sorted.size() != (header.type == ValueType::F64 ? 8u : 4u))
        text.fail("an order of the bytes of a number, each once");
    for (const std::int64_t byte : order)
        header.order.push_back(static_cast<std::uint8_t>(byte - 1));
    header.box = text.box(dimensions);
    header.variables = static_cast<std::size_t>(text.integer("a number of variables", 1, 1 << 16));
    if (!text.restOfLine().empty()) text.fail("the end of the line");
    return header;
}

}  // namespace

AmrexFabFile::AmrexFabFile(const std::filesystem::path& path) : path_(path) {
    expectFile(path);
    file_.open(path, std::ios::binary);
    std::error_code error;
    bytes_ = std::filesystem::file_size(path, error);
    if (error || !file_)
        throw FileError(fmt::format("{}: expected a file that can be read", path.string()));
}

AmrexFabHeader AmrexFabFile::headerAt(std::uint64_t offset, std::size_t dimensions) {
    constexpr std::size_t kLongestLine = 1024;
    std::string start(kLongestLine, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file_.gcount()));
    start.resize(std::min(start.find('\n'), start.size() - (start.empty() ? 0 : 1)) + 1);
    std::istringstream line(start);
    AmrexText text(line, fmt::format("{}: FAB at byte {}", path_.string(), offset), false);
    AmrexFabHeader header = headerOf(text, dimensions);
    header.first = offset + text.taken();
    const std::uint64_t room = bytes_ - std::min(header.first, bytes_);
    if (header.box.count() > room / header.order.size() / header.variables)
        text.fail(fmt::format("values of {} variables in {} cells, but the file ends",
                              header.variables, header.box.count()));
    return header;
}

template <typename T>
std::vector<T> AmrexFabFile::values(const AmrexFabHeader& header, std::size_t variable) {
    const std::uint64_t count = header.box.count();
    std::vector<T> values(count);
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(header.first + variable * count * sizeof(T)));
    file_.read(reinterpret_cast<char*>(values.data()),
               static_cast<std::streamsize>(count * sizeof(T)));
    if (static_cast<std::uint64_t>(file_.gcount()) != count * sizeof(T))
        throw FileError(fmt::format("{}: expected {} values from byte {} on, but the file ends",
                                    path_.string(), count, header.first));
    // From the sign on, as the order is told, to how this machine has them.
    std::vector<std::uint8_t> order = header.order;
    if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(order);
    bool isNative = true;
    for (std::size_t i = 0; i < sizeof(T); ++i) isNative = isNative && order[i] == i;
    if (isNative) return values;
    for (T& value : values) {
        std::array<char, sizeof(T)> stored, native;
        std::memcpy(stored.data(), &value, sizeof(T));
        for (std::size_t i = 0; i < sizeof(T); ++i) native[i] = stored[order[i]];
        std::memcpy(&value, native.data(), sizeof(T));
    }
    return values;
}

template std::vector<float> AmrexFabFile::values(const AmrexFabHeader&, std::size_t);
template std::vector<double> AmrexFabFile::values(const AmrexFabHeader&, std::size_t);

}  // namespace timeseries

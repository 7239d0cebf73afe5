#include "timeseries/readers/xdmf/xdmf_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <fstream>
#include <limits>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/netcdf/netcdf_rows.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/text/number_text.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

constexpr std::size_t kMostOpen = 4;  // HDF5 files
constexpr std::uint64_t kMostValues = std::uint64_t{1} << 40;

std::uint64_t product(const std::vector<std::uint64_t>& lengths) {
    std::uint64_t all = 1;
    for (const std::uint64_t length : lengths) {
        if (length > 0 && all > kMostValues / length) return kMostValues;
        all *= length;
    }
    return all;
}

// Those of a part of an array of these lengths. REQUIRES: it lies inside.
template <typename T>
std::vector<T> partOf(const std::vector<T>& all, const std::vector<std::size_t>& lengths,
                      const XdmfPart& part) {
    std::vector<T> values;
    values.reserve(product({part.count.begin(), part.count.end()}));
    std::vector<std::size_t> at(lengths.size(), 0);  // in the part
    if (std::ranges::find(part.count, 0u) != part.count.end()) return values;
    for (;;) {
        std::size_t index = 0;
        for (std::size_t d = 0; d < lengths.size(); ++d)
            index = index * lengths[d] + part.start[d] + at[d] * part.stride[d];
        values.push_back(all[index]);
        std::size_t d = lengths.size();
        while (d > 0 && ++at[d - 1] == part.count[d - 1]) at[--d] = 0;
        if (d == 0) return values;
    }
}

// How far along a dimension a part reaches, from its first value on.
std::size_t reachOf(const XdmfPart& part, std::size_t dimension) {
    const std::size_t count = part.count[dimension];
    return count == 0 ? 0 : (count - 1) * part.stride[dimension] + 1;
}

}  // namespace

std::vector<std::uint64_t> XdmfItems::lengths(const XdmfElement& at,
                                              const std::string& text) const {
    std::vector<std::uint64_t> all;
    for (const std::string& word : words(text)) {
        std::uint64_t length = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), length);
        if (error != std::errc() || end != word.data() + word.size())
            document_.fail(at, fmt::format("expected lengths, found '{}'", word));
        all.push_back(length);
    }
    if (!all.empty() && product(all) >= kMostValues)
        document_.fail(at, fmt::format("expected fewer than 2^40 values, found '{}'", text));
    return all;
}

XdmfItems::Kind XdmfItems::kindOf(const XdmfElement& item) const {
    const std::string kind = lower(item.attribute("ItemType"));
    if (kind.empty() || kind == "uniform") return Kind::Uniform;
    if (kind == "hyperslab") return Kind::HyperSlab;
    document_.fail(item, fmt::format("expected a DataItem that is Uniform or a HyperSlab, found "
                                     "one of ItemType {}, which is not read",
                                     item.attribute("ItemType")));
}

ValueType XdmfItems::declaredType(const XdmfElement& item) const {
    std::string kind = item.attribute("NumberType"), bytes = item.attribute("Precision");
    if (kind.empty()) kind = item.attribute("DataType");
    struct Named {
        std::string_view kind;
        char bytes;
        ValueType type;
    };
    constexpr std::array kNumberTypes{
        Named{"float", '4', ValueType::F32},  Named{"float", '8', ValueType::F64},
        Named{"double", '8', ValueType::F64}, Named{"int", '4', ValueType::I32},
        Named{"int", '8', ValueType::I64},    Named{"int", '2', ValueType::I16},
        Named{"int", '1', ValueType::I8},     Named{"uint", '4', ValueType::U32},
        Named{"uint", '8', ValueType::U64},   Named{"uint", '2', ValueType::U16},
        Named{"uint", '1', ValueType::U8},    Named{"short", '2', ValueType::I16},
        Named{"ushort", '2', ValueType::U16}, Named{"char", '1', ValueType::I8},
        Named{"uchar", '1', ValueType::U8}};
    const std::string wanted = kind.empty() ? "float" : lower(kind);
    for (const Named& each : kNumberTypes)
        if (each.kind == wanted && (bytes.empty() || bytes == std::string_view(&each.bytes, 1)))
            return each.type;
    document_.fail(item, fmt::format("expected numbers of a type that there is, found NumberType "
                                     "'{}' of Precision '{}'",
                                     kind, bytes));
}

std::filesystem::path XdmfItems::besideDocument(const std::string& name) const {
    return document_.path().parent_path() / name;  // an absolute one is itself
}

const NetcdfFile& XdmfItems::fileAt(const XdmfElement& item, const std::filesystem::path& path) {
    const auto known =
        std::ranges::find(open_, path, [](const auto& file) { return file->path(); });
    if (known != open_.end()) {
        open_.splice(open_.begin(), open_, known);
        return *open_.front();
    }
    if (const std::string flaw = flawOfFile(path); !flaw.empty())
        document_.fail(item, fmt::format("{}: {}", path.string(), flaw));
    open_.push_front(std::make_unique<NetcdfFile>(path, NetcdfFile::Header::New));
    if (open_.size() > kMostOpen) open_.pop_back();
    return *open_.front();
}

// "file.h5:/group/array".
XdmfItems::InHdf5 XdmfItems::inHdf5(const XdmfElement& item) {
    const std::string text = item.text();
    std::size_t colon = text.rfind(":/");
    if (colon == text.npos) colon = text.rfind(':');
    if (colon == text.npos || text.find('|') != text.npos)
        document_.fail(item, fmt::format("expected an array as file.h5:/path, found '{}'", text));
    const std::string array = text.substr(text.find_first_not_of('/', colon + 1) == text.npos
                                              ? text.size()
                                              : text.find_first_not_of('/', colon + 1));
    const NetcdfFile& file = fileAt(item, besideDocument(text.substr(0, colon)));
    const NcVariable* const variable = file.header().find(array, "");
    if (!variable || !variable->type)
        document_.fail(item, fmt::format("expected the array '{}' of numbers in {}", array,
                                         file.path().string()));
    return {&file, variable};
}

XdmfElement XdmfItems::wholeOf(const XdmfElement& slab) const {
    const auto inside = document_.children(slab, "DataItem");
    if (inside.size() != 2 || kindOf(inside[1]) != Kind::Uniform)
        document_.fail(slab, "expected of a HyperSlab start, stride and count, and one array");
    return inside[1];
}

XdmfPart XdmfItems::partOf(const XdmfElement& slab) {
    const XdmfElement whole = wholeOf(slab);
    const auto length = dimensionsOf(whole);
    const XdmfElement first = document_.child(slab, "DataItem");
    if (kindOf(first) != Kind::Uniform || product(dimensionsOf(first)) != 3 * length.size())
        document_.fail(slab, fmt::format("expected start, stride and count along {} dimensions",
                                         length.size()));
    const std::vector<double> all = numbers(first);
    XdmfPart part;
    const std::size_t n = length.size();
    for (std::size_t d = 0; d < n; ++d) {
        const double start = all[d], stride = all[n + d], count = all[2 * n + d];
        const auto most = static_cast<double>(length[d]);
        if (!(start >= 0 && start <= most && count >= 0 && count <= most && stride >= 1 &&
              (count == 0 || start + (count - 1) * stride < most)))
            document_.fail(slab, fmt::format("expected a part of {} values along dimension {}, "
                                             "found start {}, stride {}, count {}",
                                             length[d], d, start, stride, count));
        part.start.push_back(static_cast<std::size_t>(start));
        part.stride.push_back(count > 1 ? static_cast<std::size_t>(stride) : 1);
        part.count.push_back(static_cast<std::size_t>(count));
    }
    return part;
}

std::vector<std::uint64_t> XdmfItems::dimensionsOf(const XdmfElement& item) {
    if (kindOf(item) == Kind::HyperSlab) {
        const XdmfPart part = partOf(item);
        return {part.count.begin(), part.count.end()};
    }
    auto lengthsOf = lengths(item, item.attribute("Dimensions"));
    if (!lengthsOf.empty()) return lengthsOf;
    if (lower(item.attribute("Format")) == "hdf") {
        const auto [file, variable] = inHdf5(item);
        for (std::size_t d = 0; d < variable->dimensions.size(); ++d)
            lengthsOf.push_back(file->header().dimension(*variable, d).length);
    } else if (lower(item.attribute("Format")) != "binary") {
        lengthsOf.push_back(words(item.text()).size());
    }
    if (lengthsOf.empty()) document_.fail(item, "expected the Dimensions of a DataItem");
    return lengthsOf;
}

ValueType XdmfItems::typeOf(const XdmfElement& item) {
    if (kindOf(item) == Kind::HyperSlab) return typeOf(wholeOf(item));
    if (lower(item.attribute("Format")) == "hdf") return *inHdf5(item).variable->type;
    return declaredType(item);
}

std::string XdmfItems::sourceOf(const XdmfElement& item) {
    if (kindOf(item) == Kind::HyperSlab) {
        std::string source = sourceOf(wholeOf(item));
        for (const double number : numbers(document_.child(item, "DataItem")))
            source += fmt::format(" {}", number);
        return source;
    }
    const std::string format = lower(item.attribute("Format"));
    if (format.empty() || format == "xml")
        return fmt::format("line {} {}", item.line(), fmt::ptr(item.node()));
    std::string source = item.text();
    for (const char* name : {"Dimensions", "Seek", "Endian", "NumberType", "DataType", "Precision"})
        source += fmt::format(" {}", item.attribute(name));
    return source;
}

Values XdmfItems::fromHdf5(const XdmfElement& item, const XdmfPart* part) {
    const auto [file, variable] = inHdf5(item);
    std::vector<std::uint64_t> length;
    for (std::size_t d = 0; d < variable->dimensions.size(); ++d)
        length.push_back(file->header().dimension(*variable, d).length);
    const auto declared = lengths(item, item.attribute("Dimensions"));
    if ((!declared.empty() && product(declared) != product(length)) ||
        (part && part->start.size() != length.size()))
        document_.fail(item, fmt::format("expected the Dimensions that {} has in {}, {}; found "
                                         "'{}'",
                                         variable->name, file->path().string(),
                                         fmt::join(length, " "), item.attribute("Dimensions")));
    XdmfPart block{std::vector<std::size_t>(length.size(), 0),
                   std::vector<std::size_t>(length.size(), 1),
                   {length.begin(), length.end()}};
    if (part) {
        block.start = part->start;
        for (std::size_t d = 0; d < length.size(); ++d) block.count[d] = reachOf(*part, d);
    }
    const std::uint64_t count = product({block.count.begin(), block.count.end()});
    if (const std::string why = file->tooLarge(*variable, count); !why.empty())
        file->fail("variable '" + variable->name + "'", why);
    return withType(*variable->type, [&, of = file, from = variable]<typename T>(T) -> Values {
        std::vector<T> values(count);
        if (count > 0) of->read(*from, block.start, block.count, values.data());
        if (!part || std::ranges::all_of(part->stride, [](std::size_t s) { return s == 1; }))
            return values;
        XdmfPart thinned = *part;
        std::ranges::fill(thinned.start, 0u);
        return timeseries::partOf(values, block.count, thinned);
    });
}

Values XdmfItems::fromText(const XdmfElement& item) {
    const std::vector<std::string> all = words(item.text());
    const std::uint64_t count = product(dimensionsOf(item));
    if (all.size() != count)
        document_.fail(item, fmt::format("expected {} numbers, found {}", count, all.size()));
    return withType(declaredType(item), [&]<typename T>(T) -> Values {
        std::vector<T> values;
        values.reserve(all.size());
        for (const std::string& word : all) {
            const auto value = numberOfText<T>(word);
            if (!value)
                document_.fail(item, fmt::format("expected a number of {}, found '{}'",
                                                 typeName(declaredType(item)), word));
            values.push_back(*value);
        }
        return values;
    });
}

Values XdmfItems::fromBinary(const XdmfElement& item) {
    const std::filesystem::path path = besideDocument(item.text());
    if (const std::string flaw = flawOfFile(path); !flaw.empty())
        document_.fail(item, fmt::format("{}: {}", path.string(), flaw));
    if (const std::string packed = lower(item.attribute("Compression"));
        !packed.empty() && packed != "raw")
        document_.fail(item, fmt::format("expected raw values, found Compression {}, which is not "
                                         "read",
                                         item.attribute("Compression")));
    const auto seek = lengths(item, item.attribute("Seek"));
    const std::uint64_t from = seek.empty() ? 0 : seek[0], count = product(dimensionsOf(item));
    const std::string endian = lower(item.attribute("Endian"));
    const bool big = endian == "big";
    if (!(big || endian.empty() || endian == "little" || endian == "native"))
        document_.fail(item, fmt::format("expected Endian Big, Little or Native, found '{}'",
                                         item.attribute("Endian")));
    return withType(declaredType(item), [&]<typename T>(T) -> Values {
        std::error_code ignored;
        const std::uint64_t bytes = std::filesystem::file_size(path, ignored);
        if (from > bytes || count > (bytes - from) / sizeof(T))
            document_.fail(item, fmt::format("{}: expected {} values of {} bytes from byte {} on, "
                                             "found {} bytes in all",
                                             path.string(), count, sizeof(T), from, bytes));
        std::vector<T> values(count);
        std::ifstream file(path, std::ios::binary);
        file.seekg(static_cast<std::streamoff>(from));
        file.read(reinterpret_cast<char*>(values.data()),
                  static_cast<std::streamsize>(count * sizeof(T)));
        if (!file)
            document_.fail(item,
                           fmt::format("{}: expected a file that can be read", path.string()));
        if (big != (std::endian::native == std::endian::big) && !endian.empty() &&
            endian != "native")
            for (T& value : values) {
                auto* const first = reinterpret_cast<char*>(&value);
                std::reverse(first, first + sizeof(T));
            }
        return values;
    });
}

Values XdmfItems::uniform(const XdmfElement& item) {
    const std::string format = lower(item.attribute("Format"));
    if (format == "hdf") return fromHdf5(item, nullptr);
    if (format == "binary") return fromBinary(item);
    if (format.empty() || format == "xml") return fromText(item);
    document_.fail(item, fmt::format("expected the Format HDF, Binary or XML, found '{}'",
                                     item.attribute("Format")));
}

Values XdmfItems::read(const XdmfElement& item) {
    if (kindOf(item) == Kind::Uniform) return uniform(item);
    const XdmfElement whole = wholeOf(item);
    const XdmfPart part = partOf(item);
    if (lower(whole.attribute("Format")) == "hdf") return fromHdf5(whole, &part);
    const auto length = dimensionsOf(whole);
    return std::visit(
        [&](const auto& all) -> Values {
            return timeseries::partOf(all, {length.begin(), length.end()}, part);
        },
        uniform(whole));
}

std::vector<double> XdmfItems::numbers(const XdmfElement& item) { return asDoubles(read(item)); }

}  // namespace timeseries

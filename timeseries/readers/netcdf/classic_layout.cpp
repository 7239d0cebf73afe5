#include "timeseries/readers/netcdf/classic_layout.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "timeseries/readers/reader.h"

// The grammar is that of "The NetCDF File Format Specification" in the NetCDF User's Guide,
// appendix B: header = magic numrecs dim_list gatt_list var_list, all big-endian.

namespace timeseries {
namespace {

constexpr std::uint32_t kDimensionTag = 10, kVariableTag = 11, kAttributeTag = 12;
constexpr std::uint64_t kMaxRank = 1024;  // NC_MAX_VAR_DIMS
constexpr std::uint64_t kMaxName = 256;   // NC_MAX_NAME, the size of the library's buffers

class ClassicHeader {
 public:
    ClassicHeader(const std::filesystem::path& path, std::istream& file, std::uint64_t fileBytes)
        : path_(path), file_(file), fileBytes_(fileBytes) {}

    void check() {
        std::array<char, 4> magic{};
        bytes(magic.data(), magic.size());
        version_ = magic[3];
        const std::uint64_t records = count();
        const std::uint64_t streaming = version_ == 5 ? ~std::uint64_t{0} : 0xFFFFFFFFu;
        dimensionList();
        attributeList("global attributes");
        const std::uint64_t length = listLength(kVariableTag, 28, "variables");
        for (std::uint64_t i = 0; i < length; ++i) variable();
        if (records == streaming)
            damaged("expected the number of records, but the writer left it open");
        checkRecords(records);
    }

 private:
    struct RecordPart {
        std::string name;
        std::uint64_t begin, bytes;
    };

    [[noreturn]] void damaged(std::string_view what) const {
        throw FileError(fmt::format("{}: netCDF header at byte {}: {}", path_.string(), at_, what));
    }
    [[noreturn]] void tooShort(const std::string& variable) const {
        throw FileError(fmt::format(
            "{}: variable '{}': expected its values within the file, but they pass its end at byte "
            "{}: the file is cut off",
            path_.string(), variable, fileBytes_));
    }

    void expectBytes(std::uint64_t count) const {
        if (count > fileBytes_ - at_)
            damaged(
                fmt::format("expected {} more bytes, but the file ends at byte {}: it is cut "
                            "off or damaged",
                            count, fileBytes_));
    }
    void bytes(char* to, std::uint64_t count) {
        expectBytes(count);
        file_.read(to, static_cast<std::streamsize>(count));
        if (!file_) damaged("expected to read on, but the file cannot be read");
        at_ += count;
    }
    void skip(std::uint64_t count) {
        if (count == 0) return;
        expectBytes(count);
        at_ += count;
        file_.seekg(static_cast<std::streamoff>(at_));
    }
    std::uint64_t integer(std::size_t size) {
        std::array<char, 8> raw{};
        bytes(raw.data(), size);
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value = value << 8 | static_cast<unsigned char>(raw[i]);
        return value;
    }
    std::uint64_t count() { return integer(version_ == 5 ? 8 : 4); }
    std::uint64_t offset() { return integer(version_ == 1 ? 4 : 8); }

    std::string name() {
        const std::uint64_t length = count();
        if (length > kMaxName) damaged(fmt::format("expected a name, found {} bytes", length));
        std::string text(length, '\0');
        bytes(text.data(), length);
        for (const char c : text)
            if (c >= '\0' && c < ' ') damaged("expected a name, found control characters");
        skip((4 - length % 4) % 4);
        return text;
    }

    std::uint64_t typeSize() {
        constexpr std::array<std::uint64_t, 12> kSize{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
        const std::uint64_t type = integer(4), last = version_ == 5 ? 11 : 6;
        if (type < 1 || type > last)
            damaged(fmt::format("expected a type from 1 to {}, found {}", last, type));
        return kSize[type];
    }

    // The number of entries, each of at least `entryBytes`.
    std::uint64_t listLength(std::uint32_t tag, std::uint64_t entryBytes, std::string_view what) {
        const std::uint64_t found = integer(4), length = count();
        if (found == 0 && length == 0) return 0;
        if (found != tag) damaged(fmt::format("expected the list of {}", what));
        if (length > (fileBytes_ - at_) / entryBytes)
            damaged(fmt::format("expected {} {} within the file, but it ends at byte {}", length,
                                what, fileBytes_));
        return length;
    }

    void dimensionList() {
        const std::uint64_t length = listLength(kDimensionTag, 8, "dimensions");
        for (std::uint64_t i = 0; i < length; ++i) {
            name();
            dimensions_.push_back(count());
        }
    }

    void attributeList(std::string_view what) {
        const std::uint64_t length = listLength(kAttributeTag, 12, what);
        for (std::uint64_t i = 0; i < length; ++i) {
            name();
            const std::uint64_t size = typeSize(), n = count();
            if (n > fileBytes_ / size)
                damaged(fmt::format("expected an attribute within the file, found {} values", n));
            skip((n * size + 3) / 4 * 4);
        }
    }

    void variable() {
        const std::string text = name();
        const std::uint64_t rank = count();
        if (rank > kMaxRank)
            damaged(fmt::format("variable '{}': expected at most {} dimensions, found {}", text,
                                kMaxRank, rank));
        bool record = false, fits = true;
        std::uint64_t points = 1;
        for (std::uint64_t d = 0; d < rank; ++d) {
            const std::uint64_t id = count();
            if (id >= dimensions_.size())
                damaged(fmt::format("variable '{}': expected a dimension, found number {} of {}",
                                    text, id, dimensions_.size()));
            const std::uint64_t n = dimensions_[id];
            if (n == 0 && d > 0)
                damaged(fmt::format("variable '{}': expected the record dimension first", text));
            if (n == 0)
                record = true;
            else if (points > fileBytes_ / n)
                fits = false;
            else
                points *= n;
        }
        attributeList("attributes");
        const std::uint64_t size = typeSize();
        count();  // vsize: redundant, and by design not right for large variables
        const std::uint64_t begin = offset();
        fits = fits && points <= fileBytes_ / size;
        const std::uint64_t bytes = fits ? points * size : fileBytes_ + 1;
        // A record variable's values count only when there are records.
        if (record)
            records_.push_back({text, begin, bytes});
        else if (begin > fileBytes_ || bytes > fileBytes_ - begin)
            tooShort(text);
    }

    // Record variables lie interleaved: record r begins r strides after record 0.
    void checkRecords(std::uint64_t records) const {
        if (records == 0) return;
        // A lone record variable is not padded to four bytes.
        std::uint64_t stride = 0;
        for (const RecordPart& part : records_)
            stride += records_.size() == 1 ? part.bytes : (part.bytes + 3) / 4 * 4;
        for (const RecordPart& part : records_)
            if (part.begin > fileBytes_ || part.bytes > fileBytes_ - part.begin ||
                records - 1 > (fileBytes_ - part.begin - part.bytes) / stride)
                tooShort(part.name);
    }

    const std::filesystem::path& path_;
    std::istream& file_;
    std::uint64_t fileBytes_, at_ = 0;
    int version_ = 1;
    std::vector<std::uint64_t> dimensions_;
    std::vector<RecordPart> records_;
};

}  // namespace

void checkClassicLayout(const std::filesystem::path& path, std::istream& file,
                        std::uint64_t fileBytes) {
    ClassicHeader(path, file, fileBytes).check();
}

}  // namespace timeseries

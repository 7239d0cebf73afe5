#include "timeseries/readers/fits_file.h"

#include <fitsio.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr int kMostAxes = 16;
constexpr int kMostImages = 4096;
// More than this, and than its bytes may hold, is believed of no compressed image.
constexpr double kFreeBytes = 67108864, kMostPacked = 1100;

std::mutex& libraryMutex() {
    static std::mutex one;
    return one;
}

// What a type is called in CFITSIO, as an image's and as memory's.
struct TypeName {
    int image, memory;
    ValueType type;
};
constexpr std::array kTypes{TypeName{BYTE_IMG, TBYTE, ValueType::U8},
                            TypeName{SBYTE_IMG, TSBYTE, ValueType::I8},
                            TypeName{USHORT_IMG, TUSHORT, ValueType::U16},
                            TypeName{SHORT_IMG, TSHORT, ValueType::I16},
                            TypeName{ULONG_IMG, TUINT, ValueType::U32},
                            TypeName{LONG_IMG, TINT, ValueType::I32},
                            TypeName{ULONGLONG_IMG, TULONGLONG, ValueType::U64},
                            TypeName{LONGLONG_IMG, TLONGLONG, ValueType::I64},
                            TypeName{FLOAT_IMG, TFLOAT, ValueType::F32},
                            TypeName{DOUBLE_IMG, TDOUBLE, ValueType::F64}};

std::string sentenceOf(int status) {
    std::array<char, FLEN_STATUS> text{};
    fits_get_errstatus(status, text.data());
    fits_clear_errmsg();
    return text.data();
}

std::string trimmed(std::string_view text) {
    const auto last = text.find_last_not_of(' ');
    return std::string(text.substr(0, last == text.npos ? 0 : last + 1));
}

// Keywords of the HDU that the file stands at.
class Keywords {
 public:
    explicit Keywords(fitsfile* file) : file_(file) {}
    std::string text(const std::string& key) const {
        std::array<char, FLEN_VALUE> value{};
        int status = 0;
        fits_read_key(file_, TSTRING, key.c_str(), value.data(), nullptr, &status);
        if (status != 0) fits_clear_errmsg();
        return status == 0 ? trimmed(value.data()) : "";
    }
    std::optional<double> number(const std::string& key) const {
        double value = 0;
        int status = 0;
        fits_read_key(file_, TDOUBLE, key.c_str(), &value, nullptr, &status);
        if (status != 0) fits_clear_errmsg();
        if (status != 0 || !std::isfinite(value)) return std::nullopt;
        return value;
    }
    std::optional<std::int64_t> integer(const std::string& key) const {
        LONGLONG value = 0;
        int status = 0;
        fits_read_key(file_, TLONGLONG, key.c_str(), &value, nullptr, &status);
        if (status != 0) fits_clear_errmsg();
        return status == 0 ? std::optional<std::int64_t>(value) : std::nullopt;
    }

 private:
    fitsfile* file_;
};

FitsAxis axisOf(const Keywords& keys, int number, LONGLONG size) {
    FitsAxis axis;
    axis.size = static_cast<std::uint64_t>(size);
    axis.type = keys.text(fmt::format("CTYPE{}", number));
    axis.unit = keys.text(fmt::format("CUNIT{}", number));
    axis.reference = keys.number(fmt::format("CRVAL{}", number));
    axis.referencePixel = keys.number(fmt::format("CRPIX{}", number)).value_or(0);
    axis.step = keys.number(fmt::format("CDELT{}", number));
    // A matrix stands for the steps (section 8.1).
    if (const auto step = keys.number(fmt::format("CD{0}_{0}", number))) axis.step = step;
    return axis;
}

bool isTurned(const Keywords& keys, int axes) {
    for (int i = 1; i <= axes; ++i) {
        if (keys.number(fmt::format("CROTA{}", i)).value_or(0) != 0) return true;
        for (int j = 1; j <= axes; ++j)
            for (const char* matrix : {"PC", "CD"})
                if (i != j && keys.number(fmt::format("{}{}_{}", matrix, i, j)).value_or(0) != 0)
                    return true;
    }
    return false;
}

}  // namespace

struct FitsFile::Open {
    fitsfile* file = nullptr;
    ~Open() {
        int status = 0;
        if (file) fits_close_file(file, &status);
        if (status != 0) fits_clear_errmsg();
    }
    // Of the HDU that the file stands at; nothing when it is no image of values.
    std::optional<FitsImage> image(const FitsFile& of, int hdu) const;
    void expectBytes(const FitsFile& of, const FitsImage& image) const;
};

FitsFile::FitsFile(const std::filesystem::path& path)
    : path_(path), open_(std::make_unique<Open>()) {
    const std::lock_guard lock(libraryMutex());
    int status = 0;
    // Names with brackets are names, not commands.
    fits_open_diskfile(&open_->file, path.c_str(), READONLY, &status);
    if (status != 0)
        fail("header",
             fmt::format("expected a whole FITS header, but CFITSIO says: {}", sentenceOf(status)));
}

FitsFile::~FitsFile() {
    const std::lock_guard lock(libraryMutex());
    open_.reset();
}

std::optional<FitsImage> FitsFile::Open::image(const FitsFile& of, int hdu) const {
    int status = 0, dimensions = 0, type = 0;
    std::array<LONGLONG, kMostAxes> sizes{};
    fits_get_img_dim(file, &dimensions, &status);
    if (status == 0 && dimensions > kMostAxes)
        of.fail(fmt::format("HDU {}", hdu),
                fmt::format("expected at most {} axes, found {}", kMostAxes, dimensions));
    fits_get_img_sizell(file, kMostAxes, sizes.data(), &status);
    fits_get_img_equivtype(file, &type, &status);
    const Keywords keys(file);
    // CFITSIO 4.2 does not tell 64 bits without a sign.
    if (type == LONGLONG_IMG && keys.number("BZERO") == 0x1p63 &&
        keys.number("BSCALE").value_or(1) == 1)
        type = ULONGLONG_IMG;
    const auto known = std::ranges::find(kTypes, type, &TypeName::image);
    if (status != 0 || known == kTypes.end())
        of.fail(fmt::format("HDU {}", hdu),
                fmt::format("expected an image, but CFITSIO says: {}", sentenceOf(status)));
    FitsImage image;
    image.hdu = hdu;
    image.type = known->type;
    std::uint64_t points = dimensions > 0 ? 1 : 0;
    for (int i = 0; i < dimensions; ++i) {
        if (sizes[i] < 1) return std::nullopt;
        image.axes.push_back(axisOf(keys, i + 1, sizes[i]));
        if (__builtin_mul_overflow(points, image.axes.back().size, &points))
            of.fail(fmt::format("HDU {}", hdu), "expected at most 2^64 - 1 values");
    }
    if (points == 0) return std::nullopt;
    image.name = keys.text("EXTNAME");
    image.unit = keys.text("BUNIT");
    image.turned = isTurned(keys, dimensions);
    image.storedAs = fmt::format("BITPIX {}", keys.integer("BITPIX").value_or(0));
    const bool isInteger = image.type != ValueType::F32 && image.type != ValueType::F64;
    if (const auto blank = keys.integer("BLANK"); blank && isInteger) {
        const double zero = keys.number("BZERO").value_or(0);
        const auto offset = zero < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(zero))
                                     : static_cast<std::uint64_t>(zero);
        image.blank = {*blank, static_cast<std::uint64_t>(*blank) + offset};
    }
    expectBytes(of, image);
    return image;
}

// Whether the file can hold what it declares.
void FitsFile::Open::expectBytes(const FitsFile& of, const FitsImage& image) const {
    int status = 0;
    LONGLONG header = 0, begin = 0, end = 0;
    const bool packed = fits_is_compressed_image(file, &status) != 0;
    fits_get_hduaddrll(file, &header, &begin, &end, &status);
    std::error_code error;
    const auto bytes = std::filesystem::file_size(of.path(), error);
    double values = withType(image.type, [](auto v) { return static_cast<double>(sizeof v); });
    for (const FitsAxis& axis : image.axes) values *= static_cast<double>(axis.size);
    const bool holds =
        packed ? std::max(values - kFreeBytes, 0.0) <= kMostPacked * static_cast<double>(bytes)
               : begin >= 0 && end >= begin && static_cast<std::uint64_t>(begin) <= bytes &&
                     values <= 2 * static_cast<double>(bytes - begin);
    if (status != 0 || error || !holds)
        of.fail(fmt::format("HDU {}", image.hdu),
                fmt::format("expected {:.0f} bytes of values, found a file of {}", values, bytes));
}

std::vector<FitsImage> FitsFile::images() {
    const std::lock_guard lock(libraryMutex());
    std::vector<FitsImage> images;
    for (int hdu = 1; hdu <= kMostImages; ++hdu) {
        int status = 0, type = 0;
        fits_movabs_hdu(open_->file, hdu, &type, &status);
        if (status == END_OF_FILE) {
            fits_clear_errmsg();
            break;
        }
        if (status != 0)
            fail(fmt::format("HDU {}", hdu),
                 fmt::format("expected a whole header, but CFITSIO says: {}", sentenceOf(status)));
        if (type != IMAGE_HDU) continue;
        if (auto image = open_->image(*this, hdu)) images.push_back(std::move(*image));
    }
    return images;
}

Values FitsFile::read(const FitsImage& image, const std::vector<std::uint64_t>& first,
                      const std::vector<std::uint64_t>& last) {
    std::vector<long> from, to, every(image.axes.size(), 1);
    std::uint64_t points = 1;
    for (std::size_t i = 0; i < image.axes.size(); ++i) {
        from.push_back(static_cast<long>(first[i] + 1));
        to.push_back(static_cast<long>(last[i] + 1));
        points *= last[i] - first[i] + 1;
    }
    const auto memory = std::ranges::find(kTypes, image.type, &TypeName::type)->memory;
    const std::lock_guard lock(libraryMutex());
    return withType(image.type, [&](auto value) -> Values {
        using T = decltype(value);
        std::vector<T> values(points);
        // Blank pixels of scaled integers and of floats that were packed.
        T none = std::numeric_limits<T>::quiet_NaN();
        int status = 0, any = 0;
        fits_movabs_hdu(open_->file, image.hdu, nullptr, &status);
        fits_read_subset(open_->file, memory, from.data(), to.data(), every.data(),
                         std::is_floating_point_v<T> ? &none : nullptr, values.data(), &any,
                         &status);
        if (status != 0)
            fail(fmt::format("HDU {}", image.hdu),
                 fmt::format("expected {} values, but CFITSIO says: {}", points,
                             sentenceOf(status)));
        return values;
    });
}

void FitsFile::fail(std::string_view place, std::string_view what) const {
    throw FileError(fmt::format("{}: {}: {}", path_.string(), place, what));
}

}  // namespace timeseries

#include "timeseries/readers/arrays/fits_file.h"

#include <fitsio.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr int kMostAxes = 9;  // that CFITSIO reads parts of
constexpr int kMostImages = 4096;
// More than this, and than its bytes may hold, is believed of no compressed image.
constexpr double kFreeBytes = 67108864;

std::mutex& cfitsioMutex() {
    static std::mutex one;
    return one;
}

// What numbers of so many bits are, and with which offset they have the other sign (section 5.2.5).
struct Stored {
    int bitpix;
    ValueType type;
    double signOffset;
    ValueType otherSign;
};
constexpr std::array kStored{
    Stored{8, ValueType::U8, -128, ValueType::I8},
    Stored{16, ValueType::I16, 32768, ValueType::U16},
    Stored{32, ValueType::I32, 2147483648.0, ValueType::U32},
    Stored{64, ValueType::I64, 0x1p63, ValueType::U64},
    Stored{-32, ValueType::F32, 0, ValueType::F32},
    Stored{-64, ValueType::F64, 0, ValueType::F64},
};

// What CFITSIO calls them in memory, in the order of ValueType.
constexpr std::array kInMemory{TBYTE, TSBYTE,     TUSHORT,   TSHORT, TUINT,
                               TINT,  TULONGLONG, TLONGLONG, TFLOAT, TDOUBLE};

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

// What a pixel along an axis adds to each coordinate (section 8.1): CD, or CDELT times PC where an
// axis has none.
class Matrix {
 public:
    Matrix(const Keywords& keys, int axes) : axes_(axes) {
        for (int j = 1; j <= axes; ++j)
            for (int i = 1; i <= axes; ++i) {
                const auto cd = keys.number(fmt::format("CD{}_{}", j, i)),
                           pc = keys.number(fmt::format("PC{}_{}", j, i));
                hasCd_[static_cast<std::size_t>(i)] |= cd.has_value();
                cd_[at(j, i)] = cd.value_or(0);
                const auto delta = keys.number(fmt::format("CDELT{}", j));
                told_[static_cast<std::size_t>(i)] |= cd || (i == j && (pc || delta));
                pc_[at(j, i)] = pc.value_or(i == j ? 1 : 0) * delta.value_or(1);
            }
    }
    // How long a pixel is, with the sign that it has along its own coordinate; nothing when it is
    // not told.
    std::optional<double> step(int i) const {
        if (!told_[static_cast<std::size_t>(i)]) return std::nullopt;
        double length = 0;
        for (int j = 1; j <= axes_; ++j) length = std::hypot(length, of(j, i));
        return std::copysign(length, of(worldOf(i), i));
    }
    // The coordinate that pixels along an axis differ in, where it is one alone, and of no other
    // axis; else its own.
    int worldOf(int i) const {
        const int only = onlyOne(i);
        for (int other = 1; other <= axes_; ++other)
            if (other != i && onlyOne(other) == only) return i;
        return only != 0 ? only : i;
    }
    bool isTurned() const {
        for (int i = 1; i <= axes_; ++i)
            for (int j = 1; j <= axes_; ++j)
                if (j != worldOf(i) && of(j, i) != 0) return true;
        return false;
    }

 private:
    int onlyOne(int i) const {
        int only = 0;
        for (int j = 1; j <= axes_; ++j) {
            if (of(j, i) == 0) continue;
            if (only != 0) return 0;
            only = j;
        }
        return only;
    }
    std::size_t at(int j, int i) const { return static_cast<std::size_t>(j * (kMostAxes + 1) + i); }
    double of(int j, int i) const {
        return hasCd_[static_cast<std::size_t>(i)] ? cd_[at(j, i)] : pc_[at(j, i)];
    }
    int axes_;
    std::array<bool, kMostAxes + 1> told_{}, hasCd_{};  // of a pixel along each axis
    std::array<double, (kMostAxes + 1) * (kMostAxes + 1)> cd_{}, pc_{};
};

FitsAxis axisOf(const Keywords& keys, const Matrix& matrix, int number, LONGLONG size) {
    FitsAxis axis;
    axis.size = static_cast<std::uint64_t>(size);
    const int world = matrix.worldOf(number);
    axis.type = keys.text(fmt::format("CTYPE{}", world));
    axis.unit = keys.text(fmt::format("CUNIT{}", world));
    axis.reference = keys.number(fmt::format("CRVAL{}", world));
    axis.referencePixel = keys.number(fmt::format("CRPIX{}", number)).value_or(0);
    axis.step = matrix.step(number);
    return axis;
}

// None where a double holds every sum; 0 where not even 64 bits do.
std::optional<std::int64_t> shiftOf(int bitpix, double zero, std::optional<std::int64_t> whole) {
    constexpr double kMostExact = 0x1p52;  // beside integers of 32 bits
    const bool isExact = bitpix < 64 && std::abs(zero) <= kMostExact;
    if (isExact || zero != std::floor(zero)) return std::nullopt;
    return std::abs(zero) > 0x1p63 ? 0 : whole.value_or(0);
}

bool isTurned(const Keywords& keys, const Matrix& matrix, int axes) {
    for (int i = 1; i <= axes; ++i)
        if (keys.number(fmt::format("CROTA{}", i)).value_or(0) != 0) return true;
    return matrix.isTurned();
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
    void expectBytes(const FitsFile& of, const FitsImage& image, double values) const;
};

FitsFile::FitsFile(const std::filesystem::path& path)
    : path_(path), open_(std::make_unique<Open>()) {
    const std::lock_guard lock(cfitsioMutex());
    int status = 0;
    // Names with brackets are names, not commands.
    fits_open_diskfile(&open_->file, path.c_str(), READONLY, &status);
    if (status != 0)
        fail("header",
             fmt::format("expected a whole FITS header, but CFITSIO says: {}", sentenceOf(status)));
}

FitsFile::~FitsFile() {
    const std::lock_guard lock(cfitsioMutex());
    open_.reset();
}

std::optional<FitsImage> FitsFile::Open::image(const FitsFile& of, int hdu) const {
    const std::string place = fmt::format("HDU {}", hdu);
    int status = 0, dimensions = 0, bitpix = 0;
    std::array<LONGLONG, kMostAxes> sizes{};
    fits_get_img_dim(file, &dimensions, &status);
    if (status == 0 && dimensions > kMostAxes)
        of.fail(place, fmt::format("expected at most {} axes, found {}", kMostAxes, dimensions));
    fits_get_img_sizell(file, kMostAxes, sizes.data(), &status);
    fits_get_img_type(file, &bitpix, &status);
    const auto stored = std::ranges::find(kStored, bitpix, &Stored::bitpix);
    if (status != 0 || stored == kStored.end())
        of.fail(place, fmt::format("expected an image, but CFITSIO says: {}", sentenceOf(status)));
    const Keywords keys(file);
    const Matrix matrix(keys, dimensions);
    FitsImage image;
    image.hdu = hdu;
    std::uint64_t points = dimensions > 0 ? 1 : 0;
    for (int i = 0; i < dimensions; ++i) {
        if (sizes[static_cast<std::size_t>(i)] < 1) return std::nullopt;
        image.axes.push_back(axisOf(keys, matrix, i + 1, sizes[static_cast<std::size_t>(i)]));
        if (__builtin_mul_overflow(points, image.axes.back().size, &points))
            of.fail(place, "expected at most 2^64 - 1 values");
    }
    if (points == 0) return std::nullopt;
    image.name = keys.text("EXTNAME");
    image.unit = keys.text("BUNIT");
    image.turned = isTurned(keys, matrix, dimensions);
    image.packed = fits_is_compressed_image(file, &status) != 0;
    image.storedAs = fmt::format("BITPIX {}", bitpix);
    const double scale = keys.number("BSCALE").value_or(1), zero = keys.number("BZERO").value_or(0);
    const bool isInteger = bitpix > 0, plain = scale == 1 && zero == 0;
    const auto whole = keys.integer("BZERO");  // none of 2^63
    const bool otherSign =
        isInteger && scale == 1 && zero == stored->signOffset && !(zero == 0x1p63 && whole);
    if (isInteger && scale == 1 && !plain && !otherSign) image.shift = shiftOf(bitpix, zero, whole);
    if (image.shift && *image.shift == 0)
        of.fail(place, fmt::format("expected a BZERO below 2^63, found {}", zero));
    image.type = plain         ? stored->type
                 : otherSign   ? stored->otherSign
                 : image.shift ? ValueType::I64
                               : ValueType::F64;
    const bool scaled = !plain && !otherSign && !image.shift;
    image.scaledIntegers = scaled && isInteger;
    if (scaled) image.storedAs += fmt::format(", scale {}, offset {}", scale, zero);
    if (image.shift) image.storedAs += fmt::format(", offset {}", *image.shift);
    if (const auto blank = keys.integer("BLANK"); blank && isInteger && !scaled) {
        // 2^63 is beyond the integers with a sign.
        const auto offset = image.shift ? static_cast<std::uint64_t>(*image.shift)
                            : zero < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(zero))
                                       : static_cast<std::uint64_t>(zero);
        image.blank = {*blank, static_cast<std::uint64_t>(*blank) + offset};
    }
    expectBytes(of, image, static_cast<double>(points) * std::abs(bitpix) / 8);
    return image;
}

// Whether the file can hold so many bytes of values.
void FitsFile::Open::expectBytes(const FitsFile& of, const FitsImage& image, double values) const {
    int status = 0;
    LONGLONG header = 0, begin = 0, end = 0;
    fits_get_hduaddrll(file, &header, &begin, &end, &status);
    std::error_code error;
    const auto bytes = std::filesystem::file_size(of.path(), error);
    const bool holds =
        image.packed
            ? std::max(values - kFreeBytes, 0.0) <= kMaxInflated * static_cast<double>(bytes)
            : begin >= 0 && static_cast<std::uint64_t>(begin) <= bytes &&
                  values <= static_cast<double>(bytes) - static_cast<double>(begin);
    if (status != 0 || error || !holds)
        of.fail(fmt::format("HDU {}", image.hdu),
                fmt::format("expected {:.0f} bytes of values, found a file of {}", values, bytes));
}

std::vector<FitsImage> FitsFile::images(std::vector<DamagedVariable>& damaged) {
    const std::lock_guard lock(cfitsioMutex());
    std::vector<FitsImage> images;
    for (int hdu = 1;; ++hdu) {
        int status = 0, type = 0;
        fits_movabs_hdu(open_->file, hdu, &type, &status);
        if (status == END_OF_FILE) {
            fits_clear_errmsg();
            break;
        }
        if (hdu > kMostImages)
            fail("images", fmt::format("expected at most {} HDUs, found more", kMostImages));
        try {
            if (status != 0)
                fail(fmt::format("HDU {}", hdu),
                     fmt::format("expected a whole header, but CFITSIO says: {}",
                                 sentenceOf(status)));
            if (type != IMAGE_HDU) continue;
            if (auto image = open_->image(*this, hdu)) images.push_back(std::move(*image));
        } catch (const FileError& flaw) {
            damaged.push_back({fmt::format("HDU {}", hdu), flaw.what()});
            if (status != 0) break;  // nobody knows where another begins
        }
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
    const int memory = kInMemory[static_cast<std::size_t>(image.type)];
    const std::lock_guard lock(cfitsioMutex());
    return withType(image.type, [&](auto value) -> Values {
        using T = decltype(value);
        std::vector<T> values(points);
        // Of scaled integers blank ones, of packed floats those that were not numbers. Of other
        // floats CFITSIO, asked so, would change infinities and what is next to 0.
        T none = std::numeric_limits<T>::quiet_NaN();
        const bool asks = std::is_floating_point_v<T> && (image.packed || image.scaledIntegers);
        int status = 0, any = 0;
        fits_movabs_hdu(open_->file, image.hdu, nullptr, &status);
        if (image.shift) fits_set_bscale(open_->file, 1, 0, &status);
        fits_read_subset(open_->file, memory, from.data(), to.data(), every.data(),
                         asks ? &none : nullptr, values.data(), &any, &status);
        if (status != 0)
            fail(fmt::format("HDU {}", image.hdu),
                 fmt::format("expected {} values, but CFITSIO says: {}", points,
                             sentenceOf(status)));
        if constexpr (std::is_same_v<T, std::int64_t>)
            if (image.shift) addShift(image, values);
        return values;
    });
}

// Of what is blank modulo 2^64, as it is looked for.
void FitsFile::addShift(const FitsImage& image, std::vector<std::int64_t>& values) const {
    for (std::int64_t& value : values) {
        std::int64_t sum = 0;
        const bool isBlank = image.blank && value == image.blank->stored;
        if (__builtin_add_overflow(value, *image.shift, &sum) && !isBlank)
            fail(fmt::format("HDU {}", image.hdu),
                 fmt::format("expected values of 64 bits, found {} with BZERO {}", value,
                             *image.shift));
        value = sum;
    }
}

void FitsFile::fail(std::string_view place, std::string_view what) const {
    throw FileError(fmt::format("{}: {}: {}", path_.string(), place, what));
}

}  // namespace timeseries

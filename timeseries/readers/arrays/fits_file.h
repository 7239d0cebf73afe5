// A FITS file through CFITSIO: the images that it holds and their values. Pence and others,
// "Definition of the Flexible Image Transport System (FITS)", version 4.0 (2018).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/reader.h"

namespace timeseries {

// One axis as its keywords tell it: pixel p, counted from 1, lies at (p - referencePixel) step from
// the reference value.
struct FitsAxis {
    std::uint64_t size = 1;
    std::string type, unit;  // CTYPE, CUNIT; "" when not told
    std::optional<double> step, reference;
    double referencePixel = 0;
};

struct FitsImage {
    int hdu = 1;       // counted from 1
    std::string name;  // EXTNAME; ""
    std::string unit;  // BUNIT
    ValueType type{};  // with scale and offset applied: double, but where they turn a sign
    // Of integers of which a double would not hold all: what is added to them as they are stored.
    std::optional<std::int64_t> shift;
    bool scaledIntegers = false;
    bool packed = false;  // compressed by tiles
    std::string storedAs;
    // Of integers without a scale, the value that is none: as stored, and with the offset that
    // makes it unsigned, modulo 2^64.
    struct Blank {
        std::int64_t stored;
        std::uint64_t value;
    };
    std::optional<Blank> blank;
    std::vector<FitsAxis> axes;  // fastest first
    bool turned = false;         // its axes lean to those of the sky
};

// Every call holds CFITSIO's lock.
class FitsFile {
 public:
    // Throws FileError.
    explicit FitsFile(const std::filesystem::path& path);
    ~FitsFile();
    FitsFile(const FitsFile&) = delete;
    FitsFile& operator=(const FitsFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    // Those of any values that can be read; what cannot is told beside. Throws FileError.
    std::vector<FitsImage> images(std::vector<DamagedVariable>& damaged);
    // The pixels from `first` to `last` on each axis, counted from 0, inclusive. Throws FileError.
    Values read(const FitsImage& image, const std::vector<std::uint64_t>& first,
                const std::vector<std::uint64_t>& last);
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;

 private:
    void addShift(const FitsImage& image, std::vector<std::int64_t>& values) const;

    struct Open;
    std::filesystem::path path_;
    std::unique_ptr<Open> open_;
};

}  // namespace timeseries

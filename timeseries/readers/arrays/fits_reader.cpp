#include "timeseries/readers/arrays/fits_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "timeseries/readers/arrays/fits_file.h"
#include "timeseries/readers/cf/cf_time.h"
#include "timeseries/readers/limits.h"

namespace timeseries {
namespace {

// "RA" of RA---TAN.
std::string quantityOf(const FitsAxis& axis) {
    return axis.type.substr(0, std::min(axis.type.find('-'), axis.type.size()));
}

// Of the sky: angles from the reference are told as they are on its tangent plane.
bool isCelestial(const FitsAxis& axis) {
    static constexpr std::array kLongitudesAndLatitudes{"RA",   "DEC",  "GLON", "GLAT", "ELON",
                                                        "ELAT", "HPLN", "HPLT", "SLON", "SLAT"};
    return std::ranges::find(kLongitudesAndLatitudes, quantityOf(axis)) !=
           kLongitudesAndLatitudes.end();
}

// Units that need not be written (FITS 4.0, tables 22 and 25).
std::string unitOf(const FitsAxis& axis) {
    if (!axis.unit.empty()) return axis.unit == "deg" ? "degree" : axis.unit;
    if (isCelestial(axis)) return "degree";
    const std::string quantity = quantityOf(axis);
    if (quantity == "FREQ") return "Hz";
    if (quantity == "WAVE" || quantity == "AWAV") return "m";
    if (quantity == "VRAD" || quantity == "VOPT" || quantity == "VELO") return "m/s";
    if (quantity == "TIME") return "s";
    return "";
}

// "LOG" of WAVE-LOG: how pixels become coordinates where that is not even (FITS 4.0, table 26).
std::string algorithmOf(const FitsAxis& axis) {
    if (axis.type.size() < 8 || axis.type[4] != '-' || isCelestial(axis)) return "";
    const std::string code = axis.type.substr(5, 3);
    const bool isTold = code == "LOG" || code == "TAB" || code == "GRI" || code == "GRA";
    return isTold || code[1] == '2' ? code : "";
}

bool isWorkedOut(const FitsAxis& axis) {
    const std::string algorithm = algorithmOf(axis);
    return algorithm.empty() || (algorithm == "LOG" && axis.reference.value_or(0) != 0);
}

std::vector<double> coordinatesOf(const FitsAxis& axis) {
    const double first = isCelestial(axis) ? 0 : axis.reference.value_or(0);
    const bool isLog = algorithmOf(axis) == "LOG";
    std::vector<double> coordinates;
    for (std::uint64_t i = 0; i < axis.size; ++i) {
        const double away =
            (static_cast<double>(i + 1) - axis.referencePixel) * axis.step.value_or(1);
        coordinates.push_back(isLog ? first * std::exp(away / first) : first + away);
    }
    return coordinates;
}

Axis spaceAxis(const FitsAxis& axis, const char* letter, std::vector<std::string>& notes) {
    const std::string quantity = quantityOf(axis);
    const std::string name = quantity.empty() ? letter : quantity;
    if (!isWorkedOut(axis)) {
        notes.push_back(fmt::format("{} is placed by index: {} is not even, and not worked out",
                                    name, axis.type));
        return {name, "index", indexCoordinates(axis.size), false};
    }
    if (axis.step) {
        Axis placed{name, unitOf(axis), coordinatesOf(axis), false};
        if (flawOf(placed.coordinates).empty()) {
            if (!isCelestial(axis)) return placed;
            notes.push_back(fmt::format("{} is the angle from {} {} on the plane of the sky", name,
                                        axis.reference.value_or(0), unitOf(axis)));
            return placed;
        }
    }
    if (axis.size > 1)
        notes.push_back(name +
                        " is placed by index: the file has no steps that tell its pixels apart");
    return {name, "index", indexCoordinates(axis.size), false};
}

bool isTime(const FitsAxis& axis) {
    static constexpr std::array kTimes{"TIME", "UTC", "TAI", "TDB", "TT"};
    return std::ranges::find(kTimes, quantityOf(axis)) != kTimes.end();
}

// Of polarisation, each plane of which is a variable: no place, and nothing lies between two.
constexpr const char* kStokes = "STOKES";

// FITS 4.0, table 29.
std::string stokesName(double value) {
    static constexpr std::array kNames{"YX", "XY", "YY", "XX", "LR", "RL", "LL",
                                       "RR", "",   "I",  "Q",  "U",  "V"};
    const double at = value + 8;
    const bool isNamed = at == std::floor(at) && at >= 0 && at < kNames.size() && value != 0;
    return isNamed ? kNames[static_cast<std::size_t>(at)] : fmt::format("{:g}", value);
}

// A place along an axis.
struct AlongAxis {
    std::size_t axis;
    std::uint64_t at;
};

// What a variable is read by.
struct Placed {
    FitsImage image;
    std::optional<std::size_t> time;  // of its axes
    std::optional<AlongAxis> plane = {};
};

class FitsReader final : public Reader {
 public:
    explicit FitsReader(const std::filesystem::path& path) : file_(path) {
        for (const FitsImage& image : file_.images(damaged_)) {
            const int hdu = image.hdu;
            try {
                add(image);
            } catch (const FileError& flaw) {
                damaged_.push_back({fmt::format("HDU {}", hdu), flaw.what()});
            }
        }
        if (variables_.empty() && !damaged_.empty()) throw FileError(damaged_.front().why);
        if (variables_.empty())
            file_.fail("images", "expected one with more than one pixel, found none");
    }
    std::string format() const override { return "FITS"; }
    std::span<const std::filesystem::path> files() const override { return {&file_.path(), 1}; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepSources sources(std::size_t, std::size_t step) override { return {{file_.path()}, step}; }

 private:
    void add(const FitsImage& image);
    void add(const FitsImage& image, const std::vector<std::size_t>& axes,
             std::optional<AlongAxis> plane);
    std::string nameOf(const FitsImage& image, std::optional<AlongAxis> plane) const;
    // Three axes of space and one of time at most, of those longer than one pixel.
    std::optional<std::size_t> timeOf(const FitsImage& image, const std::vector<std::size_t>& axes,
                                      std::vector<std::string>& notes) const;
    void expectSizes(const FitsImage& image, std::optional<std::size_t> time,
                     std::optional<AlongAxis> plane) const;

    FitsFile file_;
    std::vector<Placed> placed_;
    std::vector<Variable> variables_;
    std::vector<DamagedVariable> damaged_;
};

std::optional<std::size_t> FitsReader::timeOf(const FitsImage& image,
                                              const std::vector<std::size_t>& axes,
                                              std::vector<std::string>& notes) const {
    for (const std::size_t i : axes)
        if (isTime(image.axes[i])) return i;
    if (axes.size() <= 3) return std::nullopt;
    const FitsAxis& last = image.axes[axes.back()];
    const std::string named =
        last.type.empty() ? fmt::format("axis {}", axes.back() + 1) : last.type;
    notes.push_back(fmt::format("{} is taken for time: no axis says that it is", named));
    return axes.back();
}

void FitsReader::expectSizes(const FitsImage& image, std::optional<std::size_t> time,
                             std::optional<AlongAxis> plane) const {
    const std::string place = fmt::format("HDU {}", image.hdu);
    std::uint64_t points = 1;
    for (std::size_t i = 0; i < image.axes.size(); ++i) {
        const std::uint64_t size = image.axes[i].size, most = i == time ? kMaxSteps : kMaxAxis;
        if (size > most)
            file_.fail(place, fmt::format("expected at most {} pixels along axis {}, found {}",
                                          most, i + 1, size));
        if (i != time && (!plane || i != plane->axis))
            points *= size;  // three of more than one pixel
    }
    if (points > kMaxPoints)
        file_.fail(place, fmt::format("expected at most 2^32 points a step, found {}", points));
}

void FitsReader::add(const FitsImage& image) {
    constexpr std::uint64_t kMostPlanes = 12;  // that have names
    std::vector<std::size_t> axes;
    for (std::size_t i = 0; i < image.axes.size(); ++i)
        if (image.axes[i].size > 1) axes.push_back(i);
    if (axes.empty()) return;
    const auto stokes = std::ranges::find_if(axes, [&](std::size_t i) {
        return quantityOf(image.axes[i]) == kStokes && image.axes[i].size <= kMostPlanes;
    });
    if (stokes == axes.end() || axes.size() == 1) return add(image, axes, std::nullopt);
    AlongAxis plane{*stokes, 0};
    axes.erase(stokes);
    for (; plane.at < image.axes[plane.axis].size; ++plane.at) add(image, axes, plane);
}

// What CFITSIO calls images that it compresses is no name.
std::string FitsReader::nameOf(const FitsImage& image, std::optional<AlongAxis> plane) const {
    const bool named = !image.name.empty() && image.name != "COMPRESSED_IMAGE";
    const bool isFirst = std::ranges::all_of(
        placed_, [&](const Placed& other) { return other.image.hdu == image.hdu; });
    std::string name = named     ? image.name
                       : isFirst ? file_.path().stem().string()
                                 : fmt::format("HDU {}", image.hdu);
    if (plane) {
        const double value = coordinatesOf(image.axes[plane->axis])[plane->at];
        // Where nothing has a name, one that other files of a series have too.
        const bool isAlone = !named && isFirst;
        name = fmt::format("{}{}={}", isAlone ? "" : name + ":", kStokes, stokesName(value));
    }
    if (std::ranges::find(variables_, name, &Variable::name) != variables_.end())
        name += fmt::format(" (HDU {})", image.hdu);
    return name;
}

void FitsReader::add(const FitsImage& image, const std::vector<std::size_t>& longer,
                     std::optional<AlongAxis> plane) {
    std::vector<std::size_t> axes = longer;
    Variable variable;
    const auto time = timeOf(image, axes, variable.notes);
    std::erase_if(axes, [&](std::size_t i) { return i == time; });
    if (axes.size() > 3)
        file_.fail(fmt::format("HDU {}", image.hdu),
                   fmt::format("expected three axes of space and one of time at most, found {}",
                               axes.size() + (time ? 1 : 0)));
    expectSizes(image, time, plane);

    static constexpr std::array kLetters{"x", "y", "z"};
    std::array<Axis, 3> space;
    for (std::size_t a = 0; a < 3; ++a)
        space[a] = a < axes.size() ? spaceAxis(image.axes[axes[a]], kLetters[a], variable.notes)
                                   : Axis{kLetters[a], "index", {0.0}, false};
    if (image.turned)
        variable.notes.push_back(
            std::ranges::any_of(image.axes, isCelestial)
                ? "drawn along its pixels: the axes of the sky are turned to them"
                : "drawn along its pixels, which coordinates count: the axes of "
                  "the file are turned to them");
    variable.name = nameOf(image, plane);
    variable.nameless = variables_.empty() && !plane && variable.name != image.name;
    variable.units = image.unit;
    variable.type = image.type;
    variable.storedAs = image.storedAs;
    if (image.blank) variable.missing = fmt::format("BLANK {}", image.blank->stored);
    variable.grid = std::make_shared<const Grid>(std::move(space));
    StoredTimes times;
    if (time) {
        const FitsAxis& axis = image.axes[*time];
        times.single = false;
        const std::vector<double> at = coordinatesOf(axis);
        times.counted = !axis.step || *axis.step == 0 || !isWorkedOut(axis) ||
                        !std::ranges::all_of(at, [](double t) { return std::isfinite(t); });
        times.values.clear();
        for (std::uint64_t i = 0; i < axis.size; ++i)
            times.values.emplace_back(times.counted ? static_cast<double>(i) : at[i]);
        if (!times.counted) {
            times.name = axis.type.empty() ? "time" : quantityOf(axis);
            times.units = unitOf(axis);
        }
    }
    variable.time = std::make_shared<const TimeAxis>(timeAxisOf(times, variable.notes));
    variables_.push_back(std::move(variable));
    placed_.push_back({image, time, plane});
}

Field FitsReader::read(std::size_t variable, std::size_t step) {
    const FitsImage& image = placed_[variable].image;
    const auto& time = placed_[variable].time;
    const auto& plane = placed_[variable].plane;
    std::vector<std::uint64_t> first(image.axes.size(), 0), last;
    for (const FitsAxis& axis : image.axes) last.push_back(axis.size - 1);
    if (time) first[*time] = last[*time] = step;
    if (plane) first[plane->axis] = last[plane->axis] = plane->at;
    Field field;
    field.grid = variables_[variable].grid;
    field.values = file_.read(image, first, last);
    if (!image.blank) return field;
    std::visit(
        [&](const auto& values) {
            std::vector<bool> missing(values.size());
            bool any = false;
            for (std::size_t i = 0; i < values.size(); ++i)
                if (static_cast<std::uint64_t>(values[i]) == image.blank->value)
                    missing[i] = any = true;
            if (any) field.missing = std::move(missing);
        },
        field.values);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openFits(std::span<const std::filesystem::path> paths) {
    return std::make_unique<FitsReader>(paths[0]);
}

}  // namespace timeseries

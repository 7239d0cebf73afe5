// A file (or several that make one series) opened for reading: what it holds, and one step at a
// time.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/step_grids.h"

namespace timeseries {

class StepFile;  // timeseries/index/step_file.h

// A file that cannot be used. what() is one sentence: the file, the place in it, what was expected.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct TimePoint {
    double value = 0;  // in TimeAxis::units, exactly as stored (integers beyond 2^53 are rounded)
    std::string date;  // "2000-01-04 12:00:00" in the axis's calendar; "" for plain numbers
};

struct TimeAxis {
    std::string name;      // "time"; "step" when steps are counted
    std::string units;     // "s", "hours since 0000-01-01"; "" for none
    std::string calendar;  // CF calendar of dates; "" for plain numbers
    std::vector<TimePoint>
        points;            // [steps]; of openReader() ascending, where a note does not say why not
    bool counted = false;  // the file has no time: steps are counted, points[i].value is i
};

// What a file calls the class that a value stands for (CF 1.11, section 3.5).
struct ClassName {
    double value;
    std::string name;
    friend bool operator==(const ClassName&, const ClassName&) = default;
};

struct Variable {
    std::string name, longName, units;
    bool nameless = false;    // the file's only array, called as the file is for want of a name
    ValueType type{};         // what selection compares: the unpacked type
    std::string storedAs;     // how the file holds it: "int16 packed, scale 0.001, offset 15"
    std::string missing;      // how missing values are told: "_FillValue -1e+34"; "" for none
    bool categories = false;  // as Field::categories
    std::vector<ClassName> classes{};  // of categories that the file names
    std::shared_ptr<const Grid> grid;
    std::shared_ptr<const TimeAxis> time;
    std::vector<std::string>
        notes;  // what a user must know: "drawn in index space: lon(y,x) is 2-D"
};

// A variable that cannot be read for what its file says of it.
struct DamagedVariable {
    std::string name;
    std::string why;  // a FileError's sentence
};

// Consecutive steps.
struct StepSpan {
    std::size_t first, count;
};

// All that a step's values come from, whatever other files were opened beside these.
struct StepSources {
    std::vector<std::filesystem::path> files;
    std::size_t step = 0;  // which of those that the files have
};

// The points of a grid whose places along one of its indices are [first, first + count).
struct Slab {
    std::size_t axis = 2;
    std::uint64_t first = 0, count = 0;
};

// Not thread-safe: one thread at a time. Different Readers may be used on different threads.
class Reader {
 public:
    virtual ~Reader() = default;
    virtual std::string format() const = 0;  // "NetCDF-4"
    virtual std::span<const std::filesystem::path> files() const = 0;
    virtual std::span<const Variable> variables() const = 0;  // at least one
    // Those that are no part of variables().
    virtual std::span<const DamagedVariable> damaged() const { return {}; }
    // REQUIRES: variable < variables().size(), step < its time's points. Throws FileError.
    virtual Field read(std::size_t variable, std::size_t step) = 0;
    // A part of what read() gives, in the order of the grid, without a grid; in the memory of one
    // that was read before where there is a way to. It takes the memory of all values where the
    // format, or how they lie in the file, leaves no choice.
    virtual void readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into);
    Field slab(std::size_t variable, std::size_t step, const Slab& slab) {
        Field field;
        readSlab(variable, step, slab, field);
        return field;
    }
    // Whether all slabs along the last index, one after another, are no more work than read().
    virtual bool readsPlanes(std::size_t, std::size_t) { return false; }
    // The step as its file has it, where that is a sorted one; null where it is not.
    virtual std::shared_ptr<const StepFile> sorted(std::size_t, std::size_t) { return nullptr; }
    // What the values of a step come from; no files where that is not known, or the step's places
    // are not those of variables(). REQUIRES: as read(). Throws FileError.
    virtual StepSources sources(std::size_t, std::size_t) { return {}; }
    // How the grids of the steps are to that of variables(). Where headers do not tell it, the grid
    // of one more step, the last, is read; no values are. REQUIRES: variable < variables().size().
    // Throws FileError.
    virtual StepGrids stepGrids(std::size_t) { return {}; }
    // Throws FileError where files()[file] was not opened with the series, and is now found not to
    // fit it. REQUIRES: file < files().size().
    virtual void expectToFit(std::size_t) {}
    // What its files say is of this moment or later; openReader() sets it.
    std::chrono::system_clock::time_point openedAt{};
    // Which steps of a variable files()[file] holds; none where the reader does not know. A reader
    // that joins files tells it.
    virtual std::optional<StepSpan> stepsOf(std::size_t variable, std::size_t file) const {
        if (files().size() != 1 || file != 0) return std::nullopt;
        return StepSpan{0, variables()[variable].time->points.size()};
    }
};

// Opens by content. Several paths are one series. Throws FileError.
std::unique_ptr<Reader> openReader(std::span<const std::filesystem::path> paths);

// Whether the file begins as one of the formats does that are read; not what has no values of its
// own (PLOT3D's places).
bool isReadable(const std::filesystem::path& path);
// "a NIfTI file": what a file is that begins otherwise; "" where that is not known.
std::string formatNotRead(const std::filesystem::path& path);

}  // namespace timeseries

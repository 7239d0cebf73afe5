#include "timeseries/readers/step_reader.h"

#include <fmt/format.h>

#include "timeseries/readers/cf/cf_time.h"
#include "timeseries/readers/step_about.h"

namespace timeseries {
namespace {

class StepReader final : public Reader {
 public:
    explicit StepReader(const std::filesystem::path& path) : path_(path) {
        try {
            auto bytes = openBytes(path);
            if (!bytes) throw FileError(fmt::format("{}: no such file", path.string()));
            file_ = std::make_shared<const StepFile>(std::move(bytes));
            variable_ = variableOf(*file_);
        } catch (const StepFileError& error) {
            throw FileError(error.what());
        }
    }

    std::string format() const override { return "isochron step"; }
    std::span<const std::filesystem::path> files() const override { return {&path_, 1}; }
    std::span<const Variable> variables() const override { return {&variable_, 1}; }
    std::shared_ptr<const StepFile> sorted(std::size_t, std::size_t) override { return file_; }
    Field read(std::size_t, std::size_t) override try {
        return SortedStep::ofFile(file_, variable_.grid, false).field();
    } catch (const StepFileError& error) {
        throw FileError(error.what());
    }

 private:
    const std::filesystem::path path_;
    std::shared_ptr<const StepFile> file_;
    Variable variable_;
};

Axis axisOf(const StepFile& file, const StepAbout::Place& place, std::size_t points) {
    const auto fail = [&](const std::string& what) {
        throw FileError(fmt::format("{}: axis '{}': {}", file.name(), place.name, what));
    };
    Axis axis{place.name, place.units, place.coordinates};
    if (points > kMostAlong)
        fail(fmt::format("expected at most {} points, found {}", kMostAlong, points));
    if (place.coordinates.empty()) {
        axis.coordinates = place.evenly(points);
    } else if (place.coordinates.size() != points) {
        fail(fmt::format("expected {} coordinates, found {}", points, place.coordinates.size()));
    }
    if (const std::string flaw = flawOf(axis.coordinates); !flaw.empty()) fail(flaw);
    return axis;
}

}  // namespace

Variable variableOf(const StepFile& file) {
    const auto about = stepAboutOf(file);
    if (!about)
        throw FileError(fmt::format(
            "{}: expected a step that stands alone, found the index of a step of another "
            "file: open that one, and the index is found",
            file.name()));
    Variable variable;
    variable.name = about->variable;
    variable.units = about->units;
    variable.type = file.type();
    variable.storedAs = typeName(file.type());
    variable.grid = std::make_shared<const Grid>(std::array{
        axisOf(file, about->axes[0], file.size()[0]), axisOf(file, about->axes[1], file.size()[1]),
        axisOf(file, about->axes[2], file.size()[2])});
    variable.time = std::make_shared<const TimeAxis>(timeAxisOf(
        {"time", about->timeUnits, "", {Number(about->time)}, false, true}, variable.notes));
    return variable;
}

std::unique_ptr<Reader> openStep(std::span<const std::filesystem::path> paths) {
    return std::make_unique<StepReader>(paths[0]);
}

}  // namespace timeseries

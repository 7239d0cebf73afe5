#include "timeseries/readers/netcdf/vtkhdf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "timeseries/grid/with_type.h"
#include "timeseries/grid/without_cells.h"
#include "timeseries/readers/components.h"
#include "timeseries/readers/image_grid.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/vtkhdf_arrays.h"

namespace timeseries {
namespace {

// An array at points or cells, [step][z][y][x][component], or a number of each of its rows.
struct ImageArray {
    const NcVariable* array;
    bool atPoints;
    Component component;
};

class VtkHdfImageReader final : public Reader {
 public:
    explicit VtkHdfImageReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()}, opened_(std::move(opened)) {
        readPlaces();
        readTimes();
        for (const bool atPoints : {false, true})
            placed_[atPoints] = placedImage(image_, !atPoints);
        for (const bool atPoints : {true, false}) addArrays(atPoints);
        tellApart(variables_);
        if (variables_.empty() && !damaged_.empty()) throw FileError(damaged_.front().why);
        if (variables_.empty())
            file_.fail("VTKHDF", "expected an array of numbers at points or cells, found none");
    }

    std::string format() const override { return "VTKHDF image"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepSources sources(std::size_t, std::size_t step) override { return {file_.sources(), step}; }

 private:
    std::vector<double> said(const char* attribute, std::size_t count) const;
    void readPlaces();
    void readTimes();
    void addArrays(bool atPoints);
    std::string flawOf(const NcVariable& array, bool atPoints) const;
    std::uint64_t length(bool atPoints, int axis) const {
        const std::uint64_t points = image_.points[static_cast<std::size_t>(axis)];
        return atPoints ? points : std::max<std::uint64_t>(points, 2) - 1;
    }
    const NcVariable* ghostsAt(bool atPoints) const;
    std::uint64_t rowOf(const NcVariable& array, bool atPoints, std::size_t step) const;
    Values rowsAt(const NcVariable& array, bool atPoints, std::size_t step) const;

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    ImagePlaces image_;
    bool inTime_ = false;
    std::shared_ptr<const TimeAxis> time_;
    std::array<PlacedImage, 2> placed_;  // of cells, of points
    std::vector<Variable> variables_;
    std::vector<ImageArray> sources_;
    std::vector<DamagedVariable> damaged_;
};

std::vector<double> VtkHdfImageReader::said(const char* attribute, std::size_t count) const {
    const auto numbers = file_.header().findGroup("VTKHDF")->numbers(attribute);
    const bool areFinite =
        std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
    if (numbers.size() != count || !areFinite)
        file_.fail("VTKHDF", fmt::format("expected {} numbers of {}, found {}", count, attribute,
                                         areFinite ? numbers.size() : 0));
    return numbers;
}

void VtkHdfImageReader::readPlaces() {
    constexpr double kMostIndex = 1 << 30;  // VTK's are of 32 bits
    const auto extent = said("WholeExtent", 6), origin = said("Origin", 3),
               spacing = said("Spacing", 3);
    double points = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const double lo = extent[2 * i], hi = extent[2 * i + 1];
        if (!(lo <= hi && lo >= -kMostIndex && hi <= kMostIndex) || lo != std::floor(lo) ||
            hi != std::floor(hi) || hi - lo >= static_cast<double>(kMaxAxis))
            file_.fail("VTKHDF",
                       fmt::format("expected a WholeExtent of 1 to 2^24 points along each "
                                   "axis, found {} to {}",
                                   lo, hi));
        points *= hi - lo + 1;
        image_.first[i] = static_cast<std::int64_t>(lo);
        image_.points[i] = static_cast<std::uint64_t>(hi - lo) + 1;
        image_.origin[i] = origin[i];
        image_.spacing[i] = spacing[i];
    }
    if (points > static_cast<double>(kMaxPoints))
        file_.fail("VTKHDF", fmt::format("expected at most 2^32 points, found {:.0f}", points));
    if (!file_.header().findGroup("VTKHDF")->find("Direction")) return;
    const auto direction = said("Direction", 9);
    std::ranges::copy(direction, image_.direction.begin());
}

void VtkHdfImageReader::readTimes() {
    const NcHeader& header = file_.header();
    const NcVariable* const steps = header.find("VTKHDF/Steps/Values", "");
    const NcVariable* const one = header.find("VTKHDF/FieldData/TimeValue", "");
    TimeAxis axis{"step", "", "", {{0, ""}}, true};
    const auto take = [&](const NcVariable& times) {
        axis = {"time", "", "", {}, false};
        if (!times.type || times.dimensions.size() != 1 ||
            header.dimension(times, 0).length > kMaxSteps)
            file_.fail("variable '" + times.name + "'", "expected a number of each step");
        for (const Number& number : file_.numbers(times)) {
            axis.points.push_back({toDouble(number), ""});
            if (!std::isfinite(axis.points.back().value))
                file_.fail("variable '" + times.name + "'", "expected times that are finite");
        }
        if (axis.points.empty()) file_.fail("VTKHDF/Steps", "expected a step, found none");
    };
    inTime_ = steps != nullptr;
    if (steps)
        take(*steps);
    else if (one && one->type && one->dimensions.size() == 1 &&
             header.dimension(*one, 0).length == 1)
        take(*one);
    time_ = std::make_shared<const TimeAxis>(std::move(axis));
}

// Why an array is not of this image, as a sentence's end.
std::string VtkHdfImageReader::flawOf(const NcVariable& array, bool atPoints) const {
    const std::size_t before = inTime_ ? 1 : 0, rank = array.dimensions.size();
    std::string found;
    for (std::size_t i = 0; i < rank; ++i)
        found += fmt::format("{}{}", i > 0 ? ", " : "", file_.header().dimension(array, i).length);
    bool fits = rank == before + 3 || rank == before + 4;
    for (int axis = 0; fits && axis < 3; ++axis)
        fits =
            file_.header().dimension(array, before + 2 - static_cast<std::size_t>(axis)).length ==
            length(atPoints, axis);
    if (!fits)
        return fmt::format("expected {}{}, {}, {} numbers, found {}", inTime_ ? "steps of " : "",
                           length(atPoints, 2), length(atPoints, 1), length(atPoints, 0), found);
    const std::uint64_t components =
        rank == before + 4 ? file_.header().dimension(array, rank - 1).length : 1;
    const double points = static_cast<double>(placed_[atPoints].grid->count());
    if (points * static_cast<double>(components) > static_cast<double>(kMaxPoints) * 16)
        return fmt::format("expected fewer numbers a step, found {} a point", components);
    return file_.tooLarge(array, placed_[atPoints].grid->count() * components);
}

void VtkHdfImageReader::addArrays(bool atPoints) {
    const std::string group = vtkHdfGroup(atPoints);
    for (const NcVariable& array : file_.header().variables) {
        if (!array.name.starts_with(group) || !array.type) continue;
        const std::string own = array.name.substr(group.size());
        if (own.find('/') != own.npos) continue;
        if (const std::string flaw = flawOf(array, atPoints); !flaw.empty()) {
            damaged_.push_back({own, file_.sentence("variable '" + array.name + "'", flaw)});
            continue;
        }
        if (own == kVtkHdfGhosts) continue;
        const std::size_t rank = array.dimensions.size();
        const bool isRow = rank == (inTime_ ? 5 : 4);
        const std::uint64_t count = isRow ? file_.header().dimension(array, rank - 1).length : 1;
        for (const ComponentVariable& each :
             componentsOf(vtkHdfName(file_.header(), own, atPoints), *array.type, count)) {
            Variable variable;
            variable.name = each.name;
            variable.type = each.type;
            variable.storedAs = each.storedAs + (atPoints ? "" : ", at cells");
            if (ghostsAt(atPoints) || ghostsAt(false)) variable.missing = kVtkHdfMissing;
            variable.grid = placed_[atPoints].grid;
            variable.time = time_;
            variable.notes = placed_[atPoints].notes;
            variables_.push_back(std::move(variable));
            sources_.push_back({&array, atPoints, each.component});
        }
    }
}

const NcVariable* VtkHdfImageReader::ghostsAt(bool atPoints) const {
    const NcVariable* const found = vtkHdfGhosts(file_.header(), atPoints);
    const std::size_t rank = inTime_ ? 4 : 3;
    const bool fits = found && found->dimensions.size() == rank && flawOf(*found, atPoints).empty();
    return fits ? found : nullptr;
}

// Where the step stands along the array's first dimension.
std::uint64_t VtkHdfImageReader::rowOf(const NcVariable& array, bool atPoints,
                                       std::size_t step) const {
    const std::string offsets =
        fmt::format("VTKHDF/Steps/{}DataOffsets/{}", atPoints ? "Point" : "Cell", array.baseName());
    const std::uint64_t rows = file_.header().dimension(array, 0).length;
    double row = static_cast<double>(step);
    if (const NcVariable* const told = file_.header().find(offsets, ""); told && told->type) {
        const auto all = file_.numbers(*told);
        row = step < all.size() ? toDouble(all[step]) : -1;
    }
    if (!(row >= 0 && row < static_cast<double>(rows)) || row != std::floor(row))
        file_.fail("variable '" + array.name + "'",
                   fmt::format("expected step {} among its {}, found it at {}", step, rows, row));
    return static_cast<std::uint64_t>(row);
}

// As the file has them, x fastest.
Values VtkHdfImageReader::rowsAt(const NcVariable& array, bool atPoints, std::size_t step) const {
    std::vector<std::size_t> start(array.dimensions.size(), 0), count;
    std::size_t total = 1;
    for (std::size_t i = 0; i < start.size(); ++i)
        count.push_back(file_.header().dimension(array, i).length);
    if (inTime_) {
        start[0] = rowOf(array, atPoints, step);
        count[0] = 1;
    }
    for (const std::size_t each : count) total *= each;
    return withType(*array.type, [&]<typename T>(T) -> Values {
        std::vector<T> values(total);
        file_.read(array, start, count, values.data());
        return values;
    });
}

Field VtkHdfImageReader::read(std::size_t variable, std::size_t step) {
    const ImageArray& source = sources_[variable];
    const StridedLayout& layout = placed_[source.atPoints].layout;
    // In the order of the grid, whose axes may be the image's in another.
    const auto inOrder = [&](const Values& stored) {
        return std::visit([&](const auto& values) -> Values { return arranged(values, layout); },
                          stored);
    };
    Field field{.grid = variables_[variable].grid,
                .values = inOrder(
                    componentOf(rowsAt(*source.array, source.atPoints, step), source.component)),
                .missing = {}};
    if (const NcVariable* const ghosts = ghostsAt(source.atPoints))
        field.missing =
            vtkHdfMissing(inOrder(rowsAt(*ghosts, source.atPoints, step)), source.atPoints);
    const NcVariable* const cells = source.atPoints ? ghostsAt(false) : nullptr;
    if (!cells) return field;
    const auto ofGhosts =
        pointsOfGhosts(vtkHdfMissing(rowsAt(*cells, false, step), false), image_.points);
    if (!ofGhosts.empty()) leaveOut(arranged(ofGhosts, layout), field.missing);
    return field;
}

}  // namespace

bool isVtkHdfImage(const NcHeader& header) {
    const NcGroup* const group = header.findGroup("VTKHDF");
    return group && group->text("Type") == "ImageData";
}

std::unique_ptr<Reader> openVtkHdfImage(std::unique_ptr<NetcdfFile> file) {
    return std::make_unique<VtkHdfImageReader>(std::move(file));
}

}  // namespace timeseries

#include "timeseries/readers/netcdf/vtkhdf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "timeseries/grid/without_cells.h"
#include "timeseries/readers/components.h"
#include "timeseries/readers/netcdf/netcdf_rows.h"
#include "timeseries/readers/netcdf/vtkhdf_arrays.h"
#include "timeseries/readers/netcdf/vtkhdf_image.h"
#include "timeseries/readers/netcdf/vtkhdf_mesh.h"
#include "timeseries/readers/other_formats.h"

namespace timeseries {
namespace {

// An array at points or cells, or a number of each of its rows.
struct ArrayOf {
    const NcVariable* array;
    std::string name;  // in the file
    bool atPoints;
    Component component;
};

class VtkHdfReader final : public Reader {
 public:
    explicit VtkHdfReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()}, opened_(std::move(opened)), layout_(file_) {
        addTime();
        for (const bool atPoints : {true, false}) addArrays(atPoints);
        tellApart(variables_);
        if (variables_.empty())
            file_.fail("VTKHDF", "expected an array of numbers at points or cells, found none");
    }

    std::string format() const override {
        return layout_.isPolygons() ? "VTKHDF polygons" : "VTKHDF unstructured grid";
    }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override;
    StepSources sources(std::size_t, std::size_t step) override {
        const bool isThere = layout_.steps()[step] == layout_.steps()[0];
        if (!isThere || vtkHdfGhosts(file_.header(), false)) return {};
        return {file_.sources(), step};
    }

 private:
    void addTime();
    void addArrays(bool atPoints);
    void add(ArrayOf source, const ComponentVariable& component);
    void open(std::size_t step);
    std::shared_ptr<const Grid> gridAt(std::size_t step, bool atPoints);
    std::vector<bool> ghostsOf(std::size_t step, bool atPoints, std::uint64_t count) const;

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    VtkHdfLayout layout_;
    std::shared_ptr<const TimeAxis> time_;
    // Of the step that is open.
    std::optional<VtkHdfStep> open_;
    std::uint64_t ghostsAt_ = 0;  // where its cells' flags begin
    UnstructuredGrid cells_;
    std::optional<UnstructuredShapes> shapes_;
    std::array<std::shared_ptr<const Grid>, 2> grids_;  // at cells, at points
    std::vector<Variable> variables_;
    std::vector<ArrayOf> sources_;
};

void VtkHdfReader::addTime() {
    auto time = std::make_shared<TimeAxis>();
    const auto& times = layout_.times();
    time->counted = times.empty();
    time->name = times.empty() ? "step" : "time";
    for (std::size_t i = 0; i < layout_.steps().size(); ++i)
        time->points.push_back({times.empty() ? static_cast<double>(i) : times[i], ""});
    time_ = std::move(time);
}

void VtkHdfReader::open(std::size_t step) {
    const VtkHdfStep& wanted = layout_.steps()[step];
    const std::uint64_t ghostsAt =
        vtkHdfGhosts(file_.header(), false) ? layout_.firstValue(step, false, kVtkHdfGhosts) : 0;
    if (open_ == wanted && ghostsAt == ghostsAt_) return;
    open_.reset();
    shapes_.reset();
    grids_ = {};
    cells_ = layout_.gridOf(wanted);
    open_ = wanted;
    ghostsAt_ = ghostsAt;
}

std::vector<bool> VtkHdfReader::ghostsOf(std::size_t step, bool atPoints,
                                         std::uint64_t count) const {
    const NcVariable* const ghosts = vtkHdfGhosts(file_.header(), atPoints);
    if (!ghosts) return {};
    const std::uint64_t first = layout_.firstValue(step, atPoints, kVtkHdfGhosts);
    return vtkHdfMissing(rowsOf(file_, *ghosts, first, count, 1), atPoints);
}

std::shared_ptr<const Grid> VtkHdfReader::gridAt(std::size_t step, bool atPoints) {
    auto& grid = grids_[atPoints ? 1 : 0];
    if (grid) return grid;
    if (!shapes_) shapes_.emplace(cells_);
    try {
        const auto mesh = std::make_shared<const Mesh>(
            atPoints
                ? meshOfPointsWithout(ghostsOf(step, false, cells_.types.size()), cells_, *shapes_)
                : meshOfCells(cells_, *shapes_));
        return grid = std::make_shared<const Grid>(spaceAxes(), mesh);
    } catch (const std::invalid_argument& flaw) {
        file_.fail("VTKHDF",
                   fmt::format("expected cells that take space, found that {}", flaw.what()));
    }
}

void VtkHdfReader::add(ArrayOf source, const ComponentVariable& component) {
    Variable variable;
    variable.name = component.name;
    variable.type = component.type;
    variable.storedAs = component.storedAs + (source.atPoints ? "" : ", at cells");
    // Points of ghost cells alone are, too.
    if (vtkHdfGhosts(file_.header(), false) || vtkHdfGhosts(file_.header(), source.atPoints))
        variable.missing = kVtkHdfMissing;
    open(0);
    variable.grid = gridAt(0, source.atPoints);
    variable.time = time_;
    variable.notes = notesOf(cells_);
    for (std::string& note : notesOf(*variable.grid->mesh()))
        variable.notes.push_back(std::move(note));
    variables_.push_back(std::move(variable));
    sources_.push_back(std::move(source));
}

void VtkHdfReader::addArrays(bool atPoints) {
    const std::string group = vtkHdfGroup(atPoints);
    for (const NcVariable& array : file_.header().variables) {
        if (!array.name.starts_with(group) || !array.type) continue;
        const std::string own = array.name.substr(group.size());
        const std::size_t rank = array.dimensions.size();
        if (own == kVtkHdfGhosts || own.find('/') != own.npos || rank < 1 || rank > 2) continue;
        const std::uint64_t count = rank == 2 ? file_.header().dimension(array, 1).length : 1;
        const std::string name = vtkHdfName(file_.header(), own, atPoints);
        for (const ComponentVariable& each : componentsOf(name, *array.type, count))
            add({&array, own, atPoints, each.component}, each);
    }
}

// Lists of cells that several steps share are told by where they begin.
StepGrids VtkHdfReader::stepGrids(std::size_t variable) {
    const VtkHdfStep& first = layout_.steps()[0];
    StepGrids grids{.least = std::numeric_limits<std::uint64_t>::max()};
    for (const VtkHdfStep& step : layout_.steps()) {
        const bool joinedAlike = step.cells == first.cells && step.ids == first.ids &&
                                 step.faces == first.faces && step.parts == first.parts &&
                                 layout_.pointsOf(step) == layout_.pointsOf(first) &&
                                 layout_.cellsOf(step) == layout_.cellsOf(first);
        const std::uint64_t points =
            sources_[variable].atPoints ? layout_.pointsOf(step) : layout_.cellsOf(step);
        grids.least = std::min(grids.least, points);
        grids.most = std::max(grids.most, points);
        if (!joinedAlike)
            grids.are = StepGrids::Are::Own;
        else if (step.points != first.points)
            grids.are = std::max(grids.are, StepGrids::Are::Moved);
    }
    return grids;
}

Field VtkHdfReader::read(std::size_t variable, std::size_t step) {
    open(step);
    const ArrayOf& source = sources_[variable];
    Field field;
    field.grid = gridOfStep(variables_[variable].grid, gridAt(step, source.atPoints));
    if (!field.grid) file_.fail("VTKHDF", "expected the steps of one series");
    const std::uint64_t count = field.grid->count();
    field.values = componentOf(
        rowsOf(file_, *source.array, layout_.firstValue(step, source.atPoints, source.name), count,
               source.component.of),
        source.component);
    field.missing = ghostsOf(step, source.atPoints, count);
    if (source.atPoints)
        leaveOut(pointsOfGhosts(ghostsOf(step, false, cells_.types.size()), cells_), field.missing);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openVtkHdf(std::unique_ptr<NetcdfFile> file) {
    if (isVtkHdfImage(file->header())) return openVtkHdfImage(std::move(file));
    if (!file->header().find("VTKHDF/Points", ""))
        throw FileError(notReadSentence(
            file->path(),
            "a VTKHDF file of neither an unstructured grid nor polygons nor an image"));
    return std::make_unique<VtkHdfReader>(std::move(file));
}

}  // namespace timeseries

#include "timeseries/readers/vtk/vtk_reader.h"
#include "timeseries/readers/components.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/sequence_reader.h"
#include "timeseries/readers/vtk/vtk_file.h"
#include "timeseries/readers/vtk/vtk_glance.h"
#include "timeseries/readers/vtk/vtk_grid.h"
#include "timeseries/readers/vtk/vtk_parts.h"
#include "timeseries/readers/vtk/vtk_step_grids.h"
#include "timeseries/readers/vtk/vtk_variables.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

// One step, of which all is known but values.
struct OpenedStep {
    VtkContents contents;
    std::array<std::optional<VtkGrid>, 2> grids;  // by VtkPlace, where there is an array
    const VtkHeader& header() const { return contents.whole; }
};

OpenedStep frameOf(VtkContents contents) {
    OpenedStep frame{std::move(contents), {}};
    VtkHeader& header = frame.contents.whole;
    std::optional<UnstructuredShapes> shapes;
    if (isUnstructured(header.kind)) shapes = vtkShapesOf(header);
    for (const VtkArray& array : header.arrays) {
        auto& grid = frame.grids[static_cast<std::size_t>(array.place)];
        if (!grid)
            grid =
                shapes ? vtkGridOf(header, array.place, *shapes) : vtkGridOf(header, array.place);
    }
    header.places = {};
    header.unstructured = {};
    return frame;
}

// Points of ghost cells alone are missing, too.
bool hasGhosts(const VtkHeader& header, VtkPlace place) {
    const auto& [atPoints, atCells] = header.ghosts;
    return atCells || (place == VtkPlace::Points && atPoints);
}

class VtkReader final : public Reader {
 public:
    // `first` is of the first member.
    VtkReader(const Path& path, std::vector<VtkMember> members, OpenedStep first, bool collection)
        : files_{path}, members_(std::move(members)), frame_(std::move(first)) {
        const VtkHeader& header = frame_.header();
        if (header.arrays.empty() && !header.differing.empty())
            throw FileError(header.differing.front().why);
        if (header.arrays.empty()) {
            std::string why;
            for (const std::string& each : header.passedOver) why += "; " + each;
            failVtk(header.path, "", "expected an array of numbers, found none" + why);
        }
        damaged_ = header.differing;
        format_ = header.format;
        if (collection) format_ = "VTK collection of " + format_.substr(4);
        addTime();
        for (VtkVariable& each : vtkVariablesOf(header.path, header.arrays)) add(std::move(each));
        tellApart(variables_);
    }

    std::string format() const override { return format_; }
    std::span<const Path> files() const override { return files_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepSources sources(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override {
        return vtkStepGrids(members_, *variables_[variable].grid);
    }

 private:
    void addTime();
    void add(VtkVariable of);
    void open(std::size_t step);

    std::vector<Path> files_;
    std::string format_;
    std::vector<VtkMember> members_;  // [step]
    OpenedStep frame_;                // of openStep_
    std::size_t openStep_ = 0;
    std::shared_ptr<const TimeAxis> time_;
    std::vector<std::string> notes_;  // of all variables
    std::vector<Variable> variables_;
    std::vector<DamagedVariable> damaged_;
    std::vector<VtkVariable> sources_;  // [variable]
};

void VtkReader::addTime() {
    TimeAxis axis = vtkTimeAxisOf(members_.size() == 1 ? frame_.header().time : std::nullopt);
    if (members_[0].time) axis.name = "time";
    if (members_[0].time || members_.size() > 1) {
        axis.counted = !members_[0].time;
        axis.points.clear();
        for (std::size_t i = 0; i < members_.size(); ++i)
            axis.points.push_back({members_[i].time.value_or(static_cast<double>(i)), ""});
    }
    time_ = std::make_shared<const TimeAxis>(std::move(axis));

    std::vector<std::string> absent;
    std::size_t files = 0;
    const auto look = [&](const Path& path) {
        ++files;
        if (!flawOfFile(path).empty()) absent.push_back(path.filename().string());
    };
    for (const VtkMember& member : members_) {
        look(member.path);
        for (const Path& part : member.beside) look(part);
    }
    if (!absent.empty())
        notes_.push_back(fmt::format("{} of {} files are missing, the first {}", absent.size(),
                                     files, absent[0]));
}

void VtkReader::add(VtkVariable of) {
    const std::size_t place = static_cast<std::size_t>(of.array.place);
    Variable variable;
    variable.name = of.name;
    variable.type = of.type;
    variable.storedAs = of.storedAs;
    if (hasGhosts(frame_.header(), of.array.place))
        variable.missing = "ghost and blanked, by vtkGhostType";
    if (!of.array.isEverywhere)
        variable.missing += std::string(variable.missing.empty() ? "" : "; ") + "blocks without it";
    variable.grid = frame_.grids[place]->grid;
    variable.time = time_;
    variable.notes = frame_.grids[place]->notes;
    variable.notes.insert(variable.notes.end(), notes_.begin(), notes_.end());
    variables_.push_back(std::move(variable));
    sources_.push_back(std::move(of));
}

void VtkReader::open(std::size_t step) {
    if (step == openStep_) return;
    frame_ = frameOf(vtkContentsOf(members_[step]));
    openStep_ = step;
}

StepSources VtkReader::sources(std::size_t variable, std::size_t step) {
    open(step);
    const auto& own = frame_.grids[static_cast<std::size_t>(sources_[variable].array.place)];
    const auto& grid = variables_[variable].grid;
    if (!own || gridOfStep(grid, own->grid) != grid) return {};
    const VtkMember& member = members_[step];
    StepSources sources{{member.path}};
    if (!member.beside.empty())  // also what holds nothing now
        sources.files.insert(sources.files.end(), member.beside.begin(), member.beside.end());
    else
        for (const VtkHeader& part : frame_.contents.parts) sources.files.push_back(part.path);
    return sources;
}

Field VtkReader::read(std::size_t variable, std::size_t step) {
    open(step);
    const VtkArray& array = sources_[variable].array;
    const VtkHeader& header = frame_.header();
    const auto found = std::ranges::find_if(header.arrays, [&](const VtkArray& other) {
        return other.name == array.name && other.place == array.place;
    });
    if (found == header.arrays.end() || found->type != array.type ||
        found->components != array.components)
        failVtk(header.path, fmt::format("'{}'", array.name),
                fmt::format("expected {} of {} components, as in {}", typeName(array.type),
                            array.components, members_[0].path.filename().string()));
    if (!found->notNumber.empty())
        failVtk(header.path, fmt::format("'{}'", array.name),
                fmt::format("expected finite numbers of type {}, found \"{}\"",
                            typeName(array.type), found->notNumber));
    const VtkGrid& grid = *frame_.grids[static_cast<std::size_t>(array.place)];
    Field field;
    field.grid = gridOfStep(variables_[variable].grid, grid.grid);
    if (!field.grid)
        failVtk(header.path, "", "expected the grid of " + members_[0].path.filename().string());
    readVtkArray(frame_.contents, array, sources_[variable].part, grid.layout, field);
    return field;
}

// A file, or a list of some.
std::unique_ptr<Reader> openOne(const Path& path) {
    expectFile(path);
    std::vector<VtkMember> members{{path, std::nullopt}};
    const auto alone = [&](VtkContents contents) {
        return std::make_unique<VtkReader>(path, std::move(members), frameOf(std::move(contents)),
                                           false);
    };
    if (isVtkSeries(path)) {
        members = readVtkSeries(path);
    } else if (isVtkLegacy(path)) {
        return alone(vtkContentsOf(path));
    } else {
        const XmlFile file = readXml(path);
        if (!isVtkCollection(file)) return alone(vtkContentsOf(file));
        members = readVtkCollection(file);
    }
    auto first = frameOf(vtkContentsOf(members[0]));
    return std::make_unique<VtkReader>(path, std::move(members), std::move(first), true);
}

}  // namespace

std::unique_ptr<Reader> openVtk(std::span<const Path> paths) {
    if (paths.size() == 1) return openOne(paths[0]);
    return openSequence(paths, openOne, vtkGlanceAt,
                        [](std::span<const Path> files, const Grid& first) {
                            std::vector<VtkMember> members;
                            for (const Path& file : files) members.push_back({file, std::nullopt});
                            return vtkStepGrids(members, first);
                        });
}

}  // namespace timeseries

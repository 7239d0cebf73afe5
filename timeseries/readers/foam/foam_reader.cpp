#include "timeseries/readers/foam/foam_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "timeseries/readers/components.h"
#include "timeseries/readers/foam/foam_case.h"
#include "timeseries/readers/foam/foam_field.h"
#include "timeseries/readers/foam/foam_mesh.h"

namespace timeseries {
namespace {

// A field, or a number of each of its values.
struct FoamSource {
    std::string field;
    FoamFieldHead head;
    Component component;
    std::vector<std::size_t> times;  // of the case, [step]
};

class FoamReader final : public Reader {
 public:
    explicit FoamReader(const std::filesystem::path& path) : paths_{path}, case_(foamCaseOf(path)) {
        if (case_.times.empty())
            throw FileError(
                fmt::format("{}: expected folders of times with fields of the case, not of its "
                            "regions, found none",
                            path.string()));
        for (const auto& [field, times] : case_.fields) addField(field, times);
        tellApart(variables_);
        if (variables_.empty())
            throw FileError(damaged_.empty()
                                ? fmt::format("{}: expected a field of cells or points, found none",
                                              path.string())
                                : damaged_.front().why);
        auto& notes = variables_.front().notes;
        notes.insert(notes.end(), case_.notes.begin(), case_.notes.end());
        if (!atFaces_.empty())
            notes.push_back(
                fmt::format("fields of faces are left out: {}", fmt::join(atFaces_, ", ")));
    }

    std::string format() const override { return "OpenFOAM case"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override;
    StepSources sources(std::size_t variable, std::size_t step) override;

 private:
    void addField(const std::string& field, const std::vector<std::size_t>& times);
    FoamFieldHead headOf(const std::string& field, const std::vector<std::size_t>& times) const;
    std::shared_ptr<const TimeAxis> timeOf(const std::vector<std::size_t>& times) const;
    void add(const FoamSource& source, const ComponentVariable& component);
    void open(std::size_t time);
    std::shared_ptr<const Grid> gridAt(bool atPoints);

    std::vector<std::filesystem::path> paths_;
    FoamCase case_;
    std::vector<Variable> variables_;
    std::vector<DamagedVariable> damaged_;
    std::vector<FoamSource> sources_;   // [variable]
    std::vector<std::string> atFaces_;  // fields
    // Of the mesh that is open.
    std::vector<FoamMeshFiles> open_;
    FoamMesh mesh_;
    std::optional<UnstructuredShapes> shapes_;
    std::array<std::shared_ptr<const Grid>, 2> grids_;  // at cells, at points
};

// What is written last a solver wrote; what is first is often text by hand, which says no type.
FoamFieldHead FoamReader::headOf(const std::string& field,
                                 const std::vector<std::size_t>& times) const {
    return foamFieldHeadOf(case_.filesOf(field, times.back())[0]);
}

void FoamReader::addField(const std::string& field, const std::vector<std::size_t>& times) {
    FoamSource source{field, {}, {}, times};
    try {
        source.head = headOf(field, times);
    } catch (const FileError& error) {
        damaged_.push_back({field, error.what()});
        return;
    }
    if (source.head.className.starts_with("surface")) atFaces_.push_back(field);
    for (const ComponentVariable& each :
         componentsOf(field, source.head.type, source.head.components)) {
        source.component = each.component;
        add(source, each);
    }
}

std::shared_ptr<const TimeAxis> FoamReader::timeOf(const std::vector<std::size_t>& times) const {
    for (std::size_t v = 0; v < variables_.size(); ++v)
        if (sources_[v].times == times) return variables_[v].time;
    TimeAxis axis;
    axis.name = "time";
    for (const std::size_t time : times) axis.points.push_back({case_.times[time].value, ""});
    return std::make_shared<const TimeAxis>(std::move(axis));
}

void FoamReader::add(const FoamSource& source, const ComponentVariable& component) {
    Variable variable;
    variable.name = component.name;
    variable.units = source.head.units;
    variable.type = component.type;
    variable.storedAs = component.storedAs + (source.head.atPoints ? "" : ", at cells");
    open(source.times.front());
    variable.grid = gridAt(source.head.atPoints);
    variable.time = timeOf(source.times);
    variable.notes = notesOf(*variable.grid->mesh());
    variables_.push_back(std::move(variable));
    sources_.push_back(source);
}

void FoamReader::open(std::size_t time) {
    auto files = case_.meshAt(time);
    if (files == open_) return;
    open_.clear();
    shapes_.reset();
    grids_ = {};
    mesh_ = {};
    mesh_ = foamMeshOf(files);
    open_ = std::move(files);
}

std::shared_ptr<const Grid> FoamReader::gridAt(bool atPoints) {
    auto& grid = grids_[atPoints ? 1 : 0];
    if (grid) return grid;
    if (!shapes_) shapes_.emplace(mesh_.grid);
    try {
        const auto mesh = std::make_shared<const Mesh>(
            atPoints ? meshOfPoints(mesh_.grid, *shapes_) : meshOfCells(mesh_.grid, *shapes_));
        return grid = std::make_shared<const Grid>(spaceAxes(), mesh);
    } catch (const std::invalid_argument& flaw) {
        throw FileError(fmt::format("{}: expected cells that take space, found that {}",
                                    open_[0].faces.string(), flaw.what()));
    }
}

// Each time has files of its own where its mesh is another: of points alone where these move.
StepGrids FoamReader::stepGrids(std::size_t variable) {
    const auto& times = sources_[variable].times;
    const auto first = case_.meshAt(times.front());
    StepGrids grids;
    for (const std::size_t time : times) {
        auto files = case_.meshAt(time);
        if (files == first) continue;
        if (files.size() == first.size())
            for (std::size_t part = 0; part < files.size(); ++part)
                files[part].points = first[part].points;
        const bool moved = files == first;
        grids.are = std::max(grids.are, moved ? StepGrids::Are::Moved : StepGrids::Are::Own);
    }
    return grids;
}

StepSources FoamReader::sources(std::size_t variable, std::size_t step) {
    const FoamSource& source = sources_[variable];
    const std::size_t time = source.times[step];
    const auto meshes = case_.meshAt(time);
    if (meshes != case_.meshAt(source.times.front())) return {};
    StepSources all{case_.filesOf(source.field, time)};
    for (const FoamMeshFiles& mesh : meshes)
        all.files.insert(all.files.end(), {mesh.points, mesh.faces, mesh.owner, mesh.neighbour});
    return all;
}

Field FoamReader::read(std::size_t variable, std::size_t step) {
    const FoamSource& source = sources_[variable];
    const std::size_t time = source.times[step];
    open(time);
    Field field;
    field.grid = gridOfStep(variables_[variable].grid, gridAt(source.head.atPoints));
    const auto files = case_.filesOf(source.field, time);
    const auto& counts = source.head.atPoints ? mesh_.points : mesh_.cells;
    Values rows;
    if (source.head.type == ValueType::F32)
        rows.emplace<std::vector<float>>();
    else
        rows.emplace<std::vector<double>>();
    for (std::size_t part = 0; part < files.size(); ++part)
        appendFoamValues(files[part], source.head, counts[part], rows);
    field.values = componentOf(std::move(rows), source.component);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openFoam(std::span<const std::filesystem::path> paths) {
    return std::make_unique<FoamReader>(paths[0]);
}

}  // namespace timeseries

#include "timeseries/readers/netcdf/openpmd_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "timeseries/grid/scattered.h"
#include "timeseries/readers/cf/cf_packing.h"
#include "timeseries/readers/netcdf/openpmd_mesh.h"
#include "timeseries/readers/netcdf/openpmd_particles.h"

namespace timeseries {
namespace {

using Components = std::vector<OpenPmdComponent>;

// A step of a variable: its component in one of the iterations, and of particles all components of
// their species, which tell where they lie.
struct OpenPmdStep {
    const OpenPmdIteration* iteration;
    const OpenPmdComponent* component;
    const Components* species = nullptr;
};

struct OpenPmdSource {
    std::vector<OpenPmdStep> steps;  // of the iterations that have it
    StridedLayout layout;            // of meshes
};

class OpenPmdReader final : public Reader {
 public:
    explicit OpenPmdReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()},
          opened_(std::move(opened)),
          iterations_(openPmdIterationsOf(file_)) {
        addMeshes();
        addParticles();
        if (!variables_.empty()) return;
        if (!damaged_.empty()) throw FileError(damaged_.front().why);
        file_.fail("data", "expected a mesh or particles with positions, found none");
    }

    std::string format() const override { return "openPMD"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override;
    StepSources sources(std::size_t variable, std::size_t step) override {
        if (sources_[variable].steps[step].species || file_.sources().empty()) return {};
        return {paths_, step};
    }

 private:
    void addMeshes();
    void addMesh(const std::string& name, std::vector<OpenPmdStep> steps);
    void addParticles();
    void addSpecies(const std::string& species);
    void addRecord(const std::string& name, std::vector<OpenPmdStep> steps);
    void add(const std::string& name, std::shared_ptr<const Grid> grid, OpenPmdSource source,
             std::vector<std::string> notes);
    void unlessDamaged(const std::string& name, const std::function<void()>& add);
    std::shared_ptr<const TimeAxis> timeOf(const std::vector<OpenPmdStep>& steps) const;
    std::shared_ptr<const Grid> scattered(const Components& species);

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    const std::vector<OpenPmdIteration> iterations_;
    std::vector<Variable> variables_;
    std::vector<DamagedVariable> damaged_;
    std::vector<OpenPmdSource> sources_;  // [variable]
    // Of the species and iteration that were read last.
    const Components* placed_ = nullptr;
    std::shared_ptr<const Grid> places_;
};

// By name, those that come first in the file first.
class StepsByName {
 public:
    void add(const OpenPmdStep& step) {
        const std::string& name = step.component->name;
        const auto [at, isNew] = where_.emplace(name, all.size());
        if (isNew) all.emplace_back(name, std::vector<OpenPmdStep>());
        all[at->second].second.push_back(step);
    }
    std::vector<std::pair<std::string, std::vector<OpenPmdStep>>> all;

 private:
    std::map<std::string, std::size_t> where_;
};

void OpenPmdReader::unlessDamaged(const std::string& name, const std::function<void()>& add) {
    try {
        add();
    } catch (const AttributeError& error) {
        damaged_.push_back({name, error.what()});
    }
}

// Iterations are counted where one of them has no time.
std::shared_ptr<const TimeAxis> OpenPmdReader::timeOf(const std::vector<OpenPmdStep>& steps) const {
    TimeAxis time;
    const bool timed = std::ranges::all_of(
        steps, [](const OpenPmdStep& step) { return step.iteration->seconds.has_value(); });
    time.name = timed ? "time" : "iteration";
    time.units = timed ? "s" : "";
    for (const OpenPmdStep& step : steps)
        time.points.push_back(
            {timed ? *step.iteration->seconds : static_cast<double>(step.iteration->number), ""});
    const auto same = [&](const Variable& other) {
        return other.time->name == time.name &&
               std::ranges::equal(other.time->points, time.points, {}, &TimePoint::value,
                                  &TimePoint::value);
    };
    const auto known = std::ranges::find_if(variables_, same);
    return known != variables_.end() ? known->time
                                     : std::make_shared<const TimeAxis>(std::move(time));
}

void OpenPmdReader::add(const std::string& name, std::shared_ptr<const Grid> grid,
                        OpenPmdSource source, std::vector<std::string> notes) {
    const OpenPmdComponent& first = *source.steps.front().component;
    Variable variable;
    variable.name = name;
    variable.units = openPmdUnitsOf(file_, first);
    variable.type = openPmdNumbersOf(file_, first).type;
    variable.storedAs =
        std::string(typeName(variable.type)) + (first.array ? "" : ", one value for all points");
    variable.grid = std::move(grid);
    variable.time = timeOf(source.steps);
    variable.notes = std::move(notes);
    if (const double after = openPmdNumber(file_, first, *first.record, "timeOffset", 0);
        after != 0)
        variable.notes.push_back(
            fmt::format("its values are of {} of the file's units of time after the steps' times "
                        "(timeOffset)",
                        after));
    variables_.push_back(std::move(variable));
    sources_.push_back(std::move(source));
}

void OpenPmdReader::addMeshes() {
    StepsByName meshes;
    for (const OpenPmdIteration& iteration : iterations_)
        for (const OpenPmdComponent& component : iteration.meshes)
            meshes.add({&iteration, &component});
    for (auto& mesh : meshes.all)
        unlessDamaged(mesh.first, [&] { addMesh(mesh.first, std::move(mesh.second)); });
}

// A window that moves with what it shows is drawn where it began.
void OpenPmdReader::addMesh(const std::string& name, std::vector<OpenPmdStep> steps) {
    const OpenPmdNumbers numbers = openPmdNumbersOf(file_, *steps.front().component);
    const OpenPmdMesh mesh = openPmdMeshOf(file_, *steps.front().component, numbers);
    std::vector<std::string> notes;
    if (!mesh.isCartesian())
        notes.push_back(fmt::format("drawn by index: its geometry is {}", mesh.geometry));
    bool moves = false;
    for (const OpenPmdStep& step : steps) {
        const OpenPmdNumbers own = openPmdNumbersOf(file_, *step.component);
        const OpenPmdMesh other = openPmdMeshOf(file_, *step.component, own);
        if (own.type != numbers.type || !other.sameCells(mesh))
            failComponent(
                file_, *step.component,
                fmt::format("expected the type, spacing and number of points of iteration {}",
                            steps.front().iteration->number));
        moves = moves || other.first != mesh.first;
    }
    if (moves)
        notes.push_back(fmt::format(
            "drawn where it lies in iteration {}: gridGlobalOffset moves it in later ones",
            steps.front().iteration->number));
    auto grid = std::make_shared<const Grid>(mesh.axes());
    const auto same = [&](const Variable& other) { return *other.grid == *grid; };
    if (const auto known = std::ranges::find_if(variables_, same); known != variables_.end())
        grid = known->grid;
    add(name, grid, {std::move(steps), mesh.layout}, std::move(notes));
}

void OpenPmdReader::addParticles() {
    std::set<std::string> names;
    for (const OpenPmdIteration& iteration : iterations_)
        for (const auto& species : iteration.species) names.insert(species.first);
    for (const std::string& species : names) unlessDamaged(species, [&] { addSpecies(species); });
}

// Of the iterations in which there are particles of it.
void OpenPmdReader::addSpecies(const std::string& species) {
    StepsByName steps;
    for (const OpenPmdIteration& iteration : iterations_) {
        const auto at = iteration.species.find(species);
        if (at == iteration.species.end() || openPmdParticles(file_, at->second) == 0) continue;
        for (const OpenPmdComponent& component : at->second)
            if (!isOpenPmdPlace(component)) steps.add({&iteration, &component, &at->second});
    }
    for (auto& named : steps.all)
        unlessDamaged(species + '/' + named.first,
                      [&] { addRecord(species + '/' + named.first, std::move(named.second)); });
}

void OpenPmdReader::addRecord(const std::string& name, std::vector<OpenPmdStep> steps) {
    const ValueType type = openPmdNumbersOf(file_, *steps.front().component).type;
    for (const OpenPmdStep& step : steps) {
        const OpenPmdNumbers own = openPmdNumbersOf(file_, *step.component);
        const std::uint64_t particles = openPmdParticles(file_, *step.species);
        if (own.type != type || own.lengths != std::vector{particles})
            failComponent(file_, *step.component,
                          fmt::format("expected {} numbers of type {}", particles, typeName(type)));
    }
    const auto grid = scattered(*steps.front().species);
    add(name, grid, {std::move(steps), {}}, notesOf(*grid->mesh()));
}

std::shared_ptr<const Grid> OpenPmdReader::scattered(const Components& species) {
    if (placed_ == &species) return places_;
    // Those of another step are of no more use, and may be as large.
    placed_ = nullptr;
    places_ = nullptr;
    auto axes = spaceAxes();
    for (Axis& axis : axes) axis.units = "m";
    try {
        const auto mesh =
            std::make_shared<const Mesh>(meshOfScattered(openPmdPlacesOf(file_, species)));
        places_ = std::make_shared<const Grid>(std::move(axes), mesh);
    } catch (const std::invalid_argument& flaw) {
        failComponent(
            file_, species.front(),
            fmt::format("expected particles that take space, found that {}", flaw.what()));
    }
    placed_ = &species;
    return places_;
}

StepGrids OpenPmdReader::stepGrids(std::size_t variable) {
    const auto& steps = sources_[variable].steps;
    if (!steps.front().species || steps.size() == 1) return {};
    StepGrids grids{.are = StepGrids::Are::Own, .least = std::numeric_limits<std::uint64_t>::max()};
    for (const OpenPmdStep& step : steps) {
        const std::uint64_t particles = openPmdParticles(file_, *step.species);
        grids.least = std::min(grids.least, particles);
        grids.most = std::max(grids.most, particles);
    }
    return grids;
}

Field OpenPmdReader::read(std::size_t variable, std::size_t step) {
    const OpenPmdSource& source = sources_[variable];
    const OpenPmdStep& at = source.steps[step];
    Field field;
    field.grid = variables_[variable].grid;
    if (at.species) {
        if (step > 0) field.grid = gridOfStep(field.grid, scattered(*at.species));
        field.values = openPmdValuesOf(file_, *at.component, openPmdParticles(file_, *at.species));
        return field;
    }
    const OpenPmdNumbers numbers = openPmdNumbersOf(file_, *at.component);
    if (!at.component->array) {
        field.values = openPmdConstant(*at.component, numbers);
        return field;
    }
    Packing asStored;
    asStored.stored = asStored.unpacked = numbers.type;
    const std::vector<std::size_t> start(numbers.lengths.size(), 0),
        count(numbers.lengths.begin(), numbers.lengths.end());
    const auto read = [&](void* values) { file_.read(*at.component->array, start, count, values); };
    unpack(asStored, source.layout, read, field);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openOpenPmd(std::unique_ptr<NetcdfFile> file) {
    return std::make_unique<OpenPmdReader>(std::move(file));
}

}  // namespace timeseries

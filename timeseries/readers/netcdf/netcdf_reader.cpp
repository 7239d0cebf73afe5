#include "timeseries/readers/netcdf/netcdf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "timeseries/readers/cf/cf_meshes.h"
#include "timeseries/readers/netcdf/netcdf_block.h"
#include "timeseries/readers/netcdf/netcdf_contents.h"

namespace timeseries {
namespace {

using Paths = std::vector<std::filesystem::path>;

class CfReader final : public Reader {
 public:
    // `first` is the first of them.
    CfReader(std::span<const std::filesystem::path> paths, std::unique_ptr<CfFile> first,
             OpenCfFile openFile)
        : paths_(paths.begin(), paths.end()),
          openFile_(std::move(openFile)),
          file_(std::move(first)) {
        // Backwards, so that the first file is the one left open.
        contents_.resize(paths_.size());
        sources_.resize(paths_.size());
        for (std::size_t i = paths_.size(); i-- > 0;) {
            CfFile& file = open(i);
            FileContents contents = contentsOf(file);
            sources_[i] = file.sources();
            contents_[i] = std::move(contents.variables);
            addDamaged(std::move(contents.damaged));
        }
        format_ = file_->header().format;
        leaveOutDamaged();
        expectSameVariables();
        addVariables();
        for (auto& contents : contents_)  // told by variables_ now
            for (FileVariable& variable : contents) {
                if (!variable.axes.columns) variable.axes = {};
                variable.times = {};
            }
    }

    std::string format() const override { return format_; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    void readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) override;
    bool readsPlanes(std::size_t variable, std::size_t step) override;
    StepSources sources(std::size_t variable, std::size_t step) override;
    std::optional<StepSpan> stepsOf(std::size_t variable, std::size_t file) const override;
    StepGrids stepGrids(std::size_t variable) override;

 private:
    CfFile& open(std::size_t index);
    void addDamaged(std::vector<DamagedVariable> damaged);
    void leaveOutDamaged();
    void expectSameVariables() const;
    void addVariables();
    void addVariable(std::size_t v, CfEarth& earth);
    std::shared_ptr<const Grid> gridOf(std::size_t v, std::vector<std::string>& notes);
    void placeOnEarth(std::size_t v, Variable& variable, CfEarth& earth);
    // Of one step of a file: all points where there is no slab. Without a grid.
    Field valuesOf(std::size_t variable, std::size_t index, std::size_t step, const Slab* slab);
    // The file that holds a step, and which of its steps that is.
    std::pair<std::size_t, std::size_t> fileOf(std::size_t variable, std::size_t step) const;
    // Of one step of a file, of a variable whose columns tell where its points lie.
    static constexpr std::size_t kLastStep = std::numeric_limits<std::size_t>::max();
    std::shared_ptr<const Mesh> meshAt(std::size_t f, std::size_t v, std::size_t step);
    [[noreturn]] void differ(std::size_t file, const std::string& what) const;

    Paths paths_;
    std::vector<Paths> sources_;  // [file]: of what it is made
    OpenCfFile openFile_;
    std::string format_;
    std::vector<std::vector<FileVariable>> contents_;  // [file][variable], the same order in each
    std::vector<Variable> variables_;
    std::vector<DamagedVariable> damaged_;
    // A variable without time is the same in all files, unless nothing in them has time: then each
    // file is a step.
    bool anyTime_ = false;
    std::vector<std::vector<Segment>> segments_;  // [variable]
    std::unique_ptr<CfFile> file_;  // one at a time: a series may have more files than handles
    std::size_t openIndex_ = 0;
    CfMeshes meshes_;
};

CfFile& CfReader::open(std::size_t index) {
    if (!file_ || openIndex_ != index) {
        file_.reset();
        file_ = openFile_(paths_[index], !contents_[index].empty());
        openIndex_ = index;
    }
    return *file_;
}

void CfReader::differ(std::size_t file, const std::string& what) const {
    throw FileError(fmt::format("{} and {}: {}", paths_[0].string(), paths_[file].string(), what));
}

// Of a file before those that were added: its sentences stay.
void CfReader::addDamaged(std::vector<DamagedVariable> damaged) {
    std::set<std::string> names;
    for (const DamagedVariable& each : damaged) names.insert(each.name);
    for (DamagedVariable& later : damaged_)
        if (!names.contains(later.name)) damaged.push_back(std::move(later));
    damaged_ = std::move(damaged);
}

// What is damaged in one file is no variable of the series.
void CfReader::leaveOutDamaged() {
    std::set<std::string> names;
    for (const DamagedVariable& each : damaged_) names.insert(each.name);
    for (auto& contents : contents_)
        std::erase_if(contents, [&](const FileVariable& v) {
            return names.contains(v.name) || names.contains(v.stored);
        });
    if (contents_[0].empty()) throw FileError(damaged_.front().why);
}

void CfReader::expectSameVariables() const {
    const auto& first = contents_[0];
    for (std::size_t f = 1; f < contents_.size(); ++f) {
        const auto& other = contents_[f];
        for (std::size_t v = 0; v < std::max(first.size(), other.size()); ++v)
            if (v >= first.size() || v >= other.size() || first[v].name != other[v].name)
                differ(f, fmt::format("expected the same variables, found '{}' and '{}'",
                                      v < first.size() ? first[v].name : "none",
                                      v < other.size() ? other[v].name : "none"));
        for (std::size_t v = 0; v < first.size(); ++v) {
            const FileVariable &a = first[v], &b = other[v];
            const std::string place = fmt::format("variable '{}': expected the same ", a.name);
            if (a.packing.unpacked != b.packing.unpacked)
                differ(f, fmt::format("{}type, found {} and {}", place,
                                      typeName(a.packing.unpacked), typeName(b.packing.unpacked)));
            if (a.units != b.units)
                differ(f, fmt::format("{}units, found \"{}\" and \"{}\"", place, a.units, b.units));
            for (std::size_t i = 0; i < 3; ++i) {
                const Axis &one = a.axes.axes[i], &second = b.axes.axes[i];
                if (one != second)
                    differ(f, fmt::format("{}grid, but their axes {} ({} points) and {} ({} "
                                          "points) differ",
                                          place, one.name, one.coordinates.size(), second.name,
                                          second.coordinates.size()));
            }
            if (a.axes.columns != b.axes.columns)
                differ(f, place + "grid, but other coordinates tell where their points lie");
        }
    }
}

// Of the first step. Its bounds are those of the last one, too: of a nest that moves, the way.
std::shared_ptr<const Grid> CfReader::gridOf(std::size_t v, std::vector<std::string>& notes) {
    FileVariable& first = contents_[0][v];
    std::array<Axis, 3> axes = first.axes.axes;
    if (!first.axes.columns) return std::make_shared<const Grid>(std::move(axes));
    // Most variables of a file share their columns, which take a while to measure.
    for (std::size_t before = 0; before < v; ++before)
        if (contents_[0][before].axes.columns == first.axes.columns &&
            contents_[0][before].axes.axes == axes && variables_[before].grid->mesh())
            return variables_[before].grid;
    std::size_t file = 0;
    try {
        const auto mesh = meshAt(file, v, 0);
        if (const auto& heights = first.axes.columns->heights)
            axes[2] = {heights->name, heights->units, {}, heights->down};
        const bool isLong = first.axes.columns->inTime;
        file = contents_.size() - 1;
        const auto last = isLong || file > 0 ? meshAt(file, v, kLastStep) : mesh;
        for (int a = 0; a < 3; ++a) {
            const double lo = std::min(mesh->lo()[a], last->lo()[a]),
                         hi = std::max(mesh->hi()[a], last->hi()[a]);
            axes[static_cast<std::size_t>(a)].coordinates =
                lo < hi ? std::vector{lo, hi} : std::vector{lo};
        }
        open(0);
        return std::make_shared<const Grid>(std::move(axes), mesh);
    } catch (const std::invalid_argument& flaw) {
        if (first.axes.columns->heights) {
            // By levels then, as if the file said no more of them.
            notes.push_back(fmt::format("drawn by levels: of the {} that a formula gives, {}",
                                        first.axes.columns->heights->name, flaw.what()));
            for (auto& contents : contents_) {
                auto& columns = contents[v].axes.columns;
                columns->heights.reset();
                if (columns->upright) columns.reset();
            }
            return gridOf(v, notes);
        }
        if (first.axes.columns->by != ColumnPlaces::By::Neighbours)
            throw AttributeError(open(file).sentence(
                "variable '" + first.stored + "'",
                fmt::format("expected cells that take space, found that {}", flaw.what())));
        notes.push_back(fmt::format("drawn in index space: of its 2-D coordinates {} and {}, {}",
                                    first.axes.columns->x, first.axes.columns->y, flaw.what()));
        first.axes.columns.reset();
        for (std::size_t a = 0; a < 2; ++a) axes[a].units = "index";
        return std::make_shared<const Grid>(std::move(axes));
    }
}

std::shared_ptr<const Mesh> CfReader::meshAt(std::size_t f, std::size_t v, std::size_t step) {
    const FileVariable& source = contents_[f][v];
    CfFile& file = open(f);
    const NcVariable* const found = file.header().find(source.stored, "");
    if (!found)
        file.fail("variable '" + source.stored + "'", "expected it, but the file has changed");
    return meshes_.of(file, f, *found, source.roles, *source.axes.columns, source.axes.axes[2],
                      step);
}

// One whose places make no cells costs no other.
void CfReader::addVariables() {
    anyTime_ = std::ranges::any_of(
        contents_[0], [](const FileVariable& f) { return !f.times.single || !f.times.counted; });
    CfEarth earth;
    for (std::size_t v = 0; v < contents_[0].size();) {
        try {
            addVariable(v, earth);
            ++v;
        } catch (const AttributeError& error) {
            damaged_.push_back({contents_[0][v].name, error.what()});
            for (auto& contents : contents_)
                contents.erase(contents.begin() + static_cast<std::ptrdiff_t>(v));
            segments_.resize(variables_.size());
        }
    }
    if (variables_.empty()) throw FileError(damaged_.front().why);
}

// Of the first file. That its places on the Earth cannot be told costs nothing else.
void CfReader::placeOnEarth(std::size_t v, Variable& variable, CfEarth& earth) {
    const FileVariable& first = contents_[0][v];
    if (!first.axes.earth) return;
    CfFile& file = open(0);
    const NcVariable* const found = file.header().find(first.stored, "");
    if (!found) return;
    const auto& [places, flaw] = earth.of(file, *found, first.roles, *first.axes.earth);
    if (!flaw.empty())
        variable.notes.push_back("no globe by its longitudes and latitudes: " + flaw);
    if (places &&
        places->count() == std::uint64_t{variable.grid->size()[0]} * variable.grid->size()[1])
        variable.grid = std::make_shared<const Grid>(variable.grid->withEarth(places));
}

void CfReader::addVariable(std::size_t v, CfEarth& earth) {
    const FileVariable& first = contents_[0][v];
    Variable variable;
    variable.name = first.name;
    variable.longName = first.longName;
    variable.units = first.units;
    variable.type = first.packing.unpacked;
    variable.storedAs = first.packing.storedAs;
    variable.missing = first.packing.missingText;
    variable.categories = first.categories;
    variable.classes = first.classes;
    variable.notes = first.notes;

    const bool fixed = anyTime_ && first.times.single && first.times.counted;
    std::vector<StoredTimes> parts;
    for (std::size_t f = 0; f < (fixed ? 1 : contents_.size()); ++f)
        parts.push_back(contents_[f][v].times);
    JoinedTimes joined = join(parts, paths_, first.name);
    segments_.push_back(std::move(joined.segments));

    auto time = std::make_shared<TimeAxis>(timeAxisOf(joined.times, variable.notes));
    variable.time = time;
    variable.grid = gridOf(v, variable.notes);
    placeOnEarth(v, variable, earth);
    if (variable.grid->mesh())
        for (std::string& note : notesOf(*variable.grid->mesh()))
            variable.notes.push_back(std::move(note));
    if (const auto& columns = first.axes.columns; columns && columns->heights)
        if (std::string note = approximationIn(*columns->heights); !note.empty())
            variable.notes.push_back(std::move(note));
    const auto sameGrid = [&](const Variable& other) { return *other.grid == *variable.grid; };
    if (const auto other = std::ranges::find_if(variables_, sameGrid); other != variables_.end())
        variable.grid = other->grid;
    const auto samePoint = [](const TimePoint& a, const TimePoint& b) {
        return a.value == b.value && a.date == b.date;
    };
    const auto sameTime = [&](const Variable& other) {
        return other.time->name == time->name && other.time->units == time->units &&
               other.time->calendar == time->calendar &&
               std::ranges::equal(other.time->points, time->points, samePoint);
    };
    if (const auto other = std::ranges::find_if(variables_, sameTime); other != variables_.end())
        variable.time = other->time;
    variables_.push_back(std::move(variable));
}

std::optional<StepSpan> CfReader::stepsOf(std::size_t variable, std::size_t file) const {
    std::size_t first = 0;
    for (const Segment& segment : segments_[variable]) {
        if (segment.file == file) return StepSpan{first, segment.count};
        first += segment.count;
    }
    return std::nullopt;  // what has no time is read of the first file
}

StepSources CfReader::sources(std::size_t variable, std::size_t step) {
    const auto [file, own] = fileOf(variable, step);
    const auto& columns = contents_[0][variable].axes.columns;
    if (columns && (columns->inTime || file > 0)) return {};
    if (sources_[file].empty()) return {};
    return {sources_[file], own};
}

std::pair<std::size_t, std::size_t> CfReader::fileOf(std::size_t variable, std::size_t step) const {
    auto segment = segments_[variable].begin();
    while (step >= segment->count) step -= (segment++)->count;
    return {segment->file, step};
}

Field CfReader::valuesOf(std::size_t variable, std::size_t index, std::size_t step,
                         const Slab* slab) {
    const FileVariable& source = contents_[index][variable];
    CfFile& file = open(index);
    const NcVariable* found = file.header().find(source.stored, "");
    std::vector<std::uint64_t> lengths;
    if (found)
        for (std::size_t i = 0; i < found->dimensions.size(); ++i)
            lengths.push_back(file.header().dimension(*found, i).length);
    if (!found || found->type != source.type || lengths != source.lengths)
        file.fail("variable '" + source.stored + "'",
                  "expected it as it was when the series was opened, but the file has changed");

    Field field;
    field.categories = source.categories;
    const NetcdfBlock block = blockOf(source, step, slab);
    unpack(
        source.packing, block.layout,
        [&](void* values) { file.read(*found, block.start, block.count, values); }, field);
    return field;
}

void CfReader::readSlab(std::size_t variable, std::size_t seriesStep, const Slab& slab,
                        Field& into) {
    const auto [index, step] = fileOf(variable, seriesStep);
    into = valuesOf(variable, index, step, &slab);
}

bool CfReader::readsPlanes(std::size_t variable, std::size_t step) {
    const std::size_t index = fileOf(variable, step).first;
    const FileVariable& source = contents_[index][variable];
    const auto &x = source.roles.x, &y = source.roles.y, &z = source.roles.z;
    const NcVariable* const found = open(index).header().find(source.stored, "");
    // Chunks would be unpacked once for each slab that they reach into.
    return found && found->chunkBytes == 0 && z && (!y || *z < *y) && (!x || *z < *x);
}

StepGrids CfReader::stepGrids(std::size_t variable) {
    const auto& columns = contents_[0][variable].axes.columns;
    const auto& mesh = variables_[variable].grid->mesh();
    const std::size_t steps = variables_[variable].time->points.size();
    if (!columns || !mesh || steps == 1) return {};
    const auto [file, step] = fileOf(variable, steps - 1);
    if (!columns->inTime && file == 0) return {};
    try {
        const bool moved = *meshAt(file, variable, step) != *mesh;
        return {.are = moved ? StepGrids::Are::Moved : StepGrids::Are::One};
    } catch (const std::invalid_argument&) {  // told where that step is read
        return {};
    }
}

Field CfReader::read(std::size_t variable, std::size_t seriesStep) {
    const auto [index, step] = fileOf(variable, seriesStep);
    Field field = valuesOf(variable, index, step, nullptr);
    field.grid = variables_[variable].grid;
    const auto& columns = contents_[0][variable].axes.columns;
    if (columns && (columns->inTime || index > 0)) {
        try {
            const auto mesh = meshAt(index, variable, step);
            if (*mesh != *field.grid->mesh())
                field.grid = std::make_shared<const Grid>(
                    Grid(field.grid->axes(), mesh, true).withEarth(field.grid->earth()));
        } catch (const std::invalid_argument& flaw) {
            open(index).fail(
                "variable '" + contents_[index][variable].stored + "'",
                fmt::format("expected cells that take space, found that {}", flaw.what()));
        }
    }
    return field;
}

}  // namespace

std::unique_ptr<Reader> openCf(std::span<const std::filesystem::path> paths,
                               std::unique_ptr<CfFile> first, OpenCfFile open) {
    return std::make_unique<CfReader>(paths, std::move(first), std::move(open));
}

}  // namespace timeseries

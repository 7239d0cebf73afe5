#include "timeseries/readers/netcdf/exodus_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/components.h"
#include "timeseries/readers/netcdf/exodus_mesh.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

// One behind the other: the parts that a variable's values are read from, a step at a time. Null:
// the block has none of it.
struct BlockPart {
    const NcVariable* variable;
    std::uint64_t count;
    std::optional<std::size_t> among;  // of variables that stand in one, the second dimension
};

class ExodusReader final : public Reader {
 public:
    explicit ExodusReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()}, opened_(std::move(opened)), mesh_(exodusMeshOf(file_)) {
        addTime();
        addDisplacements();
        addVariables();
        if (displacements_.empty()) {
            mesh_.grid = {};
            shapes_.reset();
        }
        if (variables_.empty()) file_.fail("", "expected results at nodes or elements, found none");
    }

    std::string format() const override { return "Exodus II"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t) override {
        return {.are = moves() ? StepGrids::Are::Moved : StepGrids::Are::One};
    }
    StepSources sources(std::size_t, std::size_t step) override {
        if (moves()) return {};
        return {file_.sources(), step};
    }

 private:
    bool moves() const { return !displacements_.empty() && steps_ > 1; }
    void addTime();
    void addDisplacements();
    void addVariables();
    std::vector<BlockPart> partsOf(bool atNodes, std::size_t index) const;
    void add(const std::string& name, bool atNodes, std::vector<BlockPart> parts);
    // Moves the nodes to where they are in a step.
    void move(std::size_t step);
    // Of the step that they are moved to.
    std::shared_ptr<const Grid> gridOf(bool atNodes);
    template <typename T>
    void read(const BlockPart& part, std::size_t step, T* into) const;

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    ExodusMesh mesh_;
    std::uint64_t steps_ = 0;
    std::shared_ptr<const TimeAxis> time_;
    std::optional<UnstructuredShapes> shapes_;
    std::array<std::shared_ptr<const Grid>, 2> grids_;  // at elements, at nodes
    std::vector<Variable> variables_;
    struct Source {
        bool atNodes;
        std::vector<BlockPart> parts;
    };
    std::vector<Source> sources_;           // [variable]
    std::vector<BlockPart> displacements_;  // along x, y, z; none where nodes stand still
    PageVector<glm::dvec3> still_;          // the nodes without them, then
    std::optional<std::size_t> movedTo_;    // the step
};

void ExodusReader::addTime() {
    steps_ = exodusLength(file_.header(), "time_step");
    if (steps_ == 0) file_.fail("", "expected results of a time step, found none");
    auto time = std::make_shared<TimeAxis>();
    time->name = "time";
    const NcVariable* times = exodusVariable(file_, "time_whole", {steps_});
    if (!times) file_.fail("", "expected the variable time_whole");
    for (const Number& number : file_.numbers(*times)) {
        const double value = toDouble(number);
        if (!std::isfinite(value))
            file_.fail("variable 'time_whole'", "expected times that are finite");
        time->points.push_back({value, ""});
    }
    time_ = std::move(time);
}

// As those who draw Exodus's results do: a vector at nodes whose name begins with "dis" says how
// far each has moved.
void ExodusReader::addDisplacements() {
    const std::vector<std::string> names = file_.lines("name_nod_var");
    const std::uint64_t dimensions = exodusLength(file_.header(), "num_dim");
    for (const std::string& first : names) {
        const std::string name = lower(first);
        if (!name.starts_with("dis") || !name.ends_with("x")) continue;
        std::vector<BlockPart> parts;
        std::vector<std::string> all;
        for (std::uint64_t axis = 0; axis < dimensions; ++axis) {
            const std::string wanted = name.substr(0, name.size() - 1) + "xyz"[axis];
            const auto found = std::ranges::find(names, wanted, [](auto& n) { return lower(n); });
            if (found == names.end()) break;
            const auto part = partsOf(true, static_cast<std::size_t>(found - names.begin()));
            parts.insert(parts.end(), part.begin(), part.end());
            all.push_back(*found);
        }
        if (parts.size() != dimensions) continue;
        displacements_ = std::move(parts);
        still_ = mesh_.grid.points;
        mesh_.notes.push_back(fmt::format("nodes are moved by {}", fmt::join(all, ", ")));
        return move(0);
    }
}

void ExodusReader::move(std::size_t step) {
    if (displacements_.empty() || movedTo_ == step) return;
    PageVector<glm::dvec3> moved = still_;
    for (std::size_t axis = 0; axis < displacements_.size(); ++axis)
        withType(*displacements_[axis].variable->type, [&]<typename T>(T) {
            std::vector<T> by(moved.size());
            read(displacements_[axis], step, by.data());
            for (std::size_t i = 0; i < by.size(); ++i)
                moved[i][static_cast<int>(axis)] += static_cast<double>(by[i]);
        });
    movedTo_ = step;
    if (moved == mesh_.grid.points) return;
    mesh_.grid.points = std::move(moved);
    shapes_.reset();
    grids_ = {};
}

std::vector<BlockPart> ExodusReader::partsOf(bool atNodes, std::size_t index) const {
    std::vector<BlockPart> parts;
    if (atNodes) {
        const std::uint64_t nodes = mesh_.grid.points.size(),
                            all = exodusLength(file_.header(), "num_nod_var");
        const std::string own = fmt::format("vals_nod_var{}", index + 1);
        if (const NcVariable* one = exodusVariable(file_, own, {steps_, nodes}))
            return {{one, nodes, std::nullopt}};
        if (const NcVariable* of = exodusVariable(file_, "vals_nod_var", {steps_, all, nodes}))
            return {{of, nodes, index}};
        return {};
    }
    for (std::size_t block = 0; block < mesh_.blocks.size(); ++block) {
        const std::uint64_t count = mesh_.blocks[block];
        const std::string own = fmt::format("vals_elem_var{}eb{}", index + 1, block + 1);
        parts.push_back({count > 0 ? exodusVariable(file_, own, {steps_, count}) : nullptr, count,
                         std::nullopt});
    }
    return parts;
}

std::shared_ptr<const Grid> ExodusReader::gridOf(bool atNodes) {
    auto& grid = grids_[atNodes ? 1 : 0];
    if (grid) return grid;
    if (!shapes_) shapes_.emplace(mesh_.grid);
    try {
        const auto mesh = std::make_shared<const Mesh>(atNodes ? meshOfPoints(mesh_.grid, *shapes_)
                                                               : meshOfCells(mesh_.grid, *shapes_));
        return grid = std::make_shared<const Grid>(spaceAxes(), mesh);
    } catch (const std::invalid_argument& flaw) {
        file_.fail("connect",
                   fmt::format("expected elements that take space, found that {}", flaw.what()));
    }
}

void ExodusReader::add(const std::string& name, bool atNodes, std::vector<BlockPart> parts) {
    const auto first =
        std::ranges::find_if(parts, [](const BlockPart& part) { return part.variable; });
    if (first == parts.end()) return;
    Variable variable;
    variable.name = name;
    variable.type = *first->variable->type;
    variable.storedAs = std::string(typeName(variable.type)) + (atNodes ? "" : ", at elements");
    std::size_t without = 0;
    for (const BlockPart& part : parts) {
        if (part.variable && part.variable->type != variable.type)
            file_.fail("variable '" + name + "'", "expected the same type in all blocks");
        without += !part.variable && part.count > 0;
    }
    if (without > 0)
        variable.missing = fmt::format("{} of {} blocks have none", without, parts.size());
    variable.grid = gridOf(atNodes);
    variable.time = time_;
    variable.notes = mesh_.notes;
    for (std::string& note : notesOf(*variable.grid->mesh()))
        variable.notes.push_back(std::move(note));
    variables_.push_back(std::move(variable));
    sources_.push_back({atNodes, std::move(parts)});
}

void ExodusReader::addVariables() {
    const std::vector<std::string> atNodes = file_.lines("name_nod_var"),
                                   atElements = file_.lines("name_elem_var");
    const auto isIn = [](const std::vector<std::string>& names, const std::string& name) {
        return std::ranges::find(names, name) != names.end();
    };
    for (std::size_t i = 0; i < atNodes.size(); ++i)
        add(atNodes[i] + (isIn(atElements, atNodes[i]) ? " (points)" : ""), true, partsOf(true, i));
    for (std::size_t i = 0; i < atElements.size(); ++i)
        add(atElements[i] + (isIn(atNodes, atElements[i]) ? " (cells)" : ""), false,
            partsOf(false, i));
    tellApart(variables_);
}

template <typename T>
void ExodusReader::read(const BlockPart& part, std::size_t step, T* into) const {
    if (part.among)
        file_.read(*part.variable, std::array<std::size_t, 3>{step, *part.among, 0},
                   std::array<std::size_t, 3>{1, 1, part.count}, into);
    else
        file_.read(*part.variable, std::array<std::size_t, 2>{step, 0},
                   std::array<std::size_t, 2>{1, part.count}, into);
}

Field ExodusReader::read(std::size_t variable, std::size_t step) {
    Field field;
    const Source& source = sources_[variable];
    field.grid = variables_[variable].grid;
    if (!displacements_.empty()) {
        move(step);
        field.grid = gridOfStep(field.grid, gridOf(source.atNodes));
        if (!field.grid) file_.fail("", "expected the steps of one series");
    }
    withType(variables_[variable].type, [&]<typename T>(T) {
        auto& values = field.values.emplace<std::vector<T>>(field.grid->count());
        std::uint64_t at = 0;
        for (const BlockPart& part : source.parts) {
            if (part.variable) {
                read(part, step, values.data() + at);
            } else if (part.count > 0) {
                field.missing.resize(values.size());
                std::fill_n(field.missing.begin() + static_cast<std::ptrdiff_t>(at), part.count,
                            true);
            }
            at += part.count;
        }
    });
    return field;
}

}  // namespace

std::unique_ptr<Reader> openExodus(std::unique_ptr<NetcdfFile> file) {
    return std::make_unique<ExodusReader>(std::move(file));
}

}  // namespace timeseries

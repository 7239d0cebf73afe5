#include "timeseries/readers/netcdf/exodus_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/netcdf/exodus_mesh.h"

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
        addVariables();
        mesh_.grid = {};
        if (variables_.empty()) file_.fail("", "expected results at nodes or elements, found none");
    }

    std::string format() const override { return "Exodus II"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;

 private:
    void addTime();
    void addVariables();
    std::vector<BlockPart> partsOf(bool atNodes, std::size_t index) const;
    void add(const std::string& name, bool atNodes, std::vector<BlockPart> parts);
    std::shared_ptr<const Grid> gridOf(bool atNodes);

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    ExodusMesh mesh_;
    std::uint64_t steps_ = 0;
    std::shared_ptr<const TimeAxis> time_;
    std::optional<UnstructuredShapes> shapes_;
    std::array<std::shared_ptr<const Grid>, 2> grids_;  // at elements, at nodes
    std::vector<Variable> variables_;
    std::vector<std::vector<BlockPart>> parts_;  // [variable]
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
    parts_.push_back(std::move(parts));
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
}

Field ExodusReader::read(std::size_t variable, std::size_t step) {
    Field field;
    field.grid = variables_[variable].grid;
    withType(variables_[variable].type, [&]<typename T>(T) {
        auto& values = field.values.emplace<std::vector<T>>(field.grid->count());
        std::uint64_t at = 0;
        for (const BlockPart& part : parts_[variable]) {
            if (part.variable && part.among)
                file_.read(*part.variable, std::array<std::size_t, 3>{step, *part.among, 0},
                           std::array<std::size_t, 3>{1, 1, part.count}, values.data() + at);
            else if (part.variable)
                file_.read(*part.variable, std::array<std::size_t, 2>{step, 0},
                           std::array<std::size_t, 2>{1, part.count}, values.data() + at);
            else if (part.count > 0) {
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

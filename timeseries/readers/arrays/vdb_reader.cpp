#include "timeseries/readers/arrays/vdb_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <vector>

#include "timeseries/readers/arrays/array_axes.h"
#include "timeseries/readers/arrays/vdb_file.h"
#include "timeseries/readers/cf/cf_time.h"
#include "timeseries/readers/components.h"
#include "timeseries/readers/sequence_reader.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Boxes = std::map<std::string, VdbBox>;  // of a grid, all that is active in any file

// As an array of cells, whose first is the box's.
ArrayHeader headerOf(const Path& path, const VdbGrid& grid, const VdbBox& box) {
    ArrayHeader header;
    header.path = path;
    header.type = grid.value;
    header.spaceDimension = 3;
    glm::dvec3 origin = grid.origin;
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        origin += static_cast<double>(box.first[axis]) * grid.steps[a];
        ArrayAxis along;
        along.size = box.size()[axis];
        along.kind = ArrayKind::Space;
        along.direction = {grid.steps[a].x, grid.steps[a].y, grid.steps[a].z, 0};
        header.axes.push_back(along);
    }
    header.origin = {origin.x, origin.y, origin.z, 0};
    return header;
}

// From the order of the file's indices to that of a field.
template <typename T>
std::vector<T> turned(const std::vector<T>& from, const ArrayLayout& layout) {
    if (!layout.turned) return from;
    std::vector<T> to(from.size());
    std::size_t i = 0;
    for (std::uint64_t z = 0; z < layout.size[2]; ++z)
        for (std::uint64_t y = 0; y < layout.size[1]; ++y)
            for (std::uint64_t x = 0; x < layout.size[0]; ++x)
                to[x * layout.stride[0] + y * layout.stride[1] + z * layout.stride[2]] = from[i++];
    return to;
}

class VdbReader final : public Reader {
 public:
    VdbReader(const Path& path, VdbFile file, const Boxes& boxes)
        : path_(path), file_(std::move(file)) {
        for (const VdbGrid& grid : file_.grids()) {
            const auto box = boxes.find(grid.name);
            add(grid, box == boxes.end() ? grid.box : box->second);
        }
        if (!variables_.empty()) return;
        throw FileError(file_.damaged().empty()
                            ? fmt::format("{}: expected a grid, found none", path.string())
                            : file_.damaged().front().why);
    }
    std::string format() const override { return "OpenVDB"; }
    std::span<const Path> files() const override { return {&path_, 1}; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return file_.damaged(); }
    StepSources sources(std::size_t, std::size_t step) override { return {{path_}, step}; }
    Field read(std::size_t variable, std::size_t) override {
        const Drawn& drawn = drawn_[variable];
        Field field;
        field.grid = variables_[variable].grid;
        field.values = componentOf(file_.read(drawn.grid, drawn.box), drawn.component);
        std::visit([&](auto& values) { values = turned(values, drawn.layout); }, field.values);
        return field;
    }

 private:
    struct Drawn {
        VdbGrid grid;
        VdbBox box;
        ArrayLayout layout;
        Component component;
    };
    void add(const VdbGrid& grid, const VdbBox& box);

    Path path_;
    VdbFile file_;
    std::vector<Variable> variables_;
    std::vector<Drawn> drawn_;
};

void VdbReader::add(const VdbGrid& grid, const VdbBox& box) {
    Variable variable;
    const ArrayHeader header = headerOf(path_, grid, box);
    const ArrayRoles roles{std::nullopt, {0, 1, 2}};
    ArrayPlacing placing = placingOf(header, roles, layoutOf(header, roles), variable.notes);
    variable.grid = std::make_shared<const Grid>(std::move(placing.axes), placing.frame);
    variable.time = std::make_shared<const TimeAxis>(timeAxisOf({}, variable.notes));
    variable.notes.push_back(
        "drawn on the box of its active voxels; the others have the value that the file gives "
        "them");
    for (const ComponentVariable& one : componentsOf(grid.name, grid.value, grid.numbers)) {
        variable.name = one.name;
        variable.nameless = grid.name.empty();
        if (variable.nameless) variable.name = path_.stem().string();
        variable.type = one.type;
        variable.storedAs = grid.isHalf ? "16-bit floats" : one.storedAs;
        if (grid.kind != "unknown") variable.storedAs += ", " + grid.kind;
        variables_.push_back(variable);
        drawn_.push_back({grid, box, placing.layout, one.component});
    }
}

}  // namespace

std::unique_ptr<Reader> openVdb(std::span<const Path> paths) {
    if (paths.size() == 1)
        return std::make_unique<VdbReader>(paths[0], VdbFile(paths[0], VdbFile::Header::New),
                                           Boxes());
    Boxes boxes;
    const auto opened = std::make_shared<std::map<Path, VdbFile>>();  // and not used yet
    for (const Path& path : paths) {
        const auto file = opened->try_emplace(path, path, VdbFile::Header::New).first;
        for (const VdbGrid& grid : file->second.grids()) {
            const auto [box, isNew] = boxes.emplace(grid.name, grid.box);
            if (!isNew) box->second.add(grid.box);
        }
    }
    for (const auto& [name, box] : boxes)
        if (!box.count())
            throw FileError(
                fmt::format("{} and others: grid '{}': expected a box of at most 2^32 voxels that "
                            "holds all steps, "
                            "found {}",
                            paths[0].string(), name, fmt::join(box.size(), " x ")));
    return openSequence(paths, [boxes, opened](const Path& path) {
        auto known = opened->extract(path);
        return std::make_unique<VdbReader>(
            path, known ? std::move(known.mapped()) : VdbFile(path, VdbFile::Header::Known), boxes);
    });
}

}  // namespace timeseries

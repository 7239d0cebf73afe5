#include "timeseries/readers/netcdf/cf_fesom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

constexpr std::string_view kNodes = "nod2", kTriangles = "elem", kLayers = "nz1", kLevels = "nz";
// The group in which the mesh's variables stand, which no file of FESOM's has.
const std::string kGroup = "mesh";

const NcVariable* firstOf(const NcHeader& header, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (const NcVariable* const found = header.find(name, ""); found && found->type)
            return found;
    return nullptr;
}

// Three nodes of each triangle, counted from 1.
const NcVariable* trianglesOf(const NcHeader& header) {
    const NcVariable* const found = firstOf(header, {"face_nodes", "elements", "elem"});
    return found && found->dimensions.size() == 2 ? found : nullptr;
}

std::optional<std::size_t> dimensionOf(const NcHeader& header, std::string_view name) {
    const auto found = std::ranges::find(header.dimensions, name, &NcDimension::name);
    if (found == header.dimensions.end()) return std::nullopt;
    return static_cast<std::size_t>(found - header.dimensions.begin());
}

// "fesom" of "temp.fesom.1948.nc", by which the mesh is called, too; the first is what FESOM's
// tools look for.
std::vector<std::filesystem::path> meshesBeside(const std::filesystem::path& values) {
    std::vector<std::filesystem::path> paths{values.parent_path() / "fesom.mesh.diag.nc"};
    const std::string name = values.filename().string();
    const auto first = name.find('.'), second = name.find('.', first + 1);
    if (second != name.npos) {
        const std::string run = name.substr(first + 1, second - first - 1);
        paths.push_back(values.parent_path() / (run + ".mesh.diag.nc"));
        if (paths[1] == paths[0]) paths.pop_back();
    }
    return paths;
}

std::unique_ptr<NetcdfFile> meshFileOf(const NetcdfFile& values, NetcdfFile::Header header) {
    std::string looked;
    for (const auto& path : meshesBeside(values.path())) {
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored))
            return std::make_unique<NetcdfFile>(path, header);
        looked += (looked.empty() ? "" : " nor ") + path.filename().string();
    }
    values.fail(
        "",
        fmt::format("expected the mesh of FESOM's values beside them, but there is no {}", looked));
}

void say(NcVariable& variable, const char* name, const std::string& text) {
    std::erase_if(variable.attributes, [&](const NcAttribute& each) { return each.name == name; });
    variable.attributes.push_back({name, text, std::nullopt});
}

// A variable of the mesh, or one of its rows.
struct MeshSource {
    const NcVariable* variable;
    std::optional<std::size_t> row;
};

class FesomFile final : public CfFile {
 public:
    FesomFile(std::unique_ptr<NetcdfFile> values, NetcdfFile::Header header)
        : CfFile(values->path()), values_(std::move(values)), mesh_(meshFileOf(*values_, header)) {
        header_ = values_->header();
        nodes_ = dimensionOf(header_, kNodes);
        triangles_ = dimensionOf(header_, kTriangles);
        addMesh();
        for (const std::string_view name : {kLayers, kLevels}) addDepths(name);
        for (NcVariable& variable : header_.variables) place(variable);
    }

    std::vector<std::filesystem::path> sources() const override {
        if (values_->sources().empty() || mesh_->sources().empty()) return {};
        return {path_, mesh_->path()};
    }
    std::string tooLarge(const NcVariable& variable, std::uint64_t points) const override {
        const MeshSource* const source = sourceOf(variable);
        return source ? mesh_->tooLarge(*source->variable, points)
                      : values_->tooLarge(variable, points);
    }
    std::vector<Number> numbers(const NcVariable& variable) const override;
    std::optional<std::vector<std::string>> texts(const NcVariable& variable, std::size_t first,
                                                  std::size_t count) const override {
        if (sourceOf(variable)) return std::nullopt;  // the mesh has none that is asked for
        return values_->texts(variable, first, count);
    }
    void read(const NcVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, void* values) const override;

 private:
    using Levels = std::array<std::vector<double>, 2>;  // of each place the first and one beyond

    const MeshSource* sourceOf(const NcVariable& variable) const {
        return variable.id < 0 ? &sources_[static_cast<std::size_t>(-1 - variable.id)] : nullptr;
    }
    void addMesh();
    void addDepths(std::string_view name);
    void place(NcVariable& variable) const;
    NcVariable& add(const std::string& name, MeshSource source,
                    std::vector<std::size_t> dimensions);
    void expectLength(std::optional<std::size_t> dimension, std::uint64_t length) const;
    const Levels& levelsOf(bool atNodes) const;
    void hide(const NcVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, void* values) const;

    std::unique_ptr<NetcdfFile> values_, mesh_;
    std::optional<std::size_t> nodes_, triangles_;  // dimensions of the header
    std::vector<MeshSource> sources_;
    mutable std::map<bool, Levels> levels_;
};

// The mesh's dimension stands for the values' own.
void FesomFile::expectLength(std::optional<std::size_t> dimension, std::uint64_t length) const {
    if (!dimension || header_.dimensions[*dimension].length == length) return;
    mesh_->fail("", fmt::format("expected a mesh of {} {} for {}, found {}",
                                header_.dimensions[*dimension].length,
                                dimension == nodes_ ? "nodes" : "triangles",
                                path_.filename().string(), length));
}

NcVariable& FesomFile::add(const std::string& name, MeshSource source,
                           std::vector<std::size_t> dimensions) {
    sources_.push_back(source);
    NcVariable variable = *source.variable;
    variable.name = name;
    variable.group = name.find('/') == name.npos ? "" : kGroup;
    variable.dimensions = std::move(dimensions);
    variable.id = -static_cast<int>(sources_.size());
    header_.variables.push_back(std::move(variable));
    return header_.variables.back();
}

void FesomFile::addMesh() {
    const NcHeader& mesh = mesh_->header();
    const NcVariable* const triangles = trianglesOf(mesh);
    if (!triangles)
        mesh_->fail("",
                    "expected the triangles of FESOM's mesh, face_nodes, elements or elem, "
                    "found none");
    // Which dimension counts corners: the one that says so, else the first of three.
    const std::size_t corners = mesh.dimension(*triangles, 0).name == "n3"   ? 0
                                : mesh.dimension(*triangles, 1).name == "n3" ? 1
                                : mesh.dimension(*triangles, 0).length == 3  ? 0
                                                                             : 1;
    if (mesh.dimension(*triangles, corners).length != 3)
        mesh_->fail("variable '" + triangles->name + "'", "expected three nodes of each triangle");
    const NcVariable *const lon = firstOf(mesh, {"lon"}), *const lat = firstOf(mesh, {"lat"}),
                            *const both = firstOf(mesh, {"nodes"});
    const bool apart =
        lon && lat && lon->dimensions.size() == 1 && lat->isAlong(lon->dimensions[0]);
    const bool together =
        both && both->dimensions.size() == 2 && mesh.dimension(*both, 0).length == 2;
    if (!apart && !together)
        mesh_->fail("",
                    "expected the places of the mesh's nodes, lon and lat or nodes, found none");
    const NcDimension& nodes = apart ? mesh.dimension(*lon, 0) : mesh.dimension(*both, 1);
    const NcDimension& faces = mesh.dimension(*triangles, 1 - corners);
    expectLength(nodes_, nodes.length);
    expectLength(triangles_, faces.length);
    const auto dimension = [&](std::optional<std::size_t> own, const NcDimension& of) {
        if (own) return *own;
        header_.dimensions.push_back({kGroup + '/' + of.name, of.length, false});
        return header_.dimensions.size() - 1;
    };
    const std::size_t node = dimension(nodes_, nodes), face = dimension(triangles_, faces),
                      corner = dimension(std::nullopt, mesh.dimension(*triangles, corners));
    for (const bool isLon : {true, false}) {
        NcVariable& added = add(
            kGroup + (isLon ? "/lon" : "/lat"),
            apart ? MeshSource{isLon ? lon : lat, {}} : MeshSource{both, isLon ? 0 : 1}, {node});
        if (added.text("units").empty() || !apart)
            say(added, "units", isLon ? "degrees_east" : "degrees_north");
    }
    NcVariable& connectivity =
        add(kGroup + "/face_nodes", {triangles, {}},
            corners == 0 ? std::vector{corner, face} : std::vector{face, corner});
    say(connectivity, "cf_role", "face_node_connectivity");
    if (!connectivity.find("start_index"))
        connectivity.attributes.push_back(
            {"start_index", std::vector<Number>{std::int64_t{1}}, ValueType::I32});
    NcVariable topology;
    topology.name = kGroup + "/topology";
    topology.group = kGroup;
    say(topology, "cf_role", "mesh_topology");
    say(topology, "node_coordinates", "lon lat");
    say(topology, "face_node_connectivity", "face_nodes");
    say(topology, "face_dimension", header_.dimensions[face].name);
    header_.variables.push_back(std::move(topology));
}

// Those of the values' own file, else of the mesh: heights below 0, or depths.
void FesomFile::addDepths(std::string_view name) {
    const auto dimension = dimensionOf(header_, name);
    if (!dimension) return;
    auto own = std::ranges::find(header_.variables, name, &NcVariable::name);
    if (own == header_.variables.end()) {
        const NcVariable* const found = mesh_->header().find(name, "");
        if (!found || !found->type || found->dimensions.size() != 1 ||
            mesh_->header().dimension(*found, 0).length != header_.dimensions[*dimension].length)
            return;
        add(std::string(name), {found, {}}, {*dimension});
        own = header_.variables.end() - 1;
        if (own->text("units").empty()) say(*own, "units", "m");
    }
    if (!own->isAlong(*dimension) || !own->text("positive").empty()) return;
    const std::vector<double> depths = valuesOf(*this, *own);
    if (!depths.empty()) say(*own, "positive", depths.back() > 0 ? "down" : "up");
}

void FesomFile::place(NcVariable& variable) const {
    if (variable.id < 0 || variable.group == kGroup) return;
    const bool atNodes = variable.positionOf(nodes_).has_value();
    if (!atNodes && !variable.positionOf(triangles_)) return;
    say(variable, "mesh", kGroup + "/topology");
    say(variable, "location", atNodes ? "node" : "face");
}

std::vector<Number> FesomFile::numbers(const NcVariable& variable) const {
    const MeshSource* const source = sourceOf(variable);
    if (!source) return values_->numbers(variable);
    std::vector<Number> all = mesh_->numbers(*source->variable);
    // Every corner is a node, where other meshes may have none.
    if (const auto first = variable.numbers("start_index"); !first.empty())
        for (const Number& node : all)
            if (!(toDouble(node) >= first[0]))
                throw AttributeError(
                    mesh_->sentence("variable '" + source->variable->name + "'",
                                    fmt::format("expected nodes counted from {}, found node {}",
                                                first[0], toDouble(node))));
    if (!source->row) return all;
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(*source->row * (all.size() / 2));
    return {first, first + static_cast<std::ptrdiff_t>(all.size() / 2)};
}

void FesomFile::read(const NcVariable& variable, std::span<const std::size_t> start,
                     std::span<const std::size_t> count, void* values) const {
    values_->read(variable, start, count, values);
    hide(variable, start, count, values);
}

// Counted from 1: those of interfaces; a layer lies between two of them.
const FesomFile::Levels& FesomFile::levelsOf(bool atNodes) const {
    const auto known = levels_.find(atNodes);
    if (known != levels_.end()) return known->second;
    const std::uint64_t places = header_.dimensions[atNodes ? *nodes_ : *triangles_].length;
    const auto read = [&](const char* name) {
        const NcVariable* const found = firstOf(mesh_->header(), {name});
        if (!found) return std::vector<double>();
        if (found->dimensions.size() != 1 || mesh_->header().dimension(*found, 0).length != places)
            mesh_->fail("variable '" + found->name + "'",
                        fmt::format("expected a number of each of {} places", places));
        return valuesOf(*mesh_, *found);
    };
    return levels_
        .emplace(atNodes, Levels{read(atNodes ? "ulevels_nod2D" : "ulevels"),
                                 read(atNodes ? "nlevels_nod2D" : "nlevels")})
        .first->second;
}

// What stands for no value, as the file says, else not a number.
template <typename T>
std::optional<T> missingOf(const NcVariable& variable) {
    if (const NcAttribute* const fill = variable.find("_FillValue"))
        if (const auto* numbers = std::get_if<std::vector<Number>>(&fill->value);
            numbers && numbers->size() == 1)
            return std::visit([](auto number) { return static_cast<T>(number); }, numbers->front());
    if constexpr (std::is_floating_point_v<T>) return std::numeric_limits<T>::quiet_NaN();
    return std::nullopt;
}

// What lies below the last level of its place or above its first.
void FesomFile::hide(const NcVariable& variable, std::span<const std::size_t> start,
                     std::span<const std::size_t> count, void* values) const {
    auto list = variable.positionOf(nodes_);
    const bool atNodes = list.has_value();
    if (!list) list = variable.positionOf(triangles_);
    auto vertical = variable.positionOf(dimensionOf(header_, kLevels));
    const bool areLayers = !vertical;
    if (!vertical) vertical = variable.positionOf(dimensionOf(header_, kLayers));
    if (!list || !vertical) return;
    const auto& levels = levelsOf(atNodes);
    const std::vector<double>&first = levels[0], &beyond = levels[1];
    if (first.empty() && beyond.empty()) return;
    std::size_t total = 1, listStride = 1, verticalStride = 1;
    for (std::size_t i = count.size(); i-- > 0; total *= count[i]) {
        if (i == *list) listStride = total;
        if (i == *vertical) verticalStride = total;
    }
    withType(*variable.type, [&]<typename T>(T) {
        const std::optional<T> missing = missingOf<T>(variable);
        if (!missing)
            failAttribute(variable,
                          "expected numbers with a point, or a _FillValue for what lies "
                          "below the sea floor");
        T* const all = static_cast<T*>(values);
        for (std::size_t i = 0; i < total; ++i) {
            const std::size_t place = start[*list] + i / listStride % count[*list];
            const auto level =
                static_cast<double>(start[*vertical] + i / verticalStride % count[*vertical] + 1);
            const bool isBelow = !beyond.empty() && !(level <= beyond[place] - (areLayers ? 1 : 0));
            if (isBelow || (!first.empty() && level < first[place])) all[i] = *missing;
        }
    });
}

// Values without a mesh of their own.
bool isFesom(const NcHeader& header) {
    if (trianglesOf(header)) return false;
    if (dimensionOf(header, kNodes)) return true;
    return dimensionOf(header, kTriangles) &&
           (dimensionOf(header, kLayers) || dimensionOf(header, kLevels));
}

}  // namespace

std::unique_ptr<CfFile> withFesomMesh(std::unique_ptr<NetcdfFile> file, NetcdfFile::Header header) {
    if (!isFesom(file->header())) return file;
    return std::make_unique<FesomFile>(std::move(file), header);
}

}  // namespace timeseries

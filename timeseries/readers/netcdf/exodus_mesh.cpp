#include "timeseries/readers/netcdf/exodus_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "timeseries/grid/with_type.h"

namespace timeseries {
namespace {

// What the names of elements begin with; their number of nodes tells which they are, as numbered in
// cell_types.h.
struct Kind {
    std::string_view begins;
    struct OfNodes {
        std::uint64_t nodes;  // or more
        std::uint8_t type;
    };
    std::array<OfNodes, 4> types;  // from the most nodes to the fewest
};
constexpr std::array kKinds{
    Kind{"hex", {{{9, 25}, {8, 12}}}},   Kind{"tet", {{{5, 24}, {4, 10}}}},
    Kind{"wedge", {{{7, 26}, {6, 13}}}}, Kind{"pyr", {{{6, 27}, {5, 14}}}},
    Kind{"quad", {{{5, 23}, {4, 9}}}},   Kind{"shell", {{{8, 23}, {6, 22}, {4, 9}, {3, 5}}}},
    Kind{"tri", {{{4, 22}, {3, 5}}}},    Kind{"bar", {{{3, 21}, {2, 3}}}},
    Kind{"beam", {{{3, 21}, {2, 3}}}},   Kind{"truss", {{{3, 21}, {2, 3}}}},
    Kind{"edge", {{{3, 21}, {2, 3}}}},   Kind{"sphere", {{{1, 1}}}},
    Kind{"circle", {{{1, 1}}}},
};

std::uint8_t typeOf(const std::string& name, std::uint64_t nodes) {
    const std::string small = lower(name);
    for (const Kind& kind : kKinds)
        if (small.starts_with(kind.begins))
            for (const auto& each : kind.types)
                if (each.nodes > 0 && nodes >= each.nodes) return each.type;
    return 0;
}

// use(i, number) for all numbers of a variable.
template <typename Use>
void forEach(const NetcdfFile& file, const NcVariable& variable, const Use& use) {
    std::vector<std::size_t> start(variable.dimensions.size()), count;
    std::size_t all = 1;
    for (std::size_t i = 0; i < start.size(); ++i) {
        count.push_back(file.header().dimension(variable, i).length);
        all *= count.back();
    }
    withType(*variable.type, [&]<typename T>(T) {
        std::vector<T> numbers(all);
        if (all > 0) file.read(variable, start, count, numbers.data());
        for (std::size_t i = 0; i < all; ++i) use(i, numbers[i]);
    });
}

// Each coordinate by itself, or all in one variable.
void addNodes(const NetcdfFile& file, UnstructuredGrid& grid) {
    const std::uint64_t nodes = exodusLength(file.header(), "num_nodes"),
                        dimensions = exodusLength(file.header(), "num_dim");
    if (dimensions < 1 || dimensions > 3 || nodes == 0)
        file.fail("", fmt::format("expected nodes in 1 to 3 dimensions, found {} in {}", nodes,
                                  dimensions));
    const auto take = [&](std::size_t node, std::uint64_t axis, double at) {
        grid.points[node][static_cast<int>(axis)] = at;
    };
    if (const NcVariable* all = exodusVariable(file, "coord", {dimensions, nodes})) {
        grid.points.assign(nodes, glm::dvec3(0));
        forEach(file, *all, [&](std::size_t i, auto at) {
            take(i % nodes, i / nodes, static_cast<double>(at));
        });
        return;
    }
    for (std::uint64_t axis = 0; axis < dimensions; ++axis) {
        const std::string name = fmt::format("coord{}", "xyz"[axis]);
        const NcVariable* one = exodusVariable(file, name, {nodes});
        if (!one) file.fail("", fmt::format("expected the variable {} of its mesh", name));
        if (axis == 0) grid.points.assign(nodes, glm::dvec3(0));
        forEach(file, *one,
                [&](std::size_t i, auto at) { take(i, axis, static_cast<double>(at)); });
    }
}

void addBlock(const NetcdfFile& file, std::size_t block, ExodusMesh& mesh) {
    UnstructuredGrid& grid = mesh.grid;
    const NcHeader& header = file.header();
    const std::uint64_t elements = exodusLength(header, fmt::format("num_el_in_blk{}", block));
    mesh.blocks.push_back(elements);
    if (elements == 0) return;
    const std::uint64_t nodes = exodusLength(header, fmt::format("num_nod_per_el{}", block));
    const std::string name = fmt::format("connect{}", block);
    const NcVariable* connect = nodes > 0 ? exodusVariable(file, name, {elements, nodes}) : nullptr;
    if (!connect)
        file.fail("", fmt::format("expected the variable {} of {} elements", name, elements));
    const std::string kind = connect->text("elem_type");
    const std::uint8_t type = typeOf(kind, nodes);
    if (type == 0)
        mesh.notes.push_back(
            fmt::format("{} elements of the kind \"{}\" are not drawn", elements, kind));
    const std::uint64_t points = grid.points.size();
    grid.types.resize(grid.types.size() + elements, type);
    for (std::uint64_t i = 1; i <= elements; ++i)
        grid.ends.push_back(grid.corners.size() + i * nodes);
    forEach(file, *connect, [&](std::size_t, auto number) {
        const bool isThere = number >= 1 && static_cast<std::uint64_t>(number) <= points;
        if (!isThere)
            grid.keepFirst({grid.corners.size(), static_cast<std::int64_t>(number), points});
        grid.corners.push_back(isThere ? static_cast<std::uint32_t>(number) - 1 : kNoPoint);
    });
}

}  // namespace

bool isExodus(const NcHeader& header) {
    const auto has = [&](std::string_view name) {
        return std::ranges::find(header.dimensions, name, &NcDimension::name) !=
               header.dimensions.end();
    };
    return has("num_dim") && has("num_nodes") && has("num_el_blk");
}

std::uint64_t exodusLength(const NcHeader& header, std::string_view dimension) {
    const auto found = std::ranges::find(header.dimensions, dimension, &NcDimension::name);
    return found == header.dimensions.end() ? 0 : found->length;
}

const NcVariable* exodusVariable(const NetcdfFile& file, const std::string& name,
                                 const std::vector<std::uint64_t>& lengths) {
    const NcVariable* found = file.header().find(name, "");
    if (!found) return nullptr;
    const std::string place = fmt::format("variable '{}'", name);
    std::vector<std::uint64_t> own;
    double points = 1;
    for (std::size_t i = 0; i < found->dimensions.size(); ++i) {
        own.push_back(file.header().dimension(*found, i).length);
        points *= static_cast<double>(own.back());
    }
    if (!found->type || own != lengths)
        file.fail(place, fmt::format("expected numbers of the dimensions {}, found {}",
                                     fmt::join(lengths, " x "), fmt::join(own, " x ")));
    // Of what has time a step is read at once.
    const bool isTimed = lengths.size() > 1 && name.starts_with("vals_");
    if (isTimed) points /= std::max(static_cast<double>(lengths[0]), 1.0);
    const auto count = static_cast<std::uint64_t>(std::min(points, 1e18));
    if (const std::string why = file.tooLarge(*found, count); !why.empty()) file.fail(place, why);
    return found;
}

ExodusMesh exodusMeshOf(const NetcdfFile& file) {
    ExodusMesh mesh;
    const std::uint64_t blocks = exodusLength(file.header(), "num_el_blk");
    if (blocks > file.header().variables.size())
        file.fail("", fmt::format("expected {} blocks of elements, but it has fewer", blocks));
    addNodes(file, mesh.grid);
    for (std::size_t block = 1; block <= blocks; ++block) addBlock(file, block, mesh);
    if (const std::string flaw = flawOf(mesh.grid); !flaw.empty())
        file.fail("connect", "expected elements of nodes that there are, found that " + flaw);
    for (std::string& note : notesOf(mesh.grid)) mesh.notes.push_back(std::move(note));
    return mesh;
}

}  // namespace timeseries

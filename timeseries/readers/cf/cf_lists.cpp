#include "timeseries/readers/cf/cf_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/cf/cf_mpas.h"
#include "timeseries/readers/cf/cf_polygons.h"
#include "timeseries/readers/cf/cf_seam.h"
#include "timeseries/readers/cf/cf_triangles.h"
#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

// What is neither time nor the list, and may be a coordinate of space, is the levels.
Roles rolesOn(const NcHeader& header, const NcVariable& variable, const Roles& before,
              std::size_t list) {
    Roles roles;
    roles.list = roles.x = list;
    if (before.t != list) roles.t = before.t;
    for (std::size_t i = variable.dimensions.size(); i-- > 0;) {
        if (i == list || roles.t == i || header.dimension(variable, i).length == 1) continue;
        const bool isSpace = std::ranges::find(before.extra, i) == before.extra.end();
        if (roles.z || !isSpace)
            roles.extra.push_back(i);
        else
            roles.z = i;
    }
    return roles;
}

// The corners of each place, in two variables of the list and one dimension more.
std::optional<FoundList> byBounds(const NcHeader& header, const NcVariable& variable,
                                  const Roles& roles,
                                  std::span<const NcVariable* const> geographic) {
    if (!roles.list) return std::nullopt;
    const std::size_t along = variable.dimensions[*roles.list];
    FoundList found{{}, rolesOn(header, variable, roles, *roles.list)};
    found.places.by = ColumnPlaces::By::Bounds;
    for (const NcVariable* each : geographic) {
        if (!each->isAlong(along)) continue;
        const NcVariable* const bounds = header.find(each->text("bounds"), each->group);
        if (!bounds || !bounds->type || bounds->dimensions.size() != 2 ||
            bounds->dimensions[0] != along)
            continue;
        auto& name = kindByAttributes(*each) == AxisKind::X ? found.places.x : found.places.y;
        if (name.empty()) name = each->name;
    }
    if (found.places.x.empty() || found.places.y.empty()) return std::nullopt;
    return found;
}

// Whether what a connectivity counts is its second dimension: the one that says so, else the first;
// but where that is as long as what is counted has corners, which are so many, and the second
// longer by far, as FVCOM writes nv(three, nele).
bool isTurned(const NcHeader& header, const NcVariable& connectivity, const std::string& counted,
              std::uint64_t leastCorners, std::uint64_t mostCorners) {
    const NcDimension &first = header.dimension(connectivity, 0),
                      &second = header.dimension(connectivity, 1);
    if (!counted.empty()) return second.name == counted;
    return first.length >= leastCorners && first.length <= mostCorners &&
           second.length >= 2 * mostCorners;
}

// As UGRID says it; or as SCHISM does, to which faces are elements, and edges sides.
std::string locationOf(const NcVariable& variable) {
    std::string location = lower(variable.text("location"));
    if (location.empty()) location = lower(variable.text("data_horizontal_center"));
    return location == "elem" ? "face" : location == "side" ? "edge" : location;
}

std::optional<FoundList> byMesh(const NcHeader& header, const NcVariable& variable,
                                const Roles& roles) {
    using By = ColumnPlaces::By;
    const NcVariable* const mesh = header.find(variable.text("mesh"), variable.group);
    const std::string location = locationOf(variable);
    if (!mesh || (location != "face" && location != "node" && location != "edge"))
        return std::nullopt;
    const NcVariable* const faces = header.find(mesh->text("face_node_connectivity"), mesh->group);
    const std::vector<std::string> names = words(mesh->text("node_coordinates"));
    if (!faces || !faces->type || faces->dimensions.size() != 2 || names.size() != 2)
        return std::nullopt;
    const NcVariable* x = header.find(names[0], mesh->group);
    const NcVariable* y = header.find(names[1], mesh->group);
    if (!x || !y || x->dimensions.size() != 1 || !y->isAlong(x->dimensions[0]) || !x->type)
        return std::nullopt;
    if (kindByAttributes(*x) == AxisKind::Y) std::swap(x, y);
    FoundList found{{.x = x->name, .y = y->name, .faces = faces->name}, {}};
    found.places.turned = isTurned(header, *faces, mesh->text("face_dimension"), 3, 4);
    std::size_t along = x->dimensions[0];
    if (location == "node") {
        found.places.by = By::Nodes;
    } else if (location == "face") {
        found.places.by = By::Faces;
        along = faces->dimensions[found.places.turned ? 1 : 0];
    } else {
        const NcVariable* const edges =
            header.find(mesh->text("edge_node_connectivity"), mesh->group);
        if (!edges || !edges->type || edges->dimensions.size() != 2) return std::nullopt;
        found.places.by = By::Edges;
        found.places.edges = edges->name;
        found.places.edgesTurned = isTurned(header, *edges, mesh->text("edge_dimension"), 2, 2);
        along = edges->dimensions[found.places.edgesTurned ? 1 : 0];
    }
    const auto list = variable.positionOf(along);
    if (!list) return std::nullopt;
    found.roles = rolesOn(header, variable, roles, *list);
    return found;
}

// Of which there are so many that each has a number of 32 bits.
std::vector<double> allOf(const CfFile& file, const NcVariable& variable) {
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        count *= std::min<std::uint64_t>(file.header().dimension(variable, i).length, 1ull << 31);
    if (const std::string why = file.tooLarge(variable, count); !why.empty())
        throw std::invalid_argument(why);
    if (count >= std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(variable.name + " has more than 2^32 numbers");
    return valuesOf(file, variable);
}

PlaneCoordinates coordinatesOf(const CfFile& file, const NcVariable& x, const NcVariable& y,
                               const std::string& units) {
    PlaneCoordinates all{allOf(file, x), allOf(file, y), turnIn(units) > 0 ? 360.0 : 0.0};
    const double degrees = degreesIn(units);
    for (auto* const values : {&all.x, &all.y})
        for (double& value : *values) value *= degrees;
    if (all.turn > 0) goOnAcrossTheSeam(all.x, all.y);
    return all;
}

const NcVariable& found(const CfFile& file, const std::string& name) {
    const NcVariable* const variable = file.header().find(name, "");
    if (!variable) file.fail("variable '" + name + "'", "expected it, but the file has changed");
    return *variable;
}

const NcVariable& boundsOf(const CfFile& file, const NcVariable& coordinate) {
    const NcVariable* const bounds =
        file.header().find(coordinate.text("bounds"), coordinate.group);
    if (!bounds || !bounds->type)
        file.fail("variable '" + coordinate.name + "'",
                  "expected bounds, but the file has changed");
    return *bounds;
}

// `each`: so many corners has a place.
struct BoundedPlaces {
    PlaneCoordinates centres, corners;
    std::size_t each;
};
BoundedPlaces boundedPlaces(const CfFile& file, const ColumnPlaces& places) {
    const NcVariable &x = found(file, places.x), &y = found(file, places.y);
    // Bounds have the units of what they bound.
    const std::string units = x.text("units");
    BoundedPlaces all{coordinatesOf(file, x, y, units),
                      coordinatesOf(file, boundsOf(file, x), boundsOf(file, y), units), 0};
    const std::size_t count = all.centres.x.size(), corners = all.corners.x.size();
    all.each = count > 0 ? corners / count : 0;
    if (corners != all.corners.y.size() || count != all.centres.y.size() ||
        all.each * count != corners)
        throw std::invalid_argument("its bounds are of other places");
    return all;
}

// Of each face its nodes, without those that there are not.
NodesOf facesOf(const CfFile& file, const ColumnPlaces& places, std::size_t nodes) {
    const NcVariable& faces = found(file, places.faces);
    if (faces.dimensions.size() != 2 || !faces.type)
        file.fail("variable '" + faces.name + "'", "expected faces, but the file has changed");
    const std::vector<double> all = allOf(file, faces);
    const NcAttribute* const start = faces.find("start_index");
    double first = places.firstNode;
    const auto* const numbers = start ? std::get_if<std::vector<Number>>(&start->value) : nullptr;
    if (numbers && !numbers->empty())
        first = toDouble(numbers->front());
    else if (const auto has = [&](double node) { return std::ranges::count(all, node) > 0; };
             first == 0 && has(double(nodes)) && !has(0))
        first = 1;  // nobody says so, but there is no such node where they count from 0
    const std::size_t rows = file.header().dimension(faces, 0).length,
                      columns = file.header().dimension(faces, 1).length;
    const std::size_t count = places.turned ? columns : rows;
    if (count > all.size()) throw std::invalid_argument("its faces have no nodes");
    const std::vector<double> sizes = places.faceSizes.empty()
                                          ? std::vector<double>()
                                          : allOf(file, found(file, places.faceSizes));
    if (!sizes.empty() && sizes.size() != count)
        throw std::invalid_argument(places.faceSizes + " is of other faces");
    NodesOf result(count);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double node = all[i] - first;
        if (!(node >= 0)) continue;  // none
        const std::size_t face = places.turned ? i % columns : i / columns;
        const std::size_t corner = places.turned ? i / columns : i % columns;
        if (!sizes.empty() && !(static_cast<double>(corner) < sizes[face])) continue;
        if (!(node < static_cast<double>(nodes)))
            throw std::invalid_argument(
                fmt::format("face {} has node {} of {}", face, all[i], nodes));
        result[face].push_back(static_cast<std::uint32_t>(node));
    }
    return result;
}

// Between columns that have several levels, above the triangles that `feet` tells.
std::shared_ptr<const Mesh> withPrisms(Mesh mesh, const std::vector<double>& levels, double turn,
                                       const std::function<std::vector<SolidCells::Foot>()>& feet) {
    if (levels.size() > 1) {
        double apart = 0;
        for (std::size_t k = 1; k < levels.size(); ++k)
            apart = std::max(apart, std::abs(levels[k] - levels[k - 1]));
        const auto all = std::make_shared<const std::vector<SolidCells::Foot>>(feet());
        const auto at = [&](std::uint32_t column) { return glm::dvec2(mesh.position(column)); };
        const glm::dvec3 longest(SolidCells::longestOf(*all, turn, at), apart);
        mesh.setSolids(SolidCells::ofColumns(all, mesh.size()[0], levels.size(), longest),
                       {turn, 0, 0});
    }
    return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace

bool saysMesh(const NcHeader& header, const NcVariable& variable) {
    const auto says = [&](const char* attribute) {
        return lower(variable.text(attribute)) == "unstructured";
    };
    return (variable.find("mesh") &&
            (!locationOf(variable).empty() || variable.find("location_index_set"))) ||
           says("grid_type") || says("CDI_grid_type") || isOnMpas(header, variable);
}

std::optional<FoundList> listOf(const NcHeader& header, const NcVariable& variable,
                                const Roles& roles, std::span<const NcVariable* const> geographic) {
    if (auto found = byMesh(header, variable, roles)) return found;
    if (auto mpas = mpasPlacesOf(header, variable)) {
        Roles on = rolesOn(header, variable, roles, mpas->list);
        if (mpas->levels && !on.z) {
            std::erase(on.extra, *mpas->levels);
            on.z = mpas->levels;
        }
        return FoundList{std::move(mpas->places), std::move(on)};
    }
    return byBounds(header, variable, roles, geographic);
}

std::shared_ptr<const Mesh> meshOfList(const CfFile& file, const ColumnPlaces& places,
                                       const std::vector<double>& levels) {
    if (places.by == ColumnPlaces::By::Bounds) {
        const BoundedPlaces all = boundedPlaces(file, places);
        const auto [grid, at] = polygonsAbout(all.centres, all.corners);
        return withPrisms(meshOfCells(grid, UnstructuredShapes(grid), levels, at), levels,
                          all.centres.turn, [&] {
                              NodesOf polygons;
                              const auto nodes = nodesAtCorners(all.corners, all.each, polygons);
                              return trianglesOfFaces(polygons, nodes);
                          });
    }
    const NcVariable &x = found(file, places.x), &y = found(file, places.y);
    const PlaneCoordinates nodes =
        coordinatesOf(file, x, y, places.units.empty() ? x.text("units") : places.units);
    if (nodes.x.size() != nodes.y.size())
        throw std::invalid_argument("its nodes have other numbers of coordinates");
    const NodesOf faces = facesOf(file, places, nodes.x.size());
    if (places.by == ColumnPlaces::By::Faces) {
        const UnstructuredGrid grid = polygonsOfFaces(nodes, faces);
        return withPrisms(meshOfCells(grid, UnstructuredShapes(grid), levels), levels, nodes.turn,
                          [&] { return trianglesOfFaces(faces, nodes.x.size()); });
    }
    if (places.by == ColumnPlaces::By::Edges) {
        ColumnPlaces ofEdges = places;
        ofEdges.faces = places.edges;
        ofEdges.turned = places.edgesTurned;
        ofEdges.faceSizes.clear();
        const auto [grid, at] =
            polygonsAboutEdges(nodes, faces, facesOf(file, ofEdges, nodes.x.size()));
        Mesh mesh = meshOfCells(grid, UnstructuredShapes(grid), levels, at);
        // The polygons about them are no cells of the file.
        MeshAbout about;
        about.points = MeshAbout::Points::Edges;
        mesh.setAbout(std::move(about));
        return std::make_shared<const Mesh>(std::move(mesh));
    }
    const UnstructuredGrid grid = polygonsAboutNodes(nodes, faces);
    return withPrisms(meshOfPoints(grid, UnstructuredShapes(grid), levels, nodes.x.size()), levels,
                      nodes.turn, [&] { return trianglesOfNodes(faces); });
}

}  // namespace timeseries

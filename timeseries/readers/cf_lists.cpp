#include "timeseries/readers/cf_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <stdexcept>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/cf_mpas.h"
#include "timeseries/readers/cf_values.h"

namespace timeseries {
namespace {

// As VTK numbers them (cell_types.h).
constexpr std::uint8_t kTriangle = 5, kPolygon = 7, kQuad = 9;

std::optional<std::size_t> positionOf(const NcVariable& variable, std::size_t dimension) {
    const auto found = std::ranges::find(variable.dimensions, dimension);
    if (found == variable.dimensions.end()) return std::nullopt;
    return static_cast<std::size_t>(found - variable.dimensions.begin());
}

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

std::optional<FoundList> byMesh(const NcHeader& header, const NcVariable& variable,
                                const Roles& roles) {
    using By = ColumnPlaces::By;
    const NcVariable* const mesh = header.find(variable.text("mesh"), variable.group);
    const std::string location = lower(variable.text("location"));
    if (!mesh || (location != "face" && location != "node")) return std::nullopt;
    const NcVariable* const faces = header.find(mesh->text("face_node_connectivity"), mesh->group);
    const std::vector<std::string> names = words(mesh->text("node_coordinates"));
    if (!faces || !faces->type || faces->dimensions.size() != 2 || names.size() != 2)
        return std::nullopt;
    const NcVariable* x = header.find(names[0], mesh->group);
    const NcVariable* y = header.find(names[1], mesh->group);
    if (!x || !y || x->dimensions.size() != 1 || !y->isAlong(x->dimensions[0]) || !x->type)
        return std::nullopt;
    if (kindByAttributes(*x) == AxisKind::Y) std::swap(x, y);
    // Which of its dimensions counts faces: the one that says so, else the first.
    const bool turned = header.dimension(*faces, 1).name == mesh->text("face_dimension");
    const std::size_t along =
        location == "node" ? x->dimensions[0] : faces->dimensions[turned ? 1 : 0];
    const auto list = positionOf(variable, along);
    if (!list) return std::nullopt;
    return FoundList{{.x = x->name,
                      .y = y->name,
                      .by = location == "node" ? By::Nodes : By::Faces,
                      .faces = faces->name,
                      .turned = turned},
                     rolesOn(header, variable, roles, *list)};
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

// Longitudes and latitudes in degrees, or coordinates in whatever they are measured.
struct Coordinates {
    std::vector<double> x, y;
    double turn = 0;  // after which x comes round to itself; 0: never
};

Coordinates coordinatesOf(const CfFile& file, const NcVariable& x, const NcVariable& y,
                          const std::string& units) {
    Coordinates all{allOf(file, x), allOf(file, y), turnIn(units) > 0 ? 360.0 : 0.0};
    const double degrees = degreesIn(units);
    for (auto* const values : {&all.x, &all.y})
        for (double& value : *values) value *= degrees;
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

constexpr double kPole = 90 - 1e-6;

// As near to the reference as whole turns bring it. At a pole every longitude is the same.
glm::dvec3 unwound(double x, double y, double reference, double turn) {
    if (turn > 0)
        x = std::abs(y) > kPole ? reference : x + turn * std::round((reference - x) / turn);
    return {x, y, 0};
}

void addPolygon(UnstructuredGrid& grid, std::vector<std::uint32_t>& corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    grid.types.push_back(corners.size() == 3 ? kTriangle : corners.size() == 4 ? kQuad : kPolygon);
    std::ranges::copy(corners, std::back_inserter(grid.corners));
    grid.ends.push_back(grid.corners.size());
}

bool isPole(double y, double turn) { return turn > 0 && std::abs(y) > kPole; }

// A polygon a place, with corners of its own.
class OwnCorners {
 public:
    explicit OwnCorners(double turn) : turn_(turn) {}
    // About that longitude; none: about that of the first corner that has one.
    void add(double reference, const std::vector<glm::dvec2>& corners) {
        indices_.clear();
        for (const glm::dvec2& corner : corners)
            if (!std::isfinite(reference) && !isPole(corner.y, turn_)) reference = corner.x;
        if (!std::isfinite(reference)) reference = 0;
        for (const glm::dvec2& corner : corners) {
            const glm::dvec3 at = unwound(corner.x, corner.y, reference, turn_);
            if (!indices_.empty() && grid_.points[indices_.back()] == at) continue;
            indices_.push_back(static_cast<std::uint32_t>(grid_.points.size()));
            grid_.points.push_back(at);
        }
        addPolygon(grid_, indices_);
    }
    const UnstructuredGrid& grid() const { return grid_; }

 private:
    double turn_;
    std::vector<std::uint32_t> indices_;
    UnstructuredGrid grid_;
};

// With the places that the file gives them.
struct PlacedPolygons {
    UnstructuredGrid grid;
    std::vector<glm::dvec3> places;
};

PlacedPolygons polygonsOfBounds(const CfFile& file, const ColumnPlaces& places) {
    const NcVariable &x = found(file, places.x), &y = found(file, places.y);
    // Bounds have the units of what they bound.
    const std::string units = x.text("units");
    const Coordinates centres = coordinatesOf(file, x, y, units);
    const Coordinates corners = coordinatesOf(file, boundsOf(file, x), boundsOf(file, y), units);
    const std::size_t count = centres.x.size(), each = count > 0 ? corners.x.size() / count : 0;
    if (corners.x.size() != corners.y.size() || count != centres.y.size() ||
        each * count != corners.x.size())
        throw std::invalid_argument("its bounds are of other places");
    OwnCorners polygons(centres.turn);
    PlacedPolygons result;
    std::vector<glm::dvec2> polygon;
    for (std::size_t place = 0; place < count; ++place) {
        polygon.clear();
        for (std::size_t i = place * each; i < (place + 1) * each; ++i)
            if (std::isfinite(corners.x[i]) && std::isfinite(corners.y[i]))
                polygon.emplace_back(corners.x[i], corners.y[i]);
        polygons.add(centres.x[place], polygon);
        result.places.emplace_back(centres.x[place], centres.y[place], 0);
    }
    result.grid = polygons.grid();
    return result;
}

// Of each which nodes it has, without those that there are not.
using Faces = std::vector<std::vector<std::uint32_t>>;

Faces facesOf(const CfFile& file, const ColumnPlaces& places, std::size_t nodes) {
    const NcVariable& faces = found(file, places.faces);
    if (faces.dimensions.size() != 2 || !faces.type)
        file.fail("variable '" + faces.name + "'", "expected faces, but the file has changed");
    const std::vector<double> all = allOf(file, faces);
    const NcAttribute* const start = faces.find("start_index");
    double first = places.firstNode;
    if (start)
        if (const auto* numbers = std::get_if<std::vector<Number>>(&start->value);
            numbers && !numbers->empty())
            first = toDouble(numbers->front());
    const std::size_t rows = file.header().dimension(faces, 0).length,
                      columns = file.header().dimension(faces, 1).length;
    const std::size_t count = places.turned ? columns : rows;
    if (count > all.size()) throw std::invalid_argument("its faces have no nodes");
    const std::vector<double> sizes = places.faceSizes.empty()
                                          ? std::vector<double>()
                                          : allOf(file, found(file, places.faceSizes));
    if (!sizes.empty() && sizes.size() != count)
        throw std::invalid_argument(places.faceSizes + " is of other faces");
    Faces result(count);
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

UnstructuredGrid polygonsOfFaces(const Coordinates& nodes, const Faces& faces) {
    OwnCorners polygons(nodes.turn);
    std::vector<glm::dvec2> polygon;
    for (const auto& face : faces) {
        polygon.clear();
        for (const std::uint32_t node : face)
            if (std::isfinite(nodes.x[node]) && std::isfinite(nodes.y[node]))
                polygon.emplace_back(nodes.x[node], nodes.y[node]);
        polygons.add(std::numeric_limits<double>::quiet_NaN(), polygon);
    }
    return polygons.grid();
}

// The nodes, and the faces about them. One that lies where longitudes begin anew is there once for
// either side, with corners on the other side that are no nodes.
UnstructuredGrid polygonsAboutNodes(const Coordinates& nodes, const Faces& faces) {
    UnstructuredGrid grid;
    for (std::size_t i = 0; i < nodes.x.size(); ++i)
        grid.points.emplace_back(nodes.x[i], nodes.y[i], 0);
    std::vector<std::uint32_t> corners;
    const auto add = [&](const std::vector<std::uint32_t>& face, double reference) {
        corners.clear();
        bool crosses = false;
        double other = reference;
        for (const std::uint32_t node : face) {
            const glm::dvec3 at = unwound(nodes.x[node], nodes.y[node], reference, nodes.turn);
            if (at.x == nodes.x[node]) {
                corners.push_back(node);
                continue;
            }
            if (!isPole(nodes.y[node], nodes.turn)) {
                crosses = true;
                other = nodes.x[node];
            }
            corners.push_back(static_cast<std::uint32_t>(grid.points.size()));
            grid.points.push_back(at);
        }
        addPolygon(grid, corners);
        return crosses ? std::optional(other) : std::nullopt;
    };
    for (const auto& face : faces) {
        const auto first = std::ranges::find_if(
            face, [&](std::uint32_t node) { return !isPole(nodes.y[node], nodes.turn); });
        if (first == face.end()) continue;
        if (const auto other = add(face, nodes.x[*first])) add(face, *other);
    }
    return grid;
}

}  // namespace

bool saysMesh(const NcHeader& header, const NcVariable& variable) {
    const auto says = [&](const char* attribute) {
        return lower(variable.text(attribute)) == "unstructured";
    };
    return (variable.find("mesh") &&
            (variable.find("location") || variable.find("location_index_set"))) ||
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
        const auto [grid, at] = polygonsOfBounds(file, places);
        return std::make_shared<const Mesh>(
            meshOfCells(grid, UnstructuredShapes(grid), levels, at));
    }
    const NcVariable &x = found(file, places.x), &y = found(file, places.y);
    const Coordinates nodes =
        coordinatesOf(file, x, y, places.units.empty() ? x.text("units") : places.units);
    if (nodes.x.size() != nodes.y.size())
        throw std::invalid_argument("its nodes have other numbers of coordinates");
    const Faces faces = facesOf(file, places, nodes.x.size());
    if (places.by == ColumnPlaces::By::Faces) {
        const UnstructuredGrid grid = polygonsOfFaces(nodes, faces);
        return std::make_shared<const Mesh>(meshOfCells(grid, UnstructuredShapes(grid), levels));
    }
    const UnstructuredGrid grid = polygonsAboutNodes(nodes, faces);
    return std::make_shared<const Mesh>(
        meshOfPoints(grid, UnstructuredShapes(grid), levels, nodes.x.size()));
}

}  // namespace timeseries

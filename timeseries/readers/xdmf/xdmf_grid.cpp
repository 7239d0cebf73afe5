#include "timeseries/readers/xdmf/xdmf_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "timeseries/grid/middles.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

// How a file names the shapes of cells, in words, or among others by number; and VTK's number.
struct NamedShape {
    std::string_view name;
    std::uint32_t number, nodes;  // nodes 0: as many as the file says
    std::uint8_t shape;
};
constexpr std::array kShapes{
    NamedShape{"polyvertex", 1, 0, 2},        NamedShape{"polyline", 2, 0, 4},
    NamedShape{"polygon", 3, 0, 7},           NamedShape{"triangle", 4, 3, 5},
    NamedShape{"quadrilateral", 5, 4, 9},     NamedShape{"tetrahedron", 6, 4, 10},
    NamedShape{"pyramid", 7, 5, 14},          NamedShape{"wedge", 8, 6, 13},
    NamedShape{"hexahedron", 9, 8, 12},       NamedShape{"edge_3", 34, 3, 21},
    NamedShape{"quadrilateral_9", 35, 9, 28}, NamedShape{"triangle_6", 36, 6, 22},
    NamedShape{"quadrilateral_8", 37, 8, 23}, NamedShape{"tetrahedron_10", 38, 10, 24},
    NamedShape{"pyramid_13", 39, 13, 27},     NamedShape{"wedge_15", 40, 15, 26},
    NamedShape{"wedge_18", 41, 18, 32},       NamedShape{"hexahedron_20", 48, 20, 25},
    NamedShape{"hexahedron_24", 49, 24, 33},  NamedShape{"hexahedron_27", 50, 27, 29},
    NamedShape{"tri_6", 36, 6, 22},           NamedShape{"quad_8", 37, 8, 23},
    NamedShape{"quad_9", 35, 9, 28},          NamedShape{"tet_10", 38, 10, 24},
    NamedShape{"hex_20", 48, 20, 25},         NamedShape{"hex_24", 49, 24, 33},
    NamedShape{"hex_27", 50, 27, 29},
};

std::string kindOf(const XdmfElement& element, const char* attribute) {
    const std::string kind = element.attribute(attribute);
    return lower(kind.empty() ? element.attribute("Type") : kind);
}
std::string topologyOf(const XdmfElement& topology) { return kindOf(topology, "TopologyType"); }
std::string geometryOf(const XdmfElement& geometry) {
    const std::string kind = kindOf(geometry, "GeometryType");
    return kind.empty() ? "xyz" : kind;
}

XdmfElement expected(const XdmfDocument& document, const XdmfElement& grid, const char* name) {
    const XdmfElement found = document.child(grid, name);
    if (!found.exists()) document.fail(grid, fmt::format("expected a {} in a Grid", name));
    return found;
}

}  // namespace

XdmfGrid::XdmfGrid(const XdmfDocument& document, XdmfItems& items, const XdmfStep& step)
    : document_(document), items_(items), first_(expected(document, step.parts[0], "Topology")) {
    shape_ = shapeOf(first_);
    cells_.inParts = step.parts.size() > 1;
    for (const XdmfElement& part : step.parts) {
        const XdmfElement topology = expected(document_, part, "Topology"),
                          geometry = expected(document_, part, "Geometry");
        if (shapeOf(topology).isStructured != shape_.isStructured ||
            (shape_.isStructured && step.parts.size() > 1))
            document_.fail(part, fmt::format("expected one structured grid a step, found {} grids, "
                                             "which are not joined",
                                             step.parts.size()));
        if (shape_.isStructured) {
            const auto points = sizeAt(true), cells = sizeAt(false);
            parts_.push_back({std::uint64_t{points[0]} * points[1] * points[2],
                              std::uint64_t{cells[0]} * cells[1] * cells[2]});
            if (!shape_.hasPlaces) {
                readAxes(geometry);
                continue;
            }
            places_ = placesOf(geometry);
            if (places_.size() != parts_[0].points)
                document_.fail(geometry, fmt::format("expected {} places, found {}",
                                                     parts_[0].points, places_.size()));
            continue;
        }
        const auto places = placesOf(geometry);
        const std::uint64_t cells = cells_.types.size();
        addCells(topology, places.size());
        cells_.points.insert(cells_.points.end(), places.begin(), places.end());
        parts_.push_back({places.size(), cells_.types.size() - cells});
    }
    if (const std::string flaw = flawOf(cells_); !flaw.empty())
        document_.fail(first_, "expected cells of points that there are, found that " + flaw);
}

std::string XdmfGrid::sourceOf(const XdmfDocument& document, XdmfItems& items,
                               const XdmfStep& step) {
    std::string all;
    for (const XdmfElement& grid : step.parts)
        for (const char* name : {"Topology", "Geometry"}) {
            const XdmfElement of = expected(document, grid, name);
            all += topologyOf(of) + ' ' + geometryOf(of);
            for (const char* more :
                 {"Dimensions", "NumberOfElements", "NodesPerElement", "BaseOffset"})
                all += ' ' + of.attribute(more);
            for (const XdmfElement& item : document.children(of, "DataItem"))
                all += '\n' + items.sourceOf(item);
        }
    return all;
}

XdmfGrid::Shape XdmfGrid::shapeOf(const XdmfElement& topology) const {
    const std::string kind = topologyOf(topology);
    Shape shape;
    if (!kind.ends_with("mesh")) return shape;
    const std::size_t dimensions = kind.starts_with("2d") ? 2 : 3;
    const std::string rest = kind.substr(std::min<std::size_t>(2, kind.size()));
    if (!(kind.starts_with("2d") || kind.starts_with("3d")) ||
        !(rest == "smesh" || rest == "rectmesh" || rest == "corectmesh"))
        document_.fail(topology,
                       fmt::format("expected a TopologyType that is read, found {}", kind));
    std::string text = topology.attribute("Dimensions");
    if (text.empty()) text = topology.attribute("NumberOfElements");
    auto lengths = items_.lengths(topology, text);
    // A plane may be said as a volume of one layer.
    while (lengths.size() > dimensions && lengths.front() == 1) lengths.erase(lengths.begin());
    std::uint64_t points = 1;
    for (const std::uint64_t length : lengths) points *= length;
    if (lengths.size() != dimensions || points < 1 || points > kMaxPoints)
        document_.fail(topology, fmt::format("expected {} Dimensions of a grid of at most 2^32 "
                                             "points, found '{}'",
                                             dimensions, text));
    shape.isStructured = true;
    shape.hasPlaces = rest == "smesh";
    for (std::size_t d = 0; d < dimensions; ++d) shape.size[d] = lengths[dimensions - 1 - d];
    return shape;
}

std::array<std::size_t, 3> XdmfGrid::sizeAt(bool atPoints) const {
    auto size = shape_.size;
    if (!atPoints)
        for (std::size_t& length : size) length = std::max<std::size_t>(length - 1, 1);
    return size;
}

std::vector<glm::dvec3> XdmfGrid::placesOf(const XdmfElement& geometry) {
    const std::string kind = geometryOf(geometry);
    const bool apart = kind == "x_y_z" || kind == "x_y";
    const int along = kind == "xyz" || kind == "x_y_z" ? 3 : kind == "xy" || kind == "x_y" ? 2 : 0;
    const auto items = document_.children(geometry, "DataItem");
    if (along == 0 || items.size() != (apart ? static_cast<std::size_t>(along) : 1))
        document_.fail(geometry,
                       fmt::format("expected the arrays of a Geometry of XYZ, XY, X_Y_Z or "
                                   "X_Y, found {} and {} of them",
                                   kind, items.size()));
    std::vector<glm::dvec3> places;
    const auto width = static_cast<std::size_t>(apart ? 1 : along);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::vector<double> all = items_.numbers(items[i]);
        if (all.size() % width != 0 || (i > 0 && all.size() != places.size()) ||
            all.size() / width > kMaxPoints)
            document_.fail(items[i], fmt::format("expected {} numbers for each of as many points, "
                                                 "found {} in all",
                                                 width, all.size()));
        places.resize(all.size() / width, glm::dvec3(0));
        for (std::size_t n = 0; n < all.size(); ++n)
            places[n / width][static_cast<int>(apart ? i : n % width)] = all[n];
    }
    return places;
}

// Values of each axis, x first; or an origin and steps, the slowest first, as ParaView and VisIt
// take them.
void XdmfGrid::readAxes(const XdmfElement& geometry) {
    const std::string kind = geometryOf(geometry);
    const auto items = document_.children(geometry, "DataItem");
    const std::size_t dimensions = kind == "vxvy" || kind == "origin_dxdy" ? 2 : 3;
    for (std::size_t d = dimensions; d < 3; ++d) coordinates_[d].assign(shape_.size[d], 0.0);
    if (kind == "vxvyvz" || kind == "vxvy") {
        if (items.size() != dimensions)
            document_.fail(geometry,
                           fmt::format("expected {} arrays, found {}", dimensions, items.size()));
        for (std::size_t d = 0; d < dimensions; ++d) coordinates_[d] = items_.numbers(items[d]);
    } else if (kind == "origin_dxdydz" || kind == "origin_dxdy") {
        const auto numbers = [&](std::size_t which) {
            auto all = which < items.size() ? items_.numbers(items[which]) : std::vector<double>();
            if (all.size() != dimensions)
                document_.fail(
                    geometry,
                    fmt::format("expected an origin and steps, {} numbers each", dimensions));
            std::ranges::reverse(all);
            return all;
        };
        const auto origin = numbers(0), step = numbers(1);
        for (std::size_t d = 0; d < dimensions; ++d) {
            if (shape_.size[d] > kMaxAxis)
                document_.fail(geometry,
                               fmt::format("expected at most {} points along an axis", kMaxAxis));
            coordinates_[d] = indexCoordinates(shape_.size[d]);
            for (double& c : coordinates_[d]) c = origin[d] + step[d] * c;
        }
    } else {
        document_.fail(geometry,
                       fmt::format("expected a Geometry of VXVYVZ, VXVY, ORIGIN_DXDYDZ or "
                                   "ORIGIN_DXDY, found {}",
                                   kind));
    }
    for (std::size_t d = 0; d < 3; ++d)
        if (coordinates_[d].size() != shape_.size[d])
            document_.fail(geometry, fmt::format("expected {} coordinates along axis {}, found {}",
                                                 shape_.size[d], d, coordinates_[d].size()));
}

// Points, the first of all parts before added; beyond all others what is none.
std::vector<std::uint32_t> XdmfGrid::idsOf(const XdmfElement& topology, std::uint64_t below) {
    const auto items = document_.children(topology, "DataItem");
    if (items.size() != 1)
        document_.fail(topology, fmt::format("expected one array, found {}", items.size()));
    const Values values = items_.read(items[0]);
    std::vector<std::uint32_t> ids;
    std::visit(
        [&](const auto& all) {
            ids.reserve(all.size());
            for (const auto id : all)
                ids.push_back(id >= 0 && static_cast<double>(id) < static_cast<double>(below)
                                  ? static_cast<std::uint32_t>(id)
                                  : kNoPoint);
        },
        values);
    return ids;
}

void XdmfGrid::addCells(const XdmfElement& topology, std::uint64_t points) {
    const std::string kind = topologyOf(topology);
    const std::uint64_t before = cells_.points.size();
    if (before + points >= kNoPoint)
        document_.fail(topology, "expected fewer than 2^32 points, found more");
    const auto single = [&](const char* name, std::uint64_t otherwise) {
        const auto found = items_.lengths(topology, topology.attribute(name));
        return found.empty() ? otherwise : found[0];
    };
    const std::uint64_t base = single("BaseOffset", 0);
    const auto place = [&](std::uint32_t id) {
        return id < base || id - base >= points ? kNoPoint
                                                : static_cast<std::uint32_t>(before + id - base);
    };
    const auto named = std::ranges::find(kShapes, kind, &NamedShape::name);
    const std::size_t first = cells_.corners.size();
    if (kind == "mixed") {
        // Numbers of shapes and counts stand among the points: none is too large yet.
        addMixed(topology, idsOf(topology, kNoPoint));
    } else if (named == kShapes.end()) {
        document_.fail(topology,
                       fmt::format("expected a TopologyType that is read, found '{}'", kind));
    } else if (named->number == 1 && !document_.child(topology, "DataItem").exists()) {
        for (std::uint64_t i = 0; i < points; ++i) {
            cells_.types.push_back(named->shape);
            cells_.corners.push_back(static_cast<std::uint32_t>(base + i));
            cells_.ends.push_back(cells_.corners.size());
        }
    } else {
        const std::uint64_t nodes =
            named->nodes > 0 ? named->nodes : single("NodesPerElement", named->number == 1 ? 1 : 0);
        const auto ids = idsOf(topology, kNoPoint);
        if (nodes == 0 || ids.size() % nodes != 0)
            document_.fail(topology,
                           fmt::format("expected {} corners of each cell, found {} in all", nodes,
                                       ids.size()));
        cells_.corners.insert(cells_.corners.end(), ids.begin(), ids.end());
        for (std::uint64_t end = nodes; end <= ids.size(); end += nodes) {
            cells_.types.push_back(named->shape);
            cells_.ends.push_back(first + end);
        }
    }
    for (std::size_t i = first; i < cells_.corners.size(); ++i) {
        const std::uint32_t id = cells_.corners[i];
        cells_.corners[i] = place(id);
        if (cells_.corners[i] == kNoPoint && id != kNoPoint)
            cells_.keepFirst({i, static_cast<std::int64_t>(id), points});
    }
}

// Each cell is the number of its shape, of some how many corners, and these.
void XdmfGrid::addMixed(const XdmfElement& topology, const std::vector<std::uint32_t>& stream) {
    for (std::size_t at = 0; at < stream.size();) {
        const std::uint32_t number = stream[at++];
        const auto shape = std::ranges::find(kShapes, number, &NamedShape::number);
        if (shape == kShapes.end())
            document_.fail(topology,
                           fmt::format("expected the number of a shape that is read, found "
                                       "{} as number {}",
                                       number, at - 1));
        std::uint64_t nodes = shape->nodes;
        if (nodes == 0 && at < stream.size()) nodes = stream[at++];
        if (nodes == 0 || nodes > stream.size() - at)
            document_.fail(topology, fmt::format("expected {} corners from number {} on, found {}",
                                                 nodes, at, stream.size() - at));
        for (std::uint64_t i = 0; i < nodes; ++i) cells_.corners.push_back(stream[at++]);
        cells_.types.push_back(shape->shape);
        cells_.ends.push_back(cells_.corners.size());
    }
}

std::vector<std::string> XdmfGrid::notes() const {
    return isUnstructured() ? notesOf(cells_) : std::vector<std::string>();
}

std::shared_ptr<const Grid> XdmfGrid::made(bool atPoints) {
    if (isUnstructured()) {
        if (!shapes_) shapes_.emplace(cells_);
        return std::make_shared<const Grid>(
            spaceAxes(), std::make_shared<const Mesh>(atPoints ? meshOfPoints(cells_, *shapes_)
                                                               : meshOfCells(cells_, *shapes_)));
    }
    if (shape_.hasPlaces) {
        MeshPlaces places{.size = sizeAt(atPoints), .at = {}};
        if (atPoints) {
            places.at = places_;
        } else {
            places.corners = {shape_.size, places_};
            places.at = middlesOf(places_, shape_.size);
        }
        return std::make_shared<const Grid>(spaceAxes(), std::make_shared<const Mesh>(places));
    }
    constexpr std::array kAxes{"x", "y", "z"};
    std::array<Axis, 3> axes;
    for (std::size_t d = 0; d < 3; ++d)
        axes[d] = {kAxes[d], "", atPoints ? coordinates_[d] : middlesOf(coordinates_[d]), false};
    return std::make_shared<const Grid>(std::move(axes));
}

std::shared_ptr<const Grid> XdmfGrid::at(bool atPoints) {
    auto& grid = grids_[atPoints ? 1 : 0];
    if (grid) return grid;
    try {
        return grid = made(atPoints);
    } catch (const std::invalid_argument& flaw) {
        document_.fail(first_,
                       fmt::format("expected cells that take space, found that {}", flaw.what()));
    }
}

}  // namespace timeseries

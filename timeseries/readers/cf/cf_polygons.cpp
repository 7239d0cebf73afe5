#include "timeseries/readers/cf/cf_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <unordered_map>

namespace timeseries {
namespace {

// As VTK numbers them (cell_types.h).
constexpr std::uint8_t kTriangle = 5, kPolygon = 7, kQuad = 9;

// As near to the reference as whole turns bring it. At a pole every longitude is the same.
glm::dvec3 unwound(double x, double y, double reference, double turn) {
    if (turn > 0) x = isPole(y, turn) ? reference : x + turn * std::round((reference - x) / turn);
    return {x, y, 0};
}

void addPolygon(UnstructuredGrid& grid, std::vector<std::uint32_t>& corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    grid.types.push_back(corners.size() == 3 ? kTriangle : corners.size() == 4 ? kQuad : kPolygon);
    std::ranges::copy(corners, std::back_inserter(grid.corners));
    grid.ends.push_back(grid.corners.size());
}

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
    UnstructuredGrid taken() { return std::move(grid_); }

 private:
    double turn_;
    std::vector<std::uint32_t> indices_;
    UnstructuredGrid grid_;
};

// The mean of those of its nodes' that lie somewhere, and not at a pole; not finite where none
// does.
double longitudeOf(const PlaneCoordinates& nodes, const std::vector<std::uint32_t>& face) {
    double first = std::numeric_limits<double>::quiet_NaN(), sum = 0;
    int count = 0;
    for (const std::uint32_t node : face) {
        const double x = nodes.x[node], y = nodes.y[node];
        if (!std::isfinite(x) || !std::isfinite(y) || isPole(y, nodes.turn)) continue;
        if (count == 0) first = x;
        sum += unwound(x, y, first, nodes.turn).x;
        ++count;
    }
    return sum / count;
}

// Longitudes from the least one of any node on, once round: where faces lie across the seam, some
// before it and some behind, what they are drawn on would be wider than the Earth.
class OnceRound {
 public:
    OnceRound(const PlaneCoordinates& nodes, const NodesOf& faces) : turn_(nodes.turn) {
        for (const auto& face : faces)
            for (const std::uint32_t node : face)
                if (!isPole(nodes.y[node], turn_) && std::isfinite(nodes.x[node]))
                    least_ = std::min(least_, nodes.x[node]);
    }
    double operator()(double x) const {
        return turn_ > 0 && std::isfinite(least_) ? x - turn_ * std::floor((x - least_) / turn_)
                                                  : x;
    }

 private:
    double turn_, least_ = std::numeric_limits<double>::infinity();
};

// Of those of its nodes that lie somewhere; nothing when none does.
std::optional<glm::dvec2> middleOf(const PlaneCoordinates& nodes,
                                   const std::vector<std::uint32_t>& face) {
    double reference = std::numeric_limits<double>::quiet_NaN();
    for (const std::uint32_t node : face)
        if (!std::isfinite(reference) && !isPole(nodes.y[node], nodes.turn))
            reference = nodes.x[node];
    glm::dvec2 sum(0);
    int count = 0;
    for (const std::uint32_t node : face) {
        const glm::dvec3 at = unwound(nodes.x[node], nodes.y[node], reference, nodes.turn);
        if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
        sum += glm::dvec2(at);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / static_cast<double>(count);
}

std::uint64_t sideOf(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

constexpr std::uint32_t kNoFace = 0xFFFFFFFF;
using FacesAtSide = std::array<std::uint32_t, 2>;

// Of a side that more than two faces share the first two.
std::unordered_map<std::uint64_t, FacesAtSide> facesAtSides(const NodesOf& faces) {
    std::unordered_map<std::uint64_t, FacesAtSide> sides;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < faces[f].size(); ++i) {
            const std::uint64_t side = sideOf(faces[f][i], faces[f][(i + 1) % faces[f].size()]);
            auto& at = sides.try_emplace(side, FacesAtSide{kNoFace, kNoFace}).first->second;
            for (std::uint32_t& each : at)
                if (each == kNoFace) {
                    each = static_cast<std::uint32_t>(f);
                    break;
                }
        }
    return sides;
}

}  // namespace

PlacedPolygons polygonsAbout(const PlaneCoordinates& centres, const PlaneCoordinates& corners) {
    const std::size_t count = centres.x.size(), each = count > 0 ? corners.x.size() / count : 0;
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
    result.grid = polygons.taken();
    return result;
}

UnstructuredGrid polygonsOfFaces(const PlaneCoordinates& nodes, const NodesOf& faces) {
    OwnCorners polygons(nodes.turn);
    const OnceRound onceRound(nodes, faces);
    std::vector<glm::dvec2> polygon;
    for (const auto& face : faces) {
        polygon.clear();
        for (const std::uint32_t node : face)
            if (std::isfinite(nodes.x[node]) && std::isfinite(nodes.y[node]))
                polygon.emplace_back(nodes.x[node], nodes.y[node]);
        polygons.add(onceRound(longitudeOf(nodes, face)), polygon);
    }
    return polygons.taken();
}

UnstructuredGrid polygonsAboutNodes(const PlaneCoordinates& nodes, const NodesOf& faces) {
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

PlacedPolygons polygonsAboutEdges(const PlaneCoordinates& nodes, const NodesOf& faces,
                                  const NodesOf& edges) {
    const auto sides = facesAtSides(faces);
    const OnceRound onceRound(nodes, edges);
    OwnCorners polygons(nodes.turn);
    PlacedPolygons result;
    std::vector<glm::dvec2> polygon;
    for (const auto& edge : edges) {
        polygon.clear();
        glm::dvec3 place(std::numeric_limits<double>::quiet_NaN());
        double reference = place.x;
        if (edge.size() == 2) {
            reference = onceRound(longitudeOf(nodes, edge));
            const auto end = [&](std::size_t i) {
                return unwound(nodes.x[edge[i]], nodes.y[edge[i]], reference, nodes.turn);
            };
            place = (end(0) + end(1)) / 2.0;
            const auto found = sides.find(sideOf(edge[0], edge[1]));
            for (std::size_t i = 0; i < 2; ++i) {
                polygon.emplace_back(end(i));
                const std::uint32_t face = found == sides.end() ? kNoFace : found->second[i];
                if (face == kNoFace) continue;
                if (const auto middle = middleOf(nodes, faces[face])) polygon.push_back(*middle);
            }
        }
        std::erase_if(polygon, [](const glm::dvec2& at) {
            return !std::isfinite(at.x) || !std::isfinite(at.y);
        });
        polygons.add(reference, polygon);
        result.places.push_back(place);
    }
    result.grid = polygons.taken();
    return result;
}

}  // namespace timeseries

#include "render/splat/mesh_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace render {
namespace {

// Of a step to the next point: nearer to each other the ends of a grid are one place.
constexpr double kOnePlace = 1e-3;
// Steps between neighbours from a cell's first corner to any other, one along each index, and half
// a one more for each that is beyond the outermost points.
constexpr double kSteps = 4.5;
constexpr double kRounded = 1e-6;  // of the mesh's extent, more than its places are (Mesh)

}  // namespace

unsigned fillMissing(std::array<double, 8>& corners) {
    if (std::ranges::none_of(corners, [](double v) { return std::isnan(v); })) return 255;
    unsigned there = 0;
    for (unsigned c = 0; c < 8; ++c)
        if (!std::isnan(corners[c])) there |= 1u << c;
    const std::array<double, 8> given = corners;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    for (unsigned c = 0; c < 8 && there != 0; ++c) {
        for (int away = 1; std::isnan(corners[c]); ++away) {
            double sum = 0, least = kFar, greatest = -kFar;
            int count = 0;
            for (unsigned other = 0; other < 8; ++other) {
                if (std::popcount(other ^ c) != away || (there >> other & 1) == 0) continue;
                sum += given[other] / 4;  // of three at most
                least = std::min(least, given[other]);
                greatest = std::max(greatest, given[other]);
                ++count;
            }
            if (count > 0) corners[c] = std::clamp(sum * (4.0 / count), least, greatest);
        }
    }
    return there;
}

MeshCells::MeshCells(const PlacedPoints& placed, const timeseries::CellCorners& corners,
                     const IndexBox& clip, const timeseries::PointGradients* gradients)
    : placed_(placed),
      corners_(corners),
      clip_(clip),
      cut_(placed, clip),
      gradients_(placed, gradients),
      points_(placed.size()) {
    const glm::dvec3 scale = placed.scale();
    const timeseries::Mesh& mesh = *placed.mesh();
    period_ = placed.period();
    reach_ = reachOf(placed, kSteps * mesh.longestWay());
    if (points_.x == 1 || points_.y == 1 || points_.z == 1)
        reach_ = glm::dvec3(std::numeric_limits<double>::infinity());
    byPoints_ = !clip.holdsAll() && !cut_.cuts();
    isLeft_ = placed.mesh()->stored().turned != (scale.x * scale.y * scale.z < 0);
}

glm::dvec3 MeshCells::reachOf(const PlacedPoints& placed, const glm::dvec3& length) {
    const timeseries::Mesh& mesh = *placed.mesh();
    return glm::abs(placed.scale()) * (length + kRounded * (mesh.hi() - mesh.lo()));
}

std::pair<double, double> MeshCells::extentOf(std::uint32_t cell) const {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const double v : corners_.values(at(cell))) {
        lo = std::isnan(v) ? lo : std::min(lo, v);
        hi = std::isnan(v) ? hi : std::max(hi, v);
    }
    return {lo, hi};
}

glm::dvec3 MeshCells::placeOf(const glm::uvec3& point) const {
    return placed_.alongAxes(corners_.indexOf(point));
}

glm::dvec3 MeshCells::way(const glm::dvec3& from, const glm::dvec3& to) const {
    return timeseries::shorterWay(to - from, period_);
}

// Whether the line along this axis ends where it began, at the end where the point is.
bool MeshCells::comesRound(const glm::uvec3& point, int axis) const {
    const unsigned last = points_[axis] - 1;
    if (last < 2 || (point[axis] > 0 && point[axis] < last)) return false;
    glm::uvec3 other = point;
    other[axis] = last - point[axis];
    const glm::dvec3 place = placeOf(point), step = way(placeOf(inwardOf(point, axis)), place);
    const glm::dvec3 round = way(place, placeOf(other));
    return glm::dot(round, round) < kOnePlace * kOnePlace * glm::dot(step, step);
}

// The next one from an end.
glm::uvec3 MeshCells::inwardOf(glm::uvec3 point, int axis) const {
    point[axis] = point[axis] == 0 ? 1 : points_[axis] - 2;
    return point;
}

// Along the third direction of the point's cell, of which the other two and the volume are known:
// not of one that shares its cell with another, but of the next one, whose layer is as thick.
glm::dvec3 MeshCells::acrossLayer(const glm::uvec3& point, int axis) const {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto normalAt = [&](const glm::uvec3& at) {
        const auto stepAlong = [&](int a) {
            glm::uvec3 before = at, after = at;
            if (at[a] > 0) --before[a];
            if (at[a] + 1 < points_[a]) ++after[a];
            return way(placeOf(before), placeOf(after)) /
                   std::max(1.0, double(after[a] - before[a]));
        };
        return glm::cross(stepAlong(b), stepAlong(c));
    };
    glm::uvec3 whole = point;
    for (const int a : {b, c})
        if (comesRound(point, a)) whole = inwardOf(whole, a);
    const glm::dvec3 normal = normalAt(point);
    const double area = glm::length(normal), areaOfWhole = glm::length(normalAt(whole));
    const double volume = placed_.meshVolume(corners_.indexOf(whole));
    // In a mirrored space the third direction is the other one.
    return area > 0 && areaOfWhole > 0
               ? normal * ((isLeft_ ? -volume : volume) / areaOfWhole / area)
               : glm::dvec3(0);
}

glm::dvec3 MeshCells::beyond(const glm::uvec3& point, int axis, bool before) const {
    if (points_[axis] == 1) return (before ? -0.5 : 0.5) * acrossLayer(point, axis);
    if (comesRound(point, axis)) return glm::dvec3(0);
    return 0.5 * way(placeOf(inwardOf(point, axis)), placeOf(point));
}

// Whether the first and the last of a globe's longitudes are neighbours there.
bool MeshCells::isSeam(const glm::uvec3& point) const {
    if (!placed_.globe() || points_.x <= 2) return false;
    glm::uvec3 inward = point, other = point;
    inward.x = point.x == 0 ? 1 : points_.x - 2;
    other.x = points_.x - 1 - point.x;
    const glm::dvec3 place = placeOf(point), step = place - placeOf(inward);
    const double ratio = glm::dot(placeOf(other) - place, step) / glm::dot(step, step);
    return ratio > 0.5 && ratio < 2;
}

glm::dvec3 MeshCells::cornerAt(const glm::uvec3& cell, unsigned corner) const {
    const auto outwards = [&](const glm::uvec3& point, int firstAxis) {
        glm::dvec3 place = placeOf(point);
        for (int a = firstAxis; a < 3; ++a) {
            const unsigned side = corner >> a & 1;
            if (cell[a] + side == 0) place += beyond(point, a, true);
            if (cell[a] + side > points_[a]) place += beyond(point, a, false);
        }
        return place;
    };
    const glm::uvec3 point = corners_.pointAt(cell, corner);
    if (glm::uvec3(corner & 1, corner >> 1 & 1, corner >> 2) + cell - 1u == point)
        return placeOf(point);  // between the outermost points
    const unsigned x = cell.x + (corner & 1);
    if ((x > 0 && x <= points_.x) || !isSeam(point)) return outwards(point, 0);
    glm::uvec3 other = point;
    other.x = points_.x - 1 - point.x;
    return 0.5 * (outwards(point, 1) + outwards(other, 1));
}

MeshCells::FarCorners MeshCells::farCorners(const glm::uvec3& cell) const {
    FarCorners far{.at = {}, .isShared = {true, true, true}};
    for (unsigned c = 1; c < 8; ++c) far.at[c] = cornerAt(cell, c);
    if (period_ == glm::dvec3(0)) return far;
    // The first corner says where a cell is drawn.
    const glm::dvec3 first = cornerAt(cell, 0);
    for (std::size_t a = 0; a < 3; ++a) {
        const glm::dvec3 direct = far.at[std::size_t{1} << a] - first;
        far.isShared[a] = timeseries::shorterWay(direct, period_) == direct;
    }
    return far;
}

// Two triangles about the diagonal from the face's first corner.
double MeshCells::sideOfFace(const FarCorners& corners, int axis, const glm::dvec3& eye) const {
    if (!corners.isShared[static_cast<std::size_t>(axis)]) return 0;
    const unsigned end = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    const glm::dvec3& first = corners.at[end];
    const auto to = [&](unsigned corner) { return way(first, corners.at[end | corner]); };
    const double side = glm::dot(glm::cross(to(u | v), to(v) - to(u)), eye - first);
    return isLeft_ ? -side : side;
}

std::optional<MeshCells::Hexahedron> MeshCells::operator()(const glm::uvec3& cell) const {
    Hexahedron out{};
    out.values = corners_.values(cell);
    out.octants = fillMissing(out.values);
    if (byPoints_)
        for (unsigned c = 0; c < 8; ++c)
            if (!placed_.inside(corners_.indexOf(corners_.pointAt(cell, c)), clip_))
                out.octants &= ~(1u << c);
    if (out.octants == 0) return std::nullopt;
    for (unsigned c = 0; c < 8; ++c) {
        out.at[c] = cornerAt(cell, c);
        if (!timeseries::isPlace(out.at[c])) return std::nullopt;
        out.at[c] = out.at[0] + way(out.at[0], out.at[c]);
        if (gradients_)
            out.gradients[c] = gradients_.at(corners_.indexOf(corners_.pointAt(cell, c)));
    }
    return out;
}

// Of two beside each other the one on the eye's side of the face between them is in front.
MeshCells::Order MeshCells::ringFrom(const glm::dvec3& eye, const std::array<glm::dvec3, 8>& at) {
    constexpr std::size_t n = kRing.size();
    std::array<bool, n> beforeNext{};
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3& shared = at[kRing[(k + 1) % n]];
        const auto side = [&](const glm::dvec3& place) {
            return turnOf({at[0], shared, at[7], place}) > 0;
        };
        beforeNext[k] = side(eye) == side(at[kRing[k]]);
    }
    Order order = kAsTheyAre;
    std::array<bool, n> taken{};
    for (std::size_t count = 0; count < n; ++count) {
        const auto isFree = [&](std::size_t k) {
            const std::size_t before = (k + n - 1) % n, next = (k + 1) % n;
            return !taken[k] && (taken[before] || !beforeNext[before]) &&
                   (taken[next] || beforeNext[k]);
        };
        std::size_t next = 0;
        while (next < n && !isFree(next)) ++next;
        if (next == n)  // bent so far that each is before another
            next = static_cast<std::size_t>(std::ranges::find(taken, false) - taken.begin());
        taken[next] = true;
        order[count] = static_cast<std::uint8_t>(next);
    }
    return order;
}

MeshCells::Order MeshCells::octantsFrom(const glm::dvec3& eye,
                                        const std::array<glm::dvec3, 8>& at) {
    Order order = kAsTheyAre;
    std::ranges::sort(order, {}, [&](std::uint8_t o) { return glm::distance(eye, at[o]); });
    return order;
}

MeshCells::Hexahedron MeshCells::octantOf(const Hexahedron& cell, unsigned octant) const {
    const glm::dvec3 first(octant & 1 ? 0.5 : 0, octant & 2 ? 0.5 : 0, octant & 4 ? 0.5 : 0);
    Hexahedron part = cell;
    for (unsigned c = 0; c < 8; ++c) {
        const glm::dvec3 u = first + 0.5 * glm::dvec3(c & 1, c >> 1 & 1, c >> 2);
        part.values[c] = render::cell::valueAt(cell.values, u);
        const auto between = [&](const std::array<glm::dvec3, 8>& corners) {
            glm::dvec3 at;
            for (int a = 0; a < 3; ++a) {
                std::array<double, 8> along{};
                for (std::size_t k = 0; k < 8; ++k) along[k] = corners[k][a];
                at[a] = render::cell::valueAt(along, u);
            }
            return at;
        };
        part.at[c] = between(cell.at);
        if (gradients_) part.gradients[c] = between(cell.gradients);
    }
    return part;
}

}  // namespace render

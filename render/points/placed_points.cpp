#include "render/points/placed_points.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "timeseries/readers/text/units.h"

namespace render {
namespace {

using timeseries::Axis;
using timeseries::Grid;

using Wide = long double;

Wide extent(const Axis& axis) {
    return std::abs(Wide{axis.coordinates.back()} - Wide{axis.coordinates.front()});
}

// Lengths of other units cannot be compared: such an axis might be drawn as a sheet or a needle.
std::array<Wide, 3> fittedStretch(const Grid& grid) {
    constexpr Wide kFittedShare = 0.5;
    const auto& axes = grid.axes();
    // The axes whose units compare with the first axis's keep their proportions and lead.
    std::array<std::optional<double>, 3> ratios;
    Wide longest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        ratios[a] = unitRatio(axes[a], axes[0]);
        if (ratios[a]) longest = std::max(longest, Wide{*ratios[a]} * extent(axes[a]));
    }
    if (longest == 0)
        for (const Axis& axis : axes) longest = std::max(longest, extent(axis));
    std::array<Wide, 3> stretch{1, 1, 1};
    for (std::size_t a = 0; a < 3; ++a) {
        const Wide length = extent(axes[a]);
        if (length == 0) continue;
        stretch[a] = ratios[a] ? Wide{*ratios[a]} : kFittedShare * longest / length;
    }
    return stretch;
}

// How far the box's corners are from its centre, at most.
Wide farthestCorner(const glm::dmat3& directions, const std::array<Wide, 3>& half) {
    Wide farthest2 = 0;
    for (int corner = 0; corner < 4; ++corner) {  // the other four lie opposite
        Wide distance2 = 0;
        for (int c = 0; c < 3; ++c) {
            const Wide sum = half[0] * Wide{directions[0][c]} +
                             (corner & 1 ? half[1] : -half[1]) * Wide{directions[1][c]} +
                             (corner & 2 ? half[2] : -half[2]) * Wide{directions[2][c]};
            distance2 += sum * sum;
        }
        farthest2 = std::max(farthest2, distance2);
    }
    return std::sqrt(farthest2);
}

double mean(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

}  // namespace

std::string comparableUnit(const Axis& axis) {
    return axis.units.starts_with("degree") ? "degree" : axis.units;
}

std::optional<double> unitRatio(const Axis& of, const Axis& other) {
    if (comparableUnit(of) == comparableUnit(other)) return 1;
    const auto ratio = timeseries::unitRatio(of.units, other.units);
    return ratio && *ratio > 0 ? ratio : std::nullopt;
}

PlacedPoints::PlacedPoints(const Grid& grid, std::optional<glm::dvec3> stretch, Map map)
    : mesh_(grid.mesh()),
      fileMesh_(mesh_),
      size_(grid.size()[0], grid.size()[1], grid.size()[2]),
      worldFromAxes_(grid.frame().directions) {
    if (map == Map::Globe && Globe::shows(grid)) {
        try {
            placeOnGlobe(grid, stretch);
            return;
        } catch (const std::invalid_argument&) {  // no cell of it has a volume there
            globe_ = nullptr;
        }
    }
    // Thinner boxes and cells could not be seen; their volumes would leave the GPU's floats.
    constexpr Wide kThinnestBox = 1e-9L;
    const auto stretched =
        stretch ? std::array<Wide, 3>{stretch->x, stretch->y, stretch->z} : fittedStretch(grid);
    std::array<Wide, 3> half{};
    for (std::size_t a = 0; a < 3; ++a) half[a] = extent(grid.axes()[a]) / 2 * stretched[a];
    Wide radius = farthestCorner(worldFromAxes_, half);
    if (!(radius > 0)) radius = 1;
    for (int a = 0; a < 3; ++a) {
        const Axis& axis = grid.axes()[a];
        const Wide length = extent(axis);
        const Wide size = length > 0 ? std::max(half[a] / radius, kThinnestBox) : 0;
        const Wide perUnit = length > 0 ? 2 * size / length : stretched[a] / radius;
        boxHalf_[a] = static_cast<double>(size);
        centre_[a] = (Wide{axis.coordinates.front()} + Wide{axis.coordinates.back()}) / 2;
        scale_[a] = axis.down ? -perUnit : perUnit;
    }
    mesh_ ? measureMesh() : measureAxes(grid);
}

Outline PlacedPoints::outline() const {
    Outline out(boxHalfEdges(), globe_ && globe_->isWhole());
    if (mesh_ || boxHalf_ == glm::dvec3(0)) return out;  // of a single point, there is no size
    const auto [lo, hi] = domain();
    const glm::dvec3 half = glm::max(glm::abs(lo), glm::abs(hi));
    for (int a = 0; a < 3; ++a) out.filledHalfEdges[a] = half[a] * worldFromAxes_[a];
    return out;
}

Outline PlacedPoints::outlineOf(const Grid& grid, std::optional<glm::dvec3> stretch, Map map) {
    if (map != Map::Globe || !Globe::shows(grid)) return PlacedPoints(grid, stretch).outline();
    const Globe globe = globeOf(grid, stretch);
    const Globe::Box box = globe.box();
    const glm::dvec3 half = glm::normalize(box.hi - box.lo);
    return {glm::dmat3(half.x, 0, 0, 0, half.y, 0, 0, 0, half.z), globe.isWhole()};
}

void PlacedPoints::placeOnGlobe(const Grid& grid, std::optional<glm::dvec3> stretch) {
    globe_ = std::make_shared<const Globe>(globeOf(grid, stretch));
    mesh_ = globe_->meshOf(grid);
    const Globe::Box box = globe_->box();
    const double radius = glm::length(0.5 * (box.hi - box.lo));
    boxHalf_ = glm::normalize(box.hi - box.lo);
    for (int a = 0; a < 3; ++a) {
        centre_[a] = (Wide{box.lo[a]} + Wide{box.hi[a]}) / 2;
        scale_[a] = 1 / Wide{radius};
    }
    measureMesh();
}

std::optional<PlacedPoints::Ball> PlacedPoints::ball() const {
    if (!globe_) return std::nullopt;
    return Ball{axesFromGlobe(glm::dvec3(0)), meshScale_.x * globe_->ballRadius()};
}

double PlacedPoints::ballOnRay(const glm::dvec3& eye, const glm::dvec3& along) const {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const auto ball = this->ball();
    if (!ball) return kNowhere;
    // |eye + t along - centre| = radius: the lesser root.
    const glm::dvec3 from = eye - ball->centre;
    const double a = glm::dot(along, along), b = glm::dot(from, along),
                 c = glm::dot(from, from) - ball->radius * ball->radius;
    const double root2 = b * b - a * c;
    return root2 > 0 && b < 0 && c > 0 ? c / (-b + std::sqrt(root2)) : kNowhere;
}

void PlacedPoints::measureMesh() {
    Wide volume = mesh_->meanVolume(), widest2 = 0;
    for (int a = 0; a < 3; ++a) {
        meshScale_[a] = static_cast<double>(scale_[a]);
        meshCentre_[a] = static_cast<double>(centre_[a]);
        volume *= std::abs(scale_[a]);
        const Wide widest = scale_[a] * Wide{mesh_->widest()[a]};
        widest2 += widest * widest;
    }
    unitLength_ = static_cast<double>(std::cbrt(volume));
    widest_ = static_cast<double>(std::sqrt(widest2));
    // A tenth of the box and more.
    constexpr double kHigh = 0.2;
    const auto levels = mesh_->stored().levels;
    for (const auto& level : levels)
        longCells_ = longCells_ || level.height * std::abs(meshScale_.z) > kHigh * boxHalf_.z;
    if (!longCells_) return;
    const bool down = meshScale_.z < 0, ascends = levels.front().at < levels.back().at;
    const auto& [first, last] = std::pair(levels.front().height, levels.back().height);
    const double half = std::abs(meshScale_.z) / 2;
    beyondBox_ = {half * (ascends != down ? first : last), half * (ascends != down ? last : first)};
}

void PlacedPoints::measureAxes(const Grid& grid) {
    constexpr Wide kThinnestCell = 1e-15L;
    double thinnest = 0;  // an axis of one point takes the smallest mean width of the others
    for (int a = 0; a < 3; ++a) {
        const Axis& axis = grid.axes()[a];
        const Wide length = extent(axis), perUnit = std::abs(scale_[a]);
        for (std::size_t i = 0; i < axis.coordinates.size(); ++i) {
            positions_[a].push_back(
                static_cast<double>((Wide{axis.coordinates[i]} - centre_[a]) * scale_[a]));
            // No cell is longer than its axis: the width of the widest overflows.
            const Wide width = std::min(std::abs(Wide{axis.width(i)}), length) * perUnit;
            widths_[a].push_back(static_cast<double>(std::max(width, kThinnestCell)));
        }
        if (axis.coordinates.size() > 1 && (thinnest == 0 || mean(widths_[a]) < thinnest))
            thinnest = mean(widths_[a]);
    }
    if (thinnest == 0) thinnest = 1;
    for (int a = 0; a < 3; ++a)
        if (widths_[a].size() == 1) widths_[a][0] = thinnest;
    unitLength_ = std::cbrt(mean(widths_[0]) * mean(widths_[1]) * mean(widths_[2]) *
                            std::abs(glm::determinant(worldFromAxes_)));
    constexpr double kLong = 3;
    for (const auto& widths : widths_)
        widest_ = std::max(widest_, *std::ranges::max_element(widths));
    longCells_ = widest_ > kLong * thinnest;
}

glm::dvec3 PlacedPoints::scale() const {
    constexpr Wide kMost = std::numeric_limits<double>::max();
    glm::dvec3 scale;
    for (int a = 0; a < 3; ++a)
        scale[a] = static_cast<double>(std::clamp(scale_[a], -kMost, kMost));
    return scale;
}

glm::dvec3 PlacedPoints::axesFromGrid(const glm::dvec3& grid) const {
    glm::dvec3 along;
    for (int a = 0; a < 3; ++a)
        along[a] = static_cast<double>((Wide{grid[a]} - centre_[a]) * scale_[a]);
    return along;
}

glm::dvec3 PlacedPoints::gridFromAxes(const glm::dvec3& axes) const {
    glm::dvec3 along;
    for (int a = 0; a < 3; ++a)
        along[a] = static_cast<double>(Wide{axes[a]} / scale_[a] + centre_[a]);
    return along;
}

PlacedPoints::Lengthening PlacedPoints::lengthening() const {
    // The squares are the eigenvalues of the columns' scalar products: 1 + t with
    // t^3 - (p^2 + q^2 + r^2) t - 2 p q r = 0, whose three real roots are cosines (Viete).
    const glm::dmat3& m = worldFromAxes_;
    const double p = glm::dot(m[0], m[1]), q = glm::dot(m[0], m[2]), r = glm::dot(m[1], m[2]);
    const double third = (p * p + q * q + r * r) / 3;
    if (!(third > 0)) return {1, 1};
    const double amplitude = 2 * std::sqrt(third);
    const double cosine = std::clamp(p * q * r / (third * std::sqrt(third)), -1.0, 1.0);
    const double angle = std::acos(cosine) / 3;  // [0, pi / 3]
    const double least = amplitude * std::cos(angle + 2 * std::numbers::pi / 3);
    return {std::sqrt(1 + least), std::sqrt(1 + amplitude * std::cos(angle))};
}

View PlacedPoints::inAxes(const View& view) const {
    return {view.clipFromView, view.viewFromWorld * glm::dmat4(worldFromAxes_), view.size};
}

glm::dmat3 PlacedPoints::boxHalfEdges() const {
    return {worldFromAxes_[0] * boxHalf_.x, worldFromAxes_[1] * boxHalf_.y,
            worldFromAxes_[2] * boxHalf_.z};
}

bool PlacedPoints::cubes() const {
    if (mesh_) return false;
    const glm::dmat3 products = glm::transpose(worldFromAxes_) * worldFromAxes_;
    for (int a = 0; a < 3; ++a)
        if (std::abs(products[a][(a + 1) % 3]) > 1e-12) return false;
    for (const auto& widths : widths_)
        for (const double w : widths)
            if (std::abs(w - unitLength_) > 1e-12 * unitLength_) return false;
    return true;
}

PlacedPoints::Box PlacedPoints::domain() const {
    if (mesh_) {
        Box box = pointsBox();
        box.lo.z -= beyondBox_[0];
        box.hi.z += beyondBox_[1];
        return box;
    }
    Box box{};
    for (int a = 0; a < 3; ++a) {
        const auto &at = positions_[a], &width = widths_[a];
        const bool down = at.front() > at.back();
        const auto [lo, hi] = std::pair(down ? at.size() - 1 : 0, down ? 0 : at.size() - 1);
        box.lo[a] = at[lo] - width[lo] / 2;
        box.hi[a] = at[hi] + width[hi] / 2;
    }
    return box;
}

PlacedPoints::Box PlacedPoints::pointsBox() const {
    if (!mesh_) return {-boxHalf_, boxHalf_};
    const glm::dvec3 a = axesFromGrid(mesh_->lo()), b = axesFromGrid(mesh_->hi());
    return {glm::min(a, b), glm::max(a, b)};
}

PlacedPoints::Box PlacedPoints::cornersBox() const {
    const auto box = mesh_->cornersBox();
    const glm::dvec3 a = axesFromGrid(box.lo), b = axesFromGrid(box.hi);
    return {glm::min(a, b), glm::max(a, b)};
}

glm::uvec3 PlacedPoints::indices(std::uint64_t index) const {
    return timeseries::indicesOf(index, glm::vec<3, std::uint64_t>(size()));
}

bool PlacedPoints::inside(std::uint64_t index, const IndexBox& box) const {
    if (fileMesh_) return box.holdsAll() || box.holdsPlace(fileMesh_->position(index));
    return box.holds(indices(index));
}

timeseries::LowerTriangle<double> PlacedPoints::meshCell(std::uint64_t index) const {
    return mesh_->cell(index).scaled(meshScale_);
}

double PlacedPoints::meshVolume(std::uint64_t index) const {
    return mesh_->volumeOf(meshCell(index), index);
}

glm::dvec3 PlacedPoints::position(std::uint64_t index) const {
    return worldFromAxes_ * alongAxes(index);
}

glm::dvec3 PlacedPoints::alongAxes(std::uint64_t index) const {
    if (mesh_) return meshScale_ * (mesh_->position(index) - meshCentre_);
    const glm::uvec3 at = indices(index);
    return {positions_[0][at.x], positions_[1][at.y], positions_[2][at.z]};
}

glm::dvec3 PlacedPoints::cell(std::uint64_t index) const {
    const glm::uvec3 at = indices(index);
    return {widths_[0][at.x], widths_[1][at.y], widths_[2][at.z]};
}

IndexBox indexBox(const Grid& grid, const glm::dvec3& lo, const glm::dvec3& hi) {
    if (grid.mesh()) return {.from = lo, .to = hi};
    IndexBox box{glm::uvec3(1), glm::uvec3(0)};
    for (int a = 0; a < 3; ++a) {
        const auto places = grid.placesWithin(static_cast<std::size_t>(a), lo[a], hi[a]);
        if (!places) return {glm::uvec3(1), glm::uvec3(0)};
        box.lo[a] = static_cast<std::uint32_t>(places->first);
        box.hi[a] = static_cast<std::uint32_t>(places->last);
    }
    return box;
}

}  // namespace render

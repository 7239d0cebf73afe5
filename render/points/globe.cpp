#include "render/points/globe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace render {
namespace {

using timeseries::Axis;
using timeseries::Grid;

constexpr double kTurn = 360;
constexpr double kEarth = 6371e3;  // metres: the mean radius (IUGG)

std::string lowerCase(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool isDegrees(const Axis& axis, std::string_view direction, std::string_view name) {
    const std::string units = lowerCase(axis.units), called = lowerCase(axis.name);
    if (!units.starts_with("degree")) return false;
    std::string_view rest = std::string_view(units).substr(6);
    if (rest.starts_with('s')) rest.remove_prefix(1);
    if (rest.starts_with('_')) rest.remove_prefix(1);
    if (rest == direction || rest == direction.substr(0, 1)) return true;
    // Degrees alone with a name that leaves no doubt.
    return rest.empty() && (called == name || called == name.substr(0, 3));
}

std::optional<double> metresOf(const Axis& axis) {
    constexpr std::array<std::pair<std::string_view, double>, 12> kLengths{{{"m", 1},
                                                                            {"metre", 1},
                                                                            {"metres", 1},
                                                                            {"meter", 1},
                                                                            {"meters", 1},
                                                                            {"km", 1e3},
                                                                            {"kilometre", 1e3},
                                                                            {"kilometres", 1e3},
                                                                            {"kilometer", 1e3},
                                                                            {"kilometers", 1e3},
                                                                            {"cm", 1e-2},
                                                                            {"centimeters", 1e-2}}};
    const std::string units = lowerCase(axis.units);
    for (const auto& [name, metres] : kLengths)
        if (name == units) return metres;
    return std::nullopt;
}

// Levels of the air count downwards, too: of what is no length, the name tells.
bool saysDepth(const Axis& axis) {
    const std::string name = lowerCase(axis.name), units = lowerCase(axis.units);
    if (units.starts_with("dbar") || units.starts_with("decibar")) return true;  // the sea's
    return name.find("depth") != name.npos || name.find("ocean") != name.npos;
}

// Columns: east, north, up, before anything is turned.
glm::dmat3 directionsOf(const Globe::Angle& lon, const Globe::Angle& lat) {
    return {{-lon.sine, lon.cosine, 0},
            {-lat.sine * lon.cosine, -lat.sine * lon.sine, lat.cosine},
            {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine}};
}

}  // namespace

bool saysDegrees(const Grid& grid) {
    const auto& axes = grid.axes();
    return grid.frame().aligned() && isDegrees(axes[0], "east", "longitude") &&
           isDegrees(axes[1], "north", "latitude");
}

bool isGeographic(const Grid& grid) {
    if (!saysDegrees(grid)) return false;
    const auto x = grid.ends(0);
    return x.most - x.least <= kTurn + 1 && std::max(std::abs(x.least), std::abs(x.most)) <= 720;
}

bool isOnEarth(const Grid& grid) { return grid.earth() || isGeographic(grid); }

glm::dvec2 onEarth(const Grid& grid, std::uint64_t index) {
    if (!grid.earth()) return glm::dvec2(grid.position(index));
    return (*grid.earth())[index % grid.earth()->count()];
}

EarthEnds earthEnds(const Grid& grid) {
    if (const auto& earth = grid.earth()) return {earth->lo(), earth->hi()};
    const auto x = grid.ends(0), y = grid.ends(1);
    return {{x.least, y.least}, {x.most, y.most}};
}

bool isDepth(const Axis& axis) { return axis.down && (metresOf(axis) || saysDepth(axis)); }

Globe::Globe(const Grid& grid, std::optional<double> stretch) {
    constexpr double kFitted = 0.1, kFittedShare = 0.5, kDeepest = 0.9, kHighest = 9;
    const Axis& axis = grid.axes()[2];
    const auto ends = earthEnds(grid);
    const auto z = grid.ends(2);
    lo_ = {ends.lo, z.least};
    hi_ = {ends.hi, z.most};
    const glm::dvec3 middle = 0.5 * (lo_ + hi_);
    if (!isWhole()) {
        const double tilt = 0.5 * (hi_.y - lo_.y) * kPerDegree;
        const glm::dmat3 tilted({1, 0, 0}, {0, std::cos(tilt), std::sin(tilt)},
                                {0, -std::sin(tilt), std::cos(tilt)});
        turn_ = tilted * glm::transpose(directionsOf(Angle(middle.x), Angle(middle.y)));
    }
    metres_ = metresOf(axis);
    below_ = metres_ ? (middle.z > 0) == axis.down : isDepth(axis);
    surface_ = metres_ ? 0 : below_ == axis.down ? z.least : z.most;

    const double farthest = std::max(std::abs(z.least - surface_), std::abs(z.most - surface_));
    if (z.least == z.most) {
        surface_ = z.least;  // one level is the surface
    } else {
        const double wide = (hi_.x - lo_.x) * std::cos(middle.y * kPerDegree);
        const double longer = std::max(wide, hi_.y - lo_.y) * kPerDegree;
        // A column alone has no longer side.
        const double fitted = longer > 0 ? std::min(kFitted, kFittedShare * longer) : kFitted;
        double perUnit = fitted / farthest;
        if (stretch) perUnit = *stretch * (metres_ ? *metres_ / kEarth : kPerDegree);
        const double deepest = axis.down ? z.most - surface_ : surface_ - z.least;
        if (deepest > 0) perUnit = std::min(perUnit, kDeepest / deepest);
        perUnit = std::min(perUnit, kHighest / farthest);
        perUnit_ = axis.down ? -perUnit : perUnit;
    }
    const auto levels = static_cast<double>(grid.size()[2]);
    const double lowest = std::min({1.0, radius(z.least), radius(z.most)});
    // Half a level deeper; of one level, half a cell.
    const double columns = static_cast<double>(grid.count()) / levels;
    const double area =
        std::max(hi_.x - lo_.x, 0.0) * std::max(hi_.y - lo_.y, 0.0) * kPerDegree * kPerDegree;
    const double thick = levels > 1 ? std::abs(radius(z.most) - radius(z.least)) / (levels - 1)
                                    : std::sqrt(area / columns);
    ball_ = std::max(lowest - 0.5 * thick, 0.5 * lowest);
}

bool Globe::isSound() const {
    const bool isFlat = lo_.z == hi_.z;
    return std::isfinite(radius(lo_.z)) && std::isfinite(radius(hi_.z)) &&
           (isFlat || (std::isfinite(perUnit_) && perUnit_ != 0));
}

bool Globe::shows(const Grid& grid) {
    if (!isOnEarth(grid) || grid.count() > kMostPoints) return false;
    const auto [lo, hi] = earthEnds(grid);
    return lo != hi && lo.y >= -kPole && hi.y <= kPole && Globe(grid).isSound();
}

Globe::Angle::Angle(double degrees)
    : sine(std::sin(degrees * kPerDegree)), cosine(std::cos(degrees * kPerDegree)) {}

Globe::Directions Globe::directionsAt(const Angle& longitude, const Angle& latitude) const {
    const glm::dmat3 directions = turn_ * directionsOf(longitude, latitude);
    return {directions[0], directions[1], directions[2]};
}

glm::dvec3 Globe::at(const glm::dvec3& place) const {
    return radius(place.z) * (turn_ * directionsOf(Angle(place.x), Angle(place.y))[2]);
}

glm::dvec3 Globe::placeOf(const glm::dvec3& at) const {
    const double r = glm::length(at), middle = 0.5 * (lo_.x + hi_.x);
    const glm::dvec3 up = glm::transpose(turn_) * at / r;
    const double longitude = std::atan2(up.y, up.x) / kPerDegree;
    return {longitude - kTurn * std::round((longitude - middle) / kTurn),
            std::atan2(up.z, std::hypot(up.x, up.y)) / kPerDegree,
            surface_ + (perUnit_ != 0 ? (r - 1) / perUnit_ : 0)};
}

glm::dmat3 Globe::waysAt(const glm::dvec3& place) const {
    const auto [east, north, up] = directionsAt(place);
    const double r = radius(place.z) * kPerDegree;
    // A layer without heights is as thick as its points' cells are wide.
    const double outwards = perUnit_ != 0 ? perUnit_ : kPerDegree;
    return {r * std::cos(place.y * kPerDegree) * east, r * north, outwards * up};
}

Globe::Box Globe::box() const {
    if (isWhole()) {
        const double most = std::max({1.0, radius(lo_.z), radius(hi_.z)});
        return {glm::dvec3(-most), glm::dvec3(most)};
    }
    constexpr int kSteps = 96;
    Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j)
            for (const double third : {lo_.z, hi_.z}) {
                const glm::dvec2 share = glm::dvec2(i, j) / static_cast<double>(kSteps);
                const glm::dvec3 place = at({glm::mix(lo(), hi(), share), third});
                box.lo = glm::min(box.lo, place);
                box.hi = glm::max(box.hi, place);
            }
    // Between two of these a surface is no farther out than an arc over its chord.
    const glm::dvec2 step = (hi() - lo()) * (kPerDegree / kSteps);
    const double beyond = glm::dot(step, step) / 4;
    return {box.lo - beyond, box.hi + beyond};
}

std::optional<double> Globe::exaggeration() const {
    if (!metres_ || perUnit_ == 0) return std::nullopt;
    return std::abs(perUnit_) * kEarth / *metres_;
}

double Globe::degreesPerUnit() const { return std::abs(perUnit_) / kPerDegree; }

}  // namespace render

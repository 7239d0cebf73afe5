#include "timeseries/grid/earth_places.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

namespace timeseries {
namespace {

constexpr double kWhole = 360;  // degrees

bool canBeOnEarth(const glm::dvec2& at) {
    constexpr double kFarthest = 2 * kWhole, kPole = 90.01;  // beyond rounding
    return std::abs(at.x) <= kFarthest && std::abs(at.y) <= kPole;
}

}  // namespace

EarthPlaces::EarthPlaces(std::vector<glm::dvec2> columns) : columns_(std::move(columns)) {
    for (glm::dvec2& at : columns_)
        if (!canBeOnEarth(at)) at = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    measure();
    if (lo_.x > hi_.x)
        throw std::invalid_argument("none of them is a longitude and latitude in degrees");
    if (hi_.x - lo_.x <= kWhole) return;
    for (glm::dvec2& at : columns_) at.x -= kWhole * std::floor(at.x / kWhole + 0.5);
    measure();
}

void EarthPlaces::measure() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    lo_ = glm::dvec2(kInfinity);
    hi_ = -lo_;
    for (const glm::dvec2& at : columns_) {
        if (std::isnan(at.x)) continue;
        lo_ = glm::min(lo_, at);
        hi_ = glm::max(hi_, at);
    }
}

bool operator==(const EarthPlaces& a, const EarthPlaces& b) {
    // By bits: what is no number is the same, too.
    return a.count() == b.count() &&
           std::memcmp(a.columns_.data(), b.columns_.data(), a.count() * sizeof(glm::dvec2)) == 0;
}

// The spherical triangle between the place, the grid's pole and the Earth's: of the sides from the
// grid's pole and the angle between them the side from the Earth's pole (the cosine rule) and the
// angle there (the sine and the five parts rule).
glm::dvec2 RotatedPole::onEarth(const glm::dvec2& onGrid) const {
    const double angle = glm::radians(onGrid.x - northPole), up = glm::radians(onGrid.y),
                 pole = glm::radians(latitude);
    const double toPole = std::sin(up), across = std::cos(up) * std::sin(angle),
                 along = std::cos(up) * std::cos(angle);
    const double north = std::sin(pole) * toPole + std::cos(pole) * along;
    const double south = std::sin(pole) * along - std::cos(pole) * toPole;
    const double east = glm::degrees(std::atan2(across, south)) + 180 + longitude;
    return {east - kWhole * std::floor(east / kWhole + 0.5),
            glm::degrees(std::atan2(north, std::hypot(across, south)))};
}

}  // namespace timeseries

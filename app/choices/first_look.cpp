#include "app/choices/first_look.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "render/points/globe.h"

namespace app {
namespace {

bool hasMiddle(const render::Globe& globe) {
    constexpr double kAllRound = 330;  // degrees: what is left free is no other side
    const bool isBesideEquator = globe.lo().y >= 0 || globe.hi().y <= 0;
    return globe.hi().x - globe.lo().x < kAllRound || isBesideEquator;
}

// Angles alone: what else a view has is kept.
void turn(ViewChoice& view, const ViewChoice& look) {
    view.azimuthDegrees = look.azimuthDegrees;
    view.elevationDegrees = look.elevationDegrees;
}

bool looksAs(const ViewChoice& view, const ViewChoice& look) {
    ViewChoice same = look;
    same.projection = view.projection;
    same.shift = view.shift;
    return view == same;
}

}  // namespace

// See directionOf (camera.h): seen from there, the third axis, where north is, points up.
ViewChoice firstLook(render::Map map, const timeseries::Grid& grid) {
    ViewChoice look;
    if (map != render::Map::Globe || !render::Globe::shows(grid)) return look;
    const render::Globe globe(grid);
    if (!hasMiddle(globe)) return look;
    const glm::dvec3 up = globe.directionsAt({0.5 * (globe.lo() + globe.hi()), 0}).up;
    // Straight from above, where a field of one latitude lies, every azimuth looks the same way.
    const bool isAbove = std::hypot(up.x, up.y) < 1e-9;
    look.azimuthDegrees =
        isAbove ? 0.0 : std::round(glm::degrees(std::atan2(up.x, -up.y))) + 0.0;  // no -0
    look.elevationDegrees = std::round(glm::degrees(std::asin(glm::clamp(up.z, -1.0, 1.0))));
    return look;
}

void lookFirst(Explorer& e, const timeseries::Grid& grid) {
    if (e.view.chosen || !looksAs(e.view, {})) return;
    turn(e.view, firstLook(e.map, grid));
}

void followMap(Explorer& e, render::Map before, const timeseries::Grid& grid) {
    if (e.map != before && looksAs(e.view, firstLook(before, grid)))
        turn(e.view, firstLook(e.map, grid));
}

}  // namespace app

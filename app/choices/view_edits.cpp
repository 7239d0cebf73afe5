#include "app/choices/view_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>
#include <utility>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"

namespace app {
namespace {

// World units right and up for an offset in the picture's pixels, in the plane of the target.
glm::dvec2 onTarget(const Stand& stand, const Looking& at, glm::dvec2 pixels) {
    return 2 * stand.distance * stand.slope * pixels / glm::dvec2(at.size.x, -at.size.y);
}

// Wrapped to (-180, 180]: a session shows readable angles after any number of turns.
double wrapped(double degrees) { return degrees - 360 * std::ceil((degrees - 180) / 360); }

glm::dvec3 bounded(const glm::dvec3& target) { return glm::clamp(target, -kFarthest, kFarthest); }

}  // namespace

ViewChoice orbited(ViewChoice view, glm::dvec2 pixels, const Looking& at) {
    const Stand stand = standOf(view, at.outline, at.size, at.legend);
    view.shift = stand.shift;
    view.distance = stand.distance;
    view.target = stand.target;
    const double degreesPerPixel = 180.0 / std::min(at.size.x, at.size.y);
    view.azimuthDegrees = wrapped(view.azimuthDegrees - pixels.x * degreesPerPixel);
    view.elevationDegrees =
        std::clamp(view.elevationDegrees + pixels.y * degreesPerPixel, -90.0, 90.0);
    return view;
}

ViewChoice panned(ViewChoice view, glm::dvec2 pixels, const Looking& at) {
    const Stand stand = standOf(view, at.outline, at.size, at.legend);
    view.shift = stand.shift;
    const glm::dvec2 by = onTarget(stand, at, pixels);
    view.distance = stand.distance;
    view.target = bounded(stand.target - by.x * stand.axes[0] - by.y * stand.axes[1]);
    return view;
}

ViewChoice zoomed(ViewChoice view, double factor, glm::dvec2 cursor, const Looking& at) {
    const Stand stand = standOf(view, at.outline, at.size, at.legend);
    view.shift = stand.shift;
    view.distance = std::clamp(stand.distance * factor, kNearest, kFarthest);
    const glm::dvec2 middle = 0.5 * glm::dvec2(at.size) * (1.0 + stand.shift * glm::dvec2(1, -1));
    const glm::dvec2 offset =
        onTarget(stand, at, cursor - middle) * (1 - *view.distance / stand.distance);
    view.target = bounded(stand.target + offset.x * stand.axes[0] + offset.y * stand.axes[1]);
    return view;
}

ViewChoice fitted(ViewChoice view) {
    view.distance.reset();
    view.target = glm::dvec3(0);
    view.shift.reset();
    return view;
}

LampChoice lampBeside(const ViewChoice& view) {
    return {std::round(wrapped(view.azimuthDegrees - 40)),
            std::round(std::clamp(view.elevationDegrees + 30, -90.0, 80.0))};
}

ViewChoice lookedFrom(ViewChoice view, Side side) {
    // Azimuth and elevation, in the order of Side.
    constexpr std::array<std::pair<double, double>, 6> kAngles = {
        {{0, 0}, {180, 0}, {-90, 0}, {90, 0}, {0, 90}, {0, -90}}};
    std::tie(view.azimuthDegrees, view.elevationDegrees) = kAngles[static_cast<std::size_t>(side)];
    return view;
}

}  // namespace app

#include "app/choices/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "app/choices/fit.h"
#include "render/annotate/axes.h"
#include "render/annotate/legend.h"

namespace app {
namespace {

// Half the field of view of the picture's shorter side: narrow, as for a photograph of an object.
const double kHalfAngle = glm::radians(15.0);
// The point midway between the eyes, and the frustum from there.
struct Camera {
    glm::dvec3 at;
    glm::dvec2 slope;
    double near, far;
};

Camera perspective(const Stand& stand) {
    return {.at = stand.target + stand.distance * stand.axes[2],
            .slope = stand.slope,
            .near = stand.distance / 200,
            .far = stand.distance + 10 + glm::length(stand.target)};
}

double farDistance(const Stand& stand) { return std::max(kFarEye, stand.distance); }

Camera orthographic(const Stand& stand) {
    const glm::dvec3 back = stand.axes[2];
    const double from = farDistance(stand);
    // Depths are about `from`, wherever the target is: the box is near the plane through its
    // centre. The near plane is no nearer to it than the splats' fading there allows (nearFade).
    return {.at = stand.target + (from - glm::dot(stand.target, back)) * back,
            .slope = stand.slope * (stand.distance / from),
            .near = from / 2 - 1,
            .far = from + 2};
}

}  // namespace

glm::dvec2 freeAreaOf(glm::ivec2 size) {
    // Lines of labels: a title and the time above, numbers and a name below, numbers beside. Of a
    // picture too small for labels, most is the box's all the same.
    constexpr glm::dvec2 kLines(1.5, 2);
    const double line =
        std::min<double>(render::labelStyle(size).linePixels, 0.05 * std::min(size.x, size.y));
    return 1.0 - 2 * line * kLines / glm::dvec2(size);
}

glm::dvec3 directionOf(double azimuthDegrees, double elevationDegrees) {
    const double azimuth = glm::radians(azimuthDegrees);
    const double elevation = glm::radians(elevationDegrees);
    return {std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
            std::sin(elevation)};
}

Stand standOf(const ViewChoice& view, const render::Outline& outline, glm::ivec2 size,
              const glm::dvec2& legend) {
    const double azimuth = glm::radians(view.azimuthDegrees);
    // Right comes from the azimuth alone, so that looking straight down is no special case.
    const glm::dvec3 right(std::cos(azimuth), std::sin(azimuth), 0);
    const glm::dvec3 back = directionOf(view.azimuthDegrees, view.elevationDegrees);
    const glm::dmat3 axes(right, glm::cross(back, right), back);
    const double shorter = std::min(size.x, size.y);
    const glm::dvec2 slope = std::tan(kHalfAngle) * glm::dvec2(size) / shorter;
    Stand stand{axes, 0, view.target, slope, view.shift.value_or(glm::dvec2(0))};
    if (view.distance) {
        stand.distance = *view.distance;
        return stand;
    }
    const Looks looks{axes, slope, view.target, view.projection == Projection::Orthographic,
                      freeAreaOf(size)};
    const bool isBeside = !view.shift && legend != glm::dvec2(0) && view.target == glm::dvec3(0);
    const Fit fit = isBeside ? fitBeside(legend, size, looks, outline) : fitOf(looks, outline);
    stand.distance = fit.distance;
    stand.target += fit.aside.x * axes[0] + fit.aside.y * axes[1];
    stand.shift += fit.shift;
    return stand;
}

glm::dvec2 legendOf(const Explorer& e) {
    if (!e.legend) return glm::dvec2(0);
    std::size_t scales = 0, swatches = 0;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        const bool byValue = layer.color && std::holds_alternative<MapChoice>(*layer.color);
        ++(byValue ? scales : swatches);
    }
    return render::legendCorner(scales, swatches, e.size);
}

std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const render::Outline& outline, glm::ivec2 size,
                               const glm::dvec2& legend) {
    const Stand stand = standOf(view, outline, size, legend);
    const bool isFar = view.projection == Projection::Orthographic;
    const Camera camera = isFar ? orthographic(stand) : perspective(stand);
    const auto eye = [&](double sideways, double convergence) {
        const double parallax = -sideways / convergence;
        const glm::dvec3 at = camera.at + sideways * stand.axes[0];
        const glm::dvec2 slope = camera.slope, middle = -stand.shift * slope;
        glm::dmat4 viewFromWorld(glm::transpose(stand.axes));
        viewFromWorld[3] = glm::dvec4(glm::dmat3(viewFromWorld) * -at, 1.0);
        return render::View{.clipFromView = render::clipFromView(
                                {middle.x - slope.x + parallax, middle.x + slope.x + parallax,
                                 middle.y - slope.y, middle.y + slope.y, camera.near, camera.far}),
                            .viewFromWorld = viewFromWorld,
                            .size = size};
    };
    if (stereo.mode == Stereo::Off) return {eye(0, 1)};
    double apart = stereo.eyeDistance.value_or(stand.distance / 30);
    double convergence = stereo.convergence.value_or(stand.distance);
    if (isFar) {
        // Parallax is apart (1 / convergence - 1 / depth): the same change with depth, in shares of
        // the picture, about the same plane of none.
        const double from = farDistance(stand);
        apart *= from * stand.distance / (convergence * convergence);
        convergence += from - stand.distance;
    }
    return {eye(-apart / 2, convergence), eye(apart / 2, convergence)};
}

std::vector<render::View> eyes(const Explorer& e, const render::Outline& outline) {
    return eyes(e.view, e.stereo, outline, e.size, legendOf(e));
}

}  // namespace app

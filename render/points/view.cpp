#include "render/points/view.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace render {

glm::dmat4 clipFromView(const Frustum& f) {
    // OpenXR's and GL's asymmetric projection with depth [0, 1]: columns of x, y, z, 1.
    glm::dmat4 m(0.0);
    m[0][0] = 2 / (f.right - f.left);
    m[1][1] = 2 / (f.up - f.down);
    m[2][0] = (f.right + f.left) / (f.right - f.left);
    m[2][1] = (f.up + f.down) / (f.up - f.down);
    m[2][2] = -f.far / (f.far - f.near);
    m[2][3] = -1;
    m[3][2] = -f.far * f.near / (f.far - f.near);
    return m;
}

View coarser(const View& view, int across) {
    View coarse = view;
    coarse.size = (view.size + across - 1) / across;
    coarse.across *= across;
    // Of normalised device coordinates: the lower left corners meet, and pixels are as many times
    // as large.
    const glm::dvec2 scale = glm::dvec2(view.size) / glm::dvec2(across * coarse.size);
    glm::dmat4 place(1.0);
    for (int k = 0; k < 2; ++k) {
        place[k][k] = scale[k];
        place[3][k] = scale[k] - 1;
    }
    coarse.clipFromView = place * view.clipFromView;
    return coarse;
}

std::vector<View> coarser(std::span<const View> views, int across) {
    std::vector<View> coarse;
    for (const View& view : views) coarse.push_back(coarser(view, across));
    return coarse;
}

PixelRays pixelRays(const View& view) {
    const glm::dmat4& p = view.clipFromView;
    const glm::dmat3 worldFromView = glm::inverse(glm::dmat3(view.viewFromWorld));
    const glm::dvec2 half = glm::dvec2(view.size) * 0.5;
    PixelRays rays;
    rays.focal = {p[0][0] * half.x, p[1][1] * half.y};
    // ndc = p00 t - p20 with t = x / -z.
    rays.centre = {half.x * (1 - p[2][0]), half.y * (1 - p[2][1])};
    rays.eye = -(worldFromView * glm::dvec3(view.viewFromWorld[3]));
    rays.perPixelX = worldFromView[0] / rays.focal.x;
    rays.perPixelY = worldFromView[1] / rays.focal.y;
    rays.axis = -worldFromView[2];
    rays.near = p[3][2] / p[2][2];
    return rays;
}

PixelRays besideFaces(PixelRays rays) {
    // A golden ratio apart, so that no plane of small whole numbers holds both.
    constexpr glm::dvec2 kBeside{3e-3, 3e-3 * 0.6180339887498949};
    rays.centre += kBeside;
    return rays;
}

Projected project(const View& view, const glm::dvec3& world) {
    const glm::dvec4 inView = view.viewFromWorld * glm::dvec4(world, 1.0);
    const PixelRays rays = pixelRays(view);
    const double depth = -inView.z;
    return {depth, rays.centre + rays.focal * glm::dvec2(inView) / depth};
}

}  // namespace render

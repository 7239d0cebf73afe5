// One eye: all that drawing code knows of cameras. Perspective, any asymmetric frustum.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace render {

struct HiddenArea;

// Right-handed; view looks along -z, y up. Clip depth is [0, 1], 0 at the near plane. Pixels: (0,
// 0) is the lower left corner, as in GL; pictures are turned over when they are read back.
struct View {
    glm::dmat4 clipFromView{1.0};
    glm::dmat4 viewFromWorld{1.0};  // rigid, or rigid and one uniform scale
    glm::ivec2 size{0};
    // What of the picture nobody sees (render/annotate/hidden_area.h): GL leaves it out. None: all
    // is seen.
    std::shared_ptr<const HiddenArea> hidden = {};
    int across = 1;  // so many of the picture's pixels across are one of these
    friend bool operator==(const View&, const View&) = default;
};

// The same eye's pixels, so many across in one: the last ones of a side may reach beyond the view.
View coarser(const View& view, int across);
std::vector<View> coarser(std::span<const View> views, int across);

// What GL's depth buffer has for a view depth > 0.
inline double windowDepth(const View& view, double depth) {
    return (view.clipFromView[3][2] - view.clipFromView[2][2] * depth) / depth;
}

// Tangents of the half angles, left and down negative: x / -z of the frustum's sides.
struct Frustum {
    double left, right, down, up, near, far;
};
glm::dmat4 clipFromView(const Frustum& frustum);

// What the pixels of a view see, in world space. Offsets are window positions (in pixels, pixel
// centres at .5) less `centre`.
struct PixelRays {
    glm::dvec3 eye, axis, perPixelX, perPixelY;
    glm::dvec2 focal;   // pixels per unit of x / -z and y / -z
    glm::dvec2 centre;  // window position of the view axis
    double near;        // view depth of the near plane
    // What the ray of an offset leaves `eye` along, of view depth 1.
    glm::dvec3 along(const glm::dvec2& offset) const {
        return axis + offset.x * perPixelX + offset.y * perPixelY;
    }
};
PixelRays pixelRays(const View& view);
// As cells are drawn and held against the truth: as if the view axis lay a few thousandths of a
// pixel beside its place, which nothing shows. In a picture along an axis, or a diagonal, of its
// grid no pixel's ray lies in a face between cells then, of which rounding would tell whether both
// have it, or neither.
PixelRays besideFaces(PixelRays rays);

// View depth (> 0 in front of the eye) and window position of a world point.
struct Projected {
    double depth;
    glm::dvec2 window;
};
Projected project(const View& view, const glm::dvec3& world);

}  // namespace render

#include "render/annotate/box_edges.h"

#include <algorithm>
#include <glm/mat3x3.hpp>

namespace render {

std::vector<Edge> edges(const glm::dvec3& half) {
    std::vector<Edge> found;
    for (int axis = 0; axis < 3; ++axis) {
        if (half[axis] == 0) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const int su : {-1, 1}) {
            for (const int sv : {-1, 1}) {
                if ((half[u] == 0 && su > 0) || (half[v] == 0 && sv > 0)) continue;
                Edge edge{axis, glm::ivec3(0)};
                edge.side[u] = su;
                edge.side[v] = sv;
                found.push_back(edge);
            }
        }
    }
    return found;
}

Lies lies(const Edge& edge, const glm::dvec3& half, const glm::dvec3& eye) {
    int showing = 0;
    for (int a = 0; a < 3; ++a) {
        if (a == edge.axis) continue;
        if (half[a] == 0) return Lies::Outline;  // of a sheet or a line
        if (eye[a] * edge.side[a] > half[a]) ++showing;
    }
    return showing == 2 ? Lies::Front : showing == 1 ? Lies::Outline : Lies::Behind;
}

Screen::Screen(const View& view)
    : clipFromAxes_(view.clipFromView * view.viewFromWorld), size_(view.size) {}

glm::dvec3 Screen::pixel(const glm::dvec3& at) const {
    const glm::dvec4 clip = clipFromAxes_ * glm::dvec4(at, 1);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {(0.5 + 0.5 * ndc.x) * size_.x, (0.5 - 0.5 * ndc.y) * size_.y, ndc.z};
}

std::optional<glm::dvec2> Screen::visible(const glm::dvec3& a, const glm::dvec3& b, Cut cut) const {
    const glm::dvec4 from = clipFromAxes_ * glm::dvec4(a, 1);
    const glm::dvec4 to = clipFromAxes_ * glm::dvec4(b, 1);
    glm::dvec2 part(0, 1);
    // A point is visible where each of these is positive.
    const auto keep = [&](double atFrom, double atTo) {
        if (atFrom < 0 && atTo < 0) part = {1, 0};
        if (atFrom < 0 && atTo >= 0) part[0] = std::max(part[0], atFrom / (atFrom - atTo));
        if (atFrom >= 0 && atTo < 0) part[1] = std::min(part[1], atFrom / (atFrom - atTo));
    };
    keep(from.z, to.z);
    if (cut == Cut::Picture) {
        for (int a2 = 0; a2 < 2; ++a2) {
            keep(from.w - from[a2], to.w - to[a2]);
            keep(from.w + from[a2], to.w + to[a2]);
        }
    }
    if (part[0] >= part[1]) return std::nullopt;
    return part;
}

View viewFrom(const Middle& middle, const View& eye) {
    View view = eye;
    view.clipFromView[2][0] = middle.lean.x;
    view.clipFromView[2][1] = middle.lean.y;
    const glm::dmat3 rotation(eye.viewFromWorld);
    view.viewFromWorld[3] = glm::dvec4(-(rotation * middle.eye), 1);
    return view;
}

}  // namespace render

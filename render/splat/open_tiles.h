// Where in a picture that is drawn from the eye on something that comes now is still seen.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "render/splat/cell_view.h"
#include "render/splat/tile_plane.h"
#include "render/splat/window_box.h"

namespace render {

// Asked of tetrahedra before they are looked at (forEachTet): of these most are hidden where cells
// are opaque, and outside of the picture where the eye is among them. View and plane must outlive
// it, and the plane does not change meanwhile.
class OpenTiles {
 public:
    OpenTiles(const CellView& view, const TilePlane& plane) : view_(view), plane_(plane) {}
    // Whether a tile is open that something between these places may be seen in.
    bool operator()(std::span<const glm::dvec3> corners) const {
        return isOpenIn(windowBox(view_.seen, corners));
    }
    class Within {
     public:
        Within(const OpenTiles& of, const glm::dvec3& reach)
            : of_(of), box_(of.view_.seen, reach) {}
        bool operator()(const glm::dvec3& place) const { return of_.isOpenIn(box_(place)); }

     private:
        const OpenTiles& of_;
        ReachBox box_;
    };
    Within within(const glm::dvec3& reach) const { return {*this, reach}; }

 private:
    bool isOpenIn(const WindowBox& box) const;

    const CellView& view_;
    const TilePlane& plane_;
};

}  // namespace render

// What of a mesh's tetrahedra lies within a clip box: cut along its faces, plane after plane, in
// which the field goes on as it was (after Sutherland & Hodgman 1974, for solids).
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "render/points/placed_points.h"

namespace render {

// A part of a cell with the field at its corners, between which it is linear.
struct Tetrahedron {
    std::array<glm::dvec3, 4> at;  // in axis coordinates
    std::array<double, 4> values;
    // Of the cell's, those that corners are, or are cut from or nearest to.
    std::array<unsigned, 4> corners;
    std::array<glm::dvec3, 4> gradients;  // as MeshGradients has them, if there are some
};

class TetClip {
 public:
    TetClip(const PlacedPoints& placed, const IndexBox& clip);
    // Whether that is how the box clips this mesh; else by its points, each with what is nearest to
    // it: of a globe, whose coordinates are not those of space, and where the box is a plane, which
    // holds points, but nothing of a cell. A face of the box that no point is beyond
    // leaves half cells around the outermost ones, as without a box.
    bool cuts() const { return cuts_; }
    // use(Tetrahedron) for what is left of one, turned as it is; from an eye that is given, each
    // part before what it hides. REQUIRES: cuts().
    template <typename Use>
    void operator()(const Tetrahedron& tet, const glm::dvec3* eye, const Use& use) const;

 private:
    enum class Lies { Inside, Across, Outside };
    Lies where(const Tetrahedron& tet) const;
    const std::vector<Tetrahedron>& cut(const Tetrahedron& tet, const glm::dvec3* eye) const;

    glm::dvec3 lo_{0}, hi_{0};  // in axis coordinates
    bool cuts_;
};

template <typename Use>
void TetClip::operator()(const Tetrahedron& tet, const glm::dvec3* eye, const Use& use) const {
    const Lies lies = where(tet);
    if (lies == Lies::Inside) use(tet);
    if (lies == Lies::Across)
        for (const Tetrahedron& part : cut(tet, eye)) use(part);
}

}  // namespace render

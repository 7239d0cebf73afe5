// The cells of a grid whose points lie one by one, as tetrahedra: six about the diagonal from the
// first corner to the last (Kuhn 1960), along which neighbours' faces are divided alike, so that
// they fill what lies between the points without gaps, however it is bent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>

#include "render/model/tet_splat.h"
#include "render/points/placed_points.h"
#include "render/splat/tet_clip.h"
#include "timeseries/index/cell_corners.h"
#include "timeseries/index/point_gradients.h"

namespace render {

// A face of a mesh's cell, as both cells beside it name it.
using FaceKey = std::array<std::uint32_t, 3>;

// Corners that have no value get the mean of those that have one and are the fewest edges away, so
// that cells beside each other have like values on their common face; a bit for each that has one.
unsigned fillMissing(std::array<double, 8>& corners);

// A field's gradients at the points of a mesh, in units of its range (PointGradients) a length in
// axis coordinates. What it is made of must outlive it.
class MeshGradients {
 public:
    // Null: there are none.
    MeshGradients(const PlacedPoints& placed, const timeseries::PointGradients* gradients)
        : gradients_(gradients),
          perLength_(1.0 / (placed.scale() * (gradients ? gradients->extent() : glm::dvec3(1)))) {}
    explicit operator bool() const { return gradients_ != nullptr; }
    glm::dvec3 at(std::uint64_t point) const { return perLength_ * gradients_->at(point); }

 private:
    const timeseries::PointGradients* gradients_;
    glm::dvec3 perLength_;
};

// What it is made of must outlive it.
class MeshCells {
 public:
    // REQUIRES: placed.isMesh() and hasNeighbours().
    MeshCells(const PlacedPoints& placed, const timeseries::CellCorners& corners,
              const IndexBox& clip, const timeseries::PointGradients* gradients = nullptr);

    struct Hexahedron {
        std::array<glm::dvec3, 8> at;  // in axis coordinates
        std::array<double, 8> values;
        std::array<glm::dvec3, 8> gradients;  // as MeshGradients has them, if there are some
        unsigned octants = 0;                 // that are seen, as of SeenOctants
    };
    // None where nothing is seen: a corner has no place, or none a value, or, where the clip box
    // does not cut cells (TetClip), none a value within it. Half cells beyond the outermost points
    // reach as far as half the way to the points before these, and nowhere where a grid comes round
    // to where it began; on a globe those of the first and the last longitude meet. A layer of
    // points is as thick as its points' cells.
    std::optional<Hexahedron> operator()(const glm::uvec3& cell) const;
    using Tetrahedron = render::Tetrahedron;
    // use(Tetrahedron) for those that fill what is seen of it, within the clip box; from an eye
    // that is given, each before what it hides. Those that are turned inside out beside most of the
    // grid's are left out, as points' cells are.
    template <typename Use>
    void forEachTet(const Hexahedron& cell, const glm::dvec3* eye, const Use& use) const;
    // The six, right-handed where it is.
    template <typename Use>
    static void forEachTetIn(const Hexahedron& part, const glm::dvec3* eye, const Use& use);

    // What SolidTets (render/splat/solid_tets.h) has, too. Cells by their numbers:
    std::uint64_t count() const {
        return std::uint64_t{corners_.size().x} * corners_.size().y * corners_.size().z;
    }
    // The least and the greatest of the values at its corners; inf and -inf without any.
    std::pair<double, double> extentOf(std::uint32_t cell) const;
    // Where one of its corners is, in axis coordinates, about which the cell goes as far as reach()
    // says, and no farther.
    glm::dvec3 about(std::uint32_t cell) const { return placeOf(corners_.pointAt(at(cell), 0)); }
    // Begins to load what about() takes of cells to come: cellAhead(n) is the cell n places on in a
    // list, if there is one.
    template <typename CellAhead>
    void prefetch(const CellAhead& cellAhead) const {
        constexpr std::uint64_t kAhead = 16;
        if (const auto cell = cellAhead(kAhead))
            placed_.prefetch(corners_.indexOf(corners_.pointAt(at(*cell), 0)));
    }
    const glm::dvec3& reach() const { return reach_; }  // infinite for a layer of points
    // The point at a corner of one of its tetrahedra.
    std::uint64_t pointOf(std::uint32_t cell, unsigned corner) const {
        return corners_.indexOf(corners_.pointAt(at(cell), corner));
    }
    // use(Tetrahedron) for what is seen of it, if mayBeSeen(places of corners that it lies
    // between).
    template <typename MayBeSeen, typename Use>
    void forEachTet(std::uint32_t cell, const glm::dvec3* eye, const MayBeSeen& mayBeSeen,
                    const Use& use) const {
        const auto whole = (*this)(at(cell));
        if (whole && mayBeSeen(whole->at)) forEachTet(*whole, eye, use);
    }
    // use(key, sideOf) for its faces; sideOf(an eye in axis coordinates): > 0 where that is beyond
    // the face, < 0 where it is on the cell's side, 0 where that is not told, or for the cell
    // beyond to tell.
    template <typename Use>
    void forEachFace(std::uint32_t cell, const Use& use) const;
    std::uint64_t faceKeys() const { return count(); }  // a key's first number is less
    // use(triangle, side of the eye, as above) for those of one of its faces.
    template <typename Use>
    void forEachTriangle(std::uint32_t cell, const FaceKey& key, const glm::dvec3& eye,
                         const Use& use) const;
    // What goes as far along the coordinates of the file's space goes in axis coordinates.
    static glm::dvec3 reachOf(const PlacedPoints& placed, const glm::dvec3& length);

 private:
    // About the diagonal: the tetrahedra 0, ring[i], ring[i + 1], 7, right-handed in a right-handed
    // cell.
    static constexpr std::array<unsigned, 6> kRing{1, 3, 2, 6, 4, 5};
    using Order = std::array<std::uint8_t, 8>;
    static constexpr Order kAsTheyAre{0, 1, 2, 3, 4, 5, 6, 7};
    static Order ringFrom(const glm::dvec3& eye, const std::array<glm::dvec3, 8>& at);
    static Order octantsFrom(const glm::dvec3& eye, const std::array<glm::dvec3, 8>& at);

    glm::uvec3 at(std::uint32_t cell) const { return timeseries::indicesOf(cell, corners_.size()); }
    glm::dvec3 placeOf(const glm::uvec3& point) const;
    // From a point, or from where another is, the shorter way round.
    glm::dvec3 way(const glm::dvec3& from, const glm::dvec3& to) const;
    glm::dvec3 cornerAt(const glm::uvec3& cell, unsigned corner) const;
    // From an outermost point half a cell on along an index.
    glm::dvec3 beyond(const glm::uvec3& point, int axis, bool before) const;
    bool isSeam(const glm::uvec3& point) const;
    // All but the first, and whether they are drawn where the cells beyond them have them.
    struct FarCorners {
        std::array<glm::dvec3, 8> at;
        std::array<bool, 3> isShared;  // that of each axis
    };
    FarCorners farCorners(const glm::uvec3& cell) const;
    // Of the face at the cell's end along an axis.
    double sideOfFace(const FarCorners& corners, int axis, const glm::dvec3& eye) const;
    bool comesRound(const glm::uvec3& point, int axis) const;
    // Whether the last cell along an axis is beside the first one.
    bool joinsFirst(const glm::uvec3& cell, int axis) const {
        const glm::uvec3 point = corners_.pointAt(cell, 0);
        return comesRound(point, axis) || (axis == 0 && isSeam(point));
    }
    glm::uvec3 inwardOf(glm::uvec3 point, int axis) const;
    glm::dvec3 acrossLayer(const glm::uvec3& point, int axis) const;
    Hexahedron octantOf(const Hexahedron& cell, unsigned octant) const;

    const PlacedPoints& placed_;
    timeseries::CellCorners corners_;
    const IndexBox& clip_;
    TetClip cut_;
    MeshGradients gradients_;
    glm::uvec3 points_;
    glm::dvec3 period_, reach_;
    bool byPoints_, isLeft_;  // the box clips so; most cells of the grid are left-handed
};

template <typename Use>
void MeshCells::forEachTetIn(const Hexahedron& part, const glm::dvec3* eye, const Use& use) {
    const Order order = eye ? ringFrom(*eye, part.at) : kAsTheyAre;
    for (std::size_t n = 0; n < kRing.size(); ++n) {
        const std::size_t k = order[n], next = (k + 1) % kRing.size();
        Tetrahedron tet{
            .at = {}, .values = {}, .corners = {0, kRing[k], kRing[next], 7}, .gradients = {}};
        for (std::size_t i = 0; i < 4; ++i) {
            tet.at[i] = part.at[tet.corners[i]];
            tet.values[i] = part.values[tet.corners[i]];
            tet.gradients[i] = part.gradients[tet.corners[i]];
        }
        use(tet);
    }
}

template <typename Use>
void MeshCells::forEachFace(std::uint32_t cell, const Use& use) const {
    const glm::uvec3 here = at(cell);
    const auto& size = corners_.size();
    std::optional<FarCorners> corners;  // when they are asked for
    std::uint32_t step = 1;
    for (int axis = 0; axis < 3; step *= size[axis++]) {
        const auto along = static_cast<std::uint32_t>(axis);
        use(FaceKey{cell, along, 0}, [](const glm::dvec3&) { return 0.0; });
        const bool isLast = here[axis] + 1 == size[axis];
        if (isLast && !joinsFirst(here, axis)) continue;
        const std::uint32_t next = isLast ? cell - here[axis] * step : cell + step;
        use(FaceKey{next, along, 0}, [&](const glm::dvec3& eye) {
            if (!corners) corners = farCorners(here);
            return sideOfFace(*corners, axis, eye);
        });
    }
}

template <typename Use>
void MeshCells::forEachTriangle(std::uint32_t cell, const FaceKey& key, const glm::dvec3& eye,
                                const Use& use) const {
    const bool isNear = key[0] == cell;
    const unsigned axis = key[1];
    const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    const unsigned end = isNear ? 0 : 1u << axis;
    const glm::uvec3 here = at(cell);
    const glm::dvec3 first = cornerAt(here, end);
    const auto place = [&](unsigned corner) {
        return first + way(first, cornerAt(here, end | corner));
    };
    const glm::dvec3 across = place(u | v);
    for (const auto& [b, c] : {std::pair(place(u), across), std::pair(across, place(v))}) {
        const double side = glm::dot(glm::cross(b - first, c - first), eye - first);
        use(std::array{first, b, c}, isNear != isLeft_ ? -side : side);
    }
}

template <typename Use>
void MeshCells::forEachTet(const Hexahedron& cell, const glm::dvec3* eye, const Use& use) const {
    const auto fill = [&](const Hexahedron& part, std::optional<unsigned> octant) {
        forEachTetIn(part, eye, [&](Tetrahedron& tet) {
            if (octant) tet.corners.fill(*octant);
            if ((turnOf(tet.at) < 0) != isLeft_) return;
            if (cut_.cuts()) return cut_(tet, eye, use);
            use(tet);
        });
    };
    if (cell.octants == 255) return fill(cell, std::nullopt);
    for (const std::uint8_t o : eye ? octantsFrom(*eye, cell.at) : kAsTheyAre)
        if (cell.octants >> o & 1) fill(octantOf(cell, o), o);
}

}  // namespace render

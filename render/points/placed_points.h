// A grid placed in the world: where its points are drawn and how large their cells are there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/points/globe.h"
#include "render/points/view.h"
#include "timeseries/grid/grid.h"

namespace render {

// Points between planes: of a grid without a mesh inclusive ranges of indices, lo > hi holding
// nothing; of a mesh also closed ranges of the file's coordinates.
struct IndexBox {
    glm::uvec3 lo{0}, hi{0xffffffffu};
    glm::dvec3 from{-std::numeric_limits<double>::infinity()},
        to{std::numeric_limits<double>::infinity()};
    bool holds(const glm::uvec3& at) const {
        return at.x >= lo.x && at.y >= lo.y && at.z >= lo.z && at.x <= hi.x && at.y <= hi.y &&
               at.z <= hi.z;
    }
    bool holdsAll() const {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        return lo == glm::uvec3(0) && hi == glm::uvec3(0xffffffffu) &&
               from == glm::dvec3(-kInfinity) && to == glm::dvec3(kInfinity);
    }
    bool holdsPlace(const glm::dvec3& place) const {
        return place.x >= from.x && place.y >= from.y && place.z >= from.z && place.x <= to.x &&
               place.y <= to.y && place.z <= to.z;
    }
};

// How longitudes and latitudes are drawn.
enum class Map { Flat, Globe };

// What a picture is to show all of: a box about the world's centre, or the ball in it.
struct Outline {
    glm::dmat3 boxHalfEdges;  // columns: from the centre to the middles of three faces
    bool isBall = false;      // as wide as the box along x
    // So for a box that the half cells around the outermost points are in, too.
    glm::dmat3 filledHalfEdges;
    Outline(const glm::dmat3& halfEdges, bool ball = false)
        : boxHalfEdges(halfEdges), isBall(ball), filledHalfEdges(halfEdges) {}
};

// World coordinates: z up, the centre of the grid's box at 0, and the box scaled so that its
// farthest corners are 1 away. That keeps every coordinate near 1 whatever the grid's units and
// offsets are.
//
// Axis coordinates: world lengths along the grid's axes from the same centre. There every box and
// cell is upright, but for the cells of a mesh; worldFromAxes() turns and shears them to where they
// stand, and is the identity for a grid whose axes are those of its space, as a mesh's are.
class PlacedPoints {
 public:
    // `stretch` multiplies the grid's units, each along its axis, before the uniform scaling.
    // Without it axes of one unit keep their proportions, however flat, and axes of other units are
    // fitted to half the length of the longest. Axes that count downwards are drawn downwards.
    // On a globe (render/points/globe.h) points are those of a mesh in space, of whose `stretch`
    // the third counts; clip boxes stay the file's. A grid that a globe cannot show lies flat.
    explicit PlacedPoints(const timeseries::Grid& grid, std::optional<glm::dvec3> stretch = {},
                          Map map = Map::Flat);

    glm::uvec3 size() const { return size_; }  // points along the indices
    // In the world.
    glm::dvec3 position(std::uint64_t index) const;
    glm::dvec3 alongAxes(std::uint64_t index) const;  // in axis coordinates
    // The same of a corner of a mesh's solid cells: of a point or a node.
    glm::dvec3 cornerAlongAxes(std::uint64_t corner) const {
        return meshScale_ * (mesh_->cornerPosition(corner) - meshCentre_);
    }
    glm::uvec3 indices(std::uint64_t index) const;
    // Whether that point is within the box.
    bool inside(std::uint64_t index, const IndexBox& box) const;

    // Points that lie one by one, and cells of any shape. A point without a place is nowhere: its
    // coordinates are no numbers.
    bool isMesh() const { return mesh_ != nullptr; }
    bool hasNeighbours() const { return !mesh_ || mesh_->hasNeighbours(); }
    // REQUIRES: isMesh(). The shape in the world of the cell that the point stands for, its
    // determinant zero where nothing is drawn.
    timeseries::LowerTriangle<double> meshCell(std::uint64_t index) const;
    // Of the cell; splats may be wider.
    double meshVolume(std::uint64_t index) const;
    // Along each axis, after how much a mesh's coordinates come again; 0: never.
    glm::dvec3 period() const { return mesh_->period() * glm::abs(scale()); }
    void prefetch(std::uint64_t index) const { mesh_->prefetch(index); }
    const std::shared_ptr<const timeseries::Mesh>& mesh() const { return mesh_; }  // none: null

    const Globe* globe() const { return globe_.get(); }  // none: null
    // In axis coordinates, from those of the globe. REQUIRES: globe().
    glm::dvec3 axesFromGlobe(const glm::dvec3& place) const {
        return meshScale_ * (place - meshCentre_);
    }
    // What an eye cannot see through, in axis coordinates: the Earth of a globe.
    struct Ball {
        glm::dvec3 centre;
        double radius;
    };
    std::optional<Ball> ball() const;
    // Where a ray from an eye meets that, in multiples of `along`; infinity where it does not. Both
    // in axis coordinates.
    double ballOnRay(const glm::dvec3& eye, const glm::dvec3& along) const;

    // REQUIRES of these: not isMesh(). Lengths of the cell's sides, all > 0.
    glm::dvec3 cell(std::uint64_t index) const;
    // Per axis, by index along it, in axis coordinates.
    const std::array<std::vector<double>, 3>& positions() const { return positions_; }
    const std::array<std::vector<double>, 3>& widths() const { return widths_; }

    // No cell's side is longer, and no cell of a mesh has steps whose squares add up to more than
    // that of this; in axis coordinates.
    double widest() const { return widest_; }

    // Columns: the directions of the axes in the world, of length 1.
    const glm::dmat3& worldFromAxes() const { return worldFromAxes_; }
    // What a length in axis coordinates is in the world, at least and at most: the singular values
    // of worldFromAxes().
    struct Lengthening {
        double least, most;
    };
    Lengthening lengthening() const;
    // The view as it sees axis coordinates: no longer rigid when the axes are oblique.
    View inAxes(const View& view) const;

    // The length l in which optical depth is counted: the cube root of the mean cell volume.
    double unitLength() const { return unitLength_; }
    // All cells are cubes of one size, to 1e-12. Not told of a mesh's.
    bool cubes() const;
    // Cells along some axis are more than 3 times as long as those of another are in the mean:
    // their splats end where the cells do (render/model/footprint.h). Of a mesh, its columns have
    // few levels, and splats end above and below.
    bool longCells() const { return longCells_; }
    // What the cells fill, the half ones around the outermost points included; in axis coordinates.
    // Of a mesh pointsBox(), with half a cell above and below where its cells are long.
    struct Box {
        glm::dvec3 lo, hi;
    };
    Box domain() const;
    // Between the outermost points: boxHalf() about the centre, but for a mesh that moves, whose
    // steps are in one box as far as they go.
    Box pointsBox() const;
    // Of a mesh, that its nodes are in, too.
    Box cornersBox() const;
    // Half sides of the points' box, in axis coordinates; all zero for a single point.
    glm::dvec3 boxHalf() const { return boxHalf_; }
    // The half box in the world: columns from the centre of the box to the middles of its faces.
    glm::dmat3 boxHalfEdges() const;
    // Without placing a point.
    static Outline outlineOf(const timeseries::Grid& grid, std::optional<glm::dvec3> stretch,
                             Map map);
    Outline outline() const;
    // World length per grid unit along each axis, signed; their ratios are what a picture states.
    glm::dvec3 scale() const;
    // In axis coordinates, from the grid's coordinates along its axes.
    glm::dvec3 axesFromGrid(const glm::dvec3& grid) const;
    glm::dvec3 gridFromAxes(const glm::dvec3& axes) const;  // and back

 private:
    void placeOnGlobe(const timeseries::Grid& grid, std::optional<glm::dvec3> stretch);
    void measureMesh();
    void measureAxes(const timeseries::Grid& grid);

    std::array<std::vector<double>, 3> positions_, widths_;
    std::shared_ptr<const timeseries::Mesh> mesh_, fileMesh_;  // drawn, and the grid's own
    std::shared_ptr<const Globe> globe_;
    glm::dvec3 meshScale_{1}, meshCentre_{0};  // scale_ and centre_, for many points
    glm::uvec3 size_{1};
    // Long doubles: products and squares of very large or small extents leave the doubles.
    std::array<long double, 3> scale_{}, centre_{};
    glm::dmat3 worldFromAxes_{1.0};
    glm::dvec3 boxHalf_{0};
    double unitLength_ = 1, widest_ = 0;
    bool longCells_ = false;
    std::array<double, 2> beyondBox_{};  // how far a mesh's long cells reach below and above
};

// The unit that lengths along an axis are compared in: degrees of longitude and of latitude are
// drawn alike.
std::string comparableUnit(const timeseries::Axis& axis);
// How many of another axis's units one of this one's is as long as: 1000 of "km" and "metre".
// Nothing where they measure different things.
std::optional<double> unitRatio(const timeseries::Axis& of, const timeseries::Axis& other);

// The points inside closed ranges of the grid's coordinates along its axes: what `info` and the
// labels of a picture tell, also of a rotated or sheared grid.
IndexBox indexBox(const timeseries::Grid& grid, const glm::dvec3& lo, const glm::dvec3& hi);

}  // namespace render

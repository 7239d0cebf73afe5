// Where point i of a field lies and the shape of its cell. Pure geometry in double: no values.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/earth_places.h"
#include "timeseries/grid/mesh.h"

namespace timeseries {

// One axis of a rectilinear grid, or of the space that a mesh lies in.
struct Axis {
    std::string name;   // as in the file: "lon", "depth"
    std::string units;  // as in the file; "" for none, "index" when counted, not measured
    // [n], strictly ascending or strictly descending, n >= 1; of a mesh the least and the greatest.
    std::vector<double> coordinates;
    bool down = false;  // greater coordinates lie lower (depth, pressure)

    // Spaced evenly to within 1e-4 of the mean step, the rounding of coordinates stored as floats.
    bool uniform() const;
    // The part of the axis that point i stands for: half the way to each neighbour, signed along
    // increasing index; at an end the whole step to its only neighbour. An axis of one point has
    // width 0: Grid::cell gives it a thickness.
    double width(std::size_t i) const;
    friend bool operator==(const Axis&, const Axis&) = default;
};

// How the axes lie in the file's space: coordinates c along them are the place origin + directions
// c.
struct CoordinateFrame {
    glm::dmat3 directions{1.0};  // columns: of length 1, along increasing coordinates
    glm::dvec3 origin{0.0};
    std::array<std::string, 3> names{"x", "y", "z"};  // of the coordinates of space

    // Whether each axis runs along its own coordinate of space, which it then measures.
    bool aligned() const { return directions == glm::dmat3(1.0); }
    friend bool operator==(const CoordinateFrame&, const CoordinateFrame&) = default;
};

// For each axis the coordinate of space that it runs along, forwards or backwards, but for
// rounding (1e-6); nothing when one runs along none or two along one.
std::optional<std::array<int, 3>> alignedWith(const glm::dmat3& directions);
// What keeps directions from placing points, in words; "" when nothing does.
std::string flawOf(const glm::dmat3& directions);

// 0, 1, 2, ...: the coordinates of an axis that is counted, not measured (units "index").
std::vector<double> indexCoordinates(std::uint64_t length);
// What keeps coordinates from placing points, in words; "" when nothing does. REQUIRES: not empty.
std::string flawOf(const std::vector<double>& coordinates);

// The places along the axes of point `index` of a grid of this size, x fastest. In the narrowest
// type that holds the index: it divides fastest.
template <std::unsigned_integral I>
constexpr glm::vec<3, I> indicesOf(I index, const glm::vec<3, I>& size) {
    const I row = index / size.x, slice = row / size.y;
    return {index - row * size.x, row - slice * size.y, slice};
}
// The same of many indices below 2^32, without dividing: half a point beyond an index no quotient
// is so near a whole number that rounding of doubles passes it.
class IndicesAlong {
 public:
    explicit IndicesAlong(const glm::uvec3& size)
        : row_(size.x),
          slice_(size.x * size.y),
          perRow_(1.0 / size.x),
          perSlice_(perRow_ / size.y) {}
    glm::uvec3 operator()(std::uint32_t index) const {
        const auto whole = [](double quotient) {
            return static_cast<std::uint32_t>(static_cast<std::int64_t>(quotient));
        };
        const std::uint32_t z = whole((index + 0.5) * perSlice_), inSlice = index - z * slice_;
        const std::uint32_t y = whole((inSlice + 0.5) * perRow_);
        return {inSlice - y * row_, y, z};
    }

 private:
    std::uint32_t row_, slice_;  // the latter means nothing where there is only one
    double perRow_, perSlice_;
};

// Uniform and rectilinear grids, also rotated and sheared ones, and curvilinear ones, whose points
// lie where a mesh says. Points are numbered by their places along three indices, the first
// fastest: index = i + ni (j + nj k). Of a grid without a mesh these run along its axes.
class Grid {
 public:
    // Throws std::invalid_argument when an axis is empty, not finite or not strictly monotonic, the
    // directions are flawed, or the point count passes 2^63.
    explicit Grid(std::array<Axis, 3> axes, CoordinateFrame frame = {});
    // Axes without coordinates get the bounds of the mesh's corners, one coordinate where these
    // differ by rounding alone. Of a mesh that moves, they are the series', and each step has a
    // grid, whose memory is its own.
    Grid(std::array<Axis, 3> space, std::shared_ptr<const Mesh> mesh, bool ofOneStep = false);

    const std::array<Axis, 3>& axes() const { return axes_; }
    const CoordinateFrame& frame() const { return frame_; }
    // None: the axes tell where each point lies.
    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    bool ofOneStep() const { return ofOneStep_; }
    // Where its columns stand on the Earth, if its first two axes do not tell. None: null.
    const std::shared_ptr<const EarthPlaces>& earth() const { return earth_; }
    std::array<std::size_t, 3> size() const;
    std::uint64_t count() const;
    bool uniform() const;

    // The least and the greatest coordinate along an axis.
    using Ends = Mesh::Ends;
    Ends ends(std::size_t axis) const;
    // REQUIRES of both: no mesh. The places along an index whose coordinates are in [lo, hi], the
    // first and the last; nothing where there are none.
    struct Places {
        std::size_t first, last;
    };
    std::optional<Places> placesWithin(std::size_t axis, double lo, double hi) const;
    // The coordinate of the points nearest to this one.
    double nearestPlane(std::size_t axis, double coordinate) const;
    // The same points, where axes have these names ("" leaves one) and count the other way.
    Grid relabelled(const std::array<std::string, 3>& names, const std::array<bool, 3>& flip) const;
    // The same points, of which that is known. REQUIRES: as many columns as a level has points.
    Grid withEarth(std::shared_ptr<const EarthPlaces> earth) const;

    glm::vec<3, std::uint64_t> indices(std::uint64_t index) const;
    // In the file's space, in the units of the axes.
    glm::dvec3 position(std::uint64_t index) const;
    // REQUIRES: no mesh. Columns: the steps along the indices that the point stands for (index step
    // -> the file's space). Never singular: an axis of one point takes the smallest mean step of
    // the others, else 1.
    glm::dmat3 cell(std::uint64_t index) const;

    // The same points in another space, which `of` tells from others. make() is called once while
    // somebody holds what it made, of which others may ask meanwhile. Null where it made none.
    std::shared_ptr<const Mesh> elsewhere(
        double of, const std::function<std::shared_ptr<const Mesh>()>& make) const;
    // What was made, while somebody holds it; else null. Never waits for who makes one.
    std::shared_ptr<const Mesh> elsewhereIfMade(double of) const;

    friend bool operator==(const Grid& a, const Grid& b) {
        const bool sameMesh = a.mesh_ == b.mesh_ || (a.mesh_ && b.mesh_ && *a.mesh_ == *b.mesh_);
        const bool sameEarth =
            a.earth_ == b.earth_ || (a.earth_ && b.earth_ && *a.earth_ == *b.earth_);
        return sameMesh && sameEarth && a.axes_ == b.axes_ && a.frame_ == b.frame_;
    }

 private:
    std::array<Axis, 3> axes_;
    CoordinateFrame frame_;
    std::shared_ptr<const Mesh> mesh_;
    bool ofOneStep_ = false;
    std::shared_ptr<const EarthPlaces> earth_;
    struct Elsewhere;
    std::shared_ptr<Elsewhere> elsewhere_;  // shared by copies
};

// Coordinates x, y and z without bounds: of points that lie one by one.
std::array<Axis, 3> spaceAxes();

// The grid of a step of a series whose grid is `series`: that one, if the step's is the same; of a
// mesh that moves the step's places, within the series' bounds, so that all are drawn in one box.
// Null where they are no steps of one series.
std::shared_ptr<const Grid> gridOfStep(const std::shared_ptr<const Grid>& series,
                                       const std::shared_ptr<const Grid>& step);

}  // namespace timeseries

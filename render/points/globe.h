// The Earth as a ball: where places of longitude, latitude and height lie in space. Pure, in
// double.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <optional>

#include "timeseries/grid/grid.h"

namespace render {

inline constexpr double kPerDegree = std::numbers::pi / 180;  // in radians

// Whether the first two axes are longitude and latitude in degrees (CF 1.10, sections 4.1 and 4.2),
// at most once round.
bool isGeographic(const timeseries::Grid& grid);
// Whether that is what they are, however often they go round.
bool saysDegrees(const timeseries::Grid& grid);
// Whether a point's longitude and latitude are known: so, or beside other axes (Grid::earth()).
bool isOnEarth(const timeseries::Grid& grid);
// In degrees, as onEarth() tells them. REQUIRES: isOnEarth(grid).
glm::dvec2 onEarth(const timeseries::Grid& grid, std::uint64_t index);
struct EarthEnds {
    glm::dvec2 lo, hi;
};
EarthEnds earthEnds(const timeseries::Grid& grid);  // likewise
// Coordinates that count downwards from the surface of the Earth: lengths, or what says that it is
// the sea's. The air's pressures and hybrid levels count down to it.
bool isDepth(const timeseries::Axis& axis);

// The surface has radius 1 about the origin. At longitude a, latitude b and radius r a place is
//   (r cos b cos a, r cos b sin a, r sin b),
// and of a field that covers less than half of the longitudes this turned so that at its middle x
// leads east, y north and z up, and tilted towards who looks from the front (-y) by half of its
// latitudes. Heights, depths, and what else the third axis counts, add to the
// radius or take from it in proportion, exaggerated.
class Globe {
 public:
    static constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 26;  // 24 bytes each
    static constexpr double kPole = 90.01;  // degrees, beyond rounding

    // `stretch`: of lengths how many times as long as on the Earth they are drawn, of other units
    // how many degrees of the surface one of them is. Without it they reach a tenth of the radius,
    // or half of the field's longer side where that is less. In either case no deeper than nine
    // tenths of the radius, and no higher than nine times as far out. REQUIRES: isOnEarth(grid).
    explicit Globe(const timeseries::Grid& grid, std::optional<double> stretch = {});
    // Whether a grid can be drawn so: on the Earth, between the poles, of so many points at most,
    // of more than one place, and of heights that are told apart.
    static bool shows(const timeseries::Grid& grid);

    // `place`: longitude and latitude in degrees, and the third coordinate as the file has it.
    glm::dvec3 at(const glm::dvec3& place) const;
    // The way back: a longitude within half a turn of the field's middle. On a surface without
    // levels the third coordinate is the surface's. REQUIRES: not the Earth's middle.
    glm::dvec3 placeOf(const glm::dvec3& at) const;
    struct Directions {
        glm::dvec3 east, north, up;
    };
    // The sine and the cosine of degrees, which the points of a meridian or a parallel share.
    struct Angle {
        double sine, cosine;
        explicit Angle(double degrees);
    };
    Directions directionsAt(const Angle& longitude, const Angle& latitude) const;
    Directions directionsAt(const glm::dvec3& place) const {
        return directionsAt(Angle(place.x), Angle(place.y));
    }
    double radius(double third) const { return 1 + perUnit_ * (third - surface_); }
    // Columns: the ways of a degree east, a degree north and a unit of the third coordinate.
    glm::dmat3 waysAt(const glm::dvec3& place) const;
    // What is between the ends of the grid's axes lies in this box, as do all steps of a series; of
    // a field that goes about half of the longitudes or more all of the globe.
    struct Box {
        glm::dvec3 lo, hi;
    };
    Box box() const;
    bool isWhole() const { return 2 * (hi_.x - lo_.x) >= 360; }
    // Below all that is drawn.
    double ballRadius() const { return ball_; }

    double surface() const { return surface_; }  // the third coordinate there
    bool liesBelow() const { return below_; }    // what is drawn, below the surface
    // Of lengths, how many times as long as on the Earth they are drawn; of other units nothing.
    std::optional<double> exaggeration() const;
    double degreesPerUnit() const;  // of the surface that a unit is drawn as long as; 0: none
    // The corners of the field, in degrees.
    glm::dvec2 lo() const { return glm::dvec2(lo_); }
    glm::dvec2 hi() const { return glm::dvec2(hi_); }

    // The grid's points in this space: of upright grids cells have the volumes that they have
    // between spheres, cones and half planes, exactly; at 360 degrees the first and the last points
    // are one. Made once while somebody holds it; null once it is not wanted any more. Throws
    // std::invalid_argument when no cell has a volume there. REQUIRES: no more points than that, no
    // latitudes beyond the poles.
    std::shared_ptr<const timeseries::Mesh> meshOf(const timeseries::Grid& grid,
                                                   const std::atomic<bool>& wanted = true) const;
    // Null where nobody holds one. Never waits.
    std::shared_ptr<const timeseries::Mesh> meshIfMade(const timeseries::Grid& grid) const {
        return grid.elsewhereIfMade(perUnit_);
    }

 private:
    glm::dmat3 turn_{1.0};
    glm::dvec3 lo_, hi_;   // the ends of the axes
    bool isSound() const;  // radii are numbers, and several levels have several

    double surface_ = 0, perUnit_ = 0, ball_ = 1;
    std::optional<double> metres_;  // of a unit
    bool below_ = false;
};

// Of a stretch of all three axes.
inline Globe globeOf(const timeseries::Grid& grid, const std::optional<glm::dvec3>& stretch) {
    return Globe(grid, stretch ? std::optional(stretch->z) : std::nullopt);
}

}  // namespace render

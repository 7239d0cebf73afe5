// What a map shows beside data: coastlines, and lines of longitude and latitude.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render/points/placed_points.h"
#include "timeseries/grid/grid.h"

namespace render {

// Degrees, x east and y north.
using MapLine = std::vector<glm::dvec2>;

// Of the world, at 1:110,000,000 (datasets/coastlines_110m.txt): x in [-180, 180].
const std::vector<MapLine>& coastlines();

// The part of a map that a grid's box covers, at the surface of the Earth: on top of what lies in
// depths, below all else.
struct MapPlane {
    glm::dvec2 lo, hi;  // degrees
    double height;      // of the file's third coordinate
    int side;           // of the box: 1 above, -1 below, in the world
};
// Nothing where the first two axes are not longitude and latitude in degrees.
std::optional<MapPlane> mapPlaneOf(const timeseries::Grid& grid);

// Lines as far as they lie within, whole turns east and west of where they are, too.
std::vector<MapLine> linesWithin(const MapPlane& plane, const std::vector<MapLine>& lines);
// Of round longitudes and latitudes, as far as the plane goes.
std::vector<MapLine> graticuleOf(const MapPlane& plane);

}  // namespace render

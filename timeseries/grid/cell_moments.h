// How much space a polyhedron, polygon or line takes, where, and how far it reaches each way: the
// moments of a uniform density 1 over it.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace timeseries {

struct CellMoments {
    double volume = 0;  // of a surface its area, of a line its length; 0: it takes no space
    glm::dvec3 centroid{0};
    glm::dmat3 second{0.0};  // the mean of (x - centroid)(x - centroid)^T
};

// A face is bounded by straight lines between its corners, round it, and spanned to the mean of
// these, so that the cells on both of its sides meet there, and a hexahedron takes as much space as
// the trilinear one of its corners. Solids of few corners: solid_moments.h.
//
// Of faces of any number of corners, each turned either way: star-shaped about their middle.
CellMoments momentsOfPolyhedron(std::span<const std::vector<glm::dvec3>> faces);
CellMoments momentsOfPolygon(std::span<const glm::dvec3> corners);
CellMoments momentsOfLine(std::span<const glm::dvec3> corners);

}  // namespace timeseries

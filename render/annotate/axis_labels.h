// Which edges of a box carry its axes, and where their numbers and names stand. Pure.
//
// An axis is labelled along an edge on the box's outline: x and y along the lowest, z along the
// leftmost that has room for two numbers. It has two numbers or more wherever there is room for
// them beside an edge that is five times as long as two of them need to stand apart: among
// multiples of 1, 2 and 5 there are then two. On the box they stand where only there is room.
//
// Numbers come before names, those of z before those of x and y, so that no name takes a number's
// place. A name lies along the edge whose numbers it is of, nearer to it than to any other axis'
// edges and off their numbers: beyond its own or between them; where there is no room for all of it
// shortened, with its unit all the same, then on the box; else its unit alone, or nowhere. An axis
// that is seen end-on through the box has none. One that is no longer than a line of text is high,
// as depth is where it is drawn true beside degrees, is not labelled.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/annotate/label_places.h"
#include "render/points/placed_points.h"

namespace render {

struct AxisLabels {
    Edge edge;
    std::vector<double> ticks;                  // in the file's coordinates
    std::vector<glm::dvec3> places;             // of the ticks, in axis coordinates
    glm::dvec2 outward{0};                      // in the picture, of length 1
    std::vector<std::optional<Label>> numbers;  // of the ticks
    std::optional<Label> name;
};

double tickLength(FontStyle style);

// `taken`: what other texts cover, with their grounds. Sees the box through `sights`, in axis
// coordinates.
std::vector<AxisLabels> axisLabels(const timeseries::Grid& grid, const PlacedPoints& placed,
                                   const Sights& sights, const glm::dvec3& midEye,
                                   glm::ivec2 pictureSize, const Font& font, FontStyle style,
                                   std::span<const PixelRect> taken);

}  // namespace render

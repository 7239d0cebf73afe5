// The eyes of a picture: one in the middle, or two side by side with off-axis frusta.
#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "app/choices/explorer.h"
#include "render/points/placed_points.h"
#include "render/points/view.h"

namespace app {

// From the centre, in the world: azimuth 0 at -y, 90 at +x. Of length 1.
glm::dvec3 directionOf(double azimuthDegrees, double elevationDegrees);

// How a view looks at its target, whatever its projection and however many its eyes. World units.
struct Stand {
    glm::dmat3 axes;    // columns: right, up, back (towards the eye)
    double distance;    // the view's own, or the one from which all of the box is seen
    glm::dvec3 target;  // in the middle of the picture: the view's own, or one beside the centre
    glm::dvec2 slope;   // half the picture's width and height at the target, over `distance`
    glm::dvec2 shift;   // of the target, in halves of the picture's sides from the middle
};
// The part of a picture about its middle that a box may fill, in halves of the picture's sides:
// what titles and the labels around a box leave free. Labels find places among the box's edges, so
// that little is kept free for them.
glm::dvec2 freeAreaOf(glm::ivec2 size);
// Without a distance, the box or ball (centre at 0) spans kBoxShare of the free area in one
// direction, and no more in the other; where the half cells around the outermost points reach
// beyond the free area then, they span all of it. Where the view has no target of its own either,
// what is seen of the box stands in the middle: the nearer corners of a perspective reach farther,
// so that the target is then beside the box's centre, mostly below or above it.
//
// From there it is shifted as little as clears the legend (`legend`: its size in pixels, in the
// upper left corner; 0: there is none), all of it the same, and seen from farther where it has no
// room: by kFarther at most. Where that is not enough the picture is as it is without a legend.
inline constexpr double kBoxShare = 0.9;
inline constexpr double kFarther = 4.0 / 3;
Stand standOf(const ViewChoice& view, const render::Outline& outline, glm::ivec2 size,
              const glm::dvec2& legend = glm::dvec2(0));
// What an explorer's legend takes of the picture, whatever its numbers are; 0 where it has none.
glm::dvec2 legendOf(const Explorer& explorer);

// One view, or left then right. The eyes look along parallel axes and their frusta meet at the
// convergence distance (off-axis projection), so that nothing is sheared or keystoned.
//
// An orthographic view is a perspective from kFarEye half diagonals (the distance, where that is
// more) through a frustum as much narrower, so that the plane through the box's centre has the size
// that a perspective from `distance` gives it. A point of the box is then off by at most
// 1 / (kFarEye - 1) of its distance from the middle of the picture: 1/12 of a pixel in a picture of
// 1600. Its eyes are as much farther apart, so that depth shows as it does in the perspective.
inline constexpr double kFarEye = 1e4;
std::vector<render::View> eyes(const ViewChoice& view, const StereoChoice& stereo,
                               const render::Outline& outline, glm::ivec2 size,
                               const glm::dvec2& legend = glm::dvec2(0));
// As an explorer's picture has them.
std::vector<render::View> eyes(const Explorer& explorer, const render::Outline& outline);

}  // namespace app

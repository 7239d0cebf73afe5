// The space that points stand for which lie without cells or neighbours.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "timeseries/grid/mesh.h"

namespace timeseries {

// Each stands for as much as one of its 16 nearest does of the ball that just holds these (of more
// points at one place, of the ball that reaches another place), or, where most lie along lines, as
// a track's do, for a cube as wide as they are apart. Splats then sum up to 1 on average (0.98
// to 1.02) where points lie more or less evenly; points that lie by chance sum up unevenly whatever
// they stand for: tests/bench/NOTES.md. All at one place stand for 1 together, those that are not
// finite for none. Throws std::invalid_argument when nothing has a volume.
Mesh meshOfScattered(std::span<const glm::dvec3> at);

// Splats are wider than a lattice's: points lie closer in one place than in another.
constexpr double kScatteredSpread = 1.5;

// The same of points of which it is known what each stands for. Splats are as wide as cubes of
// these volumes, times the spread; points whose volume is not finite, or not above 0, stand for
// nothing.
Mesh meshOfVolumes(std::span<const glm::dvec3> at, const std::vector<double>& volumes,
                   double spread = kScatteredSpread);

}  // namespace timeseries

// What a picture's light loses by the order in which it puts together what a ray passes, told from
// some of its pixels. It is looked at apart from all else that a picture gets wrong: what is put
// together are the exact parts of the interval volume (render/reference/parts_on_rays.h), with the
// picture's own opacities and colours, evenly lit.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/together.h"
#include "timeseries/grid/field.h"

namespace render {

//   sqrt( sum w |drawn - exact|^2 / sum w |exact|^2 )
// of premultiplied linear light, each pixel's of the ray in its middle and counted `weights` times.
// `exact`: emission and absorption along the ray. `drawn`: mixed by optical depth, of a scene
// without order; of cells in order one cell after another, in it one layer after another. 0 of one
// colour, which is the same in any order; and of points in order, whose distances are told apart to
// a four millionth of the box. `field`: the scene's, in the grid's order. The same for any number
// of threads.
double orderError(const Scene& scene, const timeseries::Field& field, const View& view,
                  std::span<const glm::ivec2> pixels, std::span<const double> weights,
                  unsigned threads = sharingThreads());

}  // namespace render

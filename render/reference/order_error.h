// What a picture's light loses by the order in which it puts together what a ray passes, told from
// some of its pixels. It is looked at apart from all else that a picture gets wrong: what is put
// together are the exact parts of the interval volume (render/reference/parts_on_rays.h), with the
// picture's own opacities and colours, evenly lit.
#pragma once

#include <atomic>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/parts_on_rays.h"
#include "render/together.h"
#include "timeseries/index/field_slabs.h"

namespace render {

//   sqrt( sum w |drawn - exact|^2 / sum w |exact|^2 )
// of premultiplied linear light, each pixel's of the ray in its middle and counted `weights` times.
// `exact`: emission and absorption along the ray. `drawn`: mixed by optical depth, of a scene
// without order; of cells in order one cell after another, in it one layer after another. 0 of one
// colour, which is the same in any order; and of points in order, whose distances are told apart to
// a four millionth of the box. The same for any number of threads.
class OrderError {
 public:
    // These must outlive this.
    OrderError(const Scene& scene, const View& view, std::span<const glm::ivec2> pixels,
               std::span<const double> weights, unsigned threads = sharingThreads());
    // Each slab of the scene's field, in the grid's order, once.
    void add(const timeseries::FieldSlab& slab);
    // Of what was added; anything once it is not wanted any more.
    double error(const std::atomic<bool>* wanted = nullptr) const;

 private:
    bool isNone() const;

    const Scene& scene_;
    const View& view_;
    std::span<const glm::ivec2> pixels_;
    std::span<const double> weights_;
    unsigned threads_;
    std::vector<std::vector<PartInLayer>> parts_;  // [pixel]
};

}  // namespace render

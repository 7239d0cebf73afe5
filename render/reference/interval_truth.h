// The continuous truth: what each pixel sees of the interval volume of a scene's layers
// (render/reference/interval_cells.h), in double, whatever the scene is drawn by. Of a ray, what
// lies in a cell is exact; a pixel is the mean of n x n rays, regularly spaced in it. Where points
// lie one by one the field is linear in tetrahedra (render/splat/mesh_cells.h), of which what a ray
// has is exact, too.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/interval_cells.h"
#include "render/reference/light_on_ray.h"
#include "render/reference/opaque_depths.h"
#include "render/reference/sparse_walk.h"
#include "render/together.h"

namespace render {

// Where rays of a pixel pass it, [0, 1] each way: n x n, regularly spaced.
std::vector<glm::dvec2> placesOfRays(int across);

// Of what the scene shows, its layers' ranges between points, clip box and styles count. `slab` is
// of the scene's field, in the grid's order, and its values must outlive this, as the scene; what
// rays have in other cells counts for nothing.
class IntervalTruth {
 public:
    // REQUIRES: raysAcross > 0; layers whose `cells.ranges` are there.
    IntervalTruth(const Scene& scene, const timeseries::FieldSlab& slab, int raysAcross,
                  unsigned threads = sharingThreads(),
                  IntervalCells::Look look = IntervalCells::Look::Before);

    // The plane W of a layer, as CellSum has it for Channels::Weight: the path length in its ranges
    // in units of l, or what the scene's opacityPer makes of it where it is drawn by cells, from
    // the near plane on. [y][x], row 0 at the bottom. Not a bit depends on the threads.
    std::vector<double> weight(const View& view, std::size_t layer) const;
    // The plane W at these pixels alone, of the rays at these places in each.
    std::vector<double> weight(const View& view, std::size_t layer,
                               std::span<const glm::ivec2> pixels,
                               std::span<const glm::dvec2> places) const;
    // The light of all layers, ordered: emission and absorption along each ray, of optical depth
    // opticalDepthPerWeight(opacity) a unit of W and of the colour that the field's value has
    // there, lit as its gradient has it where the scene has light, which REQUIRES scene.cells.
    // Premultiplied, linear. [y][x], row 0 at the bottom.
    std::vector<glm::dvec4> light(const View& view) const {
        return light(view, LightOnRay::Of::Front);
    }
    // In no order: of each pixel the sum of optical depth times colour, and the optical depth.
    std::vector<glm::dvec4> sums(const View& view) const {
        return light(view, LightOnRay::Of::All);
    }
    // Rays end there from now on.
    void endAt(OpaqueDepths opaque) { opaque_ = std::move(opaque); }

 private:
    struct Ray {
        glm::dvec3 eye, along;     // axis coordinates; a unit of t is one of view depth
        double near, far, weight;  // where it begins and ends; W of a unit of t
    };
    // visit(cell, from, to) as long as it is true: what the ray passes.
    template <typename Visit>
    void walk(const Ray& ray, const Visit& visit) const;
    std::vector<glm::dvec4> light(const View& view, LightOnRay::Of what) const;
    // The mean over rays at these places in each pixel of sum(ray, work); each thread has a `Work`.
    template <typename Pixel, typename Work, typename Sum>
    std::vector<Pixel> meanOfRays(const View& view, std::span<const glm::ivec2> pixels,
                                  std::span<const glm::dvec2> places, const Sum& sum) const;
    struct WeightWork {
        std::vector<LinePart> parts;
        IntervalCells::Lately lately;
    };
    double weight(const Ray& ray, std::size_t layer, WeightWork& work) const;

    const Scene& scene_;
    timeseries::FieldSlab slab_;
    std::vector<glm::dvec2> places_;
    unsigned threads_;
    OpaqueDepths opaque_;
    std::optional<SparseWalk> walk_;  // none of a mesh
    std::vector<IntervalCells> layers_;
};

}  // namespace render

// What rays pass of the interval volume of a scene's layers (render/reference/interval_truth.h),
// part by part: for those who ask where on a ray something is, and what order does to its light.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/reference/cell_walk.h"
#include "render/reference/interval_cells.h"
#include "render/reference/light_on_ray.h"
#include "render/reference/tets_on_pixels.h"

namespace render {

// A part of a ray's way through a cell on which the field is in one range of a layer.
struct PartInLayer {
    std::uint32_t layer = 0, range = 0;
    std::uint32_t cell = 0;  // as CellIndex numbers them
    PartOnRay part{};
    double opticalDepth = 0;
    // Of its field in the world where it begins and ends, and what these are measured against
    // (render/model/light.h); nothing where nobody asks for light.
    std::array<glm::dvec3, 2> gradients = {};
    double steepness = 0;
};
// Of a way of so many units of l a unit of view depth; its W is as the scene's opacityPer has it.
PartInLayer partInLayer(const Scene& scene, std::size_t layer, std::uint32_t cell,
                        const PartOnRay& part, double lengthPerDepth);

// Rays of a view through an upright grid.
class CellRays {
 public:
    // The scene and the slab's values, of its field in the grid's order, must outlive this.
    CellRays(const Scene& scene, const timeseries::FieldSlab& slab, const View& view);
    // Of the ray at a window position: of the slab's cells one after another from the eye on, in
    // each layer after layer.
    std::vector<PartInLayer> partsOn(const glm::dvec2& window) const;
    // Where in a cell, [0, 1] along each axis, that ray is at a view depth.
    glm::dvec3 placeIn(std::uint32_t cell, const glm::dvec2& window, double depth) const;
    double valueAt(std::size_t layer, std::uint32_t cell, const glm::dvec3& place) const;

 private:
    glm::dvec3 alongOf(const glm::dvec2& window) const;
    void pass(const glm::uvec3& cell, const glm::dvec3& along, double from, double to,
              std::size_t layer, std::vector<PartInLayer>& into) const;

    const Scene& scene_;
    CellWalk walk_;
    PixelRays rays_;  // in axis coordinates
    std::vector<IntervalCells> layers_;
};

// Adds, of each pixel's own ray, those in the slab's cells. Not a bit depends on the threads.
// REQUIRES: as many in `into` as pixels.
void addPartsOnRays(const Scene& scene, const timeseries::FieldSlab& slab, const View& view,
                    std::span<const glm::ivec2> pixels, unsigned threads,
                    std::span<std::vector<PartInLayer>> into);
// Those that begin first first.
void orderAlongRay(std::vector<PartInLayer>& parts);

// The light of one ray's parts: premultiplied, linear.
class LightOfParts {
 public:
    // The layers outlive this. Their colours as they are.
    explicit LightOfParts(std::span<const Layer> layers) : layers_(layers), light_(layers) {}
    // As the scene's light falls on them, which outlives this, on rays that go `way` in the world.
    explicit LightOfParts(const Scene& scene, LightOnRay::Of what = LightOnRay::Of::Front)
        : layers_(scene.layers), light_(scene.layers, what), lit_(&scene) {}
    void setWay(const glm::dvec3& way) { way_ = way; }

    // Emission and absorption from the eye on; where parts lie over each other, of all of them at
    // once. REQUIRES: parts by where they begin.
    glm::dvec4 inOrder(std::span<const PartInLayer> parts);
    // Each part as a whole before the next, wherever they lie.
    glm::dvec4 oneByOne(std::span<const PartInLayer> parts);
    // Whatever lies before what, by optical depth: sum(tau_i c_i) (1 - e^-tau) / tau.
    glm::dvec4 mixed(std::span<const PartInLayer> parts) const;

 private:
    void passOpen(double from, double to);
    Shade shadeAt(const PartInLayer& part, double share) const;

    std::span<const Layer> layers_;
    LightOnRay light_;
    const Scene* lit_ = nullptr;
    glm::dvec3 way_{0};
    std::vector<double> ends_, depths_;
    std::vector<const PartInLayer*> open_;
    std::vector<std::size_t> in_;
};

}  // namespace render

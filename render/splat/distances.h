// How far points of the grid are from one place, many at once, for every processor that the program
// may meet: Highway chooses among the targets when the program runs.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "render/model/scene.h"
#include "render/points/placed_points.h"

namespace render {

class Distances {
 public:
    // In the world. the scene's points must outlive this.
    Distances(const Scene& scene, const glm::dvec3& from);

    // Of the points of these grid indices, each into its place; negative outside of the clip box
    // and where a point has no place. `points`: what the mesh keeps of them, where that is at hand.
    void find(std::span<const std::uint32_t> index, std::span<double> away,
              std::span<const timeseries::Mesh::Point> points = {}) const;

    // What the kernels take: the grid's size, its positions along each axis, what takes them to
    // where `from` is the origin (columns), and the clip box.
    std::array<double, 3> size;
    std::array<const double*, 3> position;
    std::array<std::array<double, 3>, 4> fromAxes;
    std::array<double, 3> clipLo, clipHi;
    // Of a mesh instead: what takes its units there, and where its origin is.
    std::array<double, 3> meshScale, meshFrom;
    bool clips = false;  // some may be negative

 private:
    void takeMesh();
    void findInMesh(std::span<const std::uint32_t> index,
                    std::span<const timeseries::Mesh::Point> points, std::span<double> away) const;

    const PlacedPoints& placed_;
    timeseries::Mesh::Stored stored_{};
    IndexBox clip_;
    glm::dvec3 from_;
};

}  // namespace render

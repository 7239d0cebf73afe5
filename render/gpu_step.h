// A step's points on the GPU, as far as pictures have asked for them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/gl/object.h"
#include "render/scene.h"

namespace render {

// How a value becomes what a shader sees: a float that is 0 and 1 at the ends of the narrowest
// colour map, beyond which it may lie. A field's own extent may be so much wider than a map (a fill
// value that the file does not tell) that no float over it would tell the map's values apart.
struct ValueScale {
    double lo = 0, halfWidth = 0;  // halves: the difference of two huge values stays finite
    // Of layers that are coloured by value; halfWidth is 0 when no map has a width.
    static ValueScale of(const std::vector<Layer>& layers);
    float operator()(double value) const;
    friend bool operator==(const ValueScale&, const ValueScale&) = default;
};

// The points lie in blocks: block b holds the points [b kBlock, (b + 1) kBlock) of the sorted step,
// in an order in which neighbours are near each other in space. Splats that follow each other then
// fall on the same pixels, which is quicker by a third than order of value. Each point knows its
// place in the sorted block, so a run is drawn exactly: whole blocks are sent to the vertex shader,
// which passes only the points whose place lies in the run.
class GpuStep {
 public:
    static constexpr std::uint64_t kBlock = 1 << 15;

    // Refers to neither. Makes room for all points; uploads none. Throws std::length_error for 2^31
    // points or more, the most that one draw call can count.
    GpuStep(const timeseries::SortedStep& step, const Lattice& lattice);
    // Uploads the blocks that the scene's runs touch, unless they are there; with values on this
    // scale when there is one. `scene` is of the step and lattice that this was made for.
    void need(const Scene& scene, const std::optional<ValueScale>& scale);

    // [points] each: grid index, 4 bytes; place in the block, 2 bytes; scaled value, 4 bytes, once
    // needed.
    const gl::Buffer& gridIndex() const { return gridIndex_; }
    const gl::Buffer& place() const { return place_; }
    const gl::Buffer* values() const { return values_ ? &*values_ : nullptr; }
    const gl::BufferTexture& axisPoints() const { return axisTexture_; }
    std::size_t blocksUploaded() const;

 private:
    void upload(const Scene& scene, std::uint64_t block);

    gl::Buffer gridIndex_, place_, axisPoints_;
    gl::BufferTexture axisTexture_;
    std::optional<gl::Buffer> values_;
    ValueScale scale_;           // of values_
    std::vector<bool> present_;  // per block, with its values if there are values_
};

// An order of the points in which neighbours are near: by cells of the lattice's box, 32 along each
// axis, along Morton's curve; in a cell as given. [i] is a position in `gridIndex`.
// REQUIRES: at most 2^16 points.
std::vector<std::uint16_t> nearOrder(std::span<const std::uint32_t> gridIndex, glm::uvec3 size);

}  // namespace render

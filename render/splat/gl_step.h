// A step's points on the GPU, as far as pictures have asked for them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/gl/object.h"
#include "render/model/scene.h"
#include "render/model/value_scale.h"
#include "render/points/subset.h"
#include "render/splat/gl_mesh.h"

namespace render {

// Block b holds the points [b kBlock, (b + 1) kBlock) of the sorted step in blockOrder: splats that
// follow each other fall on near pixels, which is quicker than order of value, and a subset lies in
// the beginnings of blocks. Each point knows its place in the sorted block, so a run is drawn
// exactly: all of a block that it touches, or its beginning, is sent to the vertex shader, which
// passes only the points whose place lies in the run and the subset. Blocks come when a scene needs
// them, in slices, so that frames keep their pace. They lie in slots, in the order in which they
// came; there are as many slots as were ever needed, or up to twice that.
//
// A scene here is of the step and the grid that this was made for.
class GlStep {
 public:
    static constexpr std::uint64_t kBlock = kSubsetPeriod;

    // Holds no points yet, nor room for them, and asks nothing of GL until it is asked for some.
    // `mesh`: that of another step, which is shared if it is the grid's.
    GlStep(const timeseries::SortedStep& step, const PlacedPoints& placed,
           std::shared_ptr<GlMesh> mesh = nullptr);

    // Sends the mesh, and blocks that the scene's runs touch and that are not there, with their
    // values on `scale` if there is one, until `bytes` are reached: one block at least. While
    // values on another scale come, those that are there stay in use. Throws std::length_error when
    // the blocks hold 2^31 points or more, the most that a draw call can count, and
    // std::runtime_error when the driver has no room.
    static constexpr std::uint64_t kAll = ~std::uint64_t{0};
    void upload(const Scene& scene, const std::optional<ValueScale>& scale,
                std::uint64_t bytes = kAll);
    // What upload() has still to send, and what it would send to a step that holds nothing.
    std::uint64_t missingBytes(const Scene& scene, const std::optional<ValueScale>& scale) const;
    static std::uint64_t neededBytes(const Scene& scene, const std::optional<ValueScale>& scale);
    // Whether the scene can be drawn: its mesh and blocks are there, and values on some scale where
    // a layer is coloured by value.
    bool ready(const Scene& scene) const;
    // `wanted`, or the scale of values that are there or coming and serve as well.
    ValueScale serving(const ValueScale& wanted) const;
    // Draws the points where they are placed now; REQUIRES: of the same grid.
    void place(const PlacedPoints& placed);

    // Where the point that comes first in this point's block, or so many behind it, lies in what
    // follows. REQUIRES: the block is there.
    std::uint64_t placeOf(std::uint64_t point) const {
        return slot_[point / kBlock] * slotPoints_ + point % kBlock;
    }
    // REQUIRES: some block is there. Of each point, slot after slot: grid index, 4 bytes; place in
    // the block, 2 bytes; scaled value, 4 bytes.
    const gl::Buffer& gridIndex() const { return *gridIndex_; }
    const gl::Buffer& placeInBlock() const { return *placeInBlock_; }
    const gl::Buffer* values() const { return values_ ? &values_->buffer : nullptr; }
    // Of values(). REQUIRES: they are there.
    const ValueScale& valueScale() const { return values_->scale; }
    // Place and cell's side of each index, axis after axis; of a mesh, of its levels, or 0, 0.
    const gl::BufferTexture& axisPoints() const;
    const std::shared_ptr<GlMesh>& mesh() const { return mesh_; }  // none: null
    std::uint64_t bytes() const;  // with its share of a mesh that others hold, too

 private:
    using Blocks = std::vector<bool>;  // which of the step's
    struct ScaledValues {
        gl::Buffer buffer;
        ValueScale scale;
        Blocks present;
    };
    // Where values on this scale go. Makes room for them.
    ScaledValues* valuesOn(const std::optional<ValueScale>& scale);
    // Returns the bytes sent. `values`: those to fill as well, or null.
    std::uint64_t send(const Scene& scene, std::uint64_t block, ScaledValues* values);
    bool isThere(std::uint64_t block) const { return slot_[block] != kNowhere; }
    // Slots for these blocks beside those that are there, wherever they are kept.
    void makeRoom(std::span<const std::uint64_t> blocks);
    std::uint64_t room() const { return slots_ * slotPoints_; }  // points

    static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
    std::vector<std::uint32_t> slot_;      // of each block
    std::uint64_t slots_ = 0, taken_ = 0;  // so many there are; the first ones hold a block
    std::uint64_t slotPoints_;             // a block's, or the step's if these are fewer
    std::optional<gl::Buffer> gridIndex_, placeInBlock_;
    struct AxisPoints {
        gl::Buffer buffer;
        gl::BufferTexture texture;
    };
    std::shared_ptr<GlMesh> mesh_;
    std::vector<glm::vec2> axisTable_;              // what axisPoints() has
    mutable std::optional<AxisPoints> axisPoints_;  // of it, once asked for
    std::optional<ScaledValues> values_, coming_;   // in use; not all that a scene needs yet
};

}  // namespace render

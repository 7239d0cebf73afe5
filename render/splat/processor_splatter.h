// The splatter on the processor, as FrameRenderer drives it.
#pragma once

#include <vector>

#include "render/splat/cell_splatter.h"
#include "render/splat/depth_order.h"
#include "render/splat/splatter.h"
#include "render/splat/tile_splatter.h"

namespace render {

class ProcessorSplatter final : public Splatter {
 public:
    DrawList order(const Scene& scene, const glm::dvec3& midEye) override {
        return order_(scene, midEye);
    }
    // Asks nothing of the step on the GPU.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;

    // Kept from frame to frame: pages that are new cost more than what is done with them.
    struct Memory {
        std::vector<float> opaqueDepth, rows, mixed;
        TileMemory tiles;
        CellMemory cells;
    };

 private:
    Memory memory_;
    DepthOrder order_;
};

}  // namespace render

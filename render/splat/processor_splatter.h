// The splatter on the processor, as FrameRenderer drives it.
#pragma once

#include <vector>

#include "render/splat/cell_splatter.h"
#include "render/splat/depth_order.h"
#include "render/splat/plane_pixels.h"
#include "render/splat/splatter.h"
#include "render/splat/tile_splatter.h"

namespace render {

class ProcessorSplatter final : public Splatter {
 public:
    // By the tiles themselves, where they can put it in order.
    DrawList order(const Scene& scene, const glm::dvec3& midEye) override {
        if (sortsWhenDrawn(scene)) return SortWhenDrawn{midEye};
        return order_(scene, midEye);
    }
    static bool sortsWhenDrawn(const Scene& scene);
    // Asks nothing of the step on the GPU.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;

    // Kept from frame to frame: pages that are new cost more than what is done with them.
    struct Memory {
        std::vector<float> opaqueDepth;
        PlanePixels mixed;
        TileMemory tiles;
        CellMemory cells;
    };

 private:
    Memory memory_;
    DepthOrder order_;
};

}  // namespace render

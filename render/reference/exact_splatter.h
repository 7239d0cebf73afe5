// The truth as a splatter: of points the same model in double (render/reference/cpu_splatter.h), in
// the exact order of depth, on one thread; of cells the interval volume that they stand for
// (render/reference/exact_cells.h). What other splatters' pictures can be held against.
#pragma once

#include <vector>

#include "render/reference/exact_order.h"
#include "render/splat/splatter.h"

namespace render {

class ExactSplatter final : public Splatter {
 public:
    DrawList order(const Scene& scene, const glm::dvec3& midEye) override {
        if (scene.cells) return Runs{};
        return orderExactly(scene, midEye);
    }
    // Asks nothing of the step on the GPU. REQUIRES: not both cells and points.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;
};

}  // namespace render

// The truth as a splatter: the same model in double (render/reference/cpu_splatter.h), in the exact
// order of depth, on one thread. What other splatters' pictures can be held against.
#pragma once

#include <vector>

#include "render/reference/exact_order.h"
#include "render/splat/splatter.h"

namespace render {

class ExactSplatter final : public Splatter {
 public:
    DrawList order(const Scene& scene, const glm::dvec3& midEye) override {
        return orderExactly(scene, midEye);
    }
    // Asks nothing of the step on the GPU.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;
};

}  // namespace render

// What a scene alone looks like, drawn by the program on the processor as a frame is, without axes,
// legend and what else stands in a picture: for those who measure it.
#pragma once

#include <atomic>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render/frame/memory_light.h"
#include "render/splat/memory_targets.h"
#include "render/splat/processor_splatter.h"

namespace render {

class PlainFrame {
 public:
    // Of pictures of this size on this background (linear).
    PlainFrame(glm::ivec2 size, const glm::dvec3& background);

    // The whole frame: order, sums, light; the sums in pixels so many times as wide, enlarged.
    // REQUIRES: view.size is this one's.
    void draw(const Scene& scene, const View& view, int across = 1);
    // What was drawn last. Linear, premultiplied.
    Image light() const { return targets_.readLight(); }

 private:
    Font font_;
    glm::dvec3 background_;
    MemoryTargets targets_;
    std::optional<MemoryTargets> coarse_;
    MemoryLight light_;
    ProcessorSplatter splatter_;
};

// Of all layers together, whatever the scene's order. [y][x], row 0 at the bottom. On any thread;
// empty once it is not wanted any more.
std::vector<float> opticalDepthOf(const Scene& scene, const View& view,
                                  const std::atomic<bool>& wanted = true);
// Of pixels so many times as wide, in those of the view.
std::vector<float> enlargedDepthOf(const Scene& scene, const View& view, int across);

}  // namespace render

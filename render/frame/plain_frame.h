// What a scene alone looks like, without axes, legend and what else stands in a picture: for those
// who measure it.
#pragma once

#include <atomic>
#include <glm/vec3.hpp>
#include <vector>

#include "render/frame/frame.h"

namespace render {

class PlainFrame {
 public:
    // Of scenes of this step, placed so, on this background (linear). Step and points must outlive
    // it. Needs a current GL context if it is drawn by GL.
    PlainFrame(const timeseries::SortedStep& step, const PlacedPoints& placed,
               const glm::dvec3& background, SplatterChoice by = SplatterChoice::Cpu);

    // The whole frame: order, sums, light; the sums in pixels so many times as wide, enlarged. Done
    // when it returns, on a GPU too, which is sent first what it lacks.
    void draw(const Scene& scene, const View& view, int across = 1);
    // What was drawn last. Linear, premultiplied.
    Image light() { return renderer_.targets().readLight(); }
    // By the same splatter, what opticalDepthOf() and enlargedDepthOf() below say; light() is then
    // what was drawn before no longer.
    std::vector<float> depth(const Scene& scene, const View& view, int across = 1);

 private:
    FrameContent contentOf(const Scene& scene, int across) const;

    glm::dvec3 background_;
    FrameRenderer renderer_;
    GlStep onGpu_;
};

// Of all layers together, whatever the scene's order. [y][x], row 0 at the bottom. On any thread;
// empty once it is not wanted any more.
std::vector<float> opticalDepthOf(const Scene& scene, const View& view,
                                  const std::atomic<bool>& wanted = true);
// Of pixels so many times as wide, in those of the view.
std::vector<float> enlargedDepthOf(const Scene& scene, const View& view, int across);

}  // namespace render

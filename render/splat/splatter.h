// Who sums the planes of a scene: GL, the program itself where GL is drawn on the processor, or the
// truth.
#pragma once

#include <cstdint>
#include <memory>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/gl_step.h"
#include "render/splat/targets.h"

namespace render {

// One plane while it is summed.
class PlaneSum {
 public:
    virtual ~PlaneSum() = default;
    // Adds that many splats, or fewer where they do not cost alike, or the least that is worth a
    // call, or what is left. Returns how many. Not a bit of the sum depends on the number of calls.
    virtual std::uint64_t add(std::uint64_t splats) = 0;
    virtual bool done() const = 0;  // The plane is in the targets; before, there is nothing to see.
};

// One frame's splats, for any number of eyes. Refers to the scene, and to the step on the GPU.
class SplatFrame {
 public:
    virtual ~SplatFrame() = default;
    // Of the plane of this kind; `layer` where it has one.
    virtual std::uint64_t splats(Channels channels, std::size_t layer) const = 0;
    // Plane `layer` of the targets, which hold the depth of the opaque scene: splats behind it are
    // not drawn. View and targets must outlive the sum, and planes of an eye begin with the first.
    virtual std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                            Targets& targets) = 0;
};

// By default GL where the driver draws on a GPU, else the program itself, as Cpu. Exact is the
// truth (render/reference/exact_splatter.h).
enum class SplatterChoice { ByDevice, Gl, Cpu, Exact };

class Splatter {
 public:
    virtual ~Splatter() = default;
    // The scene's list as this splatter takes it; of cells none, for they come in an order of their
    // own.
    virtual DrawList order(const Scene& scene, const glm::dvec3& midEye) = 0;
    // `step` holds the scene's step and is ready for it.
    virtual std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                                const GlStep& step) = 0;
};

}  // namespace render

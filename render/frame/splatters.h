// The splatters that there are, and who of them sums a scene.
#pragma once

#include <cstdint>
#include <memory>

#include "render/reference/exact_splatter.h"
#include "render/splat/gl_cell_splatter.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/processor_splatter.h"

namespace render {

class Splatters {
 public:
    // Needs a current GL context, from construction to destruction, unless it is Cpu or Exact.
    explicit Splatters(SplatterChoice choice);

    // Whether GL sums the scene; else the program does it itself.
    bool sumsByGl(const Scene& scene) const;
    // Whether the scene's points are taken from the step on the GPU.
    bool takesPointsFromGpu(const Scene& scene) const { return sumsByGl(scene) && !scene.cells; }

    // As the scene's splatter wants its list.
    DrawList order(const Scene& scene, const glm::dvec3& midEye);
    // By another where the scene's splatter has no room.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list, const GlStep& step);

    GlSplatter& gl() { return needGl().points; }  // made when it is first needed
    bool hasGl() const { return gl_ != nullptr; }
    // Whether the GPU puts the scene's points in order; else a list is to be made for prepare(), or
    // it takes its time there. REQUIRES: a step that is ready for the scene.
    bool sortsOnGpu(const Scene& scene, const GlStep& step);
    // Whether GL has all that it draws the scene's cells by, whatever the eye.
    bool holdsCells(const Scene& scene) const { return gl_ && gl_->cells.holds(scene); }
    // Makes so many cells more of it, or so, where prepare() would make all. Returns the share that
    // is there, [0, 1]; 1 where GL draws no cells of the scene.
    double makeCells(const Scene& scene, std::uint64_t cells);
    // On the GPU, of cells and for order.
    std::uint64_t bytes() const { return gl_ ? gl_->cells.bytes() + gl_->points.bytes() : 0; }

 private:
    struct Gl {
        GlSplatter points;
        GlCellSplatter cells{points};
    };
    Gl& needGl();
    Splatter& of(const Scene& scene);
    void noRoomFor(const Scene& scene);

    ProcessorSplatter processor_;
    ExactSplatter exact_;
    std::unique_ptr<Gl> gl_;
    Splatter& inProgram_;  // who sums what GL does not
    bool byGl_;
    std::uint64_t mostCellBytes_ = 0, mostMeshBytes_ = 0;  // on the GPU, where that draws
};

}  // namespace render

#include "render/frame/splatters.h"

#include <stdexcept>
#include <utility>

#include "render/gl/debug_output.h"
#include "render/gl/driver.h"

namespace render {
namespace {

// A driver that draws on the processor takes several times longer for point sprites than the
// program does for their pixels (tests/bench/NOTES.md).
bool isByGl(SplatterChoice choice) {
    return choice == SplatterChoice::Gl ||
           (choice == SplatterChoice::ByDevice && !gl::drawsOnProcessor());
}

}  // namespace

Splatters::Splatters(SplatterChoice choice)
    : inProgram_(choice == SplatterChoice::Exact ? static_cast<Splatter&>(exact_) : processor_),
      byGl_(isByGl(choice) && GlSplatter::canDraw()) {
    if (choice == SplatterChoice::Gl && !byGl_)
        throw std::runtime_error(
            "this GL driver lets vertex shaders read no buffers, so it cannot draw: leave "
            "--splatter gl out, and the program draws");
    if (!byGl_) return;
    mostCellBytes_ = GlCellSplatter::mostBytes();
    mostMeshBytes_ = GlMesh::mostBytes();
}

Splatters::Gl& Splatters::needGl() {
    if (!gl_) gl_ = std::make_unique<Gl>();
    return *gl_;
}

bool Splatters::sumsByGl(const Scene& scene) const {
    if (!byGl_ || mixesModels(scene)) return false;
    if (scene.cells) return GlPieces::bytesOf(scene) <= mostCellBytes_;
    // The clip box is the file's, of which the GPU's mesh knows nothing.
    if (scene.placed.globe() && !scene.clip.holdsAll()) return false;
    const auto& mesh = scene.placed.mesh();
    return !mesh || GlMesh::bytesOf(*mesh) <= mostMeshBytes_;
}

Splatter& Splatters::of(const Scene& scene) {
    if (!sumsByGl(scene)) return inProgram_;
    if (scene.cells) return needGl().cells;
    return needGl().points;
}

bool Splatters::sortsOnGpu(const Scene& scene, const GlStep& step) {
    return scene.order != Order::None && takesPointsFromGpu(scene) &&
           needGl().points.sortsOnGpu(scene, step);
}

DrawList Splatters::order(const Scene& scene, const glm::dvec3& midEye) {
    return of(scene).order(scene, midEye);
}

std::unique_ptr<SplatFrame> Splatters::prepare(const Scene& scene, DrawList list,
                                               const GlStep& step) {
    if (!scene.cells || !sumsByGl(scene)) {
        if (gl_) gl_->cells.rest();
        return of(scene).prepare(scene, std::move(list), step);
    }
    try {
        return needGl().cells.prepare(scene, list, step);
    } catch (const std::runtime_error&) {
        noRoomFor(scene);
        return processor_.prepare(scene, std::move(list), step);
    }
}

double Splatters::makeCells(const Scene& scene, std::uint64_t cells) {
    if (!scene.cells || !sumsByGl(scene)) return 1;
    try {
        return needGl().cells.make(scene, cells);
    } catch (const std::runtime_error&) {
        noRoomFor(scene);
        return 1;
    }
}

// For so many cells: the program draws them.
void Splatters::noRoomFor(const Scene& scene) {
    gl::forgetErrors();
    const std::uint64_t bytes = GlPieces::bytesOf(scene);
    mostCellBytes_ = bytes > 0 ? bytes - 1 : 0;
}

}  // namespace render

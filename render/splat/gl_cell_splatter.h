// Interval volumes summed on GL 4.5 cell by cell: the model of render/model/cell_splat.h.
#pragma once

#include <map>
#include <memory>

#include "render/gl/object.h"
#include "render/splat/gl_cells.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/splatter.h"

namespace render {

class GlCellSplatter final : public Splatter {
 public:
    // `layers` has a scene's layers before its frame is prepared, and outlives this.
    explicit GlCellSplatter(const GlSplatter& layers);

    // The most that a scene's cells may take there: what the driver binds, and no card is filled.
    // 0 where it cannot draw them.
    static std::uint64_t mostBytes();
    std::uint64_t bytes() const { return cells_ ? cells_->bytes() : 0; }  // that they take now

    DrawList order(const Scene&, const glm::dvec3&) override { return Runs{}; }
    // Asks nothing of the step on the GPU. REQUIRES: GlCells::fit(scene, mostBytes()). Throws
    // std::runtime_error where there is no room.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;

    // Of the frame's view, to draw these places of the cells, in the order of the list if there is
    // one.
    struct Draw {
        const Scene& scene;
        const GlCells& cells;
        const gl::Buffer* order;
        const View& view;
        Channels channels;
        std::uint32_t first, count;
    };
    void draw(const Draw& what, std::size_t plane, GlTargets& targets);

 private:
    struct Variant {
        Channels channels;
        bool ordered;
        auto operator<=>(const Variant&) const = default;
    };
    const gl::Program& program(const Variant& variant);

    const GlSplatter& layers_;
    std::shared_ptr<GlCells> cells_;  // of the scene prepared last
    std::map<Variant, gl::Program> programs_;
    gl::Buffer view_;
    gl::VertexArray nothing_;
};

}  // namespace render

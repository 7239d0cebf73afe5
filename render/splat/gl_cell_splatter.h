// Interval volumes summed on GL 4.5 cell by cell: the models of render/model/cell_splat.h and, of
// the tetrahedra of a mesh's cells, of render/model/tet_splat.h.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "render/gl/object.h"
#include "render/model/covered.h"
#include "render/splat/gl_pieces.h"
#include "render/splat/gl_splatter.h"
#include "render/splat/splatter.h"

namespace render {

class GlCellSplatter final : public Splatter {
 public:
    static constexpr std::uint64_t kRayBytes = std::uint64_t{128} << 20;
    // `layers` has a scene's layers before its frame is prepared, and outlives this. Where a pixel
    // has several rays, so many bytes hold those that are summed at once.
    explicit GlCellSplatter(const GlSplatter& layers, std::uint64_t rayBytes = kRayBytes);

    // The most that a scene's cells may take there: what the driver binds, and no card is filled.
    // 0 where it cannot draw them.
    static std::uint64_t mostBytes();
    // That they, their field and their order take now.
    std::uint64_t bytes() const {
        return lister_.bytes() + order_.bytes() + (pieces_ ? pieces_->bytes() : 0);
    }

    // Whether what the scene is made of is there: that of the scene prepared last.
    bool holds(const Scene& scene) const { return isWhole_ && pieces_->areOf(scene); }
    // Makes it with so many cells more, or so, and returns the share of it that is there, [0, 1].
    // Throws as prepare() does, which makes all that is missing.
    double make(const Scene& scene, std::uint64_t cells);
    // What is not drawn: gives back what is half made, and a field that is gone.
    void rest();

    DrawList order(const Scene&, const glm::dvec3&) override { return Runs{}; }
    // Asks nothing of the step on the GPU. Throws std::runtime_error where there is no room.
    std::unique_ptr<SplatFrame> prepare(const Scene& scene, DrawList list,
                                        const GlStep& step) override;

 private:
    friend class GlCellPlane;
    // Of the frame's view, to draw these places of the pieces, in the order of the list if there is
    // one: the rays, so many across a pixel, of a part of the picture.
    struct Draw {
        const Scene& scene;
        const GlPieces& pieces;
        const gl::Buffer* order;
        const View& view;
        Channels channels;
        std::uint32_t first, count;
        PixelBox part;
        int raysAcross;
        GLuint framebuffer;
    };
    void draw(const Draw& what, const GlTargets& targets);

    struct Variant {
        Channels channels;
        bool ordered, tets;
        auto operator<=>(const Variant&) const = default;
    };
    const gl::Program& program(const Variant& variant);
    const gl::Program& mean();

    const GlSplatter& layers_;
    std::uint64_t rayBytes_;
    std::shared_ptr<GlPieces> pieces_;  // of the scene prepared last
    bool isWhole_ = false;
    GlCellLister lister_;
    GlPieceOrder order_;
    std::map<Variant, gl::Program> programs_;
    std::optional<gl::Program> mean_;
    gl::Buffer view_;
    gl::VertexArray nothing_;
};

}  // namespace render

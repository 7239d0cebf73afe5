// What a scene that is drawn by cells is made of on the GPU: what of them no view changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "render/gl/object.h"
#include "render/model/scene.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/gl_cell_lister.h"
#include "render/splat/gl_piece_order.h"

namespace render {

inline constexpr const char* kTooManyPieces = "there are more cells than the GPU has room for";

class GlPieces {
 public:
    virtual ~GlPieces() = default;
    GlPieces(const GlPieces&) = delete;
    GlPieces& operator=(const GlPieces&) = delete;

    // Of the scene's cells, or of the tetrahedra of a mesh, begun: of no use before goOn() has made
    // all. Throws std::runtime_error where they are more bytes than these, or there is no room, and
    // so does goOn().
    static std::shared_ptr<GlPieces> begin(const Scene& scene, std::uint64_t mostBytes,
                                           GlCellLister& lister);
    // Makes so many cells more, or so, of the scene that they are of. Returns the share of all that
    // is made, [0, 1].
    virtual double goOn(const Scene&, std::uint64_t) { return 1; }
    // What they take, in the largest buffer, where what is missing or clipped parts none of them.
    static std::uint64_t bytesOf(const Scene& scene);

    // Whether they are those of this scene, whatever its view, its colours and their opacity.
    bool areOf(const Scene& scene) const;

    const gl::Buffer& pieces() const { return *pieces_; }  // layer by layer
    // CellSlopes of each, or GlTetSlopes, where light falls on them; else null.
    virtual const gl::Buffer* slopes() const { return nullptr; }
    // Places in pieces() that a plane takes.
    std::pair<std::uint32_t, std::uint32_t> placesOf(Channels channels, std::size_t layer) const;
    // Places of all pieces as uints, the farthest first.
    std::shared_ptr<const gl::Buffer> farthestFirst(const Scene& scene, const View& view,
                                                    GlPieceOrder& order);
    virtual std::uint64_t bytes() const;  // on the GPU
    // Of cells the middles and sizes, axis after axis, in axis coordinates; null of tetrahedra.
    virtual const gl::BufferTexture* sides() const { return nullptr; }

 protected:
    explicit GlPieces(const Scene& scene);
    // `firsts`: of each layer's pieces, and the end.
    void take(std::unique_ptr<gl::Buffer> pieces, std::vector<std::uint32_t> firsts);
    std::uint32_t count() const { return firsts_.back(); }

 private:
    // The eyes of one such key have one order.
    virtual glm::dvec3 keyOf(const Scene& scene, const View& view) const = 0;
    virtual std::shared_ptr<const gl::Buffer> order(const Scene& scene, const View& view,
                                                    GlPieceOrder& order) const = 0;

    std::weak_ptr<const timeseries::CellIndex> index_;
    std::weak_ptr<const timeseries::Mesh> mesh_;
    std::weak_ptr<const timeseries::PointGradients> gradients_;
    std::vector<double> choices_;  // all else that they depend on
    std::unique_ptr<gl::Buffer> pieces_;
    std::vector<std::uint32_t> firsts_;  // of each layer, and the end
    struct Ordered {
        glm::dvec3 key;
        bool byMiddles;  // as the scene's
        std::shared_ptr<const gl::Buffer> places;
    };
    std::vector<Ordered> ordered_;  // for the eyes that asked last
};

// How the colours by value of a piece with this field are found: of f, as mapPlaceOf() has it.
struct GlMapPlace {
    float at = 0, perValue = 0;
};
GlMapPlace glMapPlaceOf(const RangeStyle& style, const cell::ColoredField& field);

}  // namespace render

// What a scene that is drawn by cells is made of on the GPU: what of them no view changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/gl/object.h"
#include "render/model/scene.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/gl_tet_order.h"
#include "render/together.h"

namespace render {

class GlPieces {
 public:
    virtual ~GlPieces() = default;
    GlPieces(const GlPieces&) = delete;
    GlPieces& operator=(const GlPieces&) = delete;

    // Of the scene's cells, or of the tetrahedra of a mesh. Throws std::runtime_error where they
    // are more bytes than these, or there is no room.
    static std::shared_ptr<GlPieces> of(const Scene& scene, std::uint64_t mostBytes);
    // What they take where what is missing or clipped parts none of them.
    static std::uint64_t bytesOf(const Scene& scene);

    // Whether they are those of this scene, whatever its view, its colours and their opacity.
    bool areOf(const Scene& scene) const;

    const gl::Buffer& pieces() const { return *pieces_; }  // layer by layer
    // Places in pieces() that a plane takes.
    std::pair<std::uint32_t, std::uint32_t> placesOf(Channels channels, std::size_t layer) const;
    // Places of all pieces as uints, the farthest first. `tets`: who puts tetrahedra so.
    std::shared_ptr<const gl::Buffer> farthestFirst(const Scene& scene, const View& view,
                                                    GlTetOrder& tets);
    virtual std::uint64_t bytes() const;  // on the GPU
    // Of cells the middles and sizes, axis after axis, in axis coordinates; null of tetrahedra.
    virtual const gl::BufferTexture* sides() const { return nullptr; }

 protected:
    GlPieces(const Scene& scene, std::uint64_t mostBytes);
    // Looks at the scene's cells on all threads: look(cells, pieces) appends what it makes of some
    // of them. Then keep(piece) of each, in order. `kind` of a piece has its layer from bit 8 on.
    template <typename GlPiece, typename Look, typename Keep>
    void take(const Scene& scene, const Look& look, const Keep& keep);

 private:
    static constexpr const char* kTooMany = "there are more cells than the GPU has room for";
    // The eyes of one such key have one order.
    virtual glm::dvec3 keyOf(const CellRank& rank) const = 0;
    virtual std::shared_ptr<const gl::Buffer> order(const CellRank& rank,
                                                    GlTetOrder& tets) const = 0;

    std::weak_ptr<const timeseries::CellIndex> index_;
    std::weak_ptr<const timeseries::Mesh> mesh_;
    std::vector<double> choices_;  // all else that they depend on
    std::uint64_t mostBytes_;
    std::unique_ptr<gl::Buffer> pieces_;
    std::vector<std::uint32_t> firsts_;  // of each layer, and the end
    struct Ordered {
        glm::dvec3 key;
        std::shared_ptr<const gl::Buffer> places;
    };
    std::vector<Ordered> ordered_;  // for the eyes that asked last
};

// How the colours by value of a piece with this field are found: of f, as mapPlaceOf() has it.
struct GlMapPlace {
    float at = 0, perValue = 0;
};
GlMapPlace glMapPlaceOf(const RangeStyle& style, double reference, double extent);

template <typename GlPiece, typename Look, typename Keep>
void GlPieces::take(const Scene& scene, const Look& look, const Keep& keep) {
    constexpr std::size_t kWorthAThread = 1 << 10;
    const std::vector<CellOfLayer> all = cellsOf(scene, Channels::Over, 0);
    const unsigned shared = threadsFor(all.size(), kWorthAThread, sharingThreads());
    std::vector<std::vector<GlPiece>> parts(shared);
    sharing(shared, [&](unsigned k) {
        const std::size_t first = all.size() * k / shared, last = all.size() * (k + 1) / shared;
        look(std::span(all).subspan(first, last - first), parts[k]);
    });
    std::size_t count = 0, at = 0;
    for (const auto& part : parts) count += part.size();
    if (count * sizeof(GlPiece) > mostBytes_) throw std::runtime_error(kTooMany);
    pieces_ = std::make_unique<gl::Buffer>(count * sizeof(GlPiece));
    for (const auto& part : parts) {
        pieces_->write(at * sizeof(GlPiece), part.size() * sizeof(GlPiece), part.data());
        at += part.size();
        for (const GlPiece& piece : part) {
            keep(piece);
            ++firsts_[(piece.kind >> 8) + 1];
        }
    }
    for (std::size_t k = 1; k < firsts_.size(); ++k) firsts_[k] += firsts_[k - 1];
}

}  // namespace render

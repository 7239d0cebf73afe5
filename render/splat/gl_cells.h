// The cells of a scene on the GPU: what of them no view changes.
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

namespace render {

// A cell or an octant of one with one range, as CellSplat (render/model/cell_splat.h) has it.
// GLSL mirror: Piece in shaders/cell.vert.
struct GlCell {
    std::uint32_t cell;  // its number
    // Bits 0 to 3: which octant, or kWholeCell; 4 and 5: crossesLeast, crossesMost; from 8: layer.
    std::uint32_t kind;
    float least, most, perRange;
    float mapPlace, mapPerValue;
    float steep;
    float f[8];
};

class GlCells {
 public:
    // Whether a buffer of so many bytes holds them, however many are parted into octants.
    static bool fit(const Scene& scene, std::uint64_t bytes);
    explicit GlCells(const Scene& scene);

    // Whether they are those of this scene, whatever its view, its colours and their opacity.
    bool areOf(const Scene& scene) const;

    const gl::Buffer& pieces() const { return *pieces_; }  // GlCell, layer by layer
    // Places in pieces() that a plane takes.
    std::pair<std::uint32_t, std::uint32_t> placesOf(Channels channels, std::size_t layer) const;
    // Places of all pieces as uints, the farthest first.
    std::shared_ptr<const gl::Buffer> farthestFirst(const CellRank& rank);
    std::uint64_t bytes() const;  // on the GPU
    // Middles and sizes of cells, axis after axis, in axis coordinates.
    const gl::BufferTexture& sides() const { return sidesTexture_; }

 private:
    std::weak_ptr<const timeseries::CellIndex> index_;
    std::vector<double> choices_;  // all else that they depend on
    std::unique_ptr<gl::Buffer> pieces_;
    std::vector<glm::uvec3> cells_;      // of each piece, along the axes
    std::vector<std::uint32_t> firsts_;  // of each layer, and the end
    gl::Buffer sides_;
    gl::BufferTexture sidesTexture_;
    struct Ordered {
        glm::ivec3 eye;
        std::shared_ptr<const gl::Buffer> places;
    };
    std::vector<Ordered> ordered_;  // for the eyes that asked last
};

}  // namespace render

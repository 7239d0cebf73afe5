// The splats of a picture that are worked out before they are put into tiles, and where they are
// kept from picture to picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/model/scene.h"
#include "render/splat/drawn_points.h"
#include "render/splat/seen_splat.h"
#include "render/splat/tile_bins.h"
#include "render/splat/tile_view.h"
#include "timeseries/grid/pages.h"

namespace render {

class SeenSplats {
 public:
    // Makes room for so many of the scene's, which the view then knows: nothing where kernels see
    // its splats for every tile anew (findTiles()).
    void begin(const Scene& scene, TileView& view, std::size_t count);
    // Those of these points, the list's from `first` on; their grid indices become what kernels
    // take. Several threads may ask at once, each for places of its own.
    void see(const Scene& scene, const TileView& view, std::size_t first,
             std::span<std::uint32_t> index, std::span<TileSpan> spans);
    // Of a mesh, the same points before they are seen.
    std::span<const timeseries::Mesh::Point> pointsOf(std::size_t first,
                                                      std::span<const std::uint32_t> gridIndex) {
        return drawn_.of(first, gridIndex);
    }

 private:
    timeseries::LargeVector<SeenSplat> splats_;
    timeseries::LargeVector<SplatCut> cuts_;
    DrawnPoints drawn_;
};

}  // namespace render

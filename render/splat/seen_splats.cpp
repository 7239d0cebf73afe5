#include "render/splat/seen_splats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/model/footprint.h"
#include "render/splat/tile_kernels.h"

namespace render {
namespace {

// The forms in (x + m y, y).
void slant(Splat<double>& s) {
    if (!(s.n.x > 0)) return;
    const double m = s.n.y / (2 * s.n.x);
    s.n = {s.n.x, m, std::max(s.n.z - s.n.x * m * m, 0.0)};
    s.d = {s.d.x, s.d.y - 2 * s.d.x * m, s.d.z + (s.d.x * m - s.d.y) * m};
    s.l.y -= s.l.x * m;
}

SeenSplat seenSplat(const TileView& view, const Splat<double>& s, double windowDepth) {
    constexpr double kFarthest = 1e9;  // pixels: nothing beyond is in any picture
    SeenSplat seen{.pixel = {},
                   .within = {},
                   .columns = 0,
                   .rows = 0,
                   .weight = static_cast<float>(s.weight) * view.weight,
                   .depth = static_cast<float>(windowDepth),
                   .n = floats(s.n),
                   .d = floats(s.d),
                   .l = {static_cast<float>(s.l.x), static_cast<float>(s.l.y)}};
    for (std::size_t k = 0; k < 2; ++k) {
        const double window = s.centre[static_cast<int>(k)] + view.centre[k];
        const double whole = std::abs(window) < kFarthest ? std::floor(window) : -kFarthest;
        seen.pixel[k] = static_cast<std::int32_t>(whole);
        seen.within[k] = static_cast<float>(window - whole);
    }
    return seen;
}

// One after another, as splatAt() has them in double.
void seeOneByOne(const Scene& scene, const TileView& view, std::span<const std::uint32_t> index,
                 std::span<SeenSplat> splats, std::span<SplatCut> cuts, std::span<TileSpan> spans) {
    Footprint footprint = scene.footprint;
    if (view.pointSide > 0) footprint.size = view.pointSide;
    for (std::size_t i = 0; i < index.size(); ++i) {
        spans[i] = {};
        if (!scene.placed.inside(index[i], scene.clip)) continue;
        auto s = splatAt<double>(*view.oneByOne, index[i], footprint);
        if (!s.visible) continue;
        const double windowDepth = view.depthA / s.depth + view.depthB;
        if (windowDepth > 1) continue;
        const auto spanOf = [&](int k) {
            return pixelSpan(s.centre[k] + view.centre[static_cast<std::size_t>(k)], s.lo[k],
                             s.hi[k], footprint.kernel, view.box.size[k]);
        };
        const PixelSpan x = spanOf(0), y = spanOf(1);
        if (x.first >= x.last || y.first >= y.last) continue;
        if (view.endsAtFaces) slant(s);
        splats[i] = seenSplat(view, s, windowDepth);
        const auto both = [](const PixelSpan& span) {
            return static_cast<std::uint32_t>(span.first) | static_cast<std::uint32_t>(span.last)
                                                                << 16;
        };
        splats[i].columns = both(x);
        splats[i].rows = both(y);
        if (!cuts.empty())
            cuts[i] = {floats(s.c),      floats(s.x),
                       floats(s.y),      floats(s.loFace),
                       floats(s.hiFace), s.cut ? static_cast<float>(s.depth) : 0.0f};
        const int column = x.first / view.tile.x, row = y.first / view.tile.y;
        spans[i] = {static_cast<std::uint32_t>(row * view.tiles.x + column),
                    static_cast<std::uint16_t>((x.last - 1) / view.tile.x + 1 - column),
                    static_cast<std::uint16_t>((y.last - 1) / view.tile.y + 1 - row)};
    }
}

}  // namespace

void SeenSplats::begin(const Scene& scene, TileView& view, std::size_t count) {
    if (!view.isSeenBefore) return;
    splats_.resize(std::max(splats_.size(), count));
    view.seenSplats = splats_;
    if (view.endsAtFaces) cuts_.resize(std::max(cuts_.size(), count));
    if (view.endsAtFaces) view.cuts = cuts_;
    if (scene.placed.isMesh()) drawn_.begin(scene.placed.mesh(), count);
}

void SeenSplats::see(const Scene& scene, const TileView& view, std::size_t first,
                     std::span<std::uint32_t> index, std::span<TileSpan> spans) {
    if (!view.isSeenBefore) return findTiles(view, index, spans);
    const auto splats = std::span(splats_).subspan(first, index.size());
    if (view.oneByOne)
        seeOneByOne(scene, view, index, splats,
                    view.endsAtFaces ? std::span(cuts_).subspan(first, index.size())
                                     : std::span<SplatCut>(),
                    spans);
    else
        seeSplats(scene, view, index, drawn_.of(first, index), splats, spans);
    std::iota(index.begin(), index.end(), static_cast<std::uint32_t>(first));
}

}  // namespace render

#include "render/reference/splats_on_pixels.h"

#include <algorithm>

#include "render/model/footprint.h"
#include "render/reference/tets_on_pixels.h"
#include "render/splat/splat_source.h"
#include "render/splat/tile_layout.h"

namespace render {
namespace {

// The scene's splats and the rays of some pixels, which are pixels of the finer picture.
class SplatsOnPixels {
 public:
    SplatsOnPixels(const Scene& scene, const View& view, std::span<const glm::ivec2> pixels,
                   int raysAcross)
        : scene_(scene),
          view_(finer(view, raysAcross)),
          seen_(scene.placed, view_),
          pixels_(pixels),
          bins_(pixels, view.size),
          rays_(raysAcross),
          footprint_(scene.footprint),
          gridIndex_(columnsOf(scene).gridIndex) {
        // A square of whole pixels keeps them.
        if (footprint_.kernel == Kernel::Point) footprint_.size = pointSide(footprint_) * rays_;
        for (const Layer& layer : scene.layers)
            perWeight_.push_back(opticalDepthPerWeight(layer.style.opacity) *
                                 pointsPerSplat(layer, scene.stride) / (rays_ * rays_));
    }

    void add(std::uint32_t point, std::size_t layer, std::vector<double>& depth) const {
        const std::uint32_t index = gridIndex_[point];
        if (!scene_.placed.inside(index, scene_.clip)) return;
        const auto s = splatAt<double>(seen_, index, footprint_);
        if (!s.visible || windowDepth(view_, s.depth) > 1) return;
        const glm::dvec2 window = seen_.rays.centre + s.centre;
        const PixelSpan x = pixelSpan(window.x, s.lo.x, s.hi.x, footprint_.kernel, view_.size.x),
                        y = pixelSpan(window.y, s.lo.y, s.hi.y, footprint_.kernel, view_.size.y);
        const glm::dvec2 lo(x.first, y.first), hi(x.last, y.last);
        bins_.forEachIn({lo / double(rays_), hi / double(rays_)}, [&](std::size_t i) {
            const glm::ivec2 first = rays_ * pixels_[i];
            double sum = 0;
            for (int row = std::max(y.first, first.y); row < std::min(y.last, first.y + rays_);
                 ++row)
                for (int at = std::max(x.first, first.x); at < std::min(x.last, first.x + rays_);
                     ++at)
                    sum += weightAt(s, {at, row});
            depth[i] += perWeight_[layer] * sum;
        });
    }

 private:
    double weightAt(const Splat<double>& s, const glm::ivec2& ray) const {
        const glm::dvec2 offset = glm::dvec2(ray) + 0.5 - seen_.rays.centre;
        return weightOn<double>(s, footprint_.kernel, offset - s.centre, offset / seen_.rays.focal,
                                seen_.rayLength)
            .value_or(0);
    }

    const Scene& scene_;
    View view_;
    PointsView seen_;
    std::span<const glm::ivec2> pixels_;
    PixelBins bins_;
    int rays_;
    Footprint footprint_;
    std::span<const std::uint32_t> gridIndex_;
    std::vector<double> perWeight_;  // optical depth of a ray's share of its pixel
};

}  // namespace

std::vector<double> splatDepthAt(const Scene& scene, const View& view,
                                 std::span<const glm::ivec2> pixels, int raysAcross,
                                 unsigned threads, const std::atomic<bool>& wanted) {
    constexpr std::uint64_t kAtOnce = 1 << 16;
    const SplatsOnPixels splats(scene, view, pixels, raysAcross);
    std::vector<std::vector<double>> parts(kCellParts, std::vector<double>(pixels.size()));
    SplatPoints some;
    for (SplatSource source(scene); !source.done();) {
        if (!wanted) return {};
        source.next(kAtOnce, some);
        std::atomic<std::size_t> next{0};
        together(threads, [&](unsigned) {
            for (std::size_t part; (part = next++) < kCellParts;) {
                const std::size_t count = some.point.size(), end = count * (part + 1) / kCellParts;
                for (std::size_t i = count * part / kCellParts; i < end; ++i)
                    splats.add(some.point[i], some.layer[i], parts[part]);
            }
        });
    }
    return addedUp(parts);
}

}  // namespace render

#include "render/reference/tets_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

#include "render/reference/light_on_ray.h"
#include "render/reference/tets_on_pixels.h"

namespace render {
namespace {

// Pixels of a square are asked for at once: what their rays pass is kept meanwhile.
constexpr int kSquareOfRays = 32;

struct PassedPart {
    std::uint32_t ray;  // of the square
    std::uint32_t layer;
    PartOnRay part;
};

// Where a ray of a pixel is.
glm::dvec2 windowOf(const glm::ivec2& pixel, std::uint32_t ray, int raysAcross) {
    const auto across = static_cast<std::uint32_t>(raysAcross);
    return glm::dvec2(pixel) + (glm::dvec2(ray % across, ray / across) + 0.5) / double(raysAcross);
}

// Of one ray, in order of where its parts begin.
class Rays {
 public:
    explicit Rays(const Scene& scene) : light_(scene.layers) {}

    glm::dvec4 lightOf(std::span<const PassedPart> passed, double weightPerDepth) {
        ends_.clear();
        for (const PassedPart& each : passed) {
            ends_.push_back(each.part.from);
            ends_.push_back(each.part.to);
        }
        std::ranges::sort(ends_);
        light_.begin();
        open_.clear();
        std::size_t next = 0;
        for (std::size_t i = 1; i < ends_.size() && !light_.isOpaque(); ++i) {
            const double from = ends_[i - 1], to = ends_[i];
            while (next < passed.size() && passed[next].part.from <= from)
                open_.push_back(&passed[next++]);
            if (to > from) pass(from, to, weightPerDepth);
        }
        return light_.light();
    }

 private:
    void pass(double from, double to, double weightPerDepth) {
        std::erase_if(open_, [&](const PassedPart* each) { return each->part.to <= from; });
        layers_.clear();
        for (const PassedPart* each : open_) layers_.push_back(each->layer);
        light_.pass(layers_, (to - from) * weightPerDepth, [&](std::size_t i, double share) {
            const PartOnRay& part = open_[i]->part;
            return std::lerp(part.begin, part.end,
                             (std::lerp(from, to, share) - part.from) / (part.to - part.from));
        });
    }

    LightOnRay light_;
    std::vector<double> ends_;
    std::vector<const PassedPart*> open_;
    std::vector<std::size_t> layers_;
};

std::vector<PassedPart> passedBy(const Scene& scene, const timeseries::Field& field,
                                 const PointsView& seen, glm::ivec2 size,
                                 std::span<const glm::ivec2> pixels, int raysAcross,
                                 unsigned threads) {
    std::vector<std::vector<PassedPart>> parts(kCellParts);
    const auto across = static_cast<std::uint32_t>(raysAcross);
    forEachTetBefore(
        scene, field, seen, PixelBins(pixels, size), threads,
        [&](std::size_t part, std::uint32_t, const MeshCells::Tetrahedron& tet, std::size_t layer,
            std::size_t pixel) {
            for (const auto& range : scene.layers[layer].cells.ranges) {
                const auto s = tetSplatAt<double>(
                    seen, {tet.at, tet.values, range.lo, range.hi, OpacityPer::Length});
                if (!s.visible) continue;
                for (std::uint32_t ray = 0; ray < across * across; ++ray)
                    if (const auto in =
                            partOnRay(seen, s, windowOf(pixels[pixel], ray, raysAcross)))
                        parts[part].push_back(
                            {static_cast<std::uint32_t>(pixel) * across * across + ray,
                             static_cast<std::uint32_t>(layer), *in});
            }
        });
    std::vector<PassedPart> all;
    for (const auto& some : parts) all.insert(all.end(), some.begin(), some.end());
    std::ranges::stable_sort(all, [](const PassedPart& a, const PassedPart& b) {
        return std::tie(a.ray, a.part.from) < std::tie(b.ray, b.part.from);
    });
    return all;
}

}  // namespace

std::vector<glm::dvec4> meshLight(const Scene& scene, const timeseries::Field& field,
                                  const View& view, int raysAcross, unsigned threads) {
    const PointsView seen(scene.placed, view);
    const auto rays = static_cast<std::uint32_t>(raysAcross * raysAcross);
    std::vector<glm::dvec4> light(static_cast<std::size_t>(view.size.x) *
                                  static_cast<std::size_t>(view.size.y));
    Rays ofRay(scene);
    for (int top = 0; top < view.size.y; top += kSquareOfRays)
        for (int left = 0; left < view.size.x; left += kSquareOfRays) {
            std::vector<glm::ivec2> pixels;
            for (int y = top; y < std::min(top + kSquareOfRays, view.size.y); ++y)
                for (int x = left; x < std::min(left + kSquareOfRays, view.size.x); ++x)
                    pixels.emplace_back(x, y);
            const auto passed =
                passedBy(scene, field, seen, view.size, pixels, raysAcross, threads);
            for (std::size_t first = 0, end = 0; first < passed.size(); first = end) {
                const std::uint32_t ray = passed[first].ray;
                while (end < passed.size() && passed[end].ray == ray) ++end;
                const glm::ivec2 pixel = pixels[ray / rays];
                light[static_cast<std::size_t>(pixel.y * view.size.x + pixel.x)] +=
                    ofRay.lightOf(std::span(passed).subspan(first, end - first),
                                  lengthPerDepth(seen, windowOf(pixel, ray % rays, raysAcross))) /
                    double(rays);
            }
        }
    return light;
}

}  // namespace render

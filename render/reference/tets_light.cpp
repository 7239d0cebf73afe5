#include "render/reference/tets_light.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>

#include "render/reference/parts_on_rays.h"
#include "render/splat/cell_view.h"

namespace render {
namespace {

// Pixels of a square are asked for at once: what their rays pass is kept meanwhile.
constexpr int kSquareOfRays = 32;

struct PassedPart {
    std::uint32_t ray;  // of the square
    PartInLayer part;
};

// Of f, where a part of the ray at a window position begins and ends.
std::array<glm::dvec3, 2> gradientsOn(const PointsView& view, const TetSplat<double>& s,
                                      const std::array<glm::dvec3, 4>& corners,
                                      const glm::dvec2& window, const PartOnRay& part) {
    const glm::dvec2 offset = window - view.rays.centre - s.centre;
    const auto at = [&](double depth) {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < 4; ++i) {
            const double shift = offset.x * s.x[i] + offset.y * s.y[i];
            sum += (s.at[i] + s.base * shift + (depth - s.base) * (s.ray[i] + shift)) * corners[i];
        }
        return sum;
    };
    return {at(part.from), at(part.to)};
}

// With the values that have its colours: what stands for a thin range was widened.
PartOnRay ofItsColors(const TetSplat<double>& s, const timeseries::Interval<double>& range,
                      PartOnRay part) {
    const cell::ColoredField field = cell::coloredField(s, range);
    for (double* value : {&part.begin, &part.end})
        if (s.extent > 0)
            *value = field.reference + field.extent * ((*value - s.reference) / s.extent);
    return part;
}

std::vector<PassedPart> passedBy(const Scene& scene, const timeseries::Field& field,
                                 const PointsView& seen, glm::ivec2 size,
                                 std::span<const glm::ivec2> pixels,
                                 std::span<const glm::dvec2> places, unsigned threads,
                                 const OpaqueDepths& opaque) {
    std::vector<std::vector<PassedPart>> parts(kCellParts);
    const double steepness = steepnessOf(scene);
    const double unit = scene.gradients ? scene.gradients->range() : 1;
    forEachTetSplat(
        scene, field, seen, PixelBins(pixels, size), threads,
        scene.cells ? scene.opacityPer : OpacityPer::Length,
        [&](std::size_t part, std::uint32_t, const MeshCells::Tetrahedron& tet,
            const TetSplat<double>& s, const timeseries::Interval<double>& range, std::size_t layer,
            std::size_t pixel) {
            const double perWeight = opticalDepthPerWeight(scene.layers[layer].style.opacity);
            const auto gradients =
                tet::gradientsOf(s, scene.gradients ? &tet.gradients : nullptr, unit);
            for (std::size_t ray = 0; ray < places.size(); ++ray) {
                const glm::dvec2 window = glm::dvec2(pixels[pixel]) + places[ray];
                const auto in = partOnRay(seen, s, window, opaque.at(pixels[pixel]));
                if (!in) continue;
                const double weight = passageOf(s, *in, lengthPerDepth(seen, window));
                const PartOnRay colored = ofItsColors(s, range, *in);
                parts[part].push_back({static_cast<std::uint32_t>(pixel * places.size() + ray),
                                       {.layer = static_cast<std::uint32_t>(layer),
                                        .part = colored,
                                        .opticalDepth = perWeight * weight,
                                        .gradients = gradientsOn(seen, s, gradients, window, *in),
                                        .steepness = s.extent > 0 ? steepness / s.extent : 0}});
            }
        });
    std::vector<PassedPart> all;
    for (const auto& some : parts) all.insert(all.end(), some.begin(), some.end());
    std::ranges::stable_sort(all, [](const PassedPart& a, const PassedPart& b) {
        return std::tie(a.ray, a.part.part.from) < std::tie(b.ray, b.part.part.from);
    });
    return all;
}

}  // namespace

std::vector<glm::dvec4> meshLight(const Scene& scene, const timeseries::Field& field,
                                  const View& view, std::span<const glm::dvec2> places,
                                  unsigned threads, LightOnRay::Of what,
                                  const OpaqueDepths& opaque) {
    const CellsView seen(scene.placed, view);
    std::vector<glm::dvec4> light(static_cast<std::size_t>(view.size.x) *
                                  static_cast<std::size_t>(view.size.y));
    LightOfParts lightOf(scene, what);
    std::vector<PartInLayer> ofRay;
    for (int top = 0; top < view.size.y; top += kSquareOfRays)
        for (int left = 0; left < view.size.x; left += kSquareOfRays) {
            std::vector<glm::ivec2> pixels;
            for (int y = top; y < std::min(top + kSquareOfRays, view.size.y); ++y)
                for (int x = left; x < std::min(left + kSquareOfRays, view.size.x); ++x)
                    pixels.emplace_back(x, y);
            const auto passed =
                passedBy(scene, field, seen, view.size, pixels, places, threads, opaque);
            for (std::size_t i = 0; i < passed.size();) {
                const std::uint32_t ray = passed[i].ray;
                ofRay.clear();
                for (; i < passed.size() && passed[i].ray == ray; ++i)
                    ofRay.push_back(passed[i].part);
                const glm::ivec2 pixel = pixels[ray / places.size()];
                const glm::dvec2 window = glm::dvec2(pixel) + places[ray % places.size()];
                lightOf.setWay(seen.rays.along(window - seen.rays.centre));
                light[static_cast<std::size_t>(pixel.y * view.size.x + pixel.x)] +=
                    lightOf.inOrder(ofRay) / static_cast<double>(places.size());
            }
        }
    return light;
}

}  // namespace render

#include "render/reference/tets_on_pixels.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "render/reference/truth_per.h"

namespace render {
namespace {

constexpr int kSquare = 32;

}  // namespace

PixelBins::PixelBins(std::span<const glm::ivec2> pixels, glm::ivec2 size)
    : pixels_(pixels), size_(size), across_((size + kSquare - 1) / kSquare) {
    const auto squares = static_cast<std::size_t>(across_.x) * static_cast<std::size_t>(across_.y);
    const auto of = [&](const glm::ivec2& pixel) {
        const glm::ivec2 square = squareOf(glm::dvec2(pixel) + 0.5);
        return static_cast<std::size_t>(square.y * across_.x + square.x);
    };
    firsts_.resize(squares + 1);
    for (const glm::ivec2& pixel : pixels) ++firsts_[of(pixel) + 1];
    std::partial_sum(firsts_.begin(), firsts_.end(), firsts_.begin());
    std::vector<std::size_t> next = firsts_;
    order_.resize(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) order_[next[of(pixels[i])]++] = i;
}

glm::ivec2 PixelBins::squareOf(const glm::dvec2& at) const {
    return glm::ivec2(glm::clamp(at, glm::dvec2(0), glm::dvec2(size_ - 1))) / kSquare;
}

std::optional<PartOnRay> partOnRay(const PointsView& view, const TetSplat<double>& seen,
                                   const glm::dvec2& window, double opaque) {
    const glm::dvec2 offset = window - view.rays.centre - seen.centre;
    const auto [from, to] = wayThrough(view, seen, offset, opaque);
    if (!(to > from)) return std::nullopt;
    const double shift = offset.x * seen.fX + offset.y * seen.fY;
    const double change = seen.fRay + shift, first = seen.f + seen.base * shift + from * change;
    double begin = 0, end = 1;  // of this way
    const double along = (to - from) * change;
    const auto cut = [&](double bound, bool above) {  // leaves what is above or below the bound
        if (along == 0) {
            if (above ? first < bound : first > bound) end = begin;
            return;
        }
        const double at = (bound - first) / along;
        if ((along > 0) == above)
            begin = std::max(begin, at);
        else
            end = std::min(end, at);
    };
    if (seen.crossesLeast) cut(seen.least, true);
    if (seen.crossesMost) cut(seen.most, false);
    if (!(end > begin)) return std::nullopt;
    const auto valueAt = [&](double way) {
        return seen.reference + seen.extent * (first + way * along);
    };
    return PartOnRay{seen.base + std::lerp(from, to, begin), seen.base + std::lerp(from, to, end),
                     valueAt(begin), valueAt(end)};
}

double lengthPerDepth(const PointsView& view, const glm::dvec2& window) {
    const glm::dvec2 slope = (window - view.rays.centre) / view.rays.focal;
    return view.rayLength / view.unitLength * std::sqrt(1 + glm::dot(slope, slope));
}

double passageOf(const TetSplat<double>& seen, const PartOnRay& part, double lengthPerDepth) {
    const double crossed =
        seen.extent > 0 ? std::abs(part.end - part.begin) / seen.extent * seen.perRange : 0;
    return std::max((part.to - part.from) * lengthPerDepth, crossed);
}

std::vector<double> addedUp(std::span<const std::vector<double>> parts) {
    std::vector<double> sums(parts.front().size());
    for (const std::vector<double>& some : parts)
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += some[i];
    return sums;
}

std::vector<double> meshWeight(const Scene& scene, const timeseries::Field& field, const View& view,
                               std::size_t layer, std::span<const glm::ivec2> pixels,
                               std::span<const glm::dvec2> places, unsigned threads,
                               const OpaqueDepths& opaque) {
    const CellsView seen(scene.placed, view);
    const PixelBins bins(pixels, view.size);
    std::vector<std::vector<double>> parts(kCellParts, std::vector<double>(pixels.size()));
    const OpacityPer per = truthPer(scene, scene.layers[layer]);
    const auto& ranges = scene.layers[layer].cells.ranges;
    forEachTetBefore(
        scene, field, seen, bins, threads,
        [&](std::size_t part, std::uint32_t, const MeshCells::Tetrahedron& tet, std::size_t of,
            const WindowBox& box) {
            if (of != layer) return;
            thread_local std::vector<TetSplat<double>> inRanges;  // when a pixel asks for them
            inRanges.clear();
            bins.forEachIn(box, [&](std::size_t pixel) {
                if (inRanges.empty())
                    for (const auto& range : ranges)
                        inRanges.push_back(tetSplatAt<double>(
                            seen, {tet.at, tet.values, range.lo, range.hi, per}));
                double sum = 0;
                for (const TetSplat<double>& s : inRanges) {
                    if (!s.visible) continue;
                    for (const glm::dvec2& place : places) {
                        const glm::dvec2 window = glm::dvec2(pixels[pixel]) + place;
                        if (const auto in = partOnRay(seen, s, window, opaque.at(pixels[pixel])))
                            sum += passageOf(s, *in, lengthPerDepth(seen, window));
                    }
                }
                parts[part][pixel] += sum / static_cast<double>(places.size());
            });
        });
    return addedUp(parts);
}

}  // namespace render

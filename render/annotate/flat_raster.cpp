#include "render/annotate/flat_raster.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace render {
namespace {

struct RowSpan {
    int first, last;
};

// The pixels of a row whose middles lie inside. Sides that triangles share are crossed at the same
// place by both, so that no pixel is drawn twice and none is left out.
RowSpan spanOf(const std::array<glm::dvec2, 3>& corner, int row, int width) {
    const double y = row + 0.5;
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec2 a = corner[i], b = corner[(i + 1) % 3];
        if (b.y < a.y) std::swap(a, b);
        if (!(a.y <= y && y < b.y)) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        from = std::min(from, x);
        to = std::max(to, x);
    }
    const auto pixel = [&](double x) {
        return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width)));
    };
    if (!(from < to)) return {0, 0};
    return {pixel(from), pixel(to)};
}

int rowAbove(double y, int height) {
    return static_cast<int>(std::clamp(std::ceil(y - 0.5), 0.0, static_cast<double>(height)));
}

}  // namespace

FlatRaster::FlatRaster(const FlatMesh& mesh, const Font& font, glm::ivec2 picture) : font_(font) {
    const auto& corners = mesh.triangles();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) take(&corners[i], picture);
}

void FlatRaster::take(const FlatVertex* corners, glm::ivec2 picture) {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i)
        t.corner[i] = {corners[i].at.x, static_cast<double>(picture.y) - corners[i].at.y};
    const glm::dvec2 u = t.corner[1] - t.corner[0], v = t.corner[2] - t.corner[0];
    const double area = u.x * v.y - u.y * v.x;
    if (!(std::abs(area) > 0)) return;
    const auto [lowest, highest] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    t.first = rowAbove(lowest, picture.y);
    t.last = rowAbove(highest, picture.y);
    if (t.first >= t.last) return;
    // Through three corners, by Cramer's rule.
    const auto plane = [&](double a, double b, double c) {
        const double perX = ((b - a) * v.y - (c - a) * u.y) / area,
                     perY = ((c - a) * u.x - (b - a) * v.x) / area;
        return Plane{a - perX * t.corner[0].x - perY * t.corner[0].y, perX, perY};
    };
    const auto of = [&](auto part) {
        return plane(part(corners[0]), part(corners[1]), part(corners[2]));
    };
    t.depth = of([](const FlatVertex& c) { return c.at.z; });
    t.distance = of([](const FlatVertex& c) { return c.edge.x; });
    t.half = of([](const FlatVertex& c) { return c.edge.y; });
    for (int k = 0; k < 4; ++k)
        t.color[static_cast<std::size_t>(k)] = of([&](const FlatVertex& c) { return c.color[k]; });
    for (int k = 0; k < 2; ++k)
        t.texel[static_cast<std::size_t>(k)] = of([&](const FlatVertex& c) { return c.texel[k]; });
    t.glyph = corners[0].texel.x >= 0 ? &coverageOf(corners[0].color) : nullptr;
    triangles_.push_back(t);
}

const FlatRaster::Coverage& FlatRaster::coverageOf(const glm::vec4& color) {
    const float luminance =
        std::clamp(0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b, 0.0f, 1.0f);
    for (const auto& [known, coverage] : coverages_)
        if (known == luminance) return *coverage;
    auto coverage = std::make_unique<Coverage>();
    for (std::size_t i = 0; i < coverage->size(); ++i)
        (*coverage)[i] = textCoverage(static_cast<float>(i) / 255, luminance);
    return *coverages_.emplace_back(luminance, std::move(coverage)).second;
}

float FlatRaster::coverage(const Triangle& of, double x, double y) const {
    const float edge =
        std::clamp(of.half.at(x, y) + 0.5f - std::abs(of.distance.at(x, y)), 0.0f, 1.0f);
    if (of.glyph == nullptr) return edge;
    const glm::ivec2 size = font_.atlasSize();
    const glm::ivec2 at =
        glm::clamp(glm::ivec2(glm::floor(glm::vec2(of.texel[0].at(x, y), of.texel[1].at(x, y)))),
                   glm::ivec2(0), size - 1);
    return edge * (*of.glyph)[font_.atlas()[static_cast<std::size_t>(at.y) *
                                                static_cast<std::size_t>(size.x) +
                                            static_cast<std::size_t>(at.x)]];
}

// visit(triangle, x, y, place among `count` rows from `first` on): in the mesh's order.
template <typename Visit>
void FlatRaster::forEachPixel(glm::ivec2 picture, int first, int count, TouchedPixels* touched,
                              const Visit& visit) const {
    for (const Triangle& t : triangles_) {
        const int last = std::min(t.last, first + count);
        for (int row = std::max(t.first, first); row < last; ++row) {
            const RowSpan span = spanOf(t.corner, row, picture.x);
            if (touched) touched->touch(row - first, span.first, span.last);
            std::size_t place =
                static_cast<std::size_t>(row - first) * static_cast<std::size_t>(picture.x) +
                static_cast<std::size_t>(span.first);
            for (int x = span.first; x < span.last; ++x, ++place)
                visit(t, x + 0.5, row + 0.5, place);
        }
    }
}

void FlatRaster::draw(const PixelRows<float>& light, TouchedPixels* touched) const {
    forEachPixel(light.picture, light.first, light.count, touched,
                 [&](const Triangle& t, double x, double y, std::size_t place) {
                     const float covered = coverage(t, x, y);
                     if (!(covered > 0)) return;
                     float* const pixel = light.pixels + 4 * place;
                     const float rest = 1 - covered * t.color[3].at(x, y);
                     for (std::size_t k = 0; k < 4; ++k)
                         pixel[k] = covered * t.color[k].at(x, y) + rest * pixel[k];
                 });
}

void FlatRaster::drawDepth(const PixelRows<float>& depth) const {
    forEachPixel(depth.picture, depth.first, depth.count, nullptr,
                 [&](const Triangle& t, double x, double y, std::size_t place) {
                     if (coverage(t, x, y) > 0.5f)
                         depth.pixels[place] = std::min(depth.pixels[place], t.depth.at(x, y));
                 });
}

}  // namespace render

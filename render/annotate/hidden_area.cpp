#include "render/annotate/hidden_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace render {
namespace {

// Window positions along a row, or its pixels [from, to).
template <typename T>
struct Span {
    T from, to;
};
using Triangle = std::array<glm::dvec2, 3>;

// Neighbouring triangles' common side is worked out twice.
constexpr double kSeam = 1e-3;  // pixels

std::vector<Triangle> onPicture(const HiddenArea& area, const View& view) {
    std::vector<Triangle> triangles;
    const glm::dmat4& clip = view.clipFromView;
    const auto window = [&](const glm::dvec2& at) {
        const glm::dvec4 p = clip * glm::dvec4(at, -1.0, 1.0);
        return (glm::dvec2(p) / p.w + 1.0) / 2.0 * glm::dvec2(view.size);
    };
    for (std::size_t i = 0; i + 2 < area.corners.size(); i += 3)
        triangles.push_back(
            {window(area.corners[i]), window(area.corners[i + 1]), window(area.corners[i + 2])});
    return triangles;
}

// What the triangle, its border included, has of a line along x; from > to when nothing.
Span<double> cut(const Triangle& triangle, double y) {
    Span<double> inside{std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
    const auto include = [&](double x) {
        inside = {std::min(inside.from, x), std::max(inside.to, x)};
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 &a = triangle[i], &b = triangle[(i + 1) % 3];
        if (a.y == y) include(a.x);
        if ((a.y < y && y < b.y) || (b.y < y && y < a.y))
            include(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    return inside;
}

// All triangles together: ascending, disjoint.
std::vector<Span<double>> cut(std::span<const Triangle> triangles, double y) {
    std::vector<Span<double>> parts, joined;
    for (const Triangle& triangle : triangles)
        if (const auto part = cut(triangle, y); part.from <= part.to) parts.push_back(part);
    std::ranges::sort(parts, {}, &Span<double>::from);
    for (const Span<double>& part : parts) {
        if (joined.empty() || part.from > joined.back().to + kSeam)
            joined.push_back(part);
        else
            joined.back().to = std::max(joined.back().to, part.to);
    }
    return joined;
}

// Pixels whose centre and neighbours' to the left and right lie in one part.
std::vector<Span<int>> pixelsWithin(std::span<const Span<double>> parts, int width) {
    std::vector<Span<int>> pixels;
    for (const auto& [from, to] : parts) {
        const double first = from <= 0.5 ? 0 : std::ceil(from + 0.5);
        const double end = to >= width - 0.5 ? width : std::floor(to - 0.5);
        const Span<int> span{static_cast<int>(std::min(first, double(width))),
                             static_cast<int>(std::max(end, 0.0))};
        if (span.from < span.to) pixels.push_back(span);
    }
    return pixels;
}

std::vector<Span<int>> common(std::span<const Span<int>> a, std::span<const Span<int>> b) {
    std::vector<Span<int>> both;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const Span<int> span{std::max(a[i].from, b[j].from), std::min(a[i].to, b[j].to)};
        if (span.from < span.to) both.push_back(span);
        if (a[i].to < b[j].to)
            ++i;
        else
            ++j;
    }
    return both;
}

}  // namespace

std::vector<PixelBox> hiddenPixels(const HiddenArea& area, const View& view) {
    const std::vector<Triangle> triangles = onPicture(area, view);
    const auto row = [&](int y) -> std::vector<Span<int>> {
        if (y < 0 || y >= view.size.y) return {{0, view.size.x}};
        return pixelsWithin(cut(triangles, y + 0.5), view.size.x);
    };
    std::vector<PixelBox> hidden;
    auto below = row(-1), here = row(0);
    for (int y = 0; y < view.size.y; ++y) {
        auto above = row(y + 1);
        for (const auto& [from, to] : common(common(below, here), above))
            hidden.push_back({{from, y}, {to - from, 1}});
        below = std::move(here);
        here = std::move(above);
    }
    return hidden;
}

}  // namespace render

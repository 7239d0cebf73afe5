#include "render/splat/cell_slopes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/splat/cell_pieces.h"

namespace render {
namespace {

constexpr double kMost = static_cast<double>(kMostSlope);
constexpr double kMostUnits = 1e300;
constexpr double kLeastExtent = 1e-300;  // what a number may be divided by

}  // namespace

PointSlopes::PointSlopes(const Scene& scene) : scene_(scene), cells_(scene.cells->size()) {
    std::uint32_t step = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& places = scene.placed.positions()[a];
        const auto count = static_cast<std::uint32_t>(places.size());
        const auto per = [&](std::uint32_t from, std::uint32_t to) {
            return from == to ? 0 : 1 / (places[to] - places[from]);
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t below = i > 0 ? i - 1 : i, above = std::min(i + 1, count - 1);
            along_[a].push_back({(i - below) * step, (above - i) * step, per(below, above),
                                 per(below, i), per(i, above)});
        }
        step *= count;
    }
}

glm::dvec3 PointSlopes::at(const glm::uvec3& point, double extent) const {
    const timeseries::Field& field = scene_.cells->field();
    const auto index = static_cast<std::uint32_t>(scene_.cells->cornersOf().indexOf(point));
    const auto slopes = [&](const auto& values) {
        const auto valueOf = [&](std::uint32_t i) {
            return timeseries::finiteOr(values[i], !field.missing.empty() && field.missing[i]);
        };
        const auto apart = [&](double from, double to) {  // in halves, the whole may overflow
            return 2 * ((0.5 * to - 0.5 * from) / extent);
        };
        glm::dvec3 slope;
        for (int a = 0; a < 3; ++a) {
            const Neighbours& to = along_[static_cast<std::size_t>(a)][point[a]];
            const double below = valueOf(index - to.below), above = valueOf(index + to.above);
            slope[a] = apart(below, above) * to.perBoth;
            if (std::isfinite(slope[a])) continue;
            const double here = valueOf(index);
            slope[a] = std::isnan(above) ? apart(below, here) * to.perBelow
                                         : apart(here, above) * to.perAbove;
            if (!std::isfinite(slope[a])) slope[a] = 0;
        }
        return slope;
    };
    return std::visit(slopes, field.values);
}

std::array<glm::dvec3, 8> PointSlopes::gradients(const glm::uvec3& cell, double extent) const {
    std::array<glm::dvec3, 8> out;
    for (unsigned c = 0; c < 8; ++c)
        out[c] = at(scene_.cells->cornersOf().pointAt(cell, c), extent);
    return out;
}

void PointSlopes::add(std::uint32_t cell, const glm::dvec3& size, double extent,
                      SlopeBatch& batch) const {
    const timeseries::Field& field = scene_.cells->field();
    const timeseries::CellCorners& corners = scene_.cells->cornersOf();
    const glm::uvec3 at = cells_(cell);
    const glm::uvec3 low = corners.pointAt(at, 0), high = corners.pointAt(at, 7);
    const std::array points = corners.pointsOf(at);
    const std::size_t to = batch.count++;
    const double perExtent = extent > 0 ? 2 / std::max(extent, kLeastExtent) : 0;
    const auto addAlong = [&]<std::size_t kAxis>(const auto& values) {
        constexpr auto kA = static_cast<int>(kAxis);
        const std::array beside{along_[kAxis][low[kA]], along_[kAxis][high[kA]]};
        for (std::size_t end = 0; end < 2; ++end)
            batch.scale[kAxis][end][to] = size[kA] * perExtent * beside[end].perBoth;
#pragma GCC unroll 8
        for (std::size_t c = 0; c < 8; ++c) {
            const Neighbours& of = beside[c >> kAxis & 1];
            const std::uint64_t below = points[c] - of.below, above = points[c] + of.above;
            double half =
                0.5 * static_cast<double>(values[above]) - 0.5 * static_cast<double>(values[below]);
            if (!field.missing.empty() && (field.missing[below] || field.missing[above]))
                half = std::numeric_limits<double>::quiet_NaN();
            batch.difference[kAxis][c][to] = half;
        }
    };
    std::visit(
        [&](const auto& values) {
            addAlong.template operator()<0>(values);
            addAlong.template operator()<1>(values);
            addAlong.template operator()<2>(values);
        },
        field.values);
}

CellSlopes PointSlopes::atCorners(const glm::uvec3& cell, const glm::dvec3& size,
                                  double extent) const {
    CellSlopes slopes{};
    if (!(extent > 0)) return slopes;
    const std::array<glm::dvec3, 8> all = gradients(cell, extent);
    for (unsigned c = 0; c < 8; ++c)
        for (int a = 0; a < 3; ++a)
            slopes[static_cast<std::size_t>(a)][c] =
                static_cast<float>(std::clamp(all[c][a] * size[a], -kMost, kMost));
    return slopes;
}

CellSlopes PointSlopes::in(std::uint32_t cell, unsigned octant, const glm::dvec3& size,
                           double extent, OfOctants& last) const {
    const bool isWhole = octant == kWholeCell;
    CellSlopes slopes{};
    if (isWhole)
        slopes = atCorners(cells_(cell), size, extent);
    else if (extent > 0) {
        if (last.cell != cell) {
            last = {.cell = cell, .unit = std::exp2(std::ilogb(extent)), .gradients = {}};
            last.gradients = gradients(cells_(cell), last.unit);
        }
        const glm::dvec3 perGradient = size * std::min(last.unit / extent, kMostUnits);
        for (unsigned c = 0; c < 8; ++c)
            for (int a = 0; a < 3; ++a)
                slopes[static_cast<std::size_t>(a)][c] = static_cast<float>(
                    std::clamp(last.gradients[c][a] * perGradient[a], -kMost, kMost));
    }
    for (std::array<float, 8>& along : slopes) {
        std::array<float, 8> of = along;
        for (unsigned c = 0; c < 8 && !isWhole; ++c)
            of[c] = cell::valueAt(along, glm::vec3(placeInOctant(octant, c)));
        along = cell::coefficients(of);
    }
    return slopes;
}

}  // namespace render

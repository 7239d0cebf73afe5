// The cells between the points of a field, and the values at their corners.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <utility>

#include "timeseries/grid/field.h"

namespace timeseries {

// As a double; NaN where the value is missing or not finite.
template <typename T>
double finiteOr(T value, bool isMissing) {
    const auto x = static_cast<double>(value);
    return isMissing || !std::isfinite(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}

// Of a point of the field, or a node (Mesh::corners()), as finiteOr() has it.
inline double finiteValue(const Field& field, std::uint64_t point) {
    return std::visit(
        [&](const auto& values) {
            if (point >= values.size()) return field.atNodes[point - values.size()];
            return finiteOr(values[point], !field.missing.empty() && field.missing[point]);
        },
        field.values);
}
// The least and the greatest of these points' values; inf and -inf where none has any.
inline std::pair<double, double> finiteExtent(const Field& field,
                                              std::span<const std::uint32_t> points) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const std::uint32_t point : points) {
        const double v = finiteValue(field, point);
        lo = v < lo ? v : lo;  // NaN is neither
        hi = v > hi ? v : hi;
    }
    return {lo, hi};
}

// Corners of a tetrahedron that have no value get the mean of those that have one; a bit for each
// of these.
inline unsigned fillTetrahedron(std::array<double, 4>& corners) {
    unsigned there = 0;
    int count = 0;
    double sum = 0;
    for (unsigned i = 0; i < 4; ++i) {
        if (std::isnan(corners[i])) continue;
        there |= 1u << i;
        ++count;
        sum += corners[i] / 4;  // no sum of four overflows
    }
    for (double& corner : corners)
        if (std::isnan(corner)) corner = sum * (4.0 / count);
    return there;
}

// A cell lies between eight neighbouring points. Beyond the outermost points lie half cells,
// whose outer corners repeat the points' values, so that cells fill what the points stand for:
// along each index there is one more of them than of points, and cell i lies between points i - 1
// and i. Corners are numbered x fastest. The field must outlive it.
class CellCorners {
 public:
    explicit CellCorners(const Field& field)
        : field_(&field),
          points_(field.grid->size()[0], field.grid->size()[1], field.grid->size()[2]) {}

    glm::uvec3 size() const { return points_ + 1u; }  // cells along the indices
    // The point, along the indices, whose value a corner has.
    glm::uvec3 pointAt(const glm::uvec3& cell, unsigned corner) const {
        const glm::uvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::uvec3 up = glm::max(cell + side, glm::uvec3(1)) - 1u;
        return glm::min(up, points_ - 1u);
    }
    std::uint64_t indexOf(const glm::uvec3& point) const {
        const glm::vec<3, std::uint64_t> n(points_);
        return point.x + n.x * (point.y + n.y * point.z);
    }
    // Of the points at its corners.
    std::array<std::uint64_t, 8> pointsOf(const glm::uvec3& cell) const {
        const std::uint64_t first = indexOf(pointAt(cell, 0)), last = indexOf(pointAt(cell, 7));
        const std::uint64_t x = cell.x > 0 && cell.x < points_.x ? 1 : 0;
        const std::uint64_t y = cell.y > 0 && cell.y < points_.y ? points_.x : 0;
        const std::uint64_t z = last - first - x - y;
        return {first,     first + x,     first + y, first + x + y,
                first + z, first + z + x, last - x,  last};
    }
    // Of a cell; NaN where a value is missing or not finite.
    std::array<double, 8> values(const glm::uvec3& cell) const {
        const std::array<std::uint64_t, 8> points = pointsOf(cell);
        const bool lacks = !field_->missing.empty();
        std::array<double, 8> out{};
        std::visit(
            [&](const auto& values) {
                for (unsigned c = 0; c < 8; ++c)
                    out[c] = finiteOr(values[points[c]], lacks && field_->missing[points[c]]);
            },
            field_->values);
        return out;
    }

 private:
    const Field* field_;
    glm::uvec3 points_;
};

}  // namespace timeseries

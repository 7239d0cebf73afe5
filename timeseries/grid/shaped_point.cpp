#include "timeseries/grid/shaped_point.h"

#include <cmath>

namespace timeseries {
namespace {

std::uint32_t signedCode(const SmallFloat& form, double value) {
    return form.code(std::abs(value)) | std::uint32_t{std::signbit(value)} << form.bits;
}

// A cell is not lost, however thin.
std::uint32_t sideCode(const SmallFloat& form, double side) {
    return std::max(form.code(side), 1u);
}

}  // namespace

ShapedPoint::ShapedPoint(const glm::dvec3& at) {
    for (int c = 0; c < 3; ++c) {
        const double away = std::abs(at[c]);
        std::uint32_t& place = word[static_cast<std::size_t>(c)];
        if (!(away < std::numeric_limits<double>::infinity())) {
            place = kNoPlace;
            continue;
        }
        place = std::min(kPlace.code(away), kPlace.last() - 1) | std::uint32_t{std::signbit(at[c])}
                                                                     << kPlace.bits;
    }
}

ShapedPoint::ShapedPoint(const glm::dvec3& at, const LowerTriangle<double>& cell, bool turned,
                         unsigned widened, Right right)
    : ShapedPoint(at) {
    const glm::dvec3& side = cell.diagonal;
    const std::uint32_t x = sideCode(kSide, side.x), z = sideCode(kSide, side.z);
    const double nearX = kSide.magnitude(x), nearZ = kSide.magnitude(z);
    const double share = right == Right::Volume ? side.z / nearZ : 1;
    const std::uint32_t y = sideCode(kRightSide, side.y * (side.x / nearX) * share);
    const std::uint32_t first = signedCode(kFirstSlope, cell.below.x / kRightSide.magnitude(y));
    for (const int k : {0, 1, 2})
        word[static_cast<std::size_t>(k)] |= (first >> 5 * k) << kPlaceBits;
    word[3] = x | z << kSide.bits | std::uint32_t{turned} << 30 | widened << 31;
    word[4] = y | widened >> 1 << kRightSide.bits;
    word[5] = signedCode(kSlope, cell.below.y / nearZ) | signedCode(kSlope, cell.below.z / nearZ)
                                                             << 16;
}

}  // namespace timeseries

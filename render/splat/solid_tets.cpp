#include "render/splat/solid_tets.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// Beside a pole cells are many times as long along longitudes as along latitudes. One that lies
// where longitudes begin anew would reach so far beyond the map, of its own latitudes.
constexpr double kMostBeyond = 4;

}  // namespace

glm::dvec3 SolidTets::longestOn(const Globe& globe) const {
    const glm::dvec3 farthest =
        glm::max(glm::abs(placed_.mesh()->lo()), glm::abs(placed_.mesh()->hi()));
    const glm::dvec3& along = cells_.longest();
    return glm::dvec3(glm::length(farthest) * kPerDegree * (along.x + along.y) +
                      std::abs(globe.radius(along.z) - globe.radius(0)));
}

glm::dvec3 SolidTets::middle(std::uint32_t cell) const {
    timeseries::SolidCells::Room room;
    const auto corners = cells_.corners(cell, room);
    const glm::dvec3 first = placed_.cornerAlongAxes(corners.front());
    glm::dvec3 sum(0);
    for (const std::uint32_t corner : corners) sum += way(first, corner);
    return first + sum / static_cast<double>(corners.size());
}

std::uint64_t SolidTets::inFrontOf(const Drawn& part, std::span<const Drawn> parts,
                                   const glm::dvec3& eye) {
    const auto& own = part.tet.corners;
    std::uint64_t before = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto& other = parts[k].tet.corners;
        std::size_t shared = 0, lone = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::ranges::find(other, own[i]) != other.end())
                ++shared;
            else
                lone = i;
        }
        if (shared != 3) continue;
        auto at = part.tet.at;
        const bool isLeft = turnOf(at) < 0;
        at[lone] = eye;
        const double turn = turnOf(at);
        if (isLeft ? turn > 0 : turn < 0) before |= std::uint64_t{1} << k;
    }
    return before;
}

unsigned SolidTets::take(const std::array<std::uint32_t, 4>& points, Tetrahedron& tet) const {
    const bool ofMiddle = cells_.haveMiddles();  // the first
    unsigned inside = 0;
    for (unsigned i = 0; i < 4; ++i) {
        tet.at[i] = placed_.cornerAlongAxes(points[i]);
        if (i > 0 && comesRound_)
            tet.at[i] = tet.at[0] + timeseries::shorterWay(tet.at[i] - tet.at[0], period_);
        if (!timeseries::isPlace(tet.at[i])) return 0;
        tet.corners[i] = points[i];
        if (gradients_) tet.gradients[i] = gradients_.at(points[i]);
        tet.values[i] = timeseries::finiteValue(field_, points[i]);
        const std::uint32_t point = ofMiddle ? points[0] : points[i];
        if (!byPoints_ || placed_.inside(point, clip_)) inside |= 1u << i;
    }
    if (ofMiddle && std::isnan(tet.values[0])) return 0;  // all of the cell is missing
    const unsigned seen = inside & timeseries::fillTetrahedron(tet.values);
    if (comesRound_) {
        const auto [least, most] = std::ranges::minmax(tet.at, {}, &glm::dvec3::x);
        if (timeseries::SolidCells::isAboutPole(most.x - least.x, period_.x)) return 0;
        const auto [low, high] = std::ranges::minmax(tet.at, {}, &glm::dvec3::y);
        const double beyond = std::max(mapFrom_ - least.x, most.x - mapTo_);
        if (beyond > kMostBeyond * (high.y - low.y)) return 0;
    }
    return seen;
}

}  // namespace render

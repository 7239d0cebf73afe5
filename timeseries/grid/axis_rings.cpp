#include "timeseries/grid/axis_rings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "timeseries/grid/curvilinear.h"

namespace timeseries {
namespace {

using Index = glm::vec<3, std::uint64_t>;

// So many points, and those beside each on the next line.
struct Line {
    const MeshPlaces& places;
    std::uint64_t first, step, count, next;
    const glm::dvec3& at(std::uint64_t i) const { return places.at[first + i * step]; }
    const glm::dvec3& beside(std::uint64_t i) const { return places.at[next + i * step]; }
};

// From its last point to its first no farther than neighbours are apart.
bool comesRound(const Line& line) {
    constexpr double kFarther = 1.5;
    const std::uint64_t last = line.count - 1;
    return glm::distance(line.at(last), line.at(0)) <=
           kFarther * std::max(glm::distance(line.at(0), line.at(1)),
                               glm::distance(line.at(last - 1), line.at(last)));
}

// None where the line only goes there and back: a ring's area is about that of a circle.
AxisRing ringOf(const Line& line) {
    constexpr double kRound = 0.5;
    std::vector<glm::dvec3> from(line.count);  // from the first point, then from the middle
    glm::dvec3 middle(0);
    double most = 0;
    for (std::uint64_t i = 0; i < line.count; ++i) {
        from[i] = line.at(i) - line.at(0);
        middle += from[i] / static_cast<double>(line.count);
    }
    for (glm::dvec3& each : from) {
        each -= middle;
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(each[c]));
    }
    if (!(most > 0)) return {};
    glm::dvec3 area(0);
    double away = 0, away2 = 0, across = 0;
    for (std::uint64_t i = 0; i < line.count; ++i) {
        const glm::dvec3 one = from[i] / most, other = from[(i + 1) % line.count] / most;
        area += 0.5 * glm::cross(one, other);
        away += glm::length(one);
        away2 += glm::dot(one, one);
        if (one != glm::dvec3(0))
            across += std::abs(glm::dot(line.beside(i) - line.at(i), glm::normalize(one)));
    }
    const auto count = static_cast<double>(line.count);
    if (!(glm::length(area) > kRound * std::numbers::pi * away2 / count)) return {};
    return {away / count * most, across / count};
}

}  // namespace

AxisRings::AxisRings(const MeshPlaces& places)
    : size_(places.size[0], places.size[1], places.levels.empty() ? places.size[2] : 1) {
    // What comes round are degrees then, of which no ring is one.
    if (places.period != glm::dvec3(0)) return;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            if (a != b) find(places, a, b);
}

void AxisRings::find(const MeshPlaces& places, int a, int b) {
    constexpr std::uint64_t kFewest = 6;
    if (size_[a] < kFewest || size_[b] <= kRows) return;
    const Index stride(1, size_.x, size_.x * size_.y);
    const int c = 3 - a - b;
    std::vector<AxisRing> found(2 * kRows * size_[c]);
    bool any = false;
    for (std::uint64_t k = 0; k < found.size(); ++k) {
        const std::uint64_t row = k % kRows, end = k / kRows % 2;
        const std::uint64_t at = end == 0 ? row : size_[b] - 1 - row;
        const std::uint64_t first = k / (2 * kRows) * stride[c] + at * stride[b];
        const Line line{places, first, stride[a], size_[a],
                        end == 0 ? first + stride[b] : first - stride[b]};
        if (comesRound(line)) found[k] = ringOf(line);
        any = any || found[k].across > 0;
    }
    if (!any) return;
    isEmpty_ = false;
    lines_[static_cast<std::size_t>(3 * a + b)] = std::move(found);
}

unsigned AxisRings::widening(const Index& at, int a, double side) const {
    unsigned most = 0;
    for (const int b : {(a + 1) % 3, (a + 2) % 3}) {
        const auto& found = lines_[static_cast<std::size_t>(3 * a + b)];
        if (found.empty()) continue;
        const std::uint64_t before = at[b], behind = size_[b] - 1 - at[b];
        const std::uint64_t row = std::min(before, behind), end = behind < before ? 1 : 0;
        if (row >= kRows) continue;
        most = std::max(most, wideningOn(found[(2 * at[3 - a - b] + end) * kRows + row], side));
    }
    return most;
}

}  // namespace timeseries

#include "render/points/block_order.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "render/points/subset.h"
#include "timeseries/grid/grid.h"

namespace render {
namespace {

constexpr std::uint32_t kCells = 32;  // along an axis

// The five bits of a cell's number along one axis, each followed by two zeros.
std::uint32_t spread(std::uint32_t cell) {
    return (cell & 1) | (cell & 2) << 2 | (cell & 4) << 4 | (cell & 8) << 6 | (cell & 16) << 8;
}

// Per axis, by index along it: the axis's part of a cell's number on the curve.
std::array<std::vector<std::uint32_t>, 3> curveTables(glm::uvec3 size) {
    std::array<std::vector<std::uint32_t>, 3> tables;
    for (int a = 0; a < 3; ++a)
        for (std::uint64_t i = 0; i < size[a]; ++i)
            tables[a].push_back(spread(static_cast<std::uint32_t>(i * kCells / size[a])) << a);
    return tables;
}

// Counting sort of the positions in `order` by key(position), [0, Keys); stable.
template <std::size_t Keys, typename Key>
std::vector<std::uint16_t> sortedBy(const std::vector<std::uint16_t>& order, const Key& key) {
    std::vector<std::uint32_t> next(Keys + 1);
    for (const std::uint16_t i : order) ++next[key(i) + 1u];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint16_t> sorted(order.size());
    for (const std::uint16_t i : order) sorted[next[key(i)]++] = i;
    return sorted;
}

// Of points in these cells.
std::vector<std::uint16_t> orderOf(const std::vector<std::uint16_t>& cell) {
    std::vector<std::uint16_t> given(cell.size());
    std::iota(given.begin(), given.end(), std::uint16_t{0});
    const auto near =
        sortedBy<kCells * kCells * kCells>(given, [&](std::uint16_t place) { return cell[place]; });
    // Level 0: ranks of the largest prefix; each further level has three times all before it.
    constexpr std::uint32_t kLargest = prefixStride(kMaxStride);
    constexpr std::size_t kLevels = (std::bit_width(kLargest) + 1) / 2;
    return sortedBy<kLevels>(near, [](std::uint16_t place) {
        return static_cast<std::size_t>(
            (std::bit_width(subsetRank(place) / (kSubsetPeriod / kLargest)) + 1) / 2);
    });
}

}  // namespace

std::vector<std::uint16_t> blockOrder(std::span<const std::uint32_t> gridIndex, glm::uvec3 size) {
    const auto tables = curveTables(size);
    std::vector<std::uint16_t> cell;
    cell.reserve(gridIndex.size());
    for (const std::uint32_t i : gridIndex) {
        const glm::uvec3 at = timeseries::indicesOf(i, size);
        cell.push_back(
            static_cast<std::uint16_t>(tables[0][at.x] | tables[1][at.y] | tables[2][at.z]));
    }
    return orderOf(cell);
}

std::vector<std::uint16_t> blockOrder(std::span<const std::uint32_t> gridIndex,
                                      const timeseries::Mesh& mesh) {
    const glm::dvec3 extent = mesh.hi() - mesh.lo();
    std::vector<std::uint16_t> cell;
    cell.reserve(gridIndex.size());
    for (const std::uint32_t i : gridIndex) {
        const glm::dvec3 at = mesh.position(i) - mesh.lo();
        std::uint32_t code = 0;
        for (int a = 0; a < 3; ++a) {
            const double share = kCells * (at[a] / extent[a]);
            // A point without a place, or along a coordinate without an extent.
            if (!(share > 0)) continue;
            code |= spread(static_cast<std::uint32_t>(std::min(share, kCells - 1.0))) << a;
        }
        cell.push_back(static_cast<std::uint16_t>(code));
    }
    return orderOf(cell);
}

}  // namespace render

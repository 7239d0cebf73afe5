#include "render/splat/drawn_points.h"

#include <algorithm>
#include <limits>

namespace render {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kAhead = 24;

}  // namespace

void DrawnPoints::begin(const std::shared_ptr<const timeseries::Mesh>& mesh, std::size_t count) {
    if (mesh_.lock() != mesh) {
        mesh_ = mesh;
        stored_ = mesh->stored();
        isMore_ = mesh->count() > kNone;
        std::ranges::fill(gridIndex_, kNone);
    }
    if (gridIndex_.size() >= count) return;
    gridIndex_.resize(count, kNone);
    points_.resize(count);
}

std::span<const timeseries::Mesh::Point> DrawnPoints::of(std::size_t first,
                                                         std::span<const std::uint32_t> gridIndex) {
    const auto known = std::span(gridIndex_).subspan(first, gridIndex.size());
    const auto points = std::span(points_).subspan(first, gridIndex.size());
    if (!isMore_ && std::ranges::equal(known, gridIndex)) return points;
    const std::span from = stored_.points;
    const auto at = [&](std::size_t i) -> const timeseries::Mesh::Point& {
        return from[stored_.levels.empty() ? gridIndex[i] : gridIndex[i] % from.size()];
    };
    for (std::size_t i = 0; i < gridIndex.size(); ++i) {
        if (i + kAhead < gridIndex.size()) {
            const auto* const ahead = reinterpret_cast<const char*>(&at(i + kAhead));
            __builtin_prefetch(ahead);
            __builtin_prefetch(ahead + sizeof(timeseries::Mesh::Point) - 1);
        }
        points[i] = at(i);
    }
    std::ranges::copy(gridIndex, known.begin());
    return points;
}

}  // namespace render

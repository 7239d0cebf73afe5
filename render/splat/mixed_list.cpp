#include "render/splat/mixed_list.h"

#include <algorithm>
#include <cstdlib>

namespace render {

std::uint32_t MixedRank::ofCell(std::uint32_t cell) const {
    if (scene_.placed.isMesh()) return cells_(cell);
    return distanceTo(timeseries::indicesOf(cell, size_));
}

std::uint32_t MixedRank::ofPoint(std::uint32_t index) const {
    if (scene_.placed.isMesh()) return cells_.ofMiddle(scene_.placed.alongAxes(index));
    const glm::uvec3 point = scene_.placed.indices(index);
    glm::uvec3 cell(0);
    for (int a = 0; a < 3; ++a)
        cell[a] = point[a] + (cells_.eye()[a] <= static_cast<int>(point[a]) ? 1u : 0u);
    return distanceTo(cell);
}

std::uint32_t MixedRank::distanceTo(const glm::uvec3& cell) const {
    std::uint32_t sum = 0;
    for (int a = 0; a < 3; ++a)
        sum += static_cast<std::uint32_t>(std::abs(static_cast<int>(cell[a]) - cells_.eye()[a]));
    return sum;
}

MixedList::MixedList(const Scene& scene, const View& view, const timeseries::Columns& columns)
    : scene_(scene),
      onlyPoints_(render::onlyPoints(scene)),
      columns_(columns),
      rank_(scene, view),
      points_(onlyPoints_),
      cells_(scene, Channels::Over, 0),
      order_(rank_.count()) {
    if (points_.done() && cells_.done()) rankCells(0);
}

std::uint64_t MixedList::goOn(std::uint64_t some) {
    if (!points_.done()) return listPoints(some);
    if (!cells_.done()) return cells_.goOn(some);
    return isCounted_ ? place(some) : rankCells(some);
}

std::uint64_t MixedList::listPoints(std::uint64_t some) {
    points_.next(some, some_);
    for (std::size_t i = 0; i < some_.point.size(); ++i) {
        const std::uint32_t index = columns_.gridIndex[some_.point[i]];
        if (!scene_.placed.inside(index, scene_.clip)) continue;
        pointsListed_.push_back({some_.point[i], some_.layer[i]});
        ranks_.push_back(rank_.ofPoint(index));
        order_.count(ranks_.back());
    }
    return some_.point.size();
}

std::uint64_t MixedList::rankCells(std::uint64_t some) {
    const std::span<const CellOfLayer> all = cells_.cells();
    some = std::min<std::uint64_t>(some, all.size() - rankedCells_);
    for (const std::size_t end = rankedCells_ + some; rankedCells_ < end; ++rankedCells_) {
        ranks_.push_back(rank_.ofCell(all[rankedCells_].cell));
        order_.count(ranks_.back());
    }
    if (rankedCells_ < all.size()) return some;
    order_.allCounted();
    sorted_.resize(ranks_.size());
    isCounted_ = true;
    return some;
}

std::uint64_t MixedList::place(std::uint64_t some) {
    some = std::min<std::uint64_t>(some, ranks_.size() - placed_);
    for (const std::size_t end = placed_ + some; placed_ < end; ++placed_)
        sorted_[order_.place(ranks_[placed_])] =
            placed_ < pointsListed_.size() ? pointsListed_[placed_]
                                           : cells_.cells()[placed_ - pointsListed_.size()];
    return some;
}

}  // namespace render

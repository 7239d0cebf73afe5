#include "render/splat/cell_pieces.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>

#include "render/splat/mesh_cells.h"

namespace render {
namespace {

// Less is listed before another thread has begun.
constexpr std::size_t kListedWorthAThread = 1 << 15;
// So many are sorted sooner than a million ranks are gone through.
constexpr std::size_t kFew = 1 << 14;

// Before which point of its axis a place lies: the index of the cell that holds it.
std::uint32_t cellAlong(const std::vector<double>& positions, double place) {
    const bool down = positions.front() > positions.back();
    const auto before = [&](double at) { return down ? at > place : at < place; };
    return static_cast<std::uint32_t>(std::ranges::partition_point(positions, before) -
                                      positions.begin());
}

}  // namespace

std::pair<std::size_t, std::size_t> layersOf(std::size_t count, Channels channels,
                                             std::size_t layer) {
    if (channels == Channels::Over || channels == Channels::Count) return {0, count};
    return {layer, layer + 1};
}

std::uint64_t cellCount(const Scene& scene, Channels channels, std::size_t layer) {
    const auto [first, last] = layersOf(scene.layers.size(), channels, layer);
    std::uint64_t count = 0;
    for (std::size_t k = first; k < last; ++k) count += cellCount(scene.layers[k]);
    return count;
}

CellList::CellList(const Scene& scene, Channels channels, std::size_t layer,
                   const CellRank* nearestFirst, unsigned threads)
    : scene_(scene),
      count_(cellCount(scene, channels, layer)),
      sharing_(threads),
      threads_(threadsFor(count_, kListedWorthAThread, threads)),
      listing_(partsFrom(layersOf(scene.layers.size(), channels, layer).first)),
      placing_(listing_),
      rank_(nearestFirst),
      ranks_(rank_ != nullptr ? count_ : 0, timeseries::Filled::Sparsely),
      cells_(count_, timeseries::Filled::Sparsely) {
    if (rank_ == nullptr || count_ <= kFew) return;
    for (unsigned k = 0; k < threads_; ++k) orders_.emplace_back(*rank_);
}

std::vector<CellList::Part> CellList::partsFrom(std::size_t layer) const {
    std::vector<Part> parts;
    for (unsigned k = 0; k < threads_; ++k) {
        Part& part =
            parts.emplace_back(Part{count_ * k / threads_, count_ * (k + 1) / threads_, layer});
        std::uint64_t before = part.next;
        const auto left = [&] { return cellCount(scene_.layers[part.layer]); };
        for (; before > 0 && before >= left(); ++part.layer) before -= left();
        const auto runOf = [&]() -> const timeseries::Run& {
            return scene_.layers[part.layer].cells.candidates[part.run];
        };
        for (; before > 0 && before >= runOf().count; ++part.run) before -= runOf().count;
        part.inRun = before;
    }
    return parts;
}

std::uint64_t CellList::goOn(std::uint64_t cells) {
    constexpr std::uint64_t kForOneByFaces = 8;
    const std::uint64_t listed = list(cells);
    if (rank_ == nullptr || listed_ < count_) return listed;
    const std::uint64_t left = cells - std::min(cells, listed);
    if (placed_ < count_) return listed + place(left);
    if (!byFaces_) return listed;
    byFaces_->goOn(left / kForOneByFaces + 1);
    return listed + std::min(left, kForOneByFaces * count_);
}

// use(place in the list, cell, part).
template <typename Use>
std::uint64_t CellList::pass(std::vector<Part>& parts, std::uint64_t cells, const Use& use) {
    const auto left = [&] {
        std::uint64_t sum = 0;
        for (const Part& part : parts) sum += part.end - part.next;
        return sum;
    };
    const std::uint64_t before = left(), each = std::min(cells, count_) / threads_ + 1;
    together(threads_, [&](unsigned k) {
        Part& part = parts[k];
        pass(part, std::min(each, part.end - part.next),
             [&](std::uint64_t at, const CellOfLayer& cell) { use(at, cell, k); });
    });
    return before - left();
}

template <typename Use>
void CellList::pass(Part& part, std::uint64_t cells, const Use& use) const {
    for (const std::uint64_t end = part.next + cells; part.next < end;) {
        const std::vector<timeseries::Run>& runs = scene_.layers[part.layer].cells.candidates;
        if (part.run == runs.size()) {
            ++part.layer;
            part.run = 0;
            continue;
        }
        const timeseries::Run& run = runs[part.run];
        const std::uint64_t some = std::min(run.count - part.inRun, end - part.next);
        const std::uint64_t first = run.first + part.inRun;
        for (std::uint64_t i = 0; i < some; ++i)
            use(part.next + i,
                {scene_.cells->cell(first + i), static_cast<std::uint8_t>(part.layer)});
        part.next += some;
        part.inRun += some;
        if (part.inRun < run.count) continue;
        ++part.run;
        part.inRun = 0;
    }
}

std::uint64_t CellList::list(std::uint64_t cells) {
    if (listed_ == count_) return 0;
    const std::uint64_t some =
        rank_ == nullptr
            ? pass(listing_, cells,
                   [&](std::uint64_t at, const CellOfLayer& cell, unsigned) {
                       cells_.data()[at] = cell;
                   })
            : pass(listing_, cells, [&](std::uint64_t at, const CellOfLayer& cell, unsigned k) {
                  const std::uint32_t rank = ranks_.data()[at] = (*rank_)(cell.cell);
                  if (!orders_.empty()) orders_[k].count(rank);
              });
    listed_ += some;
    if (rank_ == nullptr || listed_ < count_) return some;
    if (orders_.empty())
        ranksToPlaces();
    else
        NearestFirst::allCounted(orders_);
    return some;
}

void CellList::ranksToPlaces() {
    const std::span ranks(ranks_.data(), count_);
    std::vector<std::uint32_t> byRank(count_);
    std::iota(byRank.begin(), byRank.end(), 0u);
    std::ranges::stable_sort(byRank, {}, [&](std::uint32_t at) { return ranks[at]; });
    for (std::uint32_t place = 0; const std::uint32_t at : byRank) ranks[at] = place++;
}

std::uint64_t CellList::place(std::uint64_t cells) {
    const std::uint64_t some =
        pass(placing_, cells, [&](std::uint64_t at, const CellOfLayer& cell, unsigned k) {
            const std::uint32_t rank = ranks_.data()[at];
            cells_.data()[orders_.empty() ? rank : orders_[k].place(rank)] = cell;
        });
    placed_ += some;
    if (placed_ == count_ && scene_.placed.isMesh() && !scene_.byMiddles)
        byFaces_.emplace(scene_, rank_->view(), std::span(cells_.data(), count_), sharing_);
    return some;
}

std::vector<CellOfLayer> cellsOf(const Scene& scene, Channels channels, std::size_t layer,
                                 const CellRank* nearestFirst) {
    CellList list(scene, channels, layer, nearestFirst);
    while (!list.done()) list.goOn(std::numeric_limits<std::uint32_t>::max());
    return {list.cells().begin(), list.cells().end()};
}

CellRank::CellRank(const Scene& scene, const View& view)
    : size_(scene.cells->size()), along_(size_), view_(view) {
    if (scene.placed.isMesh())
        takeDistances(scene, view);
    else
        takeBricks(scene, view);
}

void CellRank::takeDistances(const Scene& scene, const View& view) {
    constexpr std::size_t kRanks = 1 << 20;
    count_ = kRanks;
    scene_ = &scene;
    from_ = pixelRays(view).eye;
    // Of points, which lie in the box; cells end half a cell beyond it.
    const double around =
        glm::length(scene.placed.pointsBox().hi - scene.placed.pointsBox().lo) / 2;
    const glm::dvec3 middle = 0.5 * (scene.placed.pointsBox().hi + scene.placed.pointsBox().lo);
    nearest_ = std::max(glm::distance(from_, middle) - around, 0.0);
    perDistance_ =
        (kRanks - 1) / std::max(glm::distance(from_, middle) + around - nearest_, 1e-300);
}

glm::dvec3 middleOfCell(const Scene& scene, std::uint32_t cell) {
    const PlacedPoints& placed = scene.placed;
    if (const auto& solids = placed.mesh()->solids()) {
        timeseries::SolidCells::Room room;
        const auto corners = solids->corners(cell, room);
        const glm::dvec3 first = placed.cornerAlongAxes(corners.front()), period = placed.period();
        glm::dvec3 sum(0);
        for (const std::uint32_t corner : corners)
            sum += timeseries::shorterWay(placed.cornerAlongAxes(corner) - first, period);
        return first + sum / static_cast<double>(corners.size());
    }
    const timeseries::CellCorners& corners = scene.cells->cornersOf();
    const glm::uvec3 at = timeseries::indicesOf(cell, scene.cells->size());
    const auto placeOf = [&](unsigned corner) {
        return placed.alongAxes(corners.indexOf(corners.pointAt(at, corner)));
    };
    return 0.5 * (placeOf(0) + placeOf(7));
}

std::uint32_t CellRank::ofMiddle(const glm::dvec3& middle) const {
    const double away = glm::distance(from_, middle) - nearest_;
    const double rank = away * perDistance_;  // of a place that is none, nothing is drawn
    return rank > 0 ? static_cast<std::uint32_t>(std::min(rank, double(count_ - 1))) : 0;
}

glm::uvec3 cellOfEye(const Scene& scene, const View& view) {
    const glm::dvec3 eye = pixelRays(scene.placed.inAxes(view)).eye;
    glm::uvec3 cell;
    for (int a = 0; a < 3; ++a)
        cell[a] = cellAlong(scene.placed.positions()[static_cast<std::size_t>(a)], eye[a]);
    return cell;
}

void CellRank::takeBricks(const Scene& scene, const View& view) {
    constexpr std::size_t kMostBricks = 1 << 16;
    eye_ = cellOfEye(scene, view);
    std::uint32_t side = 16;
    const auto bricksAlong = [&](int a) {  // the eye's own cell, and what lies on its two sides
        return 1 + (size_[a] + 2 * side - 1) / side;
    };
    const auto bricks = [&] {
        return std::size_t{bricksAlong(0)} * bricksAlong(1) * bricksAlong(2);
    };
    while (bricks() > kMostBricks) side *= 2;

    // Bricks along an axis: the eye's own cell first, then those above, then those below.
    struct Brick {
        std::uint32_t away = 0, cells = 0;
    };
    std::array<std::vector<Brick>, 3> along;
    std::uint32_t stride = 1;
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const auto own = static_cast<std::uint32_t>(eye_[a]);
        const std::uint32_t above = (size_[a] - own - 1 + side - 1) / side;
        along[axis].resize(bricksAlong(a));
        for (std::uint32_t i = 0; i < size_[a]; ++i) {
            const std::uint32_t cells = i > own ? i - own : own - i;
            const std::uint32_t away = (cells + side - 1) / side;
            const std::uint32_t at = i < own ? above + away : away;
            along[axis][at].away = away;
            ++along[axis][at].cells;
            places_[axis].push_back({at * stride, cells == 0 ? 0 : (cells - 1) % side});
        }
        stride *= bricksAlong(a);
    }
    const auto forEachBrick = [&](const auto& use) {  // how far away, and how many ranks it has
        std::uint32_t brick = 0;
        for (const Brick& z : along[2])
            for (const Brick& y : along[1])
                for (const Brick& x : along[0]) {
                    const bool isEmpty = x.cells == 0 || y.cells == 0 || z.cells == 0;
                    use(brick++, x.away + y.away + z.away,
                        isEmpty ? 0 : x.cells + y.cells + z.cells - 2);
                }
    };
    // A counting sort by distance; any order of those at one distance will do.
    std::vector<std::uint32_t> next(size_.x + size_.y + size_.z);
    forEachBrick([&](std::uint32_t, std::uint32_t away, std::uint32_t ranks) {
        next[away] += ranks;
        count_ += ranks;
    });
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    first_.resize(bricks());
    forEachBrick([&](std::uint32_t brick, std::uint32_t away, std::uint32_t ranks) {
        first_[brick] = next[away];
        next[away] += ranks;
    });
}

std::pair<double, double> endsAlong(const PlacedPoints& placed, std::size_t axis,
                                    std::uint32_t cell) {
    const auto& at = placed.positions()[axis];
    if (cell > 0 && cell < at.size()) return {at[cell - 1], at[cell]};
    const auto& width = placed.widths()[axis];
    const double up = at.front() > at.back() ? -0.5 : 0.5;
    return {cell == 0 ? at.front() - up * width.front() : at[cell - 1],
            cell == at.size() ? at.back() + up * width.back() : at[cell]};
}

SeenOctants seenOctants(const Scene& scene, std::uint32_t number) {
    SeenOctants seen;
    ValuedCell& cell = seen.cell;
    const glm::uvec3 at = timeseries::indicesOf(number, scene.cells->size());
    cell.corners = scene.cells->cornersOf().values(at);
    cell.per = scene.opacityPer;
    for (int a = 0; a < 3; ++a)
        std::tie(cell.from[a], cell.to[a]) =
            endsAlong(scene.placed, static_cast<std::size_t>(a), at[a]);
    seen.octants = fillMissing(cell.corners);
    if (scene.clip.holdsAll()) return seen;
    const timeseries::CellCorners& corners = scene.cells->cornersOf();
    const bool isInside =
        scene.clip.holds(corners.pointAt(at, 0)) && scene.clip.holds(corners.pointAt(at, 7));
    for (unsigned c = 0; c < 8 && !isInside; ++c)
        if (!scene.clip.holds(corners.pointAt(at, c))) seen.octants &= ~(1u << c);
    return seen;
}

ValuedCell octantOf(const ValuedCell& cell, unsigned octant) {
    ValuedCell piece = cell;
    piece.from = glm::mix(cell.from, cell.to, placeInOctant(octant, 0));
    piece.to = glm::mix(cell.from, cell.to, placeInOctant(octant, 7));
    for (unsigned c = 0; c < 8; ++c)
        piece.corners[c] = render::cell::valueAt(cell.corners, placeInOctant(octant, c));
    return piece;
}

}  // namespace render

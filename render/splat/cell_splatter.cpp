#include "render/splat/cell_splatter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "render/splat/cell_kernels.h"
#include "render/splat/tile_bins.h"
#include "render/splat/tile_plane.h"

namespace render {
namespace {

using timeseries::CellIndex;
using timeseries::Interval;

// Looked at before they are summed: 22 MB of them.
constexpr std::uint64_t kAtOnce = 1 << 17;
// Less is done before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 9;

struct CellOfLayer {
    std::uint32_t cell;
    std::uint8_t layer;
};

// The layers that a plane of these channels takes: from the first to before the second.
std::pair<std::size_t, std::size_t> layersOf(const Scene& scene, Channels channels,
                                             std::size_t layer) {
    if (channels == Channels::Over || channels == Channels::Count) return {0, scene.layers.size()};
    return {layer, layer + 1};
}

// Of these layers, as their candidates lie.
std::vector<CellOfLayer> candidates(const Scene& scene, Channels channels, std::size_t layer) {
    std::vector<CellOfLayer> cells;
    cells.reserve(cellCount(scene, channels, layer));
    const auto [first, last] = layersOf(scene, channels, layer);
    for (std::size_t k = first; k < last; ++k)
        for (const timeseries::Run& run : scene.layers[k].cells.candidates)
            for (std::uint64_t i = 0; i < run.count; ++i)
                cells.push_back({scene.cells->cell(run.first + i), static_cast<std::uint8_t>(k)});
    return cells;
}

// Before which point of its axis a place lies: the index of the cell that holds it.
int cellAlong(const std::vector<double>& positions, double place) {
    const bool down = positions.front() > positions.back();
    const auto before = [&](double at) { return down ? at > place : at < place; };
    return static_cast<int>(std::ranges::partition_point(positions, before) - positions.begin());
}

// The nearest first. What hides a part of a cell lies, along each axis, no farther from the eye's
// cell than it does, and nearer along one: the sum of these distances, in cells, is an order.
void orderByDepth(const Scene& scene, const View& view, std::vector<CellOfLayer>& cells) {
    const glm::dvec3 eye = pixelRays(scene.placed.inAxes(view)).eye;
    const glm::uvec3 size = scene.cells->size();
    glm::ivec3 at;
    for (int a = 0; a < 3; ++a)
        at[a] = cellAlong(scene.placed.positions()[static_cast<std::size_t>(a)], eye[a]);
    const auto distance = [&](const CellOfLayer& c) {
        const glm::ivec3 from = glm::ivec3(timeseries::indicesOf(c.cell, size)) - at;
        return static_cast<std::size_t>(std::abs(from.x) + std::abs(from.y) + std::abs(from.z));
    };
    std::vector<std::size_t> next(std::size_t{size.x} + size.y + size.z + 1);
    for (const CellOfLayer& c : cells) ++next[distance(c)];
    std::size_t first = 0;
    for (std::size_t& n : next) first += std::exchange(n, first);
    std::vector<CellOfLayer> ordered(cells.size());
    for (const CellOfLayer& c : cells) ordered[next[distance(c)]++] = c;
    cells = std::move(ordered);
}

// The grid's coordinates of a cell's two ends along an axis: points, or half a cell beyond them.
std::pair<double, double> endsAlong(const PlacedPoints& placed, std::size_t axis,
                                    std::uint32_t cell) {
    const auto &at = placed.positions()[axis], &width = placed.widths()[axis];
    const double up = at.front() > at.back() ? -0.5 : 0.5;
    return {cell == 0 ? at.front() - up * width.front() : at[cell - 1],
            cell == at.size() ? at.back() + up * width.back() : at[cell]};
}

// Calls use(piece) for what is to be seen of a cell: all of it, or its octants, of which that is
// left out that is nearest to a missing point, or to one outside the clip box.
template <typename Use>
void forEachPiece(const Scene& scene, std::uint32_t number, const Use& use) {
    const glm::uvec3 at = timeseries::indicesOf(number, scene.cells->size());
    ValuedCell cell{};
    cell.corners = scene.cells->corners(at);
    cell.per = scene.opacityPer;
    for (int a = 0; a < 3; ++a)
        std::tie(cell.from[a], cell.to[a]) =
            endsAlong(scene.placed, static_cast<std::size_t>(a), at[a]);
    unsigned octants = 0;
    double sum = 0;
    int valid = 0;
    for (unsigned c = 0; c < 8; ++c) {
        if (std::isnan(cell.corners[c])) continue;
        sum += cell.corners[c] / 8;
        ++valid;
        octants |= 1u << c;
    }
    const bool isInside = scene.clip.holds(scene.cells->pointAt(at, 0)) &&
                          scene.clip.holds(scene.cells->pointAt(at, 7));
    for (unsigned c = 0; c < 8 && !isInside; ++c)
        if (!scene.clip.holds(scene.cells->pointAt(at, c))) octants &= ~(1u << c);
    if (octants == 0) return;
    for (double& v : cell.corners)
        if (std::isnan(v)) v = sum * (8.0 / valid);
    if (octants == 255) return use(cell);
    for (unsigned o = 0; o < 8; ++o) {
        if ((octants >> o & 1) == 0) continue;
        ValuedCell piece = cell;
        const glm::dvec3 first(o & 1 ? 0.5 : 0, o & 2 ? 0.5 : 0, o & 4 ? 0.5 : 0);
        piece.from = glm::mix(cell.from, cell.to, first);
        piece.to = glm::mix(cell.from, cell.to, first + 0.5);
        for (unsigned c = 0; c < 8; ++c)
            piece.corners[c] = render::cell::valueAt(
                cell.corners, first + 0.5 * glm::dvec3(c & 1, c >> 1 & 1, c >> 2));
        use(piece);
    }
}

// The tiles that a cell's pixels are in.
TileSpan spanOf(const CellView& view, const SeenCell& c) {
    const glm::ivec2 first = glm::ivec2(c.x, c.y) / view.tile;
    const glm::ivec2 last = (glm::ivec2(c.x + c.columns, c.y + c.rows) - 1) / view.tile;
    return {static_cast<std::uint32_t>(first.y * view.tiles.x + first.x),
            static_cast<std::uint16_t>(last.x - first.x + 1),
            static_cast<std::uint16_t>(last.y - first.y + 1)};
}

}  // namespace

std::uint64_t cellCount(const Scene& scene, Channels channels, std::size_t layer) {
    const auto [first, last] = layersOf(scene, channels, layer);
    std::uint64_t count = 0;
    for (std::size_t k = first; k < last; ++k) count += cellCount(scene.layers[k]);
    return count;
}

// Pieces of cells that one thread has looked at, and which tiles they touch.
struct CellMemory::Seen {
    std::vector<SeenCell> cells;
    std::vector<TileSpan> spans;
    TileBins bins;
    std::vector<std::uint32_t> binned;

    void look(const Scene& scene, const CellView& view, std::span<const CellOfLayer> part);
    void sum(const CellView& view, std::size_t tile, TileRoom& room) const {
        sumCells(view, cells, std::span(binned).subspan(bins.first(tile), bins.count(tile)), room);
    }
};

void CellMemory::Seen::look(const Scene& scene, const CellView& view,
                            std::span<const CellOfLayer> part) {
    cells.clear();
    spans.clear();
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const CellOfLayer& of = part[i];
        if (i + kAhead < part.size()) scene.cells->prefetch(part[i + kAhead].cell);
        const Layer& layer = scene.layers[of.layer];
        forEachPiece(scene, of.cell, [&](ValuedCell& piece) {
            for (const Interval<double>& range : layer.cells.ranges) {
                piece.lo = range.lo;
                piece.hi = range.hi;
                const SeenCell seen = seenCell(view, piece, of.layer, layer.style);
                if (seen.columns == 0) continue;
                cells.push_back(seen);
                spans.push_back(spanOf(view, seen));
            }
        });
    }
    bins.fill(
        view.count(), view.tiles.x, spans, 0, spans.size(),
        [&](std::size_t places) { binned.resize(places); },
        [&](std::uint32_t to, std::size_t i) { binned[to] = static_cast<std::uint32_t>(i); });
}

struct CellMemory::Kept {
    std::vector<float> plane;
    std::vector<Seen> seen;  // one a thread
};

CellMemory::CellMemory() : kept(std::make_unique<Kept>()) {}
CellMemory::CellMemory(CellMemory&&) noexcept = default;
CellMemory& CellMemory::operator=(CellMemory&&) noexcept = default;
CellMemory::~CellMemory() = default;

struct CellSum::Work {
    const Scene& scene;
    CellView view;
    unsigned threads;
    CellMemory memory;
    TilePlane plane;
    std::vector<CellOfLayer> cells;
    std::size_t passed = 0;

    Work(const Scene& drawn, const View& of, Channels channels, std::size_t layer,
         std::span<const float> opaqueDepth, unsigned shared, CellMemory kept)
        : scene(drawn),
          view(drawn, of, channels),
          threads(std::max(shared, 1u)),
          memory(kept.kept ? std::move(kept) : CellMemory()),
          plane(view, opaqueDepth, of.size.x, threads, memory.kept->plane) {
        cells = candidates(scene, channels, layer);
        if (channels == Channels::Over) orderByDepth(scene, of, cells);
        memory.kept->seen.resize(threads);
    }
    void sum(std::span<const CellOfLayer> part, bool lastOfAll);
};

void CellSum::Work::sum(std::span<const CellOfLayer> part, bool lastOfAll) {
    const unsigned shared = threadsFor(part.size(), kWorthAThread, threads);
    const std::span<CellMemory::Seen> seen = std::span(memory.kept->seen).first(shared);
    together(shared, [&](unsigned k) {
        const std::size_t first = part.size() * k / shared, last = part.size() * (k + 1) / shared;
        seen[k].look(scene, view, part.subspan(first, last - first));
    });
    plane.sum(
        shared, lastOfAll,
        [&](std::size_t tile) {
            return std::ranges::any_of(
                seen, [&](const CellMemory::Seen& some) { return some.bins.count(tile) > 0; });
        },
        [&](std::size_t tile, TileRoom& room) {
            for (const CellMemory::Seen& some : seen) some.sum(view, tile, room);
        });
}

CellSum::CellSum(const Scene& scene, const View& view, Channels channels, std::size_t layer,
                 std::span<const float> opaqueDepth, unsigned threads, CellMemory memory)
    : work_(new Work(scene, view, channels, layer, opaqueDepth, threads, std::move(memory))) {
    if (done()) work_->sum({}, true);  // nothing, which also is to be written
}

CellSum::CellSum(CellSum&&) noexcept = default;
CellSum::~CellSum() = default;

std::uint64_t CellSum::add(std::uint64_t cells) {
    std::uint64_t added = 0;
    while (!done() && added < cells) {
        const std::span<const CellOfLayer> all(work_->cells);
        const std::uint64_t count =
            std::min({kAtOnce, cells - added, std::uint64_t{all.size() - work_->passed}});
        const std::span<const CellOfLayer> part = all.subspan(work_->passed, count);
        work_->passed += count;
        work_->sum(part, done());
        added += count;
    }
    return added;
}

bool CellSum::done() const { return work_->passed == work_->cells.size(); }
const PixelBox& CellSum::box() const { return work_->view.box; }
std::vector<float>& CellSum::plane() { return work_->memory.kept->plane; }
CellMemory CellSum::takeMemory() { return std::move(work_->memory); }

}  // namespace render

#include "render/splat/mixed_splatter.h"

#include <algorithm>
#include <utility>

#include "render/splat/cell_batches.h"
#include "render/splat/cell_kernels.h"
#include "render/splat/mixed_list.h"
#include "render/splat/open_tiles.h"
#include "render/splat/seen_cells.h"
#include "render/splat/seen_splats.h"
#include "render/splat/tet_kernels.h"
#include "render/splat/tile_bins.h"
#include "render/splat/tile_kernels.h"
#include "render/splat/tile_plane.h"
#include "render/splat/tile_splatter.h"

namespace render {
namespace {

constexpr std::uint64_t kAtOnce = 1 << 16;
// Listed and put in order, on one thread, in the time that one takes to be summed.
constexpr std::uint64_t kListedForOne = 16;
// Less is done before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 10;

// What of several points is drawn, and where: of all threads', in the order of the list.
struct Points {
    struct {
        std::vector<std::uint32_t> index;
        std::vector<float> tint;
    } list;
    SeenSplats seen;
    std::vector<TileSpan> spans;

    void take(const Scene& scene, TileView& view, std::size_t count) {
        list.index.resize(count);
        list.tint.resize(count);
        spans.resize(count);
        seen.begin(scene, view, count);
    }
};

// What one thread looks at, and which tiles that touches.
class Part {
 public:
    // `points`: the first of the list's is at `first` among them.
    void look(const Scene& scene, const CellView& cells, const TilePlane& plane,
              const TileView& splats, const timeseries::Columns& columns,
              const CellBatches& batches, std::span<const CellOrPoint> passed, Points& points,
              std::size_t first);
    bool holds(std::size_t tile) const {
        return cellBins_.count(tile) + splatBins_.count(tile) > 0;
    }
    // `room` is of cells; splats have tables of rays of their own.
    void sum(const CellView& cells, const TileView& splats, std::size_t tile, TileRoom& room,
             TileRoom& splatRoom) const;

 private:
    void lookAtCells(const Scene& scene, const CellView& view, const TilePlane& plane,
                     const CellBatches& batches, std::span<const CellOrPoint> some);
    void bin(const CellView& view, const Points& points, std::size_t first, std::size_t last);

    // Points, then cells, up to these among those that are seen.
    struct Stretch {
        std::size_t points, cells;
    };
    std::vector<Stretch> stretches_;
    timeseries::PageVector<SeenCell> cells_;
    timeseries::PageVector<CellSlopes> slopes_;  // of each, where light falls on them
    SeenTets tets_;                              // of a mesh, instead of these
    PieceBatch pieces_;
    std::vector<TileSpan> cellSpans_;
    TileBins cellBins_, splatBins_;
    std::vector<std::uint32_t> binnedCells_, binnedPoints_, binnedIndex_;
    std::vector<float> binnedTint_;
};

void Part::lookAtCells(const Scene& scene, const CellView& view, const TilePlane& plane,
                       const CellBatches& batches, std::span<const CellOrPoint> some) {
    if (!scene.placed.isMesh())
        return batches.forEach(some, pieces_, [&] {
            seeCells(view, scene, batches.slopes(), pieces_, cells_, slopes_, cellSpans_);
            pieces_.count = 0;
        });
    forEachTet(scene, some, &view.seen.rays.eye, OpenTiles(view, plane),
               [&](const ValuedTet& tet, const CellOfLayer& of) {
                   if (tets_.add(view, tet, of.layer, scene.layers[of.layer].style))
                       cellSpans_.push_back(spanOf(view, tets_.tets.back()));
               });
}

void Part::look(const Scene& scene, const CellView& cells, const TilePlane& plane,
                const TileView& splats, const timeseries::Columns& columns,
                const CellBatches& batches, std::span<const CellOrPoint> passed, Points& points,
                std::size_t first) {
    stretches_.clear();
    cells_.clear();
    slopes_.clear();
    tets_.clear();
    cellSpans_.clear();
    const auto isPoint = [&](const CellOrPoint& of) { return scene.layers[of.layer].byPoints; };
    std::size_t last = first;
    for (std::size_t i = 0; i < passed.size();) {
        for (; i < passed.size() && isPoint(passed[i]); ++i, ++last) {
            const CellOrPoint& of = passed[i];
            points.list.index[last] = columns.gridIndex[of.cell];
            points.list.tint[last] =
                tintPlace(splats, of.layer, scene.layers[of.layer].style,
                          std::visit([&](auto v) { return static_cast<double>(v[of.cell]); },
                                     columns.values));
        }
        const std::size_t from = i;
        while (i < passed.size() && !isPoint(passed[i])) ++i;
        lookAtCells(scene, cells, plane, batches, passed.subspan(from, i - from));
        stretches_.push_back({last, cellSpans_.size()});
    }
    points.seen.see(scene, splats, first, std::span(points.list.index).subspan(first, last - first),
                    std::span(points.spans).subspan(first, last - first));
    bin(cells, points, first, last);
}

void Part::bin(const CellView& view, const Points& points, std::size_t first, std::size_t last) {
    cellBins_.fill(
        view.count(), view.tiles.x, cellSpans_, 0, cellSpans_.size(),
        [&](std::size_t places) { binnedCells_.resize(places); },
        [&](std::uint32_t to, std::size_t i) { binnedCells_[to] = static_cast<std::uint32_t>(i); });
    splatBins_.fill(
        view.count(), view.tiles.x, points.spans, first, last,
        [&](std::size_t places) {
            binnedPoints_.resize(places);
            binnedIndex_.resize(places);
            binnedTint_.resize(places);
        },
        [&](std::uint32_t to, std::size_t i) {
            binnedPoints_[to] = static_cast<std::uint32_t>(i);
            binnedIndex_[to] = points.list.index[i];
            binnedTint_[to] = points.list.tint[i];
        });
}

void Part::sum(const CellView& cells, const TileView& splats, std::size_t tile, TileRoom& room,
               TileRoom& splatRoom) const {
    const auto inTile = [&](const auto& binned, const TileBins& bins) {
        return std::span(binned).subspan(bins.first(tile), bins.count(tile));
    };
    const std::span cellsHere = inTile(binnedCells_, cellBins_);
    const std::span pointsHere = inTile(binnedPoints_, splatBins_);
    // Places up to which they are of a stretch.
    const auto upTo = [](std::span<const std::uint32_t> here, std::size_t from, std::size_t end) {
        const auto rest = here.subspan(from);
        return from + static_cast<std::size_t>(std::ranges::lower_bound(rest, end) - rest.begin());
    };
    // The first stretch that holds what a tile has next; the others are nothing here.
    const auto stretchOf = [&](std::span<const std::uint32_t> here, std::size_t next, auto end) {
        return next == here.size() ? stretches_.end()
                                   : std::ranges::upper_bound(stretches_, here[next], {}, end);
    };
    std::size_t cell = 0, point = 0;
    while (cell < cellsHere.size() || point < pointsHere.size()) {
        const Stretch& stretch = *std::min(stretchOf(pointsHere, point, &Stretch::points),
                                           stretchOf(cellsHere, cell, &Stretch::cells));
        const std::size_t lastPoint = upTo(pointsHere, point, stretch.points);
        if (lastPoint > point) {
            std::swap(room.sums, splatRoom.sums);
            const std::size_t at = splatBins_.first(tile) + point, count = lastPoint - point;
            sumTile(splats, std::span(binnedIndex_).subspan(at, count),
                    std::span(binnedTint_).subspan(at, count), splatRoom);
            std::swap(room.sums, splatRoom.sums);
            point = lastPoint;
        }
        const std::size_t lastCell = upTo(cellsHere, cell, stretch.cells);
        if (lastCell == cell) continue;
        const auto some = cellsHere.subspan(cell, lastCell - cell);
        if (tets_.tets.empty())
            sumCells(cells, cells_, slopes_, some, room);
        else
            sumTets(cells, tets_, some, room);
        cell = lastCell;
    }
}

}  // namespace

struct MixedSum::Work {
    const Scene& scene;
    timeseries::Columns columns;
    CellView cells;
    TileView splats;
    std::span<const float> opaqueDepth;
    int width;  // of the picture
    unsigned threads;
    PlanePixels kept, rays;
    TilePlane plane;
    CellBatches batches;
    MixedList list;
    std::size_t passed = 0;   // of it
    std::vector<Part> parts;  // one a thread
    Points points;

    Work(const Scene& drawn, const View& view, std::span<const float> opaque, int raysAcross,
         unsigned shared, PlanePixels memory)
        : scene(drawn),
          columns(columnsOf(drawn)),
          cells(drawn, view, Channels::Over, raysAcross),
          splats(drawn, view, Channels::Over, 0, raysAcross),
          opaqueDepth(opaque),
          width(view.size.x),
          threads(std::max(shared, 1u)),
          kept(std::move(memory)),
          plane(cells, opaque, view.size.x, threads, kept, raysAcross > 1 ? rays : kept),
          batches(drawn),
          list(drawn, view, columns),
          parts(threads) {}
    bool done() const { return list.done() && passed == list.all().size(); }
    void sum(std::span<const CellOrPoint> some, bool lastOfAll);
};

void MixedSum::Work::sum(std::span<const CellOrPoint> some, bool lastOfAll) {
    const unsigned shared = threadsFor(some.size(), kWorthAThread, threads);
    const auto beginOf = [&](unsigned k) { return some.size() * k / shared; };
    std::vector<std::size_t> firsts{0};  // of each thread's points
    for (unsigned k = 0; k < shared; ++k)
        firsts.push_back(firsts.back() + static_cast<std::size_t>(std::ranges::count_if(
                                             some.subspan(beginOf(k), beginOf(k + 1) - beginOf(k)),
                                             [&](const CellOrPoint& of) {
                                                 return scene.layers[of.layer].byPoints;
                                             })));
    points.take(scene, splats, firsts.back());
    together(shared, [&](unsigned k) {
        parts[k].look(scene, cells, plane, splats, columns, batches,
                      some.subspan(beginOf(k), beginOf(k + 1) - beginOf(k)), points, firsts[k]);
    });
    const std::span<const Part> looked = std::span(parts).first(shared);
    plane.sum(
        shared, lastOfAll,
        [&](std::size_t tile) {
            return std::ranges::any_of(looked, [&](const Part& part) { return part.holds(tile); });
        },
        [&](unsigned, std::size_t tile, TileRoom& room) {
            TileRoom splatRoom(splats);
            splatRoom.enter(splats, tile, opaqueDepth, width);
            for (const Part& part : looked) part.sum(cells, splats, tile, room, splatRoom);
        });
}

MixedSum::MixedSum(const Scene& scene, const View& view, std::span<const float> opaqueDepth,
                   int raysAcross, unsigned threads, PlanePixels memory)
    : work_(new Work(scene, view, opaqueDepth, raysAcross, threads, std::move(memory))) {
    if (done()) work_->sum({}, true);  // nothing, which also is to be written
}
MixedSum::MixedSum(MixedSum&&) noexcept = default;
MixedSum::~MixedSum() = default;

std::uint64_t MixedSum::add(std::uint64_t count) {
    Work& work = *work_;
    std::uint64_t added = 0;
    while (!done() && added < count) {
        if (!work.list.done()) {
            const std::uint64_t some = std::min(kAtOnce, count - added);
            added += std::clamp<std::uint64_t>(work.list.goOn(kListedForOne * some) / kListedForOne,
                                               1, some);
            if (done()) work.sum({}, true);  // all are clipped away
            continue;
        }
        const std::span<const CellOrPoint> all = work.list.all();
        const std::uint64_t some =
            std::min({kAtOnce, count - added, std::uint64_t{all.size() - work.passed}});
        const auto part = all.subspan(work.passed, some);
        work.passed += some;
        work.sum(part, done());
        added += some;
    }
    return added;
}

bool MixedSum::done() const { return work_->done(); }
const PixelBox& MixedSum::box() const { return work_->cells.pixels; }
PlanePixels& MixedSum::plane() { return work_->kept; }
PlanePixels MixedSum::takeMemory() { return std::move(work_->kept); }

}  // namespace render

#include "render/splat/cell_splatter.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "render/splat/cell_batches.h"
#include "render/splat/cell_kernels.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/open_tiles.h"
#include "render/splat/seen_cells.h"
#include "render/splat/tet_kernels.h"
#include "render/splat/tile_bins.h"
#include "render/splat/tile_plane.h"

namespace render {
namespace {

// Looked at before they are summed: 16 MB of them.
constexpr std::uint64_t kAtOnce = 1 << 17;
// Of a mesh fewer, each of several tetrahedra: then it is known anew what hides the rest. The first
// ones fill the picture where the eye is among them.
constexpr std::uint64_t kAtOnceOfMesh = 1 << 15, kFirstOfMesh = 1 << 4;
// Listed and put in order in the time that one takes to be summed.
constexpr std::uint64_t kListedForOne = 64;
constexpr std::uint64_t kListedOfMesh = 1 << 17;  // at once
// Less is done before another thread has begun.
constexpr std::size_t kCellsWorthAThread = 1 << 9;

}  // namespace

// Pieces of cells that one thread has looked at, and which tiles they touch.
struct CellMemory::Seen {
    timeseries::PageVector<SeenCell> cells;
    timeseries::PageVector<CellSlopes> slopes;  // of each, where light falls on them
    SeenTets tets;                              // of a mesh, instead of these
    PieceBatch pieces;
    std::vector<TileSpan> spans;
    TileBins bins;
    std::vector<std::uint32_t> binned;

    void look(const Scene& scene, const CellView& view, const TilePlane& plane,
              const CellBatches& batches, std::span<const CellOfLayer> part);
    void sum(const CellView& view, std::size_t tile, TileRoom& room) const {
        const auto which = std::span(binned).subspan(bins.first(tile), bins.count(tile));
        if (tets.tets.empty())
            sumCells(view, cells, slopes, which, room);
        else
            sumTets(view, tets, which, room);
    }
};

void CellMemory::Seen::look(const Scene& scene, const CellView& view, const TilePlane& plane,
                            const CellBatches& batches, std::span<const CellOfLayer> part) {
    cells.clear();
    slopes.clear();
    tets.clear();
    spans.clear();
    if (scene.placed.isMesh()) {
        const bool isOrdered = view.channels == Channels::Over;
        forEachTet(scene, part, isOrdered ? &view.seen.rays.eye : nullptr, OpenTiles(view, plane),
                   [&](const ValuedTet& tet, const CellOfLayer& of) {
                       if (tets.add(view, tet, of.layer, scene.layers[of.layer].style))
                           spans.push_back(spanOf(view, tets.tets.back()));
                   });
    } else {
        batches.forEach(part, pieces, [&] {
            seeCells(view, scene, batches.slopes(), pieces, cells, slopes, spans);
            pieces.count = 0;
        });
    }
    bins.fill(
        view.count(), view.tiles.x, spans, 0, spans.size(),
        [&](std::size_t places) { binned.resize(places); },
        [&](std::uint32_t to, std::size_t i) { binned[to] = static_cast<std::uint32_t>(i); });
}

struct CellMemory::Kept {
    PlanePixels plane, rays;
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
    std::optional<CellRank> rank;  // where they are passed in order
    CellList list;
    CellBatches batches;
    std::size_t passed = 0;  // of its cells

    Work(const Scene& drawn, const View& of, Channels channels, std::size_t layer,
         std::span<const float> opaqueDepth, int raysAcross, unsigned shared, CellMemory kept)
        : scene(drawn),
          view(drawn, of, channels, raysAcross),
          threads(std::max(shared, 1u)),
          memory(kept.kept ? std::move(kept) : CellMemory()),
          plane(view, opaqueDepth, of.size.x, threads, memory.kept->plane,
                raysAcross > 1 ? memory.kept->rays : memory.kept->plane),
          rank(channels == Channels::Over ? std::optional<CellRank>(std::in_place, drawn, of)
                                          : std::nullopt),
          list(drawn, channels, layer, rank ? &*rank : nullptr, threads),
          batches(drawn) {
        memory.kept->seen.resize(threads);
    }
    bool done() const { return list.done() && passed == list.cells().size(); }
    std::uint64_t mostListed() const {
        return scene.placed.isMesh() ? kListedOfMesh / kListedForOne : kAtOnce;
    }
    std::uint64_t mostAtOnce() const {
        if (!scene.placed.isMesh()) return kAtOnce;
        return passed == 0 && rank ? kFirstOfMesh : kAtOnceOfMesh;
    }
    void sum(std::span<const CellOfLayer> part, bool lastOfAll);
};

void CellSum::Work::sum(std::span<const CellOfLayer> part, bool lastOfAll) {
    const unsigned shared = threadsFor(part.size(), kCellsWorthAThread, threads);
    const std::span<CellMemory::Seen> seen = std::span(memory.kept->seen).first(shared);
    together(shared, [&](unsigned k) {
        const std::size_t first = part.size() * k / shared, last = part.size() * (k + 1) / shared;
        seen[k].look(scene, view, plane, batches, part.subspan(first, last - first));
    });
    std::size_t inTiles = part.size();
    for (const CellMemory::Seen& some : seen) inTiles += some.binned.size();
    plane.sum(
        threadsFor(inTiles, kCellsWorthAThread, threads), lastOfAll,
        [&](std::size_t tile) {
            return std::ranges::any_of(
                seen, [&](const CellMemory::Seen& some) { return some.bins.count(tile) > 0; });
        },
        [&](unsigned, std::size_t tile, TileRoom& room) {
            for (const CellMemory::Seen& some : seen) some.sum(view, tile, room);
        });
}

CellSum::CellSum(const Scene& scene, const View& view, Channels channels, std::size_t layer,
                 std::span<const float> opaqueDepth, int raysAcross, unsigned threads,
                 CellMemory memory)
    : work_(new Work(scene, view, channels, layer, opaqueDepth, raysAcross, threads,
                     std::move(memory))) {
    if (done()) work_->sum({}, true);  // nothing, which also is to be written
}

CellSum::CellSum(CellSum&&) noexcept = default;
CellSum::~CellSum() = default;

std::uint64_t CellSum::add(std::uint64_t cells) {
    Work& work = *work_;
    if (cells == 0) return 0;
    if (!work.list.done()) {
        const std::uint64_t most = std::min(work.mostListed(), cells);
        return std::clamp<std::uint64_t>(work.list.goOn(kListedForOne * most) / kListedForOne, 1,
                                         most);
    }
    std::uint64_t added = 0;
    const std::span<const CellOfLayer> all = work.list.cells();
    do {
        const std::uint64_t count =
            std::min({work.mostAtOnce(), cells - added, std::uint64_t{all.size() - work.passed}});
        const std::span<const CellOfLayer> part = all.subspan(work.passed, count);
        work.passed += count;
        work.sum(part, done());
        added += count;
    } while (!done() && added < cells && !work.scene.placed.isMesh());
    return added;
}

bool CellSum::done() const { return work_->done(); }
const PixelBox& CellSum::box() const { return work_->view.pixels; }
PlanePixels& CellSum::plane() { return work_->memory.kept->plane; }

CellMemory CellSum::takeMemory() {
    constexpr std::size_t kMostKept = std::size_t{64} << 20;
    PlanePixels& rays = work_->memory.kept->rays;
    if (rays.size() * sizeof(float) > kMostKept) PlanePixels().swap(rays);
    return std::move(work_->memory);
}

}  // namespace render

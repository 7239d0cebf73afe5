#include "render/splat/tile_splatter.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "render/splat/splat_source.h"
#include "render/splat/tile_kernels.h"
#include "render/splat/tile_plane.h"
#include "render/together.h"

namespace render {
namespace {

// Sorted into tiles at once: more would not make it faster.
constexpr std::uint64_t kAtOnce = 1 << 20;
// Less is done before another thread has begun.
constexpr std::size_t kSplatsWorthAThread = 1 << 11;

}  // namespace

// The splats that touch each tile, in the list's order: those of a part of the list, sorted by one
// thread.
class TileMemory::Bins {
 public:
    void fill(const TileView& view, const SplatList& list, std::span<const TileSpan> spans,
              std::size_t first, std::size_t last) {
        bins_.fill(
            view.count(), view.tiles.x, spans, first, last,
            [&](std::size_t places) {
                index_.resize(places);
                tint_.resize(list.tint.empty() ? 0 : places);
            },
            [&](std::uint32_t to, std::size_t i) {
                index_[to] = list.index[i];
                if (!tint_.empty()) tint_[to] = list.tint[i];
            });
    }
    bool holds(std::size_t tile) const { return bins_.count(tile) > 0; }
    void sum(const TileView& view, std::size_t tile, TileRoom& room) const {
        const std::uint32_t first = bins_.first(tile), count = bins_.count(tile);
        const std::span<const float> tints(tint_);
        sumTile(view, std::span(index_).subspan(first, count),
                tints.empty() ? tints : tints.subspan(first, count), room);
    }

 private:
    TileBins bins_;
    std::vector<std::uint32_t> index_;
    std::vector<float> tint_;
};

struct TileMemory::Kept {
    std::vector<float> plane;
    SplatPoints points;
    SplatList list;
    std::vector<TileSpan> spans;  // of the list
    std::vector<Bins> bins;
};

TileMemory::TileMemory() : kept(std::make_unique<Kept>()) {}
TileMemory::TileMemory(TileMemory&&) noexcept = default;
TileMemory& TileMemory::operator=(TileMemory&&) noexcept = default;
TileMemory::~TileMemory() = default;

struct TileSum::Work {
    const Scene& scene;
    timeseries::Columns columns;
    TileView view;
    SplatSource source;
    unsigned threads;
    std::uint64_t pairsAtOnce;
    TileMemory memory;
    SplatPoints& points = memory.kept->points;
    SplatList& list = memory.kept->list;
    std::vector<TileSpan>& spans = memory.kept->spans;
    std::vector<TileMemory::Bins>& bins = memory.kept->bins;
    TilePlane plane;

    Work(const Scene& drawn, const DrawList& draw, const View& of, Channels channels,
         std::size_t layer, std::span<const float> depth, unsigned shared, TileMemory kept,
         std::uint64_t most)
        : scene(drawn),
          columns(columnsOf(scene)),
          view(scene, of, channels, layer),
          source(scene, draw, channels, layer),
          threads(std::max(shared, 1u)),
          pairsAtOnce(most),
          memory(kept.kept ? std::move(kept) : TileMemory()),
          plane(view, depth, of.size.x, threads, memory.kept->plane, memory.kept->plane) {
        bins.resize(threads);
        points.point.clear();
        points.layer.clear();
    }

    void sum();
    void look(std::size_t first, std::size_t last);
    void sumPart(std::size_t first, std::size_t last, bool lastOfAll);
};

// Of these points: what of them is drawn, and where.
void TileSum::Work::look(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) list.index[i] = columns.gridIndex[points.point[i]];
    if (!list.tint.empty())
        std::visit(
            [&](auto values) {
                for (std::size_t i = first; i < last; ++i)
                    list.tint[i] =
                        tintPlace(view, points.layer[i], scene.layers[points.layer[i]].style,
                                  static_cast<double>(values[points.point[i]]));
            },
            columns.values);
    if (!scene.placed.isMesh()) return findTiles(view, list, first, last, spans);
    const std::size_t count = last - first;
    seeSplats(scene, view, std::span(list.index).subspan(first, count),
              std::span(list.seen).subspan(first, count), std::span(spans).subspan(first, count));
    std::iota(list.index.begin() + static_cast<std::ptrdiff_t>(first),
              list.index.begin() + static_cast<std::ptrdiff_t>(last),
              static_cast<std::uint32_t>(first));
}

void TileSum::Work::sumPart(std::size_t first, std::size_t last, bool lastOfAll) {
    const std::size_t count = last - first;
    const unsigned shared = threadsFor(count, kSplatsWorthAThread, threads);
    together(shared, [&](unsigned k) {
        bins[k].fill(view, list, spans, first + count * k / shared,
                     first + count * (k + 1) / shared);
    });
    const std::span<const TileMemory::Bins> filled = std::span(bins).first(shared);
    plane.sum(
        shared, lastOfAll,
        [&](std::size_t tile) {
            return std::ranges::any_of(filled, [&](const auto& some) { return some.holds(tile); });
        },
        [&](std::size_t tile, TileRoom& room) {
            for (const TileMemory::Bins& some : filled) some.sum(view, tile, room);
        });
}

// In parts of so many pairs of a splat and a tile that their number has a bound, however large
// the splats are.
void TileSum::Work::sum() {
    const std::size_t count = points.point.size();
    list.index.resize(count);
    list.tint.resize(view.channels == Channels::Weight ? 0 : count);
    spans.resize(count);
    if (scene.placed.isMesh()) {
        list.seen.resize(std::max(list.seen.size(), count));
        view.meshSplats = list.seen;
    }
    inParts(count, threadsFor(count, kSplatsWorthAThread, threads),
            [&](std::size_t first, std::size_t last) { look(first, last); });
    std::size_t first = 0;
    std::uint64_t pairs = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t more = std::uint64_t{spans[i].columns} * spans[i].rows;
        if (pairs > 0 && pairs + more > pairsAtOnce) {
            sumPart(first, i, false);
            first = i;
            pairs = 0;
        }
        pairs += more;
    }
    sumPart(first, count, source.done());
}

TileSum::TileSum(const Scene& scene, const DrawList& list, const View& view, Channels channels,
                 std::size_t layer, std::span<const float> opaqueDepth, unsigned threads,
                 TileMemory memory, std::uint64_t pairsAtOnce)
    : work_(new Work(scene, list, view, channels, layer, opaqueDepth, threads, std::move(memory),
                     pairsAtOnce)) {
    assert(canSum(scene, channels));
    if (done()) work_->sum();  // nothing, which also is to be written
}

TileSum::TileSum(TileSum&&) noexcept = default;
TileSum::~TileSum() = default;

bool TileSum::canSum(const PlacedPoints& placed, const Footprint& footprint) {
    const bool squares = footprint.kernel == Kernel::Point;
    return !placed.longCells() && !(placed.isMesh() && squares);
}

std::uint64_t TileSum::add(std::uint64_t splats) {
    std::uint64_t added = 0;
    while (!done() && added < splats) {
        work_->source.next(std::clamp(splats - added, kLeast, kAtOnce), work_->points);
        work_->sum();
        added += work_->points.point.size();
    }
    return added;
}

bool TileSum::done() const { return work_->source.done(); }
const PixelBox& TileSum::box() const { return work_->view.box; }
std::vector<float>& TileSum::plane() { return work_->memory.kept->plane; }
TileMemory TileSum::takeMemory() { return std::move(work_->memory); }

std::vector<float> sumTiles(const Scene& scene, const DrawList& list, const View& view,
                            Channels channels, std::size_t layer,
                            std::span<const float> opaqueDepth, unsigned threads) {
    TileSum sum(scene, list, view, channels, layer, opaqueDepth, threads);
    sum.add(std::numeric_limits<std::uint64_t>::max());
    const std::size_t floats = floatsPerPixel(channels);
    const auto width = static_cast<std::size_t>(view.size.x) * floats;
    std::vector<float> whole(width * static_cast<std::size_t>(view.size.y));
    const std::size_t row = static_cast<std::size_t>(sum.box().size.x) * floats;
    for (int y = 0; y < sum.box().size.y; ++y)
        std::copy_n(
            sum.plane().begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row),
            row,
            whole.begin() +
                static_cast<std::ptrdiff_t>(static_cast<std::size_t>(sum.box().at.y + y) * width +
                                            static_cast<std::size_t>(sum.box().at.x) * floats));
    return whole;
}

}  // namespace render

#include "render/splat/tile_splatter.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <numeric>
#include <utility>

#include "render/splat/splat_source.h"
#include "render/splat/tile_kernels.h"
#include "render/together.h"

namespace render {
namespace {

// Sorted into tiles at once: more would not make it faster.
constexpr std::uint64_t kAtOnce = 1 << 20;
// Less is done before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 11;

}  // namespace

// The splats that touch each tile, in the list's order: those of a part of the list, sorted by one
// thread.
class TileMemory::Bins {
 public:
    void fill(const TileView& view, const SplatList& list, std::span<const TileSpan> spans,
              std::size_t first, std::size_t last) {
        const auto tiles =
            static_cast<std::size_t>(view.tiles.x) * static_cast<std::size_t>(view.tiles.y);
        end_.assign(tiles + 1, 0);
        for (std::size_t i = first; i < last; ++i)
            forEachTile(spans[i], view.tiles.x, [&](std::uint32_t tile) { ++end_[tile + 1]; });
        std::partial_sum(end_.begin(), end_.end(), end_.begin());
        index_.resize(end_.back());
        tint_.resize(list.tint.empty() ? 0 : end_.back());
        // From each tile's beginning on; its end is then the beginning of the next.
        for (std::size_t i = first; i < last; ++i)
            forEachTile(spans[i], view.tiles.x, [&](std::uint32_t tile) {
                const std::uint32_t to = end_[tile]++;
                index_[to] = list.index[i];
                if (!tint_.empty()) tint_[to] = list.tint[i];
            });
    }
    bool holds(std::size_t tile) const { return end_[tile] > begin(tile); }
    void sum(const TileView& view, std::size_t tile, TileRoom& room) const {
        const std::uint32_t first = begin(tile), count = end_[tile] - first;
        const std::span<const float> tints(tint_);
        sumTile(view, std::span(index_).subspan(first, count),
                tints.empty() ? tints : tints.subspan(first, count), room);
    }

 private:
    std::uint32_t begin(std::size_t tile) const { return tile > 0 ? end_[tile - 1] : 0; }
    std::vector<std::uint32_t> end_, index_;
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
    std::span<const float> opaqueDepth;
    int pictureWidth;
    unsigned threads;
    std::uint64_t pairsAtOnce;
    std::size_t floats;
    TileMemory memory;
    std::vector<float>& plane = memory.kept->plane;
    SplatPoints& points = memory.kept->points;
    SplatList& list = memory.kept->list;
    std::vector<TileSpan>& spans = memory.kept->spans;
    std::vector<TileMemory::Bins>& bins = memory.kept->bins;
    std::vector<TileRoom> rooms;
    std::vector<std::uint8_t> begun;  // tiles

    Work(const Scene& drawn, const DrawList& draw, const View& of, Channels channels,
         std::size_t layer, std::span<const float> depth, unsigned shared, TileMemory kept,
         std::uint64_t most)
        : scene(drawn),
          columns(columnsOf(scene)),
          view(scene, of, channels, layer),
          source(scene, draw, channels, layer),
          opaqueDepth(depth),
          pictureWidth(of.size.x),
          threads(std::max(shared, 1u)),
          pairsAtOnce(most),
          floats(floatsPerPixel(channels)),
          memory(kept.kept ? std::move(kept) : TileMemory()),
          rooms(threads, TileRoom(view)),
          begun(static_cast<std::size_t>(view.tiles.x) * static_cast<std::size_t>(view.tiles.y)) {
        plane.resize(static_cast<std::size_t>(view.box.size.x) *
                     static_cast<std::size_t>(view.box.size.y) * floats);
        bins.resize(threads);
        points.point.clear();
        points.layer.clear();
    }

    void sum();
    void look(std::size_t first, std::size_t last);
    void sumPart(std::size_t first, std::size_t last, bool lastOfAll);
    void sumOne(std::size_t tile, std::span<const TileMemory::Bins> of, bool lastOfAll,
                TileRoom& room);
    void clear(std::size_t tile);
    void load(std::size_t tile, TileRoom& room);
    void store(TileRoom& room, bool lastOfAll);
    // The pixels of one of a tile's rows.
    float* rowOf(glm::ivec2 tileAt, int row) {
        return &plane[(static_cast<std::size_t>(tileAt.y + row) *
                           static_cast<std::size_t>(view.box.size.x) +
                       static_cast<std::size_t>(tileAt.x)) *
                      floats];
    }
    template <typename Visit>
    void forEachTile(unsigned shared, const Visit& visit) {
        std::atomic<std::size_t> next{0};
        together(shared, [&](unsigned k) {
            for (std::size_t tile; (tile = next++) < begun.size();) visit(tile, rooms[k]);
        });
    }
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
    findTiles(view, list, first, last, spans);
}

void TileSum::Work::clear(std::size_t tile) {
    const glm::ivec2 at = cornerOf(view, tile), size = glm::min(view.tile, view.box.size - at);
    for (int row = 0; row < size.y; ++row)
        std::fill_n(rowOf(at, row), static_cast<std::size_t>(size.x) * floats, 0.0f);
}

// Into sums channel by channel; of a tile that nothing has touched yet, none.
void TileSum::Work::load(std::size_t tile, TileRoom& room) {
    room.enter(view, tile, opaqueDepth, pictureWidth);
    if (!std::exchange(begun[tile], 1)) {
        std::ranges::fill(room.sums, 0.0f);
        return;
    }
    for (int row = 0; row < room.size.y; ++row) {
        const float* from = rowOf(room.at, row);
        for (int x = 0; x < room.size.x; ++x)
            for (std::size_t c = 0; c < floats; ++c)
                room.sums[c * room.plane + static_cast<std::size_t>(row * kTileStride + x)] =
                    *from++;
    }
}

void TileSum::Work::store(TileRoom& room, bool lastOfAll) {
    const bool over = view.channels == Channels::Over;
    for (int row = 0; row < room.size.y; ++row) {
        float* to = rowOf(room.at, row);
        for (int x = 0; x < room.size.x; ++x) {
            const auto at = static_cast<std::size_t>(row * kTileStride + x);
            const float factor = lastOfAll && !over ? room.factor[at] : 1;
            for (std::size_t c = 0; c < floats; ++c)
                to[c] = factor * room.sums[c * room.plane + at];
            to += floats;
        }
    }
}

void TileSum::Work::sumOne(std::size_t tile, std::span<const TileMemory::Bins> of, bool lastOfAll,
                           TileRoom& room) {
    const bool none =
        std::ranges::all_of(of, [&](const TileMemory::Bins& b) { return !b.holds(tile); });
    if (none && !lastOfAll) return;
    if (none && !begun[tile]) return clear(tile);
    load(tile, room);
    for (const TileMemory::Bins& b : of) b.sum(view, tile, room);
    store(room, lastOfAll);
}

void TileSum::Work::sumPart(std::size_t first, std::size_t last, bool lastOfAll) {
    const std::size_t count = last - first;
    const unsigned shared = threadsFor(count, kWorthAThread, threads);
    together(shared, [&](unsigned k) {
        bins[k].fill(view, list, spans, first + count * k / shared,
                     first + count * (k + 1) / shared);
    });
    const std::span<const TileMemory::Bins> filled = std::span(bins).first(shared);
    forEachTile(shared,
                [&](std::size_t tile, TileRoom& room) { sumOne(tile, filled, lastOfAll, room); });
}

// In parts of so many pairs of a splat and a tile that their number has a bound, however large
// the splats are.
void TileSum::Work::sum() {
    const std::size_t count = points.point.size();
    list.index.resize(count);
    list.tint.resize(view.channels == Channels::Weight ? 0 : count);
    spans.resize(count);
    inParts(count, threadsFor(count, kWorthAThread, threads),
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

bool TileSum::canSum(const Scene& scene, Channels channels) {
    return channels != Channels::Count && !scene.placed.longCells();
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
std::vector<float>& TileSum::plane() { return work_->plane; }
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

#include "render/tile_splatter.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <numeric>
#include <utility>

#include "render/tile_kernels.h"
#include "render/together.h"

namespace render {
namespace {

// Sorted into tiles at once: more would not make it faster.
constexpr std::uint64_t kAtOnce = 1 << 20;
// Less is done before another thread has begun.
constexpr std::size_t kWorthAThread = 1 << 11;

// The points of a plane in the order in which they are summed: of a sorted list the nearest first.
class SplatSource {
 public:
    SplatSource(const Scene& scene, const DrawList& list, const TileView& view, std::size_t layer)
        : scene_(scene),
          view_(view),
          columns_(columnsOf(scene)),
          sorted_(view.channels == Channels::Over ? &std::get<Sorted>(list) : nullptr),
          layer_(layer) {}

    bool done() const {
        return sorted_ ? passed_ == sorted_->point.size() : run_ == layer().runs.size();
    }
    void next(std::uint64_t atMost, SplatList& splats) {
        splats.index.clear();
        splats.tint.clear();
        std::visit(
            [&](auto values) {
                if (sorted_)
                    nextSorted(atMost, values, splats);
                else
                    nextOfRuns(atMost, values, splats);
            },
            columns_.values);
    }

 private:
    const Layer& layer() const { return scene_.layers[layer_]; }
    template <typename T>
    float tint(std::size_t layer, T value) const {
        return tintPlace(view_, layer, scene_.layers[layer].style, static_cast<double>(value));
    }
    template <typename T>
    void nextSorted(std::uint64_t atMost, std::span<const T> values, SplatList& splats) {
        const auto index = columns_.gridIndex;
        const std::uint64_t end = std::min(passed_ + atMost, std::uint64_t{sorted_->point.size()});
        for (; passed_ < end; ++passed_) {
            const std::size_t i = sorted_->point.size() - 1 - passed_;
            const std::uint32_t point = sorted_->point[i];
            splats.index.push_back(index[point]);
            splats.tint.push_back(tint(sorted_->layer[i], values[point]));
        }
    }
    template <typename T>
    void nextOfRuns(std::uint64_t atMost, std::span<const T> values, SplatList& splats) {
        const auto index = columns_.gridIndex;
        const bool tinted = view_.channels != Channels::Weight;
        const std::uint32_t stride = strideOf(layer(), scene_.stride);
        while (!done() && splats.index.size() < atMost) {
            const timeseries::Run& whole = layer().runs[run_];
            timeseries::Run part{whole.first + passed_, whole.count - passed_};
            part.count = std::min(part.count, (atMost - splats.index.size()) * stride);
            forEachInSubset(part, stride, [&](std::uint64_t point) {
                splats.index.push_back(index[point]);
                if (tinted) splats.tint.push_back(tint(layer_, values[point]));
            });
            passed_ += part.count;
            if (passed_ == whole.count) ++run_, passed_ = 0;
        }
    }

    const Scene& scene_;
    const TileView& view_;
    timeseries::Columns columns_;
    const Sorted* sorted_;
    std::size_t layer_;
    // What is next: of this run, or of the list, after so many of its points.
    std::size_t run_ = 0;
    std::uint64_t passed_ = 0;
};

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
    SplatList list;
    std::vector<TileSpan> spans;  // of the list
    std::vector<Bins> bins;
};

TileMemory::TileMemory() : kept(std::make_unique<Kept>()) {}
TileMemory::TileMemory(TileMemory&&) noexcept = default;
TileMemory& TileMemory::operator=(TileMemory&&) noexcept = default;
TileMemory::~TileMemory() = default;

struct TileSum::Work {
    TileView view;
    SplatSource source;
    std::span<const float> opaqueDepth;
    int pictureWidth;
    unsigned threads;
    std::uint64_t pairsAtOnce;
    std::size_t floats;
    TileMemory memory;
    std::vector<float>& plane = memory.kept->plane;
    SplatList& list = memory.kept->list;
    std::vector<TileSpan>& spans = memory.kept->spans;
    std::vector<TileMemory::Bins>& bins = memory.kept->bins;
    std::vector<TileRoom> rooms;
    std::vector<std::uint8_t> begun;  // tiles

    Work(const Scene& scene, const DrawList& draw, const View& of, Channels channels,
         std::size_t layer, std::span<const float> depth, unsigned shared, TileMemory kept,
         std::uint64_t most)
        : view(scene, of, channels, layer),
          source(scene, draw, view, layer),
          opaqueDepth(depth),
          pictureWidth(of.size.x),
          threads(std::max(shared, 1u)),
          pairsAtOnce(most),
          floats(channels == Channels::Weight ? 1 : 4),
          memory(kept.kept ? std::move(kept) : TileMemory()),
          rooms(threads, TileRoom(view)),
          begun(static_cast<std::size_t>(view.tiles.x) * static_cast<std::size_t>(view.tiles.y)) {
        plane.resize(static_cast<std::size_t>(view.box.size.x) *
                     static_cast<std::size_t>(view.box.size.y) * floats);
        bins.resize(threads);
        list.index.clear();
        list.tint.clear();
    }

    void sum();
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

void TileSum::Work::clear(std::size_t tile) {
    const glm::ivec2 at = cornerOf(view, tile), size = glm::min(view.tile, view.box.size - at);
    for (int row = 0; row < size.y; ++row)
        std::fill_n(rowOf(at, row), static_cast<std::size_t>(size.x) * floats, 0.0f);
}

// Into sums channel by channel; of a tile that nothing has touched yet, as they begin.
void TileSum::Work::load(std::size_t tile, TileRoom& room) {
    room.enter(view, tile, opaqueDepth, pictureWidth);
    if (!std::exchange(begun[tile], 1)) {
        std::ranges::fill(room.sums, 0.0f);
        if (view.channels == Channels::Over)
            std::fill_n(room.sums.begin() + static_cast<std::ptrdiff_t>(3 * room.plane), room.plane,
                        1.0f);
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
            if (lastOfAll && over) to[3] = 1 - to[3];
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
    const std::size_t count = list.index.size();
    spans.resize(count);
    inParts(
        count, threadsFor(count, kWorthAThread, threads),
        [&](std::size_t first, std::size_t last) { findTiles(view, list, first, last, spans); });
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
    return channels != Channels::Count && !scene.lattice.longCells();
}

std::uint64_t TileSum::add(std::uint64_t splats) {
    std::uint64_t added = 0;
    while (!done() && added < splats) {
        work_->source.next(std::clamp(splats - added, kLeast, kAtOnce), work_->list);
        work_->sum();
        added += work_->list.index.size();
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
    const std::size_t floats = channels == Channels::Weight ? 1 : 4;
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

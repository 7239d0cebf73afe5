#include "render/splat/tile_splatter.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "render/splat/depth_order.h"
#include "render/splat/distances.h"
#include "render/splat/seen_splats.h"
#include "render/splat/splat_source.h"
#include "render/splat/tile_chains.h"
#include "render/splat/tile_kernels.h"
#include "render/splat/tile_plane.h"
#include "render/together.h"

namespace render {
namespace {

// Less is done before another thread has begun.
constexpr std::size_t kSplatsWorthAThread = 1 << 11;

// A few splats that are looked at together, while they lie in the first-level cache.
struct Batch {
    static constexpr std::size_t kMost = 512;
    std::array<std::uint32_t, kMost> index, key;
    std::array<float, kMost> tint;
    std::array<TileSpan, kMost> spans;
};

// The splats of one tile, in the order in which they are summed. What one thread makes it in.
struct InTile {
    std::vector<std::uint32_t> words, index;
    std::vector<float> tint;
    std::vector<std::uint64_t> keyed;
    std::unique_ptr<hwy::Sorter> sorter;  // made once, for it begins with random numbers
};

// What a splat is in a tile: its index; its tint, where the plane has colours; and its key, where
// the tile is to be put in order, beside a word that makes the entry whole.
enum class Entry : std::size_t { Index = 1, Tinted = 2, Keyed = 4 };

void takeApart(InTile& here) {
    const std::size_t count = here.words.size() / 2;
    here.index.resize(count);
    here.tint.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        here.index[i] = here.words[2 * i];
        here.tint[i] = std::bit_cast<float>(here.words[2 * i + 1]);
    }
}

// The nearest first; of equally near ones the last of the list, as that is drawn from its end.
void putInOrder(InTile& here) {
    const std::size_t count = here.words.size() / 4;
    here.keyed.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        here.keyed[i] = std::uint64_t{here.words[4 * i + 2]} << 32 | i;
    if (!here.sorter) here.sorter = std::make_unique<hwy::Sorter>();
    (*here.sorter)(here.keyed.data(), count, hwy::SortDescending());
    here.index.resize(count);
    here.tint.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t* const from =
            &here.words[4 * static_cast<std::uint32_t>(here.keyed[i])];
        here.index[i] = from[0];
        here.tint[i] = std::bit_cast<float>(from[1]);
    }
}

}  // namespace

struct TileMemory::Kept {
    PlanePixels plane;
    SplatPoints points;
    SeenSplats seen;  // of these points
    // One a thread.
    std::vector<TileChains> chains;
    std::vector<InTile> inTile;
};

TileMemory::TileMemory() : kept(std::make_unique<Kept>()) {}
TileMemory::TileMemory(TileMemory&&) noexcept = default;
TileMemory& TileMemory::operator=(TileMemory&&) noexcept = default;
TileMemory::~TileMemory() = default;

struct TileSum::Work {
    const Scene& scene;
    timeseries::Columns columns;
    TileView view;
    // Of a list that is to be put in order here, as long as that is done in each tile alone.
    std::optional<glm::dvec3> midEye;
    std::optional<Distances> distances;
    DepthKeys keys{};
    DrawList ordered;  // where the tiles have no room for all
    std::optional<SplatSource> source;
    Entry entry;
    unsigned threads;
    std::uint64_t pairsAtOnce;
    TileMemory memory;
    TileMemory::Kept& kept = *memory.kept;
    TilePlane plane;

    Work(const Scene& drawn, const DrawList& draw, const View& of, Channels channels,
         std::size_t layer, std::span<const float> depth, unsigned shared, TileMemory before,
         std::uint64_t most)
        : scene(drawn),
          columns(columnsOf(scene)),
          view(scene, of, channels, layer),
          entry(floatsPerPixel(channels) == 1 ? Entry::Index : Entry::Tinted),
          threads(std::max(shared, 1u)),
          pairsAtOnce(most),
          memory(before.kept ? std::move(before) : TileMemory()),
          plane(view, depth, of.size.x, threads, kept.plane, kept.plane) {
        kept.chains.resize(threads);
        kept.inTile.resize(threads);
        const auto* const later = std::get_if<SortWhenDrawn>(&draw);
        if (!later || channels != Channels::Over) {
            source.emplace(scene, draw, channels, layer);
            return;
        }
        entry = Entry::Keyed;
        midEye = later->midEye;
        keys = depthKeysOf(scene, *midEye);
        distances.emplace(scene, *midEye);
        source.emplace(scene);
    }

    bool ordersInTiles() const { return entry == Entry::Keyed; }
    std::uint64_t next(std::uint64_t splats);
    void sum();
    void look(std::size_t first, std::size_t count, Batch& batch);
    template <Entry kEntry>
    std::size_t bin(std::size_t first, std::size_t last, std::uint64_t pairs, TileChains& chains);
    std::size_t binAll(std::size_t first, unsigned shared);
    void sumTiles(std::span<const TileChains> chains, bool lastOfAll);
};

// What of these points is drawn, and where.
void TileSum::Work::look(std::size_t first, std::size_t count, Batch& batch) {
    const std::span point = std::span(kept.points.point).subspan(first, count);
    const std::span layer = std::span(kept.points.layer).subspan(first, count);
    for (std::size_t i = 0; i < count; ++i) batch.index[i] = columns.gridIndex[point[i]];
    if (entry != Entry::Index)
        std::visit(
            [&](auto values) {
                for (std::size_t i = 0; i < count; ++i)
                    batch.tint[i] = tintPlace(view, layer[i], scene.layers[layer[i]].style,
                                              static_cast<double>(values[point[i]]));
            },
            columns.values);
    const auto index = std::span(batch.index).first(count);
    const auto spans = std::span(batch.spans).first(count);
    if (entry == Entry::Keyed) {
        std::array<double, Batch::kMost> away;
        std::span<const timeseries::Mesh::Point> stored;
        if (scene.placed.isMesh()) stored = kept.seen.pointsOf(first, index);
        distances->find(index, std::span(away).first(count), stored);
        for (std::size_t i = 0; i < count; ++i) batch.key[i] = keys.of(std::max(away[i], 0.0));
    }
    kept.seen.see(scene, view, first, index, spans);
}

// Into the tiles that they touch, until there are more than so many pairs. Returns where it ended,
// which is after the first at least.
template <Entry kEntry>
std::size_t TileSum::Work::bin(std::size_t first, std::size_t last, std::uint64_t pairs,
                               TileChains& chains) {
    Batch batch;
    std::uint64_t put = 0;
    while (first < last) {
        const std::size_t count = std::min(Batch::kMost, last - first);
        look(first, count, batch);
        for (std::size_t i = 0; i < count; ++i) {
            std::array<std::uint32_t, static_cast<std::size_t>(kEntry)> words{batch.index[i]};
            if constexpr (kEntry != Entry::Index)
                words[1] = std::bit_cast<std::uint32_t>(batch.tint[i]);
            if constexpr (kEntry == Entry::Keyed) words[2] = batch.key[i];
            const TileSpan& span = batch.spans[i];
            put += std::uint64_t{span.columns} * span.rows;
            forEachTile(span, view.tiles.x, [&](std::uint32_t tile) { chains.put(tile, words); });
            if (put > pairs) return first + i + 1;
        }
        first += count;
    }
    return first;
}

// All of the points from `first` on for which there is room, by so many threads. Returns where they
// end: where a thread had no room left, others' later points are done anew.
std::size_t TileSum::Work::binAll(std::size_t first, unsigned shared) {
    const std::size_t count = kept.points.point.size() - first;
    std::vector<std::size_t> ends(shared);
    const auto endOf = [&](unsigned k) { return first + count * (k + 1) / shared; };
    together(shared, [&](unsigned k) {
        kept.chains[k].clear(view.count(), TileSum::kPairs);
        const std::size_t from = k > 0 ? endOf(k - 1) : first;
        const auto into = [&](auto form) {
            ends[k] =
                bin<decltype(form)::value>(from, endOf(k), pairsAtOnce / shared, kept.chains[k]);
        };
        switch (entry) {
            case Entry::Index:
                return into(std::integral_constant<Entry, Entry::Index>());
            case Entry::Tinted:
                return into(std::integral_constant<Entry, Entry::Tinted>());
            case Entry::Keyed:
                return into(std::integral_constant<Entry, Entry::Keyed>());
        }
    });
    for (unsigned k = 0; k + 1 < shared; ++k) {
        if (ends[k] == endOf(k)) continue;
        for (unsigned later = k + 1; later < shared; ++later)
            kept.chains[later].clear(view.count(), TileSum::kPairs);
        return ends[k];
    }
    return ends.back();
}

void TileSum::Work::sumTiles(std::span<const TileChains> chains, bool lastOfAll) {
    plane.sum(
        static_cast<unsigned>(chains.size()), lastOfAll,
        [&](std::size_t tile) {
            return std::ranges::any_of(chains, [&](const auto& some) { return some.holds(tile); });
        },
        [&](unsigned thread, std::size_t tile, TileRoom& room) {
            InTile& here = kept.inTile[thread];
            here.words.clear();
            for (const TileChains& some : chains) some.append(tile, here.words);
            if (entry == Entry::Index) return sumTile(view, here.words, {}, room);
            entry == Entry::Tinted ? takeApart(here) : putInOrder(here);
            sumTile(view, here.index, here.tint, room);
        });
}

// The points that are next. In parts of so many pairs of a splat and a tile that their number has a
// bound, however large the splats are.
void TileSum::Work::sum() {
    const std::size_t count = kept.points.point.size();
    const unsigned shared = threadsFor(count, kSplatsWorthAThread, threads);
    kept.seen.begin(scene, view, count);
    for (std::size_t first = 0;;) {
        first = binAll(first, shared);
        const bool isAll = first == count && source->done();
        if (ordersInTiles() && !isAll) {  // before, then
            ordered = order(scene, *midEye);
            source.emplace(scene, ordered, view.channels, 0);
            entry = Entry::Tinted;
            kept.points.point.clear();
            return;
        }
        sumTiles(std::span(kept.chains).first(shared), isAll);
        if (first == count) return;
    }
}

// Adds so many, or what is worth a call. Returns how many.
std::uint64_t TileSum::Work::next(std::uint64_t splats) {
    source->next(ordersInTiles() ? kOrderedAtOnce : std::clamp(splats, kLeast, kAtOnce),
                 kept.points);
    sum();
    return kept.points.point.size();
}

TileSum::TileSum(const Scene& scene, const DrawList& list, const View& view, Channels channels,
                 std::size_t layer, std::span<const float> opaqueDepth, unsigned threads,
                 TileMemory memory, std::uint64_t pairsAtOnce)
    : work_(new Work(scene, list, view, channels, layer, opaqueDepth, threads, std::move(memory),
                     pairsAtOnce)) {
    if (!done()) return;
    work_->kept.points.point.clear();
    work_->sum();  // nothing, which also is to be written
}

TileSum::TileSum(TileSum&&) noexcept = default;
TileSum::~TileSum() = default;

std::uint64_t TileSum::add(std::uint64_t splats) {
    std::uint64_t added = 0;
    while (!done() && added < splats) added += work_->next(splats - added);
    return added;
}

bool TileSum::done() const { return work_->source->done(); }
const PixelBox& TileSum::box() const { return work_->view.box; }
PlanePixels& TileSum::plane() { return work_->kept.plane; }
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

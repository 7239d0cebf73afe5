// What a cell adds to the pixels of a tile. Compiled once for each of Highway's targets, so not
// guarded as other headers are.
#if defined(RENDER_CELL_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_CELL_PIXELS_INL_H_
#undef RENDER_CELL_PIXELS_INL_H_
#else
#define RENDER_CELL_PIXELS_INL_H_
#endif

#include <array>

#include "render/splat/cell_rays-inl.h"
#include "render/splat/tile_room.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Blocks of pixels that cells are seen in, worked out together: what each of them waits for, the
// others fill.
template <class Lanes>
struct SeenBlocks {
    static constexpr std::size_t kMost = 16;
    using Row = float[hn::MaxLanes(Lanes())];
    struct Block {
        alignas(64) Row middle[3], along[3], length, depth;  // of RayParts
        alignas(64) Row value, change, values[kPieces + 1], width, perWidth;
        alignas(64) Row weight, front, back, diffuse, specular;
        const SeenCell* cell;
        const CellSlopes* slopes;  // where light falls on them
        std::size_t at;
    };
    Block all[kMost];
    std::size_t count = 0;
    // Those of cells that cross so many ends of their range.
    struct Crossing {
        std::uint8_t places[kMost];
        std::size_t count = 0;
    };
    std::array<Crossing, 3> crossing;
};

// Where rays are inside: full blocks are passed to use().
template <class Lanes, class Use>
HWY_INLINE void meetCell(Lanes lanes, const CellView& view, const SeenCell& c,
                         const CellSlopes* slopes, const TileRoom& room, SeenBlocks<Lanes>& blocks,
                         const Use& use) {
    using V = hn::Vec<Lanes>;
    constexpr PixelBlock<Lanes, kTileStride> pixels;
    constexpr int kColumns = static_cast<int>(pixels.kColumns);
    constexpr int kRows = static_cast<int>(pixels.kRows);
    const glm::ivec2 least = glm::max(glm::ivec2(c.x, c.y), room.at);
    const glm::ivec2 most =
        glm::min(glm::ivec2(c.x + c.columns(), c.y + c.rows()), room.at + room.size);
    const MeetLanes<Lanes> cell(lanes, view, c);
    const bool hides = room.nearestOpaque < 1;
    const std::size_t ends = std::size_t{c.crossesLeast()} + std::size_t{c.crossesMost()};
    const V stepsX = pixels.columns(lanes), stepsY = pixels.rows(lanes);
    for (int x = least.x; x < most.x; x += kColumns) {
        const V ox = hn::Add(hn::Set(lanes, c.ox + static_cast<float>(x - c.x)), stepsX);
        for (int y = least.y; y < most.y; y += kRows) {
            const auto at = static_cast<std::size_t>((y - room.at.y) * kTileStride + x - room.at.x);
            const V oy = hn::Add(hn::Set(lanes, c.oy + static_cast<float>(y - c.y)), stepsY);
            V to = hn::Set(lanes, 3e38f);
            if (hides) {
                const V opaque = pixels.load(lanes, room.opaque.data() + at);
                to = hn::Sub(
                    hn::Div(hn::Set(lanes, static_cast<float>(view.depthA)),
                            hn::Sub(opaque, hn::Set(lanes, static_cast<float>(view.depthB)))),
                    cell.base);
            }
            RayParts<Lanes> r;
            cell.meet(ox, oy, to, r);
            auto& block = blocks.all[blocks.count];
            for (std::size_t a = 0; a < 3; ++a) {
                hn::Store(r.middle[a], lanes, block.middle[a]);
                hn::Store(r.along[a], lanes, block.along[a]);
            }
            hn::Store(r.length, lanes, block.length);
            hn::Store(r.depth, lanes, block.depth);
            block.cell = &c;
            block.slopes = slopes;
            block.at = at;
            // Whether any ray is inside nobody foresees: no branch asks.
            const bool some = !hn::AllFalse(lanes, hn::Gt(r.length, hn::Zero(lanes)));
            auto& alike = blocks.crossing[ends];
            alike.places[alike.count] = static_cast<std::uint8_t>(blocks.count);
            blocks.count += some;
            alike.count += some;
            if (blocks.count == blocks.kMost) use();
        }
    }
}

template <class Lanes>
HWY_INLINE RayParts<Lanes> raysOf(Lanes lanes, const typename SeenBlocks<Lanes>::Block& block) {
    RayParts<Lanes> r;
    for (std::size_t a = 0; a < 3; ++a) {
        r.middle[a] = hn::Load(lanes, block.middle[a]);
        r.along[a] = hn::Load(lanes, block.along[a]);
    }
    r.length = hn::Load(lanes, block.length);
    r.depth = hn::Load(lanes, block.depth);
    return r;
}

// The field along a block's rays.
template <bool kCrossed, bool kLit, class Lanes>
HWY_INLINE void followField(Lanes lanes, const CellView& view,
                            typename SeenBlocks<Lanes>::Block& block) {
    const SeenCell& c = *block.cell;
    RayParts<Lanes> r = raysOf(lanes, block);
    const CellLanes<Lanes> cell(lanes, view, c);
    cell.lookHalfWay(r);
    hn::Vec<Lanes> values[kPieces + 1];
    cell.follow(r, values);
    for (std::size_t k = 0; k <= kPieces; ++k) hn::Store(values[k], lanes, block.values[k]);
    hn::Store(r.value, lanes, block.value);
    if constexpr (kCrossed) hn::Store(cell.acrossPixel2(r), lanes, block.width);
    if constexpr (kCrossed && kLit) hn::Store(cell.dot(r.gradient, r.along), lanes, block.change);
}

// Its light, where its rays meet the range.
template <Lit kLit, class Lanes>
HWY_INLINE void light(Lanes lanes, const CellView& view, const TileRoom& room,
                      typename SeenBlocks<Lanes>::Block& block) {
    constexpr PixelBlock<Lanes, kTileStride> pixels;
    const SeenCell& c = *block.cell;
    const LightLanes<Lanes> lit(lanes, view, c.steep, c.perSize);
    RayParts<Lanes> r = raysOf(lanes, block);
    hn::Vec<Lanes> gradient[3], diffuse, specular;
    const auto factor = pixels.load(lanes, room.factor.data() + block.at);
    const auto place = hn::Add(
        r.depth, inRange(lanes, c, hn::Load(lanes, block.value), hn::Load(lanes, block.change),
                         r.length, hn::Mul(hn::Load(lanes, block.weight), factor)));
    for (std::size_t a = 0; a < 3; ++a) r.middle[a] = hn::MulAdd(place, r.along[a], r.middle[a]);
    const auto change = slopesAt(lanes, *block.slopes, r, gradient);
    lit.template shade<kLit>(gradient, change, r.along, factor, diffuse, specular);
    hn::Store(diffuse, lanes, block.diffuse);
    hn::Store(specular, lanes, block.specular);
}

// What of a block's rays lies in the range, and which values are seen.
template <Channels kChannels, bool kByValue, int kEnds, class Lanes>
HWY_INLINE void takeRange(Lanes lanes, const CellView& view, const TileRoom& room, float scale,
                          typename SeenBlocks<Lanes>::Block& block) {
    using V = hn::Vec<Lanes>;
    constexpr PixelBlock<Lanes, kTileStride> pixels;
    constexpr bool kCrossed = kEnds > 0;
    const SeenCell& c = *block.cell;
    const V zero = hn::Zero(lanes);
    const V length = hn::Load(lanes, block.length);
    V t = hn::Mul(hn::Set(lanes, view.weight * scale), length);
    const float* const factors = room.factor.data() + block.at;
    if constexpr (kCrossed || kByValue) {
        V values[kPieces + 1], whole = t;
        for (std::size_t k = 0; k <= kPieces; ++k) values[k] = hn::Load(lanes, block.values[k]);
        V mean = kCrossed ? zero : hn::Load(lanes, block.value),
          low = hn::Min(values[0], values[kPieces]), high = hn::Max(values[0], values[kPieces]);
        if constexpr (kCrossed) {
            const RangeLanes<Lanes, kEnds> range(lanes, c);
            V crossing;
            const V width = hn::Load(lanes, block.width);
            const V perWidth = hn::Load(lanes, block.perWidth);
            // As if along the view axis: the ray's own length is a factor later.
            if (c.perRange > 0) {
                crossing = hn::Mul(hn::Set(lanes, scale * c.perRange),
                                   reciprocal(lanes, pixels.load(lanes, factors)));
                whole =
                    hn::Max(whole, hn::Mul(crossing, hn::Abs(hn::Sub(values[kPieces], values[0]))));
            }
            t = range.template sum<kByValue>(values, width, perWidth, t,
                                             c.perRange > 0 ? &crossing : nullptr, mean, low, high);
        }
        if constexpr (kByValue) {
            const V half = hn::Min(hn::Sub(mean, low), hn::Sub(high, mean));
            const V along = hn::Sub(values[kPieces], values[0]);
            const V toBack = hn::CopySign(hn::Max(half, zero), along);
            const V front = hn::Sub(mean, toBack);
            V back = hn::Add(mean, toBack);
            if constexpr (kChannels == Channels::Over) {
                const V factor = pixels.load(lanes, factors);
                back =
                    seenTo(lanes, front, back, hn::Mul(t, factor), hn::Mul(whole, factor), along);
            }
            hn::Store(front, lanes, block.front);
            hn::Store(back, lanes, block.back);
        }
    }
    hn::Store(hn::IfThenElseZero(hn::Gt(length, zero), t), lanes, block.weight);
}

// Adds them to their pixels, in their order, and leaves none.
template <Channels kChannels, bool kByValue, Lit kLit, class Lanes>
HWY_INLINE void addBlocks(Lanes lanes, const CellView& view, TileRoom& room,
                          SeenBlocks<Lanes>& blocks) {
    using V = hn::Vec<Lanes>;
    constexpr bool kColors = kChannels == Channels::WeightedColor || kChannels == Channels::Over;
    const auto scaleOf = [&](const SeenCell& c) {
        return kColors ? view.tints[static_cast<std::size_t>(c.firstTint)][3] : 1.0f;
    };
    const auto look = [&]<int kEnds>() HWY_ATTR {
        const auto& [places, count] = blocks.crossing[kEnds];
        if constexpr (kEnds > 0 || kByValue)
            for (std::size_t k = 0; k < count; ++k)
                followField<(kEnds > 0), kLit != Lit::No>(lanes, view, blocks.all[places[k]]);
        if constexpr (kEnds > 0)
            for (std::size_t k = 0; k < count; ++k) {
                auto& block = blocks.all[places[k]];
                const V width2 = hn::Load(lanes, block.width);
                const V perWidth = reciprocalRoot(lanes, width2);
                hn::Store(perWidth, lanes, block.perWidth);
                hn::Store(hn::Mul(width2, perWidth), lanes, block.width);
            }
        for (std::size_t k = 0; k < count; ++k) {
            auto& block = blocks.all[places[k]];
            takeRange<kChannels, kByValue, kEnds>(lanes, view, room, scaleOf(*block.cell), block);
        }
    };
    look.template operator()<0>();
    look.template operator()<1>();
    look.template operator()<2>();
    // A ray passes many cells that reach into the range elsewhere.
    const auto isSeen = [&](const auto& block) HWY_ATTR {
        return !hn::AllFalse(lanes, hn::Gt(hn::Load(lanes, block.weight), hn::Zero(lanes)));
    };
    if constexpr (kLit != Lit::No)
        for (std::size_t k = 0; k < blocks.count; ++k)
            if (isSeen(blocks.all[k])) light<kLit>(lanes, view, room, blocks.all[k]);
    for (std::size_t k = 0; k < blocks.count; ++k) {
        const auto& block = blocks.all[k];
        const V weight = hn::Load(lanes, block.weight);
        if (!isSeen(block)) continue;
        addWeight<kChannels>(PixelBlock<Lanes, kTileStride>(), lanes, weight, room, block.at,
                             [&](V* colors) HWY_ATTR {
                                 if constexpr (kColors) {
                                     const ColorLanes<kByValue, Lanes> color(lanes, view,
                                                                             *block.cell);
                                     V front = hn::Zero(lanes), back = front;
                                     if constexpr (kByValue) {
                                         front = hn::Load(lanes, block.front);
                                         back = hn::Load(lanes, block.back);
                                     }
                                     color.between(front, back, colors);
                                 }
                                 if constexpr (kLit != Lit::No) {
                                     const V diffuse = hn::Load(lanes, block.diffuse);
                                     const V specular = hn::Load(lanes, block.specular);
                                     for (int i = 0; i < 3; ++i)
                                         colors[i] = hn::MulAdd(colors[i], diffuse, specular);
                                 }
                             });
    }
    blocks.count = 0;
    for (auto& each : blocks.crossing) each.count = 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif

#include "render/splat/cell_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/cell_kernels.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/cell_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <Channels kChannels, bool kByValue, Lit kLit>
HWY_INLINE void addCells(const CellView& view, std::span<const SeenCell> cells,
                         std::span<const CellSlopes> slopes, std::span<const std::uint32_t> which,
                         TileRoom& room) {
    SeenBlocks<Floats> blocks;
    const auto add = [&]() HWY_ATTR {
        addBlocks<kChannels, kByValue, kLit>(Floats(), view, room, blocks);
    };
    for (std::size_t i = 0; i < which.size(); ++i) {
        if (kChannels == Channels::Over && i % kBetweenLooks == 0 && room.isClosed()) return;
        const std::uint32_t ahead = which[std::min(i + kAhead, which.size() - 1)];
        prefetch(cells[ahead]);
        if (kLit != Lit::No) prefetch(slopes[ahead]);
        const CellSlopes* const lit = kLit == Lit::No ? nullptr : &slopes[which[i]];
        meetCell(Floats(), view, cells[which[i]], lit, room, blocks, add);
    }
    add();
}

HWY_ATTR void SumCells(const CellView& view, std::span<const SeenCell> cells,
                       std::span<const CellSlopes> slopes, std::span<const std::uint32_t> which,
                       TileRoom& room) {
    const auto add = [&]<Channels kChannels, Lit kLit = Lit::No>() HWY_ATTR {
        if (view.byValue)
            addCells<kChannels, true, kLit>(view, cells, slopes, which, room);
        else
            addCells<kChannels, false, kLit>(view, cells, slopes, which, room);
    };
    switch (view.channels) {
        case Channels::Weight:
            return addCells<Channels::Weight, false, Lit::No>(view, cells, slopes, which, room);
        case Channels::Count:
            return addCells<Channels::Count, false, Lit::No>(view, cells, slopes, which, room);
        case Channels::WeightedColor:
            return add.template operator()<Channels::WeightedColor>();
        case Channels::Over:
            break;
    }
    if (view.light == Light::Off) return add.template operator()<Channels::Over>();
    if (!view.lamp) return add.template operator()<Channels::Over, Lit::FromEye>();
    add.template operator()<Channels::Over, Lit::FromLamp>();
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(SumCells);

void sumCells(const CellView& view, std::span<const SeenCell> cells,
              std::span<const CellSlopes> slopes, std::span<const std::uint32_t> which,
              TileRoom& room) {
    HWY_DYNAMIC_DISPATCH(SumCells)(view, cells, slopes, which, room);
}
}  // namespace render
#endif

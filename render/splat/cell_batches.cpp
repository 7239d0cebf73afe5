#include "render/splat/cell_batches.h"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace render {

CellBatches::CellBatches(const Scene& scene) : scene_(scene), indices_(scene.cells->size()) {
    constexpr std::size_t kTogether = 8;
    if (scene.light != Light::Off && !scene.placed.isMesh()) slopes_.emplace(scene);
    if (scene.placed.isMesh() || !scene.clip.holdsAll() || !scene.cells->field().missing.empty())
        return;
    std::size_t ranges = 1;
    for (const Layer& layer : scene.layers) ranges = std::max(ranges, layer.cells.ranges.size());
    most_ = kTogether * ranges;
    if (most_ > PieceBatch::kMost) return;
    together_ = kTogether;
    const glm::uvec3 points = scene.placed.size();
    std::uint32_t step = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t count = points[static_cast<int>(a)];
        for (std::uint32_t i = 0; i <= count; ++i) {
            const auto [from, to] = endsAlong(scene.placed, a, i);
            sides_[a].push_back(
                {from, to, (i > 0 ? i - 1 : 0) * step, std::min(i, count - 1) * step});
        }
        step *= count;
    }
}

// Adds none and says so where a corner has no value.
template <typename T>
bool CellBatches::addWhole(std::span<const T> values, std::span<const CellOfLayer> cells,
                           std::span<const CellOfLayer> later, PieceBatch& pieces) const {
    std::size_t to = pieces.count;
    double none = 0;  // of values that are none
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i < later.size()) prefetch(values, later[i].cell);
        const CellOfLayer& of = cells[i];
        const glm::uvec3 at = indices_(of.cell);
        const Side &x = sides_[0][at.x], &y = sides_[1][at.y], &z = sides_[2][at.z];
        const std::array rows{values.data() + (y.low + z.low), values.data() + (y.high + z.low),
                              values.data() + (y.low + z.high), values.data() + (y.high + z.high)};
        for (const auto& range : scene_.layers[of.layer].cells.ranges) {
            for (std::size_t a = 0; a < 3; ++a) {
                const Side& side = a == 0 ? x : a == 1 ? y : z;
                pieces.from[a][to] = side.from;
                pieces.to[a][to] = side.to;
            }
            for (std::size_t r = 0; r < 4; ++r) {
                const double low = static_cast<double>(rows[r][x.low]);
                const double high = static_cast<double>(rows[r][x.high]);
                pieces.corners[2 * r][to] = low;
                pieces.corners[2 * r + 1][to] = high;
                if constexpr (std::is_floating_point_v<T>) none += (low - low) + (high - high);
            }
            pieces.lo[to] = range.lo;
            pieces.hi[to] = range.hi;
            pieces.layer[to] = of.layer;
            pieces.octant[to] = kWholeCell;
            pieces.cell[to++] = of.cell;
        }
    }
    if (!(none == 0)) return false;
    pieces.count = to;
    return true;
}

template <typename T>
void CellBatches::prefetch(std::span<const T> values, std::uint32_t cell) const {
    const glm::uvec3 at = indices_(cell);
    const std::uint32_t x = sides_[0][at.x].low;
    const Side &y = sides_[1][at.y], &z = sides_[2][at.z];
    for (const std::uint32_t row : {y.low + z.low, y.high + z.low, y.low + z.high, y.high + z.high})
        __builtin_prefetch(values.data() + (row + x));
}

void CellBatches::forEach(std::span<const CellOfLayer> cells, PieceBatch& pieces,
                          const std::function<void()>& use) const {
    const auto addAny = [&](std::span<const CellOfLayer> some) {
        forEachPiece(scene_, some,
                     [&](const ValuedCell& piece, const CellOfLayer& of, unsigned octant) {
                         pieces.add(piece, of, octant);
                         if (pieces.isFull()) use();
                     });
    };
    if (together_ == 0) {
        addAny(cells);
        return use();
    }
    constexpr std::size_t kAhead = 32;
    std::visit(
        [&]<typename Values>(const Values& all) {
            const std::span values(all);
            for (std::size_t i = 0; i < cells.size(); i += together_) {
                const std::span some = cells.subspan(i, std::min(together_, cells.size() - i));
                const std::span later = cells.subspan(std::min(i + kAhead, cells.size()));
                if (pieces.count + most_ > PieceBatch::kMost) use();
                if (!addWhole(values, some, later, pieces)) addAny(some);
            }
        },
        scene_.cells->field().values);
    use();
}

}  // namespace render

#include "render/splat/gl_cells.h"

#include <algorithm>
#include <glm/vec2.hpp>

#include "render/splat/cell_view.h"
#include "render/together.h"

namespace render {
namespace {

constexpr std::size_t kEyes = 2;
constexpr std::size_t kGlCellsWorthAThread = 1 << 10;

// In double: floats have no difference of places that are near.
std::vector<glm::vec2> sidesOf(const Scene& scene) {
    std::vector<glm::vec2> sides;
    const glm::uvec3 size = scene.cells->size();
    for (int a = 0; a < 3; ++a)
        for (std::uint32_t i = 0; i < size[a]; ++i) {
            const auto [from, to] = endsAlong(scene.placed, static_cast<std::size_t>(a), i);
            sides.emplace_back(0.5 * from + 0.5 * to, to - from);
        }
    return sides;
}

// What cells depend on beside the field. Places along axes say how the grid is placed.
std::vector<double> choicesOf(const Scene& scene) {
    std::vector<double> choices{static_cast<double>(scene.opacityPer),
                                scene.light == Light::Off ? 0.0 : 1.0, scene.placed.unitLength()};
    for (int a = 0; a < 3; ++a) {
        choices.push_back(scene.clip.lo[a]);
        choices.push_back(scene.clip.hi[a]);
    }
    for (const Layer& layer : scene.layers) {
        const auto* map = std::get_if<ByValue>(&layer.style.color);
        choices.insert(choices.end(), {map ? 1.0 : 0.0, map ? map->lo : 0, map ? map->hi : 0,
                                       static_cast<double>(layer.cells.ranges.size())});
        for (const auto& range : layer.cells.ranges)
            choices.insert(choices.end(), {range.lo, range.hi});
    }
    for (const std::vector<double>& along : scene.placed.positions())
        choices.insert(choices.end(), along.begin(), along.end());
    return choices;
}

// Whether a cell may be parted into octants.
bool mayPart(const Scene& scene) {
    const IndexBox whole;
    return scene.step.finite().count < scene.step.grid().count() || scene.clip.lo != whole.lo ||
           scene.clip.hi != whole.hi;
}

GlCell glCell(const CellSplat<float>& s, const CellOfLayer& of, unsigned octant,
              const RangeStyle& style, double steep) {
    GlCell c{};
    c.cell = of.cell;
    c.kind = octant | static_cast<std::uint32_t>(s.crossesLeast) << 4 |
             static_cast<std::uint32_t>(s.crossesMost) << 5 | std::uint32_t{of.layer} << 8;
    c.least = s.least;
    c.most = s.most;
    c.perRange = s.perRange;
    c.steep = steepnessIn(s.extent, steep);
    std::ranges::copy(s.f, c.f);
    if (const auto* map = std::get_if<ByValue>(&style.color)) {
        const CellMapPlace place = mapPlaceOf(*map, s.reference, s.extent);
        c.mapPlace = floatPlace(place.at);
        c.mapPerValue = floatPlace(place.perValue);
    }
    return c;
}

}  // namespace

bool GlCells::fit(const Scene& scene, std::uint64_t bytes) {
    std::uint64_t most = 0;
    for (const Layer& layer : scene.layers)
        most += cellCount(layer) * std::max<std::size_t>(layer.cells.ranges.size(), 1);
    return most * (mayPart(scene) ? 8 : 1) * sizeof(GlCell) <= bytes;
}

GlCells::GlCells(const Scene& scene)
    : index_(scene.cells),
      choices_(choicesOf(scene)),
      sides_(std::span<const glm::vec2>(sidesOf(scene))),
      sidesTexture_(GL_RG32F, sides_) {
    const std::vector<CellOfLayer> all = cellsOf(scene, Channels::Over, 0);
    const double steep = steepnessOf(scene);
    const unsigned shared = threadsFor(all.size(), kGlCellsWorthAThread, sharingThreads());
    std::vector<std::vector<GlCell>> parts(shared);
    sharing(shared, [&](unsigned k) {
        const std::size_t first = all.size() * k / shared, last = all.size() * (k + 1) / shared;
        forEachPiece(
            scene, std::span(all).subspan(first, last - first),
            [&](const ValuedCell& piece, const CellOfLayer& of, unsigned octant) {
                CellSplat<float> s;
                if (cell::seeField(s, piece, scene.placed.unitLength()))
                    parts[k].push_back(glCell(s, of, octant, scene.layers[of.layer].style, steep));
            });
    });
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    pieces_ = std::make_unique<gl::Buffer>(count * sizeof(GlCell));
    cells_.reserve(count);
    firsts_.assign(scene.layers.size() + 1, 0);
    for (const auto& part : parts) {
        pieces_->write(cells_.size() * sizeof(GlCell), part.size() * sizeof(GlCell), part.data());
        for (const GlCell& piece : part) {
            cells_.push_back(timeseries::indicesOf(piece.cell, scene.cells->size()));
            ++firsts_[(piece.kind >> 8) + 1];
        }
    }
    for (std::size_t k = 1; k < firsts_.size(); ++k) firsts_[k] += firsts_[k - 1];
}

bool GlCells::areOf(const Scene& scene) const {
    return index_.lock() == scene.cells && choices_ == choicesOf(scene);
}

std::uint64_t GlCells::bytes() const {
    std::uint64_t sum = pieces_->bytes() + sides_.bytes();
    for (const Ordered& ordered : ordered_) sum += ordered.places->bytes();
    return sum;
}

std::pair<std::uint32_t, std::uint32_t> GlCells::placesOf(Channels channels,
                                                          std::size_t layer) const {
    const auto [first, last] = layersOf(firsts_.size() - 1, channels, layer);
    return {firsts_[first], firsts_[last]};
}

std::shared_ptr<const gl::Buffer> GlCells::farthestFirst(const CellRank& rank) {
    const auto found = std::ranges::find(ordered_, rank.eye(), &Ordered::eye);
    if (found != ordered_.end()) return found->places;
    NearestFirst order(rank);
    for (const glm::uvec3& cell : cells_) order.count(rank(cell));
    order.allCounted();
    std::vector<std::uint32_t> places(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i)
        places[cells_.size() - 1 - order.place(rank(cells_[i]))] = static_cast<std::uint32_t>(i);
    if (ordered_.size() == kEyes) ordered_.erase(ordered_.begin());
    ordered_.push_back(
        {rank.eye(), std::make_shared<const gl::Buffer>(std::span<const std::uint32_t>(places))});
    return ordered_.back().places;
}

}  // namespace render

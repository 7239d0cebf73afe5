#include "render/splat/gl_pieces.h"

#include <algorithm>

#include "render/splat/cell_view.h"
#include "render/splat/gl_cells.h"
#include "render/splat/gl_tets.h"

namespace render {
namespace {

constexpr std::size_t kEyes = 2;

// What pieces depend on beside the field. Places along axes say how an upright grid is placed.
std::vector<double> choicesOf(const Scene& scene) {
    const glm::dvec3 scale = scene.placed.scale();
    std::vector<double> choices{static_cast<double>(scene.opacityPer),
                                scene.light == Light::Off ? 0.0 : 1.0,
                                scene.placed.unitLength(),
                                scale.x,
                                scale.y,
                                scale.z};
    for (int a = 0; a < 3; ++a) {
        choices.insert(choices.end(), {double(scene.clip.lo[a]), double(scene.clip.hi[a]),
                                       scene.clip.from[a], scene.clip.to[a]});
    }
    for (const Layer& layer : scene.layers) {
        const auto* map = std::get_if<ByValue>(&layer.style.color);
        choices.insert(choices.end(), {map ? 1.0 : 0.0, map ? map->lo : 0, map ? map->hi : 0,
                                       static_cast<double>(layer.cells.ranges.size())});
        for (const auto& range : layer.cells.ranges)
            choices.insert(choices.end(), {range.lo, range.hi});
    }
    if (scene.placed.isMesh()) return choices;
    for (const std::vector<double>& along : scene.placed.positions())
        choices.insert(choices.end(), along.begin(), along.end());
    return choices;
}

}  // namespace

std::shared_ptr<GlPieces> GlPieces::begin(const Scene& scene, std::uint64_t mostBytes,
                                          GlCellLister& lister) {
    if (scene.placed.isMesh()) return std::make_shared<GlTets>(scene, mostBytes);
    return std::make_shared<GlCells>(scene, mostBytes, lister);
}

std::uint64_t GlPieces::bytesOf(const Scene& scene) {
    std::uint64_t pieces = 0;
    for (const Layer& layer : scene.layers)
        pieces += cellCount(layer) * std::max<std::size_t>(layer.cells.ranges.size(), 1);
    if (!scene.placed.isMesh()) return pieces * GlCells::bytesOfOne(scene);
    return static_cast<std::uint64_t>(static_cast<double>(pieces) * GlTets::perCell(scene)) *
           sizeof(GlTet);
}

GlPieces::GlPieces(const Scene& scene)
    : index_(scene.cells),
      mesh_(scene.placed.mesh()),
      gradients_(scene.gradients),
      choices_(choicesOf(scene)) {}

void GlPieces::take(std::unique_ptr<gl::Buffer> pieces, std::vector<std::uint32_t> firsts) {
    pieces_ = std::move(pieces);
    firsts_ = std::move(firsts);
}

bool GlPieces::areOf(const Scene& scene) const {
    return index_.lock() == scene.cells && mesh_.lock() == scene.placed.mesh() &&
           gradients_.lock() == scene.gradients && choices_ == choicesOf(scene);
}

std::uint64_t GlPieces::bytes() const {
    std::uint64_t sum = pieces_ ? pieces_->bytes() : 0;
    for (const Ordered& ordered : ordered_) sum += ordered.places->bytes();
    return sum;
}

std::pair<std::uint32_t, std::uint32_t> GlPieces::placesOf(Channels channels,
                                                           std::size_t layer) const {
    const auto [first, last] = layersOf(firsts_.size() - 1, channels, layer);
    return {firsts_[first], firsts_[last]};
}

std::shared_ptr<const gl::Buffer> GlPieces::farthestFirst(const Scene& scene, const View& view,
                                                          GlPieceOrder& by) {
    const glm::dvec3 key = keyOf(scene, view);
    const auto found = std::ranges::find_if(ordered_, [&](const Ordered& of) {
        return of.key == key && of.byMiddles == scene.byMiddles;
    });
    if (found != ordered_.end()) return found->places;
    if (ordered_.size() == kEyes) ordered_.erase(ordered_.begin());
    ordered_.push_back({key, scene.byMiddles, order(scene, view, by)});
    return ordered_.back().places;
}

GlMapPlace glMapPlaceOf(const RangeStyle& style, const cell::ColoredField& field) {
    const auto* map = std::get_if<ByValue>(&style.color);
    if (map == nullptr) return {};
    const CellMapPlace place = mapPlaceOf(*map, field);
    return {floatPlace(place.at), floatPlace(place.perValue)};
}

}  // namespace render

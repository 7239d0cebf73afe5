#include "render/splat/processor_splatter.h"

#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "render/model/rays_across.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/cell_splatter.h"
#include "render/splat/mixed_splatter.h"

namespace render {
namespace {

// What of a part of a picture lies in another is added there.
void addPart(const PlanePixels& part, const PixelBox& at, std::size_t floats, PlanePixels& into,
             const PixelBox& whole) {
    const glm::ivec2 lo = glm::max(at.at, whole.at);
    const glm::ivec2 hi = glm::min(at.at + at.size, whole.at + whole.size);
    const auto place = [&](const PixelBox& box, int y) {
        return floats *
               (static_cast<std::size_t>(y - box.at.y) * static_cast<std::size_t>(box.size.x) +
                static_cast<std::size_t>(lo.x - box.at.x));
    };
    for (int y = lo.y; y < hi.y; ++y)
        for (std::size_t i = 0; lo.x < hi.x && i < floats * static_cast<std::size_t>(hi.x - lo.x);
             ++i)
            into[place(whole, y) + i] += part[place(at, y) + i];
}

template <typename Sum, typename Memory>
class Plane final : public PlaneSum {
 public:
    // `into`: the part of the picture that its plane is to have, which holds the sum's.
    Plane(Sum sum, Channels channels, std::size_t plane, const std::optional<PixelBox>& into,
          Targets& targets, Memory& memory)
        : sum_(std::move(sum)),
          channels_(channels),
          plane_(plane),
          into_(into),
          targets_(targets),
          memory_(memory) {
        if (sum_.done()) write();
    }
    ~Plane() override { memory_ = sum_.takeMemory(); }
    Plane(const Plane&) = delete;
    Plane& operator=(const Plane&) = delete;
    std::uint64_t add(std::uint64_t splats) override {
        const std::uint64_t added = sum_.add(splats);
        if (sum_.done() && added > 0) write();
        return added;
    }
    bool done() const override { return sum_.done(); }

 private:
    void write() {
        if (!into_ || *into_ == sum_.box())
            return targets_.putPlane(plane_, channels_, sum_.box(), sum_.plane());
        PlanePixels pixels(floatsPerPixel(channels_) * static_cast<std::size_t>(into_->size.x) *
                           static_cast<std::size_t>(into_->size.y));
        addPart(sum_.plane(), sum_.box(), floatsPerPixel(channels_), pixels, *into_);
        targets_.putPlane(plane_, channels_, *into_, pixels);
    }

    Sum sum_;
    Channels channels_;
    std::size_t plane_;
    std::optional<PixelBox> into_;
    Targets& targets_;
    Memory& memory_;
};

// What two planes of the same channels add up to.
template <typename First, typename Second>
class BothPlanes final : public PlaneSum {
 public:
    BothPlanes(First first, Second second, glm::ivec2 size, Channels channels, std::size_t plane,
               Targets& targets)
        : first_(std::move(first)),
          second_(std::move(second)),
          size_(size),
          channels_(channels),
          plane_(plane),
          targets_(targets) {
        if (done()) write();
    }
    std::uint64_t add(std::uint64_t splats) override {
        const std::uint64_t added = first_.done() ? second_.add(splats) : first_.add(splats);
        if (done() && added > 0) write();
        return added;
    }
    bool done() const override { return first_.done() && second_.done(); }

 private:
    void write() {
        const std::size_t floats = floatsPerPixel(channels_);
        const PixelBox picture{{0, 0}, size_};
        PlanePixels whole(floats * static_cast<std::size_t>(size_.x) *
                          static_cast<std::size_t>(size_.y));
        addPart(first_.plane(), first_.box(), floats, whole, picture);
        addPart(second_.plane(), second_.box(), floats, whole, picture);
        targets_.putPlane(plane_, channels_, picture, whole);
    }

    First first_;
    Second second_;
    glm::ivec2 size_;
    Channels channels_;
    std::size_t plane_;
    Targets& targets_;
};

class ProcessorFrame final : public SplatFrame {
 public:
    ProcessorFrame(const Scene& scene, DrawList list, ProcessorSplatter::Memory& memory)
        : scene_(scene),
          points_(mixesModels(scene) ? std::optional(onlyPoints(scene)) : std::nullopt),
          list_(std::move(list)),
          memory_(memory) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        if (points_) return splatsOfBoth(channels, layer);
        if (scene_.cells) return cellCount(scene_, channels, layer);
        if (const auto* sorted = std::get_if<Sorted>(&list_)) return sorted->point.size();
        if (channels == Channels::Over) return splatCount(scene_);
        return splatCount(scene_.layers[layer], scene_.stride);
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        if (layer == 0) opaqueDepth_ = targets.opaqueDepth(memory_.opaqueDepth);
        // All planes of an eye cover the same part of the picture.
        const auto into = points_ ? std::optional(coveredPixels(scene_, view)) : std::nullopt;
        const auto plane = [&](auto sum, auto& memory) {
            return std::make_unique<Plane<decltype(sum), std::decay_t<decltype(memory)>>>(
                std::move(sum), channels, layer, into, targets, memory);
        };
        const auto cells = [&] {
            return CellSum(scene_, view, channels, layer, opaqueDepth_, raysAcross(scene_, view),
                           sharingThreads(), std::move(memory_.cells));
        };
        const auto points = [&](const Scene& scene) {
            return TileSum(scene, list_, view, channels, layer, opaqueDepth_, sharingThreads(),
                           std::move(memory_.tiles));
        };
        if (points_ && channels == Channels::Over)
            return plane(MixedSum(scene_, view, opaqueDepth_, raysAcross(scene_, view),
                                  sharingThreads(), std::move(memory_.mixed)),
                         memory_.mixed);
        if (points_ && channels == Channels::Count)
            return std::make_unique<BothPlanes<CellSum, TileSum>>(
                cells(), points(*points_), view.size, channels, layer, targets);
        const Scene& scene = points_ && scene_.layers[layer].byPoints ? *points_ : scene_;
        if (scene.cells) return plane(cells(), memory_.cells);
        return plane(points(scene), memory_.tiles);
    }

 private:
    std::uint64_t splatsOfBoth(Channels channels, std::size_t layer) const {
        const auto [first, last] = layersOf(scene_.layers.size(), channels, layer);
        std::uint64_t count = 0;
        for (std::size_t k = first; k < last; ++k) count += drawnCount(scene_, scene_.layers[k]);
        return count;
    }

    const Scene& scene_;
    const std::optional<Scene> points_;  // of one that has cells beside them
    const DrawList list_;
    ProcessorSplatter::Memory& memory_;
    std::span<const float> opaqueDepth_;
};

}  // namespace

bool ProcessorSplatter::sortsWhenDrawn(const Scene& scene) {
    return scene.order != Order::None && !scene.cells &&
           splatCount(scene) <= TileSum::kOrderedAtOnce;
}

std::unique_ptr<SplatFrame> ProcessorSplatter::prepare(const Scene& scene, DrawList list,
                                                       const GlStep&) {
    return std::make_unique<ProcessorFrame>(scene, std::move(list), memory_);
}

}  // namespace render

#include "render/reference/exact_splatter.h"

#include <algorithm>
#include <utility>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_cells.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/splat_source.h"

namespace render {
namespace {

// A plane of one layer is that of a scene that has no other.
Scene sceneOf(const Scene& scene, Channels channels, std::size_t layer) {
    Scene own = scene;
    if (channels == Channels::Weight || channels == Channels::WeightedColor)
        own.layers = {scene.layers[layer]};
    return own;
}

class Plane final : public PlaneSum {
 public:
    Plane(const Scene& scene, const DrawList& list, const View& view, Channels channels,
          std::size_t plane, Targets& targets)
        : scene_(sceneOf(scene, channels, plane)),
          sorted_(std::get_if<Sorted>(&list)),
          runs_(scene_),
          view_(view),
          channels_(channels),
          plane_(plane),
          targets_(targets),
          opaqueDepth_(targets.opaqueDepth(room_)),
          sums_(view.size, {channels}) {
        if (done()) write();
    }

    std::uint64_t add(std::uint64_t splats) override {
        std::uint64_t added = 0;
        while (!done() && added < splats) {
            Sorted some = next(std::clamp<std::uint64_t>(splats - added, kLeast, kAtOnce));
            added += some.point.size();
            splat(scene_, std::move(some), view_, opaqueDepth_, sums_);
        }
        if (done() && added > 0) write();
        return added;
    }
    bool done() const override {
        return channels_ == Channels::Over ? passed_ == sorted_->point.size() : runs_.done();
    }

 private:
    static constexpr std::uint64_t kLeast = 1 << 10, kAtOnce = 1 << 16;

    Sorted next(std::uint64_t atMost) {
        if (channels_ != Channels::Over) {
            SplatPoints some;
            runs_.next(atMost, some);
            return {std::move(some.point), std::move(some.layer)};
        }
        const auto from = static_cast<std::ptrdiff_t>(passed_);
        passed_ += std::min(atMost, sorted_->point.size() - passed_);
        const auto to = static_cast<std::ptrdiff_t>(passed_);
        return {{sorted_->point.begin() + from, sorted_->point.begin() + to},
                {sorted_->layer.begin() + from, sorted_->layer.begin() + to}};
    }
    void write() {
        PlanePixels pixels(sums_.planes[0].begin(), sums_.planes[0].end());
        targets_.putPlane(plane_, channels_, {{0, 0}, view_.size}, pixels);
    }

    const Scene scene_;
    const Sorted* sorted_;
    SplatSource runs_;
    const View& view_;
    Channels channels_;
    std::size_t plane_;
    Targets& targets_;
    std::vector<float> room_;
    std::span<const float> opaqueDepth_;
    Accumulator<double> sums_;
    std::uint64_t passed_ = 0;  // of the sorted list, the farthest first
};

class ExactFrame final : public SplatFrame {
 public:
    ExactFrame(const Scene& scene, DrawList list) : scene_(scene), list_(std::move(list)) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        if (scene_.cells) return cellCount(scene_, channels, layer);
        if (const auto* sorted = std::get_if<Sorted>(&list_)) return sorted->point.size();
        return splatCount(scene_.layers[layer], scene_.stride);
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        if (scene_.cells) return exactCellPlane(scene_, view, channels, layer, targets);
        return std::make_unique<Plane>(scene_, list_, view, channels, layer, targets);
    }

 private:
    const Scene& scene_;
    const DrawList list_;
};

}  // namespace

std::unique_ptr<SplatFrame> ExactSplatter::prepare(const Scene& scene, DrawList list,
                                                   const GlStep&) {
    return std::make_unique<ExactFrame>(scene, std::move(list));
}

}  // namespace render

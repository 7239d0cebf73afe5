#include "render/reference/exact_cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/reference/interval_truth.h"
#include "render/reference/opaque_depths.h"
#include "render/reference/parts_on_rays.h"
#include "render/splat/cell_pieces.h"

namespace render {
namespace {

PlanePixels floatsOf(const std::vector<glm::dvec4>& pixels) {
    PlanePixels floats(4 * pixels.size());
    for (std::size_t i = 0; i < floats.size(); ++i)
        floats[i] = static_cast<float>(pixels[i / 4][static_cast<int>(i % 4)]);
    return floats;
}

// A plane of one layer is that of a scene that has no other; its optical depth is W, whatever its
// opacity.
Scene onlyLayer(const Scene& scene, std::size_t layer) {
    Scene own = scene;
    own.layers = {scene.layers[layer]};
    own.layers[0].style.opacity = -std::expm1(-1.0);
    own.light = Light::Off;
    return own;
}

PlanePixels counts(const Scene& scene, const View& view, const OpaqueDepths& opaque) {
    constexpr std::size_t kAtOnce = 1 << 16;  // pixels, whose parts are kept meanwhile
    std::vector<glm::ivec2> all;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) all.emplace_back(x, y);
    PlanePixels plane(all.size());
    for (std::size_t first = 0; first < all.size(); first += kAtOnce) {
        const auto some = std::span(all).subspan(first, std::min(kAtOnce, all.size() - first));
        std::vector<std::vector<PartInLayer>> parts(some.size());
        addPartsOnRays(scene, scene.cells->field(), view, some, sharingThreads(), parts);
        for (std::size_t i = 0; i < some.size(); ++i) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> passed;
            for (const PartInLayer& each : parts[i])
                if (each.part.from < opaque.at(some[i])) passed.emplace_back(each.layer, each.cell);
            std::ranges::sort(passed);
            const auto again = std::unique(passed.begin(), passed.end());
            plane[first + i] = static_cast<float>(again - passed.begin());
        }
    }
    return plane;
}

class RayPlane final : public PlaneSum {
 public:
    RayPlane(const Scene& scene, const View& view, Channels channels, std::size_t layer,
             Targets& targets)
        : scene_(scene), view_(view), channels_(channels), layer_(layer), targets_(targets) {}

    std::uint64_t add(std::uint64_t) override {
        if (done_) return 0;
        done_ = true;
        std::vector<float> room;
        const OpaqueDepths opaque(view_, targets_.opaqueDepth(room));
        PlanePixels pixels = pixelsBefore(opaque);
        targets_.putPlane(layer_, channels_, {{0, 0}, view_.size}, pixels);
        return cellCount(scene_, channels_, layer_);
    }
    bool done() const override { return done_; }

 private:
    PlanePixels pixelsBefore(const OpaqueDepths& opaque) const {
        if (channels_ == Channels::Count) return counts(scene_, view_, opaque);
        const bool isOver = channels_ == Channels::Over;
        const Scene own = isOver ? scene_ : onlyLayer(scene_, layer_);
        IntervalTruth truth(own, scene_.cells->field(), kExactRays);
        truth.endAt(opaque);
        if (isOver) return floatsOf(truth.light(view_));
        if (channels_ == Channels::WeightedColor) return floatsOf(truth.sums(view_));
        const std::vector<double> weight = truth.weight(view_, 0);
        return {weight.begin(), weight.end()};
    }

    const Scene& scene_;
    const View& view_;
    Channels channels_;
    std::size_t layer_;
    Targets& targets_;
    bool done_ = false;
};

}  // namespace

std::unique_ptr<PlaneSum> exactCellPlane(const Scene& scene, const View& view, Channels channels,
                                         std::size_t layer, Targets& targets) {
    return std::make_unique<RayPlane>(scene, view, channels, layer, targets);
}

}  // namespace render

#include "app/drawing/gl_steps.h"

#include <algorithm>

namespace app {

GlSteps::Held::Held(const std::shared_ptr<const timeseries::SortedStep>& of,
                    const std::optional<glm::dvec3>& stretch, std::shared_ptr<render::GlMesh> mesh)
    : sorted(of),
      scale(stretch),
      placed(of->grid(), stretch),
      onGpu(*of, placed, std::move(mesh)) {}

void GlSteps::Held::stretch(const std::optional<glm::dvec3>& by) {
    if (scale == by) return;
    scale = by;
    placed = render::PlacedPoints(sorted.lock()->grid(), by);
    onGpu.place(placed);
}

GlSteps::Held& GlSteps::use(const std::shared_ptr<const timeseries::SortedStep>& sorted,
                            const std::optional<glm::dvec3>& scale) {
    const auto found =
        std::ranges::find_if(held_, [&](const Held& held) { return held.sorted.lock() == sorted; });
    if (found == held_.end()) {
        const auto& mesh = sorted->grid().mesh();
        const auto like = std::ranges::find_if(
            held_, [&](const Held& held) { return mesh && held.placed.mesh() == mesh; });
        held_.emplace_front(sorted, scale, like == held_.end() ? nullptr : like->onGpu.mesh());
    } else {
        held_.splice(held_.begin(), held_, found);
    }
    held_.front().stretch(scale);
    return held_.front();
}

void GlSteps::trim(std::uint64_t budgetBytes, const Held* drawn, const Held* coming) {
    std::uint64_t kept = 0;
    held_.remove_if([&](const Held& held) {
        if (&held == drawn || &held == coming) return false;
        // A step read again is another object: this one will never be asked for.
        if (held.sorted.expired()) return true;
        kept += held.onGpu.bytes();
        return kept > budgetBytes;
    });
}

std::uint64_t GlSteps::bytes() const {
    std::uint64_t sum = 0;
    for (const Held& held : held_) sum += held.onGpu.bytes();
    return sum;
}

}  // namespace app

#include "app/drawing/gl_steps.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace app {

GlSteps::Held::Held(const std::shared_ptr<const timeseries::SortedStep>& of, const Places& at,
                    render::PlacedPoints points, std::shared_ptr<render::GlMesh> mesh)
    : sorted(of), places(at), placed(std::move(points)), onGpu(*of, placed, std::move(mesh)) {}

bool GlSteps::Held::place(const Places& at) {
    if (places == at) return true;
    // Another globe is another mesh.
    if (places.map != at.map || at.map == render::Map::Globe) return false;
    places = at;
    placed = render::PlacedPoints(sorted.lock()->grid(), at.scale, at.map);
    onGpu.place(placed);
    return true;
}

GlSteps::Held& GlSteps::use(const std::shared_ptr<const timeseries::SortedStep>& sorted,
                            const Places& at) {
    const auto found = std::ranges::find_if(
        held_, [&](Held& held) { return held.sorted.lock() == sorted && held.place(at); });
    if (found != held_.end()) {
        held_.splice(held_.begin(), held_, found);
        return held_.front();
    }
    render::PlacedPoints placed(sorted->grid(), at.scale, at.map);
    const auto like = std::ranges::find_if(held_, [&](const Held& held) {
        return placed.isMesh() && held.placed.mesh() == placed.mesh();
    });
    held_.emplace_front(sorted, at, std::move(placed),
                        like == held_.end() ? nullptr : like->onGpu.mesh());
    return held_.front();
}

render::Outline GlSteps::outline(const std::shared_ptr<const timeseries::SortedStep>& sorted,
                                 const Places& at) const {
    const auto found = std::ranges::find_if(
        held_, [&](const Held& held) { return held.sorted.lock() == sorted && held.places == at; });
    if (found != held_.end()) return found->placed.outline();
    return render::PlacedPoints::outlineOf(sorted->grid(), at.scale, at.map);
}

void GlSteps::trim(std::uint64_t budgetBytes, const Held* drawn, const Held* coming) {
    std::uint64_t kept = 0;
    std::vector<const timeseries::SortedStep*> placedSince;
    held_.remove_if([&](const Held& held) {
        const timeseries::SortedStep* const sorted = held.sorted.lock().get();
        const bool isElsewhere = std::ranges::count(placedSince, sorted) > 0;
        placedSince.push_back(sorted);
        if (&held == drawn || &held == coming) return false;
        // A step read again is another object: this one will never be asked for.
        if (sorted == nullptr || isElsewhere) return true;
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

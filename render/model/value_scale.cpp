#include "render/model/value_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

ValueScale ValueScale::of(const std::vector<Layer>& layers) {
    ValueScale narrowest;
    for (const Layer& layer : layers) {
        const auto* map = std::get_if<ByValue>(&layer.style.color);
        if (map == nullptr) continue;
        const double halfWidth = map->halfWidth();
        if (halfWidth > 0 && (narrowest.halfWidth == 0 || halfWidth < narrowest.halfWidth))
            narrowest = {map->lo, halfWidth};
    }
    return narrowest;
}

float ValueScale::operator()(double value) const {
    if (halfWidth == 0) return 0;
    constexpr double kMost = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(placeOnScale(value, lo, halfWidth), -kMost, kMost));
}

bool ValueScale::serves(const ValueScale& wanted) const {
    // A float's error of 2^-24 grows by how far the two are apart and how much they differ in
    // width, in widths of the wanted one.
    constexpr double kMostWidths = 1024;
    if (!(wanted.halfWidth > 0)) return true;
    return halfWidth > 0 &&
           halfWidth / wanted.halfWidth + std::abs(0.5 * lo - 0.5 * wanted.lo) / wanted.halfWidth <=
               kMostWidths;
}

std::optional<ValueScale> neededScale(const Scene& scene) {
    const auto byValue = [](const Layer& layer) {
        return std::holds_alternative<ByValue>(layer.style.color);
    };
    if (std::ranges::none_of(scene.layers, byValue)) return {};
    return ValueScale::of(scene.layers);
}

}  // namespace render

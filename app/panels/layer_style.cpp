#include "app/panels/layer_style.h"

#include "render/image/color.h"

namespace app::panels {
namespace {

ImU32 encoded(const glm::vec3& linear, float alpha = 1) {
    return fromSrgb({render::srgbFromLinear(static_cast<double>(linear.x)),
                     render::srgbFromLinear(static_cast<double>(linear.y)),
                     render::srgbFromLinear(static_cast<double>(linear.z))},
                    alpha);
}

}  // namespace

ImU32 colorAt(const LayerChoice& layer, double value, float alpha) {
    if (!layer.color) return faded(kDim, alpha);
    if (const auto* srgb = std::get_if<glm::dvec3>(&*layer.color)) return fromSrgb(*srgb, alpha);
    const render::ByValue map = byValue(std::get<MapChoice>(*layer.color));
    return encoded(map.map.at(render::mapPosition(map, value)), alpha);
}

ImU32 colorOf(const LayerChoice& layer, float alpha) {
    if (layer.color)
        if (const auto* choice = std::get_if<MapChoice>(&*layer.color))
            return encoded(choice->map.at(0.65), alpha);
    return colorAt(layer, 0, alpha);
}

void drawMap(ImDrawList& list, const Rect& at, const render::ColorMap& map) {
    constexpr int kParts = 24;
    const float width = at.size().x / kParts;
    for (int i = 0; i < kParts; ++i) {
        const ImU32 a = encoded(map.at(i / static_cast<double>(kParts))),
                    b = encoded(map.at((i + 1) / static_cast<double>(kParts)));
        const float x = at.min.x + width * static_cast<float>(i);
        list.AddRectFilledMultiColor({x, at.min.y}, {x + width, at.max.y}, a, b, b, a);
    }
}

void drawSwatch(ImDrawList& list, const Rect& at, const LayerChoice& layer, float scale) {
    if (layer.color) {
        if (const auto* choice = std::get_if<MapChoice>(&*layer.color)) {
            drawMap(list, at, byValue(*choice).map);
            return;
        }
    }
    list.AddRectFilled(im(at.min), im(at.max), colorOf(layer), 4 * scale);
}

}  // namespace app::panels

#include "render/splat/tile_layout.h"

namespace render {
View finer(View view, int raysAcross) {
    view.size *= raysAcross;
    return view;
}

TileLayout::TileLayout(const Scene& scene, const View& view, const PointsView& seen, Channels of,
                       int across)
    : channels(of),
      raysAcross(across),
      pixels(coveredPixels(scene, view)),
      box{pixels.at * across, pixels.size * across} {
    // Sums and tables of a tile stay in the first-level cache. Its pixels have all of their rays.
    tile = {kTileWidth, floatsPerPixel(channels) == 1 ? 48 : 32};
    tile -= tile % across;
    tiles = (box.size + tile - 1) / tile;
    const PixelRays& rays = seen.rays;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto at = static_cast<int>(k);
        focal[k] = rays.focal[at];
        centre[k] = rays.centre[at] - box.at[at];
        slope2[k] = static_cast<float>(1 / (focal[k] * focal[k]));
    }
    near = static_cast<float>(rays.near);
    depthA = view.clipFromView[3][2];
    depthB = -view.clipFromView[2][2];
    axis = floats(rays.axis);
    perPixelX = floats(rays.perPixelX);
    perPixelY = floats(rays.perPixelY);
    if (floatsPerPixel(channels) > 1) takeTints(scene);
}

void TileLayout::takeTints(const Scene& scene) {
    for (const Layer& layer : scene.layers) {
        const RangeStyle& style = layer.style;
        double factor = isByCells(scene, layer) ? 1 : pointsPerSplat(layer, scene.stride);
        if (channels == Channels::Over) factor *= opticalDepthPerWeight(style.opacity);
        const auto add = [&](const glm::vec3& c) {
            tints.push_back({c.x, c.y, c.z, static_cast<float>(factor)});
        };
        const std::size_t first = tints.size();
        if (const auto* one = std::get_if<Constant>(&style.color)) {
            add(glm::vec3(one->linearRgb));
            add(glm::vec3(one->linearRgb));
        } else {
            for (const glm::vec3& entry : std::get<ByValue>(style.color).map.entries()) add(entry);
        }
        tintsOf.push_back(
            {static_cast<float>(first), static_cast<float>(tints.size() - 1 - first)});
        std::vector<glm::vec3> colors;
        for (std::size_t i = first; i < tints.size(); ++i)
            colors.emplace_back(tints[i][0], tints[i][1], tints[i][2]);
        for (const glm::vec3& sum : sumsOf(colors)) tintSums.push_back({sum.x, sum.y, sum.z, 0});
    }
}

}  // namespace render

#include "render/row_splatter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "render/footprint.h"

namespace render {
namespace {

// A splat in the picture.
struct Placed {
    Splat<float> splat;
    float windowDepth = 0;
    PixelSpan x, y;
    glm::vec4 color{1};  // what the four channels take for each W
};

// A layer as a view sees it.
class SeenLayer {
 public:
    SeenLayer(const Scene& scene, const View& view, Channels channels, std::size_t layer)
        : scene_(scene),
          view_(view),
          style_(scene.layers[layer].style),
          colored_(channels == Channels::WeightedColor),
          seen_(scene.lattice, view),
          perSplat_(pointsPerSplat(scene.layers[layer], scene.stride) * seen_.rayLength),
          axis_(seen_.rays.centre),
          slope2_(1.0 / (seen_.rays.focal * seen_.rays.focal)) {}

    // Spans no pixels when it is not drawn.
    Placed place(std::uint64_t point) const;
    // W of the splat's pixels in row y, 0 where the opaque scene hides it; its first pixel's first.
    void weigh(const Placed& placed, int y, const float* opaqueRow, float* weights) const;

 private:
    const Scene& scene_;
    const View& view_;
    const RangeStyle& style_;
    bool colored_;
    LatticeView seen_;
    double perSplat_;   // points that a splat stands for, times the length of the view axis' ray
    glm::vec2 axis_;    // window position of the view axis
    glm::vec2 slope2_;  // squares of x / -z and y / -z per pixel
};

Placed SeenLayer::place(std::uint64_t point) const {
    Placed placed;
    const std::uint32_t i = scene_.step.gridIndex()[point];
    const glm::uvec3 n = scene_.lattice.size();
    if (!scene_.clip.holds({i % n.x, i / n.x % n.y, i / n.x / n.y})) return placed;
    Splat<float>& s = placed.splat;
    s = splatAt<float>(seen_, scene_.lattice.position(i), scene_.lattice.cell(i), scene_.footprint);
    if (!s.visible) return placed;
    s.weight *= static_cast<float>(perSplat_);
    placed.windowDepth = static_cast<float>(windowDepth(view_, static_cast<double>(s.depth)));
    if (placed.windowDepth > 1) return placed;  // beyond the far plane
    const glm::vec2 window = axis_ + s.centre;
    placed.x = pixelSpan(window.x, s.extent, scene_.footprint.kernel, view_.size.x);
    placed.y = pixelSpan(window.y, s.extent, scene_.footprint.kernel, view_.size.y);
    if (colored_)
        placed.color = glm::vec4(
            glm::vec3(colorOf(style_, timeseries::toDouble(scene_.step.value(point)))), 1);
    return placed;
}

void SeenLayer::weigh(const Placed& placed, int y, const float* opaqueRow, float* weights) const {
    const Splat<float>& s = placed.splat;
    const float atY = static_cast<float>(y) + 0.5f - axis_.y;
    const float oy = atY - s.centre.y;
    // The quadratic forms of the row, in x alone. Those of a point splat give q = 0 and d = 1.
    const float n0 = s.n.z * oy * oy, n1 = s.n.y * oy, n2 = s.n.x;
    const float d0 = 1 + s.l.y * oy + s.d.z * oy * oy, d1 = s.l.x + s.d.y * oy, d2 = s.d.x;
    const float ray0 = 1 + slope2_.y * atY * atY, ray2 = slope2_.x;
    const float left = static_cast<float>(placed.x.first) + 0.5f - axis_.x;
    const float centre = s.centre.x, weight = s.weight, depth = placed.windowDepth;
    opaqueRow += placed.x.first;
    const int count = placed.x.last - placed.x.first;
    for (int i = 0; i < count; ++i) {
        const float atX = left + static_cast<float>(i);
        const float ox = atX - centre;
        const float d = d0 + (d1 + d2 * ox) * ox;
        const float q = (n0 + (n1 + n2 * ox) * ox) / d;
        const float t = q < 1 ? 1 - q : 0;
        const float u = t * t;
        const float w = weight * std::sqrt((ray0 + ray2 * atX * atX) / d) * u * u;
        weights[i] = depth <= opaqueRow[i] ? w : 0;
    }
}

// work(k) for every k below `threads`, each on a thread.
void together(unsigned threads, const std::function<void(unsigned)>& work) {
    std::vector<std::jthread> others;
    for (unsigned k = 1; k < threads; ++k) others.emplace_back(work, k);
    work(0);
}

// Threads take the rows of a picture in turns, so many at a time.
constexpr int kRows = 16;
constexpr std::size_t kAtOnce = 1 << 15;

}  // namespace

std::vector<float> sumRows(const Scene& scene, const View& view, Channels channels,
                           std::size_t layer, std::span<const float> opaqueDepth,
                           unsigned threads) {
    assert(channels == Channels::Weight || channels == Channels::WeightedColor);
    threads = std::max(threads, 1u);
    const SeenLayer seen(scene, view, channels, layer);
    const auto width = static_cast<std::size_t>(view.size.x);
    const std::size_t floats = channels == Channels::Weight ? 1 : 4;
    std::vector<float> plane(width * static_cast<std::size_t>(view.size.y) * floats);
    std::vector<float> rowWeights(width * threads);  // a row a thread

    const auto addRow = [&](const Placed& placed, int y, float* weights) {
        const std::size_t first = static_cast<std::size_t>(y) * width;
        seen.weigh(placed, y, &opaqueDepth[first], weights);
        float* to = &plane[(first + placed.x.first) * floats];
        const int count = placed.x.last - placed.x.first;
        if (channels == Channels::Weight)
            for (int i = 0; i < count; ++i) to[i] += weights[i];
        else
            for (int i = 0; i < count; ++i)
                for (int c = 0; c < 4; ++c) to[4 * i + c] += weights[i] * placed.color[c];
    };
    std::vector<std::uint64_t> points;
    points.reserve(kAtOnce);
    std::vector<Placed> placed(kAtOnce);
    const auto sumPoints = [&] {
        together(threads, [&](unsigned k) {
            for (std::size_t i = points.size() * k / threads; i < points.size() * (k + 1) / threads;
                 ++i)
                placed[i] = seen.place(points[i]);
        });
        together(threads, [&](unsigned k) {
            for (const Placed& p : std::span(placed).first(points.size())) {
                if (p.x.first >= p.x.last) continue;
                for (int y = p.y.first; y < p.y.last;) {
                    const int strip = y / kRows;
                    const int last = std::min((strip + 1) * kRows, p.y.last);
                    if (static_cast<unsigned>(strip) % threads == k)
                        for (; y < last; ++y) addRow(p, y, &rowWeights[width * k]);
                    y = last;
                }
            }
        });
        points.clear();
    };
    for (const timeseries::Run& run : scene.layers[layer].runs)
        forEachInSubset(run, strideOf(scene.layers[layer], scene.stride), [&](std::uint64_t point) {
            points.push_back(point);
            if (points.size() == kAtOnce) sumPoints();
        });
    sumPoints();
    return plane;
}

}  // namespace render

#include "render/splat/row_splatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "render/model/footprint.h"
#include "render/splat/rows_in_turns.h"
#include "render/splat/splat_source.h"
#include "render/together.h"

namespace render {
namespace {

// A splat in the picture.
struct Placed {
    Splat<float> splat;
    float windowDepth = 0;
    PixelSpan x, y;
    glm::vec4 color{1};  // what the four channels take of its weight, or of its opacity
};

// Points as a view sees them.
class SeenPoints {
 public:
    SeenPoints(const Scene& scene, const View& view, Channels channels)
        : scene_(scene),
          view_(view),
          columns_(columnsOf(scene)),
          colored_(channels == Channels::WeightedColor || channels == Channels::Over),
          seen_(scene.placed, view),
          axis_(seen_.rays.centre),
          slope2_(1.0 / (seen_.rays.focal * seen_.rays.focal)) {
        for (const Layer& layer : scene.layers)
            perSplat_.push_back(
                pointsPerSplat(layer, scene.stride) * seen_.rayLength *
                (channels == Channels::Over ? opticalDepthPerWeight(layer.style.opacity) : 1));
    }

    // Spans no pixels when it is not drawn.
    Placed place(std::uint32_t point, std::size_t layer, const PixelBox& box) const;
    // The pixels of row y that the splat may touch: fewer than its whole width where it is slim.
    PixelSpan spanIn(const Placed& placed, int y) const;
    // Of these pixels in row y W, or the optical depth for Over, 0 where the opaque scene hides it;
    // the first one's first.
    void weigh(const Placed& placed, int y, PixelSpan x, const float* opaqueRow,
               float* weights) const;

 private:
    const Scene& scene_;
    const View& view_;
    timeseries::Columns columns_;
    bool colored_;
    PointsView seen_;
    // Of each layer: what a splat stands for, times the length of the view axis' ray.
    std::vector<double> perSplat_;
    glm::vec2 axis_;    // window position of the view axis
    glm::vec2 slope2_;  // squares of x / -z and y / -z per pixel
};

PixelSpan within(PixelSpan span, int first, int size) {
    return {std::max(span.first, first), std::min(span.last, first + size)};
}

Placed SeenPoints::place(std::uint32_t point, std::size_t layer, const PixelBox& box) const {
    Placed placed;
    const std::uint32_t i = columns_.gridIndex[point];
    if (!scene_.placed.inside(i, scene_.clip)) return placed;
    Splat<float>& s = placed.splat;
    s = splatAt<float>(seen_, i, scene_.footprint);
    if (!s.visible) return placed;
    s.weight *= static_cast<float>(perSplat_[layer]);
    placed.windowDepth = static_cast<float>(windowDepth(view_, static_cast<double>(s.depth)));
    if (placed.windowDepth > 1) return placed;  // beyond the far plane
    const glm::vec2 window = axis_ + s.centre;
    const Kernel kernel = scene_.footprint.kernel;
    placed.x =
        within(pixelSpan(window.x, s.lo.x, s.hi.x, kernel, view_.size.x), box.at.x, box.size.x);
    placed.y =
        within(pixelSpan(window.y, s.lo.y, s.hi.y, kernel, view_.size.y), box.at.y, box.size.y);
    if (colored_)
        placed.color =
            glm::vec4(glm::vec3(colorOf(scene_.layers[layer].style, valueOf(columns_, point))), 1);
    return placed;
}

PixelSpan SeenPoints::spanIn(const Placed& placed, int y) const {
    const bool isSlim = scene_.placed.longCells() || scene_.placed.isMesh();
    if (!isSlim || scene_.footprint.kernel == Kernel::Point) return placed.x;
    // n - d <= 0, a quadratic in the offset along the row; a pixel more on both sides for rounding.
    const Splat<float>& s = placed.splat;
    const float oy = static_cast<float>(y) + 0.5f - axis_.y - s.centre.y;
    const float a = s.n.x - s.d.x, half = ((s.n.y - s.d.y) * oy - s.l.x) / 2;
    const float c = (s.n.z - s.d.z) * oy * oy - s.l.y * oy - 1;
    if (!(a > 1e-3f * s.n.x)) return placed.x;
    const float root = std::sqrt(std::max(half * half - a * c, 0.0f));
    const float middle = axis_.x + s.centre.x - 0.5f, limit = 1e6f;
    const auto pixel = [&](float at) { return static_cast<int>(std::clamp(at, -limit, limit)); };
    return {std::max(placed.x.first, pixel(std::floor(middle + (-half - root) / a)) - 1),
            std::min(placed.x.last, pixel(std::ceil(middle + (-half + root) / a)) + 2)};
}

void SeenPoints::weigh(const Placed& placed, int y, PixelSpan x, const float* opaqueRow,
                       float* weights) const {
    const Splat<float>& s = placed.splat;
    const float atY = static_cast<float>(y) + 0.5f - axis_.y;
    const float oy = atY - s.centre.y;
    // The quadratic forms of the row, in x alone. Those of a point splat give q = 0 and d = 1.
    const float n0 = s.n.z * oy * oy, n1 = s.n.y * oy, n2 = s.n.x;
    const float d0 = 1 + s.l.y * oy + s.d.z * oy * oy, d1 = s.l.x + s.d.y * oy, d2 = s.d.x;
    const float ray0 = 1 + slope2_.y * atY * atY, ray2 = slope2_.x;
    const float left = static_cast<float>(x.first) + 0.5f - axis_.x;
    const float centre = s.centre.x, weight = s.weight, depth = placed.windowDepth;
    opaqueRow += x.first;
    const int count = x.last - x.first;
    const auto denominator = [&](float ox) { return d0 + (d1 + d2 * ox) * ox; };
    const auto quotient = [&](float ox, float d) { return (n0 + (n1 + n2 * ox) * ox) / d; };
    for (int i = 0; i < count; ++i) {
        const float atX = left + static_cast<float>(i);
        const float ox = atX - centre;
        const float d = denominator(ox), q = quotient(ox, d);
        const float t = q < 1 ? 1 - q : 0;
        const float u = t * t;
        const float w = weight * std::sqrt((ray0 + ray2 * atX * atX) / d) * u * u;
        weights[i] = depth <= opaqueRow[i] && d > kLeastDenominator ? w : 0;
    }
    if (!s.cut) return;
    for (int i = 0; i < count; ++i) {
        if (!(weights[i] > 0)) continue;
        // The q that the weight is of: of another, rounded otherwise, it might be 1.
        const float ox = left + static_cast<float>(i) - centre;
        weights[i] *= s.insideShare({ox, oy}, quotient(ox, denominator(ox)));
    }
}

// To the pixels of a row. Over: the nearest splat comes first, and takes its opacity of what has
// come through.
void deposit(Channels channels, std::span<const float> weights, glm::vec4 color,
             float* __restrict to) {
    const std::size_t count = weights.size();
    switch (channels) {
        case Channels::Weight:
            for (std::size_t i = 0; i < count; ++i) to[i] += weights[i];
            return;
        case Channels::Count:
            for (std::size_t i = 0; i < count; ++i) to[i] += weights[i] > 0 ? 1.0f : 0.0f;
            return;
        case Channels::WeightedColor:
            for (std::size_t i = 0; i < count; ++i)
                for (int c = 0; c < 4; ++c) to[4 * i + c] += weights[i] * color[c];
            return;
        case Channels::Over:
            for (std::size_t i = 0; i < count; ++i) {
                const float taken = (1 - to[4 * i + 3]) * -std::expm1(-weights[i]);
                for (int c = 0; c < 4; ++c) to[4 * i + c] += taken * color[c];
            }
            return;
    }
}

constexpr std::uint64_t kAtOnce = 1 << 15;

}  // namespace

struct RowSum::Work {
    Channels channels;
    SeenPoints seen;
    SplatSource source;
    PixelBox box;
    std::size_t width, floats;  // of the box's rows
    std::size_t pictureWidth;
    std::span<const float> opaqueDepth;
    std::vector<float> nothingOpaque;  // a row of it, where there is none
    unsigned threads;
    PlanePixels plane;
    std::vector<float> rowWeights;  // a row a thread
    SplatPoints points;
    std::vector<Placed> placed;

    void sum();
    void addRow(const Placed& splat, int y, float* weights);
};

void RowSum::Work::addRow(const Placed& splat, int y, float* weights) {
    const PixelSpan x = seen.spanIn(splat, y);
    if (x.first >= x.last) return;
    const float* const opaque = opaqueDepth.empty()
                                    ? nothingOpaque.data()
                                    : &opaqueDepth[static_cast<std::size_t>(y) * pictureWidth];
    seen.weigh(splat, y, x, opaque, weights);
    const auto row = static_cast<std::size_t>(y - box.at.y);
    deposit(channels, {weights, static_cast<std::size_t>(x.last - x.first)}, splat.color,
            &plane[(row * width + static_cast<std::size_t>(x.first - box.at.x)) * floats]);
}

void RowSum::Work::sum() {
    const std::size_t count = points.point.size();
    placed.resize(count);
    together(threads, [&](unsigned k) {
        for (std::size_t i = count * k / threads; i < count * (k + 1) / threads; ++i)
            placed[i] = seen.place(points.point[i], points.layer[i], box);
    });
    together(threads, [&](unsigned k) {
        for (const Placed& p : placed) {
            if (p.x.first >= p.x.last) continue;
            forEachRowOf(k, threads, p.y, [&](int y) { addRow(p, y, &rowWeights[width * k]); });
        }
    });
}

RowSum::RowSum(const Scene& scene, const DrawList& list, const View& view, Channels channels,
               std::size_t layer, std::span<const float> opaqueDepth, unsigned threads,
               PlanePixels memory) {
    threads = std::max(threads, 1u);
    const PixelBox box = coveredPixels(scene, view);
    const auto width = static_cast<std::size_t>(box.size.x);
    const std::size_t floats = floatsPerPixel(channels);
    memory.assign(width * static_cast<std::size_t>(box.size.y) * floats, 0);
    work_.reset(new Work{.channels = channels,
                         .seen{scene, view, channels},
                         .source{scene, list, channels, layer},
                         .box = box,
                         .width = width,
                         .floats = floats,
                         .pictureWidth = static_cast<std::size_t>(view.size.x),
                         .opaqueDepth = opaqueDepth,
                         .nothingOpaque = std::vector<float>(
                             opaqueDepth.empty() ? static_cast<std::size_t>(view.size.x) : 0, 1.0f),
                         .threads = threads,
                         .plane = std::move(memory),
                         .rowWeights = std::vector<float>(width * threads),
                         .points = {},
                         .placed = {}});
}

RowSum::RowSum(RowSum&&) noexcept = default;
RowSum::~RowSum() = default;

std::uint64_t RowSum::add(std::uint64_t splats) {
    std::uint64_t added = 0;
    while (!done() && added < splats) {
        work_->source.next(std::clamp(splats - added, kLeast, kAtOnce), work_->points);
        work_->sum();
        added += work_->points.point.size();
    }
    return added;
}

bool RowSum::done() const { return work_->source.done(); }
const PixelBox& RowSum::box() const { return work_->box; }
PlanePixels& RowSum::plane() { return work_->plane; }
PlanePixels RowSum::takeMemory() { return std::move(work_->plane); }

std::vector<float> sumRows(const Scene& scene, const DrawList& list, const View& view,
                           Channels channels, std::size_t layer, std::span<const float> opaqueDepth,
                           unsigned threads) {
    RowSum sum(scene, list, view, channels, layer, opaqueDepth, threads);
    sum.add(std::numeric_limits<std::uint64_t>::max());
    const std::size_t floats = floatsPerPixel(channels);
    const auto width = static_cast<std::ptrdiff_t>(view.size.x * floats);
    std::vector<float> whole(static_cast<std::size_t>(width) * std::size_t(view.size.y));
    const auto row = static_cast<std::ptrdiff_t>(sum.box().size.x * floats);
    auto to = whole.begin() + sum.box().at.y * width + sum.box().at.x * std::ptrdiff_t(floats);
    auto from = sum.plane().begin();
    for (int y = 0; y < sum.box().size.y; ++y, from += row)
        std::copy(from, from + row, to + y * width);
    return whole;
}

}  // namespace render

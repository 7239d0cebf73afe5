#include "render/splat/splat_source.h"

#include <algorithm>
#include <numeric>

namespace render {

std::uint64_t splatCount(const Scene& scene) {
    std::uint64_t count = 0;
    for (const Layer& layer : scene.layers) count += splatCount(layer, scene.stride);
    return count;
}

SplatSource::SplatSource(const Scene& scene)
    : scene_(scene), sorted_(nullptr), layer_(0), last_(scene.layers.size()) {
    passEnds();
}

SplatSource::SplatSource(const Scene& scene, const DrawList& list, Channels channels,
                         std::size_t layer)
    : scene_(scene),
      sorted_(channels == Channels::Over ? &std::get<Sorted>(list) : nullptr),
      layer_(channels == Channels::Count ? 0 : layer),
      last_(channels == Channels::Count ? scene.layers.size() : layer + 1) {
    passEnds();
}

bool SplatSource::done() const {
    return sorted_ ? passed_ == sorted_->point.size() : layer_ == last_;
}

void SplatSource::next(std::uint64_t atMost, SplatPoints& points) {
    points.point.clear();
    points.layer.clear();
    if (sorted_)
        nextOfList(atMost, points);
    else
        nextOfRuns(atMost, points);
}

void SplatSource::nextOfList(std::uint64_t atMost, SplatPoints& points) {
    const auto from = static_cast<std::ptrdiff_t>(passed_);
    passed_ += std::min(atMost, sorted_->point.size() - passed_);
    const auto to = static_cast<std::ptrdiff_t>(passed_);
    points.point.assign(sorted_->point.rbegin() + from, sorted_->point.rbegin() + to);
    points.layer.assign(sorted_->layer.rbegin() + from, sorted_->layer.rbegin() + to);
}

void SplatSource::nextOfRuns(std::uint64_t atMost, SplatPoints& points) {
    while (!done() && points.point.size() < atMost) {
        const Layer& layer = scene_.layers[layer_];
        const std::uint32_t stride = strideOf(layer, scene_.stride);
        const timeseries::Run& whole = layer.runs[run_];
        timeseries::Run part{whole.first + passed_, whole.count - passed_};
        part.count = std::min(part.count, (atMost - points.point.size()) * stride);
        if (stride == 1) {
            const auto before = static_cast<std::ptrdiff_t>(points.point.size());
            points.point.resize(points.point.size() + part.count);
            std::iota(points.point.begin() + before, points.point.end(),
                      static_cast<std::uint32_t>(part.first));
        } else {
            forEachInSubset(part, stride, [&](std::uint64_t point) {
                points.point.push_back(static_cast<std::uint32_t>(point));
            });
        }
        points.layer.resize(points.point.size(), static_cast<std::uint8_t>(layer_));
        passed_ += part.count;
        if (passed_ == whole.count) ++run_, passed_ = 0;
        passEnds();
    }
}

// Of layers whose runs are all passed.
void SplatSource::passEnds() {
    while (!sorted_ && layer_ != last_ && run_ == scene_.layers[layer_].runs.size())
        ++layer_, run_ = 0;
}

}  // namespace render

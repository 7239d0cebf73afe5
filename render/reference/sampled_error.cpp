#include "render/reference/sampled_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "render/model/covered.h"
#include "render/reference/interval_truth.h"

namespace render {
namespace {

// Of few rays, beside an error: it makes that larger by a fiftieth, then.
constexpr double kNoise = 0.2;

// Of so many things some, by their numbers, one at random from each of as many equal stretches: of
// the pixels of a picture's rows, so that they lie all over it.
std::vector<std::size_t> sampleOf(std::size_t all, std::size_t count, std::mt19937& random) {
    std::vector<std::size_t> some(std::min(all, count));
    if (count >= all) {
        std::iota(some.begin(), some.end(), std::size_t{0});
        return some;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = all * i / count, last = all * (i + 1) / count;
        some[i] = first + random() % (last - first);
    }
    return some;
}

// All of a box's, or some.
std::vector<glm::ivec2> pixelsOf(const PixelBox& box, std::size_t count, std::mt19937& random) {
    const auto width = static_cast<std::size_t>(box.size.x);
    const std::size_t all = width * static_cast<std::size_t>(box.size.y);
    std::vector<glm::ivec2> pixels;
    pixels.reserve(std::min(all, count));
    const auto add = [&](std::size_t i) {
        pixels.push_back(box.at + glm::ivec2(i % width, i / width));
    };
    if (count >= all)
        for (std::size_t i = 0; i < all; ++i) add(i);
    else
        for (const std::size_t i : sampleOf(all, count, random)) add(i);
    return pixels;
}

bool isSomething(double depth) { return depth > 0; }

// use(coarse pixel, its share) of those around the middle of a pixel.
template <typename Use>
void forEachAround(const glm::ivec2& pixel, int across, const Use& use) {
    const glm::dvec2 place = (glm::dvec2(pixel) + 0.5) / static_cast<double>(across) - 0.5;
    const glm::dvec2 first = glm::floor(place), share = place - first;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            use(glm::ivec2(first) + glm::ivec2(x, y),
                (x == 0 ? 1 - share.x : share.x) * (y == 0 ? 1 - share.y : share.y));
}

}  // namespace

DepthAt depthFrom(std::vector<float> depth, glm::ivec2 size) {
    return [depth = std::move(depth), size](std::span<const glm::ivec2> pixels) {
        std::vector<double> found;
        found.reserve(pixels.size());
        for (const glm::ivec2& p : pixels)
            found.push_back(static_cast<double>(
                depth[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(p.x)]));
        return found;
    };
}

DepthAt enlarged(DepthAt coarse, int across, glm::ivec2 size) {
    return [coarse = std::move(coarse), across, size](std::span<const glm::ivec2> pixels) {
        std::vector<glm::ivec2> asked;
        std::vector<std::pair<std::size_t, double>> parts;  // which pixel takes so much of each
        for (std::size_t i = 0; i < pixels.size(); ++i)
            forEachAround(pixels[i], across, [&](const glm::ivec2& at, double share) {
                if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return;
                asked.push_back(at);
                parts.emplace_back(i, share);
            });
        const std::vector<double> depth = coarse(asked);
        std::vector<double> found(pixels.size());
        for (std::size_t k = 0; k < parts.size(); ++k)
            found[parts[k].first] += parts[k].second * depth[k];
        return found;
    };
}

SampledTruth::SampledTruth(const Scene& scene, const View& view, const DepthAt& first,
                           const Sampling& sampling)
    : scene_(scene), view_(view), raysAcross_(sampling.raysAcross), threads_(sampling.threads) {
    choosePixels(first, sampling);
    choosePlaces(sampling.raysAcross);
    depth_.resize(pixels_.size());
    for (Group* group : {&quarter_[0], &quarter_[1], &rest_}) group->depth.resize(pixels_.size());
}

void SampledTruth::choosePixels(const DepthAt& first, const Sampling& sampling) {
    std::mt19937 random(1);  // one picture, one figure
    const PixelBox box = coveredPixels(scene_, view_);
    const std::size_t all =
        static_cast<std::size_t>(box.size.x) * static_cast<std::size_t>(box.size.y);
    std::vector<glm::ivec2> asked;
    std::vector<double> depth;
    std::size_t shown = 0;
    for (std::size_t count = sampling.asked; true; count *= 4) {
        asked = pixelsOf(box, count, random);
        depth = first(asked);
        shown = static_cast<std::size_t>(std::ranges::count_if(depth, isSomething));
        if (asked.size() == all || shown >= sampling.pixels / 4 || count >= 16 * sampling.asked)
            break;
    }
    const auto add = [&](bool isShown, std::size_t there, std::size_t count) {
        const std::vector<std::size_t> some = sampleOf(there, count, random);
        auto next = some.begin();
        for (std::size_t i = 0, nth = 0; next != some.end(); ++i) {
            if (isSomething(depth[i]) != isShown || nth++ != *next) continue;
            pixels_.push_back(asked[i]);
            ++next;
        }
        if (some.empty()) return;
        weights_.resize(pixels_.size(),
                        static_cast<double>(there) / static_cast<double>(some.size()));
    };
    const std::size_t rest = asked.size() - shown, half = sampling.pixels / 2,
                      beside = std::min(rest, half);
    add(true, shown, sampling.pixels - beside);
    add(false, rest, std::max(beside, sampling.pixels - std::min(sampling.pixels, shown)));
}

// Of four rays that are neighbours one, of another corner each time, so that each row and column
// has as many; every second one of these is a half.
void SampledTruth::choosePlaces(int across) {
    const std::vector<glm::dvec2> all = placesOfRays(across);
    if (scene_.placed.isMesh() || across % 4 != 0) {
        quarter_[0].places = all;
        return;
    }
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x) {
            const int column = x / 2, row = y / 2;
            const bool isChosen = x % 2 == row % 2 && y % 2 == column % 2;
            (isChosen ? quarter_[static_cast<std::size_t>((column + row) % 2)] : rest_)
                .places.push_back(all[static_cast<std::size_t>(y * across + x)]);
        }
}

void SampledTruth::add(const timeseries::FieldSlab& slab, Rays rays) {
    const IntervalTruth truth(scene_, slab, raysAcross_, threads_, IntervalCells::Look::WhenAsked);
    const auto addTo = [&](Group& group) {
        if (group.places.empty()) return;
        for (std::size_t k = 0; k < scene_.layers.size(); ++k) {
            const double perWeight = opticalDepthPerWeight(scene_.layers[k].style.opacity);
            const auto weight = truth.weight(view_, k, pixels_, group.places);
            for (std::size_t i = 0; i < weight.size(); ++i) group.depth[i] += perWeight * weight[i];
        }
    };
    hasRest_ = rays == Rays::Rest;
    if (hasRest_)
        addTo(rest_);
    else
        std::ranges::for_each(quarter_, addTo);
    average();
}

void SampledTruth::average() {
    std::ranges::fill(depth_, 0);
    std::size_t rays = 0;
    for (const Group* group : {&quarter_[0], &quarter_[1], &rest_}) {
        if (group == &rest_ && !hasRest_) continue;
        rays += group->places.size();
        for (std::size_t i = 0; i < depth_.size(); ++i)
            depth_[i] += static_cast<double>(group->places.size()) * group->depth[i];
    }
    for (double& depth : depth_) depth /= static_cast<double>(rays);
}

bool SampledTruth::wantsRest(double error) const {
    if (hasRest()) return false;
    // Of the mean of both, by chance alone: to be added to the error in squares.
    const double noise = 0.5 * apart(quarter_[0].depth, quarter_[1].depth);
    const bool seesNothing = std::ranges::none_of(depth_, [](double depth) { return depth > 0; });
    return seesNothing || !(noise <= kNoise * error);
}

double SampledTruth::apart(std::span<const double> a, std::span<const double> b) const {
    double squares = 0, truths = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        squares += weights_[i] * std::pow(a[i] - b[i], 2);
        truths += weights_[i] * depth_[i] * depth_[i];
    }
    return squares == 0 ? 0 : std::sqrt(squares / truths);
}

}  // namespace render

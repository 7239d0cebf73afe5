#include "render/model/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/model/footprint.h"

namespace render {
namespace {

// The ray of a window position, and which points are too far from it to reach it.
class Ray {
 public:
    Ray(const Scene& scene, const View& view, const glm::dvec2& window)
        : scene_(scene),
          view_(view),
          pointsView_(scene.placed, view),
          rays_(pixelRays(view)),
          window_(window) {
        slope_ = (window - rays_.centre) / rays_.focal;
        // A point splat reaches half its diagonal and half a pixel of rounding.
        const bool points = scene.footprint.kernel == Kernel::Point;
        const double most = pointsView_.lengthening.most;
        const double perDepth = points
                                    ? (pointSide(scene.footprint) + 1.0) * glm::length(rays_.axis) /
                                          std::min(rays_.focal.x, rays_.focal.y)
                                    : pointsView_.smallestRadius * most;
        reachPerDepth_ = perDepth * std::sqrt(1 + glm::dot(slope_, slope_));
        if (!points) reach_ = scene.footprint.size * kQuarticRadius * scene.placed.widest() * most;
    }

    struct Splatted {
        double weight, depth;  // W, and the splat's view depth
    };
    // None where the splat is not drawn.
    std::optional<Splatted> meet(std::uint32_t gridIndex) const {
        const glm::dvec3 world = scene_.placed.position(gridIndex);
        if (!near(world) || !inClip(gridIndex)) return std::nullopt;
        const auto s = splatAt<double>(pointsView_, gridIndex, scene_.footprint);
        const glm::dmat4& clip = view_.clipFromView;
        const bool beyond = clip[3][2] - clip[2][2] * s.depth > s.depth;  // the far plane
        if (!s.visible || beyond || !inSquare(s)) return std::nullopt;
        const auto weight =
            weightOn<double>(s, scene_.footprint.kernel, window_ - rays_.centre - s.centre, slope_,
                             pointsView_.rayLength);
        if (!weight) return std::nullopt;
        return Splatted{*weight, s.depth};
    }

 private:
    bool near(const glm::dvec3& world) const {
        const glm::dvec3 away = world - rays_.eye;
        const glm::dvec3 along = rays_.along(window_ - rays_.centre);
        const double depth = glm::dot(away, rays_.axis) / glm::dot(rays_.axis, rays_.axis);
        const glm::dvec3 across = glm::cross(away, along);
        const double reach = longestSemiAxis(scene_.placed, reach_, depth * reachPerDepth_);
        return depth > 0 && glm::dot(across, across) <= reach * reach * glm::dot(along, along);
    }
    bool inClip(std::uint32_t i) const { return scene_.placed.inside(i, scene_.clip); }
    // As the splatters place a point's square on whole pixels.
    bool inSquare(const Splat<double>& s) const {
        if (scene_.footprint.kernel != Kernel::Point) return true;
        const glm::dvec2 first = glm::floor(rays_.centre + s.centre + s.lo + 0.5);
        const glm::dvec2 pixel = glm::floor(window_), past = first + s.hi - s.lo;
        return pixel.x >= first.x && pixel.y >= first.y && pixel.x < past.x && pixel.y < past.y;
    }

    const Scene& scene_;
    const View& view_;
    PointsView pointsView_;
    PixelRays rays_;  // in the world
    glm::dvec2 window_, slope_;
    double reach_ = 0, reachPerDepth_;  // world lengths: the larger one counts
};

struct Hit : Met {
    std::uint64_t point;
};

// As bright as a linear colour looks; a little, so that black in front of a ground counts, too.
double brightness(const glm::dvec3& rgb) {
    constexpr double kBlack = 0.01;
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)) + kBlack;
}

std::vector<Hit> hits(const Scene& scene, const View& view, const glm::dvec2& window) {
    const Ray ray(scene, view, window);
    const auto gridIndex = columnsOf(scene).gridIndex;
    std::vector<Hit> hits;
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const Layer& layer = scene.layers[k];
        const double perWeight =
            opticalDepthPerWeight(layer.style.opacity) * pointsPerSplat(layer, scene.stride);
        for (const timeseries::Run& run : layer.runs)
            forEachInSubset(run, strideOf(layer, scene.stride), [&](std::uint64_t p) {
                if (const auto met = ray.meet(gridIndex[p]))
                    hits.push_back({{k, met->depth, perWeight * met->weight,
                                     timeseries::toDouble(scene.step.value(p))},
                                    p});
            });
    }
    return hits;
}

}  // namespace

std::optional<HalfOfLight> atHalfOfLight(const Scene& scene, std::span<const Met> met) {
    // What is in front hides what is behind, and so it looks in a picture of one colour in any
    // order; an unordered picture of several shows all that a ray passes alike.
    const bool hiding = scene.order == Order::BackToFront || areOneColor(scene.layers);
    double whole = 0, before = 0;  // light, and the optical depth in front
    std::vector<double> upTo;
    for (const Met& m : met) {
        const double seen =
            hiding ? std::exp(-before) * -std::expm1(-m.opticalDepth) : m.opticalDepth;
        whole += seen * brightness(colorOf(scene.layers[m.layer].style, m.value));
        before += m.opticalDepth;
        upTo.push_back(whole);
    }
    if (!(whole > 0)) return std::nullopt;
    const auto at =
        static_cast<std::size_t>(std::ranges::lower_bound(upTo, whole / 2) - upTo.begin());
    const double first = at == 0 ? 0 : upTo[at - 1];
    const double share = std::min((whole / 2 - first) / (upTo[at] - first), 1.0);  // of its light
    const double depth = met[at].opticalDepth;
    // The limit of log(1 - share (1 - e^-t)) / -t at 0 is share.
    if (!hiding || depth < 1e-8) return HalfOfLight{at, share};
    return HalfOfLight{at, std::min(-std::log1p(share * std::expm1(-depth)) / depth, 1.0)};
}

double depthOfBall(const PlacedPoints& placed, const View& view, const glm::dvec2& window) {
    const PixelRays rays = pixelRays(placed.inAxes(view));
    return placed.ballOnRay(rays.eye, rays.along(window - rays.centre));
}

std::optional<Picked> pick(const Scene& scene, const View& view, const glm::dvec2& window) {
    std::vector<Hit> met = hits(scene, view, window);
    const double ball = depthOfBall(scene.placed, view, window);
    std::erase_if(met, [&](const Hit& hit) { return hit.depth > ball; });
    std::ranges::stable_sort(met, {}, &Hit::depth);
    const auto half = atHalfOfLight(scene, std::vector<Met>(met.begin(), met.end()));
    if (!half) return std::nullopt;
    const Hit& hit = met[half->at];
    const std::uint32_t at = scene.step.gridIndex(hit.point);
    return Picked{hit.layer, at, scene.step.value(hit.point), scene.placed.position(at), hit.depth};
}

}  // namespace render

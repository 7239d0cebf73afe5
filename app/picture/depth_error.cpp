#include "app/picture/depth_error.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/picture/picture.h"
#include "render/frame/plain_frame.h"
#include "render/model/rays_across.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/sampled_error.h"
#include "render/splat/cell_pieces.h"

namespace app {
namespace {

// More cells take longer to be summed for all pixels than the rays of so many pixels to pass them.
constexpr std::uint64_t kFewCells = 1 << 18;
constexpr std::size_t kPixelsAsked = 2048;

}  // namespace

std::string rungText(const Rung& rung) {
    if (rung.model == Model::Cells) return "cells";
    return rung.stride == 1 ? "points" : fmt::format("1 of {} points", rung.stride);
}

std::optional<double> DepthErrors::of(const Rung& rung) const {
    std::optional<double> error;
    std::uint32_t coarsest = 0;
    for (const auto& [known, of] : rungs) {
        if (known.model != rung.model || known.stride > rung.stride || known.stride <= coarsest)
            continue;
        coarsest = known.stride;
        error = of;
    }
    return error;
}

std::optional<Rung> DepthErrors::cheapest(double error) const {
    const std::pair<Rung, double>* best = nullptr;
    const auto draws = [](const Rung& rung) {
        return rung.model == Model::Cells ? 2.0 : 1.0 / rung.stride;
    };
    for (const auto& each : rungs) {
        const bool fits = each.second <= error;
        const bool isBetter =
            best == nullptr ||
            (best->second <= error ? fits && draws(each.first) < draws(best->first)
                                   : each.second < best->second);
        if (isBetter) best = &each;
    }
    return best != nullptr ? std::optional(best->first) : std::nullopt;
}

DepthErrors depthErrorsOf(const Explorer& explorer, const timeseries::SortedStep& step,
                          const render::View& view, std::span<const Rung> rungs, CellsBy by,
                          unsigned threads, const std::atomic<bool>& wanted) {
    const render::PlacedPoints placed(step.grid(), explorer.scale, explorer.map);
    Explorer e = explorer;
    e.opacityPer = render::OpacityPer::Length;
    e.order = render::Order::None;  // depth alone
    const auto sceneOf = [&](const Rung& rung) {
        e.model = rung.model;
        render::Scene scene = makeScene(e, step, placed, e.play.tick);
        scene.stride = rung.stride;
        scene.footprint = standingFor(scene.footprint, rung.stride);
        return scene;
    };
    const auto raysOf = [&](const render::Scene& scene) {
        return by == CellsBy::Gl ? 1 : render::raysAcross(scene, view);
    };
    const auto isByRays = [&](const render::Scene& scene) {
        return scene.cells && (raysOf(scene) != render::raysAcross(scene, view) ||
                               render::cellCount(scene, render::Channels::Over, 0) > kFewCells);
    };
    const auto depthOf = [&](render::Scene scene) -> render::DepthAt {
        if (!isByRays(scene))
            return render::depthFrom(opticalDepthOf(scene, view, wanted), view.size);
        const int rays = raysOf(scene);
        return
            [scene = std::move(scene), &view, rays, threads](std::span<const glm::ivec2> pixels) {
                return render::cellDepthAt(scene, view, pixels, rays, threads);
            };
    };
    const render::Scene first = sceneOf(rungs.front());
    if (first.layers.empty()) return {};
    std::vector<render::DepthAt> pictures;
    for (const Rung& rung : rungs) {
        pictures.push_back(depthOf(sceneOf(rung)));
        if (!wanted) return {};
    }
    render::Sampling sampling{.threads = threads};
    if (isByRays(first)) sampling.asked = kPixelsAsked;
    const auto errors = sampledErrors(first, *step.sharedField(), view, pictures, sampling);
    DepthErrors told;
    for (std::size_t i = 0; i < rungs.size(); ++i)
        told.rungs.emplace_back(rungs[i], errors[i].relativeL2);
    return told;
}

std::vector<Rung> rungsOf(const Explorer& explorer, const timeseries::SortedStep& step) {
    std::vector<Rung> rungs;
    if (step.cellsIfMade(cellsNeeded(explorer, step.type()))) rungs.push_back({Model::Cells});
    for (const std::uint32_t stride : {1u, 2u, 4u, 8u, 16u})
        rungs.push_back({Model::Points, stride});
    return rungs;
}

std::string shareText(double error) {
    const double percent = 100 * error;
    if (percent < 0.1) return "below 0.1 %";
    return fmt::format("{:.{}f} %", percent, percent < 1 ? 1 : 0);
}

std::string depthErrorText(const std::optional<double>& error) {
    if (!error || !std::isfinite(*error)) return "";
    return *error < 0.001 ? "error " + shareText(*error) : "error about " + shareText(*error);
}

}  // namespace app

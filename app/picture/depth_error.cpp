#include "app/picture/depth_error.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "app/picture/picture.h"
#include "render/frame/plain_frame.h"
#include "render/model/rays_across.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/order_error.h"
#include "render/reference/sampled_error.h"
#include "render/reference/splats_on_pixels.h"
#include "render/splat/cell_pieces.h"
#include "timeseries/index/field_slabs.h"

namespace app {
namespace {

// More cells take longer to be summed for all pixels than the rays of so many pixels to pass them.
constexpr std::uint64_t kFewCells = 1 << 18;
constexpr std::size_t kPixelsAsked = 2048;

bool isZero(double depth) { return depth == 0; }

// One view of a step, drawn in one way and another.
class Ways {
 public:
    Ways(const Explorer& explorer, const timeseries::SortedStep& step, const render::View& view,
         const ErrorQuestion& question, const std::atomic<bool>& wanted)
        : explorer_(explorer),
          step_(step),
          placed_(step.grid(), explorer.scale, explorer.map),
          view_(view),
          question_(question),
          wanted_(wanted) {}

    // For depth alone.
    render::Scene sceneOf(const Rung& rung) const {
        Explorer e = drawnBy(rung.model);
        // Who chose points chose lengths; where they stand for cells, they miss what these cross.
        if (modelOf(explorer_) == Model::Points) e.opacityPer = render::OpacityPer::Length;
        e.order = render::Order::None;
        render::Scene scene = makeScene(e, step_, placed_, e.play.tick);
        scene.stride = rung.stride;
        scene.footprint = standingFor(scene.footprint, rung.stride);
        return scene;
    }
    // As it is drawn, but for its light.
    render::Scene orderedSceneOf(Model model) const {
        Explorer e = drawnBy(model);
        if (model == Model::Points) e.opacityPer = render::OpacityPer::Length;
        return makeScene(e, step_, placed_, e.play.tick);
    }

    bool isByRays(const render::Scene& scene) const {
        return scene.cells && !mixesModels(scene) &&
               render::cellCount(scene, render::Channels::Over, 0) > kFewCells;
    }
    // What is drawn.
    render::DepthAt depthOf(const Rung& rung) const {
        const render::View seen = coarser(view_, rung.across);
        render::DepthAt depth = depthIn(sceneOf(rung), seen, render::RaysEnd::BehindAll);
        return rung.across == 1 ? depth
                                : render::enlarged(std::move(depth), rung.across, seen.size);
    }
    // Where that shows something, which is sooner told.
    render::DepthAt whereIn(const render::Scene& scene, const render::DepthAt& depth) const {
        return isByRays(scene) ? depthIn(scene, view_, render::RaysEnd::WhereSomethingIs) : depth;
    }
    // With as many rays a pixel as the truth.
    std::vector<double> finelyDrawn(Model model, std::span<const glm::ivec2> pixels) const {
        const render::Scene whole = sceneOf({model});
        const int rays = render::Sampling().raysAcross;
        const auto ofCells = [&](const render::Scene& scene) {
            return render::cellDepthAt(scene, view_, pixels, rays, question_.threads);
        };
        const auto ofPoints = [&](const render::Scene& scene) {
            return render::splatDepthAt(scene, view_, pixels, rays, question_.threads, wanted_);
        };
        if (!whole.cells) return ofPoints(whole);
        if (!mixesModels(whole)) return ofCells(whole);
        std::vector<double> depth = ofCells(onlyCells(whole));
        const std::vector<double> more = ofPoints(onlyPoints(whole));
        for (std::size_t i = 0; i < more.size(); ++i) depth[i] += more[i];
        return depth;
    }
    bool isWanted() const { return wanted_; }
    const render::View& view() const { return view_; }
    // A mesh or globe is looked at all at once.
    void forEachSlab(const std::function<void(const timeseries::FieldSlab&)>& use) const {
        const auto whileWanted = [&](const timeseries::FieldSlab& slab) {
            if (wanted_) use(slab);
            return wanted_.load();
        };
        timeseries::forEachSlab(step_, whileWanted,
                                placed_.isMesh() ? timeseries::kAllAtOnce : timeseries::kSlabBytes);
    }

 private:
    // By cells, as it was chosen, if any layer is.
    Explorer drawnBy(Model model) const {
        return model == modelOf(explorer_) && model == Model::Cells ? explorer_
                                                                    : allBy(model, explorer_);
    }
    render::DepthAt depthIn(render::Scene scene, const render::View& view,
                            render::RaysEnd end) const {
        if (!isByRays(scene))
            return render::depthFrom(opticalDepthOf(scene, view, wanted_), view.size);
        const int rays = render::raysAcross(scene, view);
        return
            [this, scene = std::move(scene), view, rays, end](std::span<const glm::ivec2> pixels) {
                return render::cellDepthAt(scene, view, pixels, rays, question_.threads, end);
            };
    }

    const Explorer& explorer_;
    const timeseries::SortedStep& step_;
    render::PlacedPoints placed_;
    const render::View& view_;
    const ErrorQuestion question_;
    const std::atomic<bool>& wanted_;
};

Ordering orderingOf(const Ways& ways, Model model) {
    const render::Scene scene = ways.orderedSceneOf(model);
    if (render::areOneColor(scene.layers)) return Ordering::OneColor;
    return scene.order == render::Order::None ? Ordering::Mixed : Ordering::ByDepth;
}

// What order costs the light of what is drawn by a model.
class OrderOf {
 public:
    OrderOf(const Ways& ways, Model model, const render::SampledTruth& truth, unsigned threads)
        : scene_(ways.orderedSceneOf(model)),
          error_(scene_, ways.view(), truth.pixels(), truth.weights(), threads) {}
    void add(const timeseries::FieldSlab& slab) {
        if (!mixesModels(scene_)) error_.add(slab);
    }
    double error(const std::atomic<bool>& wanted) const {
        return mixesModels(scene_) ? std::numeric_limits<double>::quiet_NaN()
                                   : error_.error(&wanted);
    }

 private:
    const render::Scene scene_;
    render::OrderError error_;
};

using Rays = render::SampledTruth::Rays;

// Adds all slabs to the truth, of as many rays as the least error of these pictures takes, and to
// what tells of order.
void look(const Ways& ways, std::span<const std::vector<double>> drawn, render::SampledTruth& truth,
          std::map<Model, OrderOf>& orders) {
    ways.forEachSlab([&](const timeseries::FieldSlab& slab) {
        truth.add(slab, Rays::Quarter);
        for (auto& [model, order] : orders) order.add(slab);
    });
    double least = std::numeric_limits<double>::infinity();
    for (const auto& depth : drawn) least = std::min(least, truth.apart(depth, truth.depth()));
    if (truth.wantsRest(least))
        ways.forEachSlab([&](const timeseries::FieldSlab& slab) { truth.add(slab, Rays::Rest); });
}

// What the parts of a rung's error are told by, at the truth's pixels: all its points or cells.
struct SeenWhole {
    std::vector<double> asDrawn, finely;

    SeenWhole(const Ways& ways, const Rung& rung, const render::SampledTruth& truth) {
        const render::DepthAt picture = ways.depthOf({rung.model, 1, rung.across});
        if (!ways.isWanted()) return;
        asDrawn = picture(truth.pixels());
        finely = ways.finelyDrawn(rung.model, truth.pixels());
    }
};

// Of the rungs in their order, against the truth of all rays.
void tellParts(const Ways& ways, std::span<const std::vector<double>> drawn,
               render::SampledTruth& truth, std::span<RungError> rungs) {
    if (!truth.hasRest())
        ways.forEachSlab([&](const timeseries::FieldSlab& slab) { truth.add(slab, Rays::Rest); });
    std::map<std::pair<Model, int>, SeenWhole> whole;
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        const Rung& rung = rungs[i].rung;
        const std::pair alike(rung.model, rung.across);
        const SeenWhole& all = whole.try_emplace(alike, ways, rung, truth).first->second;
        if (!ways.isWanted()) return;
        rungs[i].parts = ErrorParts{.model = truth.apart(all.finely, truth.depth()),
                                    .subset = truth.apart(drawn[i], all.asDrawn),
                                    .pixels = truth.apart(all.asDrawn, all.finely)};
    }
}

}  // namespace

const RungError* DepthErrors::find(const Rung& rung) const {
    const RungError* found = nullptr;
    for (const RungError& known : rungs) {
        const bool isAlike = known.rung.model == rung.model && known.rung.across == rung.across;
        const bool isCoarser = found == nullptr || known.rung.stride > found->rung.stride;
        if (isAlike && known.rung.stride <= rung.stride && isCoarser) found = &known;
    }
    return found;
}

std::optional<double> DepthErrors::of(const Rung& rung) const {
    const RungError* const known = find(rung);
    return known != nullptr ? std::optional(known->depth) : std::nullopt;
}

std::optional<Rung> DepthErrors::cheapest(double error) const {
    const RungError* best = nullptr;
    for (const RungError& each : rungs) {
        const bool fits = each.depth <= error;
        const bool isBetter =
            best == nullptr || (best->depth <= error ? fits && drawsLess(each.rung, best->rung)
                                                     : each.depth < best->depth);
        if (isBetter) best = &each;
    }
    return best != nullptr ? std::optional(best->rung) : std::nullopt;
}

DepthErrors depthErrorsOf(const Explorer& explorer, const timeseries::SortedStep& step,
                          const render::View& view, std::span<const Rung> rungs,
                          const ErrorQuestion& question, const std::atomic<bool>& wanted) {
    const Ways ways(explorer, step, view, question, wanted);
    const render::Scene first = ways.sceneOf(rungs.front());
    if (first.layers.empty()) return {};
    std::vector<render::DepthAt> pictures;
    for (const Rung& rung : rungs) {
        pictures.push_back(ways.depthOf(rung));
        if (!wanted) return {};
    }
    render::Sampling sampling{.threads = question.threads};
    if (ways.isByRays(first)) sampling.asked = kPixelsAsked;
    render::SampledTruth truth(first, view, ways.whereIn(first, pictures[0]), sampling);
    std::vector<std::vector<double>> drawn;
    for (const render::DepthAt& picture : pictures) drawn.push_back(picture(truth.pixels()));
    std::map<Model, OrderOf> orders;
    for (const Rung& rung : rungs)
        orders.try_emplace(rung.model, ways, rung.model, truth, question.threads);
    look(ways, drawn, truth, orders);
    std::map<Model, double> order;
    for (const auto& [model, of] : orders) order[model] = wanted ? of.error(wanted) : 0;
    DepthErrors told{.rungs = {}, .ordering = orderingOf(ways, rungs.front().model)};
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        const double depth = truth.apart(drawn[i], truth.depth());
        const bool isNothing = depth == 0 && std::ranges::all_of(truth.depth(), isZero);
        told.rungs.push_back({rungs[i],
                              isNothing ? std::numeric_limits<double>::quiet_NaN() : depth,
                              order.at(rungs[i].model)});
    }
    if (question.parts == Parts::All) tellParts(ways, drawn, truth, told.rungs);
    return wanted ? told : DepthErrors();
}

std::vector<Rung> rungsOf(const Explorer& explorer, const timeseries::SortedStep& step) {
    const Explorer byCells =
        modelOf(explorer) == Model::Cells ? explorer : allBy(Model::Cells, explorer);
    const bool areThere = step.cellsIfMade(cellsNeeded(byCells, step.type())) != nullptr;
    return ladder({.cells = areThere && !step.cellsAreGivenUp(),
                   .coarsePoints = mayBeCoarse(explorer.footprint)});
}

}  // namespace app

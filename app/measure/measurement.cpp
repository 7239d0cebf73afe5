#include "app/measure/measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"
#include "app/picture/picture.h"
#include "app/picture/still.h"
#include "render/frame/plain_frame.h"
#include "render/model/rays_across.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/color_difference.h"
#include "render/reference/image_compare.h"
#include "render/reference/interval_truth.h"
#include "render/reference/sampled_error.h"
#include "render/reference/splats_on_pixels.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::ranges::nth_element(values, middle);
    return *middle;
}

// All views' pixels in one, so that each figure is of all of them: [view][y][x].
struct Views {
    std::vector<double> opticalDepth;
    render::Image light;

    Views(glm::ivec2 size, std::size_t count)
        : light(glm::ivec2(size.x, size.y * static_cast<int>(count))) {}
    template <typename Real>
    void add(std::size_t view, const std::vector<Real>& depth, const render::Image& picture) {
        opticalDepth.insert(opticalDepth.end(), depth.begin(), depth.end());
        std::ranges::copy(
            picture.pixels,
            light.pixels.begin() + std::ssize(picture.pixels) * static_cast<std::ptrdiff_t>(view));
    }
};

std::vector<double> opticalDepth(const render::IntervalTruth& truth, const render::Scene& scene,
                                 const render::View& view) {
    std::vector<double> depth(static_cast<std::size_t>(view.size.x) *
                              static_cast<std::size_t>(view.size.y));
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const std::vector<double> weight = truth.weight(view, k);
        const double each = render::opticalDepthPerWeight(scene.layers[k].style.opacity);
        for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += each * weight[i];
    }
    return depth;
}

// Of rows from the bottom.
render::Image onBackground(const std::vector<glm::dvec4>& light, glm::ivec2 size) {
    render::Image image(size);
    auto pixel = light.begin();
    for (int y = size.y - 1; y >= 0; --y)
        for (int x = 0; x < size.x; ++x, ++pixel)
            image.at(x, y) =
                glm::vec4(glm::vec3(glm::dvec3(*pixel) + (1 - pixel->a) * kBackground), 1);
    return image;
}

class Bench {
 public:
    Bench(const Explorer& explorer, const timeseries::SortedStep& step,
          const render::PlacedPoints& placed, const Measuring& how)
        : explorer_(explorer),
          step_(step),
          placed_(placed),
          how_(how),
          frame_(step, placed, kBackground, how.splatter) {
        for (const ViewChoice& view : viewsAbout(explorer.view, how.views))
            views_.push_back(viewOf(view));
        ViewChoice turned = explorer.view;
        turned.azimuthDegrees = std::remainder(turned.azimuthDegrees + kTurnDegrees, 360.0);
        turned_ = viewOf(turned);
    }

    render::Scene sceneOf(const Mode& mode) const {
        Explorer e = allBy(mode.rung.model, explorer_);
        e.order = mode.order;
        e.light = mode.light;  // from within, or as it is given
        render::Scene scene = makeScene(e, step_, placed_, e.play.tick);
        scene.stride = mode.rung.stride;
        scene.footprint = standingFor(scene.footprint, mode.rung.stride);
        return scene;
    }

    // What a model needs before its first frame: the selection, its points in order of value, or
    // the index of cells. The first time; later it is there.
    double prepare(Model model) const {
        const auto start = Clock::now();
        const render::Scene scene = sceneOf({{model}});
        if (!scene.cells) columnsOf(scene);
        return secondsSince(start);
    }

    Views draw(const render::Scene& scene, int across) {
        Views shown(explorer_.size, views_.size());
        for (std::size_t v = 0; v < views_.size(); ++v) {
            frame_.draw(scene, views_[v], across);
            const render::Image light = frame_.light();
            shown.add(v, frame_.depth(scene, views_[v], across), light);
        }
        return shown;
    }
    std::vector<float> drawTurned(const render::Scene& scene, int across) {
        return frame_.depth(scene, turned_, across);
    }

    // Adds the time of a frame of each view, after one that makes room for them.
    void time(const render::Scene& scene, int across, std::vector<double>& into) {
        frame_.draw(scene, views_.front(), across);
        for (const render::View& view : views_) {
            const auto start = Clock::now();
            frame_.draw(scene, view, across);
            into.push_back(secondsSince(start));
        }
    }

    // As the modes are measured: light that comes from within.
    DepthErrors errorParts(std::span<const Rung> rungs, render::Order order) const {
        Explorer e = allBy(Model::Cells, explorer_);
        e.light = render::Light::Off;
        e.order = order;
        return depthErrorsOf(e, step_, views_.front(), rungs, {.parts = Parts::All});
    }

    struct Truth {
        Views shown;
        std::vector<double> turned;  // optical depth
    };
    Truth truth() const {
        const render::Scene scene = sceneOf({{Model::Cells}, render::Order::BackToFront});
        const render::IntervalTruth truth = truthOf(scene);
        Views shown(explorer_.size, views_.size());
        for (std::size_t v = 0; v < views_.size(); ++v)
            shown.add(v, opticalDepth(truth, scene, views_[v]),
                      onBackground(truth.light(views_[v]), explorer_.size));
        return {std::move(shown), opticalDepth(truth, scene, turned_)};
    }
    // The same, seen in this light.
    Views lit(const Views& dark, render::Light light) const {
        const render::Scene scene = sceneOf({{Model::Cells}, render::Order::BackToFront, light});
        const render::IntervalTruth truth = truthOf(scene);
        Views shown(explorer_.size, views_.size());
        const std::size_t pixels = dark.opticalDepth.size() / views_.size();
        for (std::size_t v = 0; v < views_.size(); ++v) {
            const auto first = dark.opticalDepth.begin() + std::ptrdiff_t(v * pixels);
            shown.add(v, std::vector<double>(first, first + std::ptrdiff_t(pixels)),
                      onBackground(truth.light(views_[v]), explorer_.size));
        }
        return shown;
    }
    // Measured::arithmetic, of what the first view shows and has in truth.
    double arithmetic(const render::Scene& scene, int across, std::span<const double> shown,
                      std::span<const double> truth) const {
        const std::vector<std::size_t> some = thinnedOut(shown, truth);
        const render::View& view = views_.front();
        std::vector<glm::ivec2> pixels;
        for (const std::size_t i : some)
            pixels.emplace_back(static_cast<int>(i) % view.size.x,
                                static_cast<int>(i) / view.size.x);
        const render::View planes = coarser(view, across);
        const render::DepthAt inDouble = [&](std::span<const glm::ivec2> at) {
            return scene.cells ? cellDepthAt(scene, planes, at, raysAcross(scene, planes))
                               : splatDepthAt(scene, planes, at, 1);
        };
        const std::vector<double> exact =
            (across == 1 ? inDouble : render::enlarged(inDouble, across, planes.size))(pixels);
        double differences = 0, squares = 0;
        for (std::size_t k = 0; k < some.size(); ++k) {
            const double difference = shown[some[k]] - exact[k];
            differences += difference * difference;
            squares += truth[some[k]] * truth[some[k]];
        }
        return differences == 0 ? 0 : std::sqrt(differences / squares);
    }

 private:
    // Places of pixels where something is shown or is, no more than take a moment.
    static std::vector<std::size_t> thinnedOut(std::span<const double> shown,
                                               std::span<const double> truth) {
        constexpr std::size_t kMost = 2048;
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < truth.size(); ++i)
            if (shown[i] > 0 || truth[i] > 0) all.push_back(i);
        if (all.size() <= kMost) return all;
        std::vector<std::size_t> some;
        for (std::size_t k = 0; k < kMost; ++k) some.push_back(all[k * all.size() / kMost]);
        return some;
    }
    render::IntervalTruth truthOf(const render::Scene& scene) const {
        return {scene, scene.cells->field(), static_cast<int>(how_.raysAcross)};
    }
    render::View viewOf(const ViewChoice& view) const {
        return eyes(view, {}, placed_.outline(), explorer_.size).front();
    }

    const Explorer& explorer_;
    const timeseries::SortedStep& step_;
    const render::PlacedPoints& placed_;
    const Measuring how_;
    render::PlainFrame frame_;
    std::vector<render::View> views_;
    render::View turned_;  // the first
};

void compare(const Views& shown, const Views& truth, Measured& into) {
    const render::ScalarError depth =
        render::compareScalars(std::span<const double>(shown.opticalDepth), truth.opticalDepth);
    into.depthError = depth.relativeL2;
    into.mass = depth.massRatio;
    const render::PictureError light = comparePictures(shown.light, truth.light);
    into.rmse = light.rmseLinear;
    into.psnr = light.psnrLinear;
    into.largest = light.maxAbsolute;
    constexpr double kShare = 0.95;
    into.colorDifference =
        colorDifferenceQuantile(shown.light, truth.light, glm::vec3(kBackground), kShare);
}

// Of all modes, those of each order at once.
void takeParts(const Bench& bench, std::vector<Measured>& all) {
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        const auto isOfIt = [&](const Measured& m) { return m.mode.order == order; };
        if (std::ranges::none_of(all, isOfIt)) continue;
        // Cells choose the pixels, also where they are not asked for.
        std::vector<Rung> rungs = {{Model::Cells}};
        for (const Measured& m : all)
            if (isOfIt(m) && m.mode.rung != rungs.front()) rungs.push_back(m.mode.rung);
        const DepthErrors errors = bench.errorParts(rungs, order);
        for (Measured& m : all) {
            const RungError* const known = errors.find(m.mode.rung);
            if (isOfIt(m) && known != nullptr) m.parts = *known;
        }
    }
}

// Of optical depth, pixel by pixel; a view and the same turned, of a picture and of the truth.
double poppingOf(std::span<const double> shown, std::span<const float> shownTurned,
                 std::span<const double> truth, std::span<const double> truthTurned) {
    double squares = 0, changes = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double change = double{shownTurned[i]} - shown[i] - (truthTurned[i] - truth[i]);
        changes += change * change;
        squares += truth[i] * truth[i];
    }
    return changes == 0 ? 0 : std::sqrt(changes / squares);
}

}  // namespace

std::string Mode::name() const {
    const char* const how = light != render::Light::Off ? "lit " : rung.across > 1 ? "coarse " : "";
    return fmt::format("{}{}{}", how, modelName(rung.model),
                       rung.stride == 1 ? "" : fmt::format(" 1/{}", rung.stride));
}

std::vector<Mode> modesFor(const ModesOf& of) {
    std::vector<render::Order> orders = {render::Order::None};
    if (of.severalColors) orders.insert(orders.begin(), render::Order::BackToFront);
    std::vector<Mode> modes;
    const auto addPoints = [&](render::Order order, int across) {
        for (const std::uint32_t stride : {8u, 4u, 2u, 1u})
            modes.push_back({{Model::Points, stride, across}, order});
    };
    for (const render::Order order : orders) addPoints(order, 1);
    for (const render::Order order : orders) modes.push_back({{Model::Cells}, order});
    if (of.coarsePoints) addPoints(orders.front(), kCoarse);
    modes.push_back({{Model::Cells, 1, kCoarse}, orders.front()});
    if (of.light != render::Light::Off)
        modes.push_back({{Model::Cells}, render::Order::BackToFront, of.light});
    return modes;
}

std::vector<Mode> modesNamed(std::span<const std::string> names, const ModesOf& of) {
    std::vector<std::string> known;
    for (const Mode& mode : modesFor({.coarsePoints = of.coarsePoints, .light = of.light}))
        known.push_back(mode.name());
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw ChoiceError(
                fmt::format("--modes: '{}' is none of {}", name, fmt::join(known, ", ")));
    std::vector<Mode> modes = modesFor(of);
    if (!names.empty())
        std::erase_if(modes, [&](const Mode& mode) {
            return std::ranges::find(names, mode.name()) == names.end();
        });
    return modes;
}

std::vector<ViewChoice> viewsAbout(const ViewChoice& view, unsigned count) {
    constexpr double kGoldenAngle = 137.50776405003785;
    std::vector<ViewChoice> views(count, view);
    for (unsigned i = 0; i < count; ++i)
        views[i].azimuthDegrees = std::remainder(view.azimuthDegrees + i * kGoldenAngle, 360.0);
    return views;
}

std::vector<Measured> measure(const Explorer& explorer, const timeseries::SortedStep& step,
                              const render::PlacedPoints& placed, const Measuring& how,
                              const std::function<void(double)>& progress) {
    Bench bench(explorer, step, placed, how);
    const double beforePoints = bench.prepare(Model::Points);
    const double beforeCells = bench.prepare(Model::Cells);
    const std::vector<Mode> modes =
        modesNamed(how.modes, {!render::areOneColor(bench.sceneOf({}).layers),
                               mayBeCoarse(explorer.footprint), explorer.light});
    struct TimedScene {
        render::Scene scene;
        Views shown;
        std::vector<float> turned;  // optical depth
        std::vector<double> times;
    };
    std::vector<TimedScene> drawn;
    const double rounds = how.frames + 2.0;  // one for what is shown, one for the truth
    const auto tell = [&](double done) {
        if (progress) progress(done / rounds);
    };
    tell(0);
    for (const Mode& mode : modes) {
        render::Scene scene = bench.sceneOf(mode);
        Views shown = bench.draw(scene, mode.rung.across);
        std::vector<float> turned = bench.drawTurned(scene, mode.rung.across);
        drawn.push_back({std::move(scene), std::move(shown), std::move(turned), {}});
    }
    // By turns, so that what else the machine does is in the times of all.
    for (unsigned i = 0; i < how.frames; ++i) {
        tell(1.0 + i);
        for (std::size_t k = 0; k < modes.size(); ++k)
            bench.time(drawn[k].scene, modes[k].rung.across, drawn[k].times);
    }
    tell(rounds - 1);
    const Bench::Truth truth = bench.truth();
    const std::span first(truth.shown.opticalDepth.data(), truth.turned.size());
    std::optional<Views> litTruth;
    std::vector<Measured> all;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        Measured& m = all.emplace_back();
        m.mode = modes[i];
        m.frame = medianOf(std::move(drawn[i].times));
        m.before = m.mode.rung.model == Model::Points ? beforePoints : beforeCells;
        for (const render::Layer& layer : drawn[i].scene.layers)
            m.drawn += static_cast<double>(drawnCount(drawn[i].scene, layer));
        const bool isLit = m.mode.light != render::Light::Off;
        if (isLit && !litTruth) litTruth = bench.lit(truth.shown, m.mode.light);
        compare(drawn[i].shown, isLit ? *litTruth : truth.shown, m);
        const std::span shown(drawn[i].shown.opticalDepth.data(), first.size());
        m.arithmetic = bench.arithmetic(drawn[i].scene, m.mode.rung.across, shown, first);
        m.popping = poppingOf(shown, drawn[i].turned, first, truth.turned);
    }
    takeParts(bench, all);
    return all;
}

}  // namespace app

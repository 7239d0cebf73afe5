// Explorers by chance, for what must hold of every one.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "app/choices/choices.h"
#include "app/choices/explorer.h"

namespace tests {

// Explorers with every choice made or left open by chance.
class RandomExplorer {
 public:
    explicit RandomExplorer(unsigned seed) : random_(seed) {}

    app::Explorer operator()() {
        app::Explorer e;
        for (std::size_t i = 0; i <= random_() % 3; ++i) e.files.push_back(pick(kFiles));
        if (maybe()) e.variable = pick(kNames);
        if (maybe()) {
            e.steps = app::StepChoice{random_() % 40, {}};
            if (maybe()) e.steps->last = e.steps->first + random_() % 4;
            if (random_() % 3 == 0) e.steps->stride = 1 + random_() % 5;
        }
        if (maybe()) e.keep = ranges();
        for (app::AxisChoice& axis : e.axes) {
            axis.flip = maybe();
            if (random_() % 4 == 0) axis.name = pick(kNames);
        }
        if (maybe()) {
            e.layers.push_back(styled({}));
            e.layers.front().motion.emplace();
            app::sweepOf(e)->animation = ranges();
            app::sweepOf(e)->delta = std::abs(number());
            app::sweepOf(e)->timerSteps = 1 + static_cast<std::int64_t>(random_() % 1000);
            app::sweepOf(e)->step = 1 + static_cast<std::int64_t>(random_() % 9);
            app::sweepOf(e)->frequency = unit();
            app::sweepOf(e)->path =
                maybe() ? timeseries::SweepPath::Loop : timeseries::SweepPath::Swing;
        }
        const std::size_t most = render::kMaxLayers - e.layers.size();
        for (std::size_t i = random_() % (most + 1); i > 0; --i)
            e.layers.push_back(styled(random_() % 5 == 0 ? timeseries::RangeSet() : ranges()));
        if (maybe()) e.model = app::Model::Cells;
        e.light = static_cast<render::Light>(random_() % 3);
        if (maybe()) e.lamp = app::LampChoice{720 * unit() - 360, 180 * unit() - 90};
        if (maybe()) e.opacityPer = render::OpacityPer::Length;
        e.footprint = {maybe() ? render::Kernel::Point : render::Kernel::Quartic,
                       0.001 + 5 * unit()};
        e.order = maybe() ? render::Order::None : render::Order::BackToFront;
        if (maybe()) e.clip = clip();
        if (maybe()) e.scale = glm::dvec3(0.1 + unit(), 1e-9 + unit(), 1 + 1e9 * unit());
        if (maybe()) e.map = render::Map::Globe;
        e.view = view();
        e.stereo.mode = static_cast<app::Stereo>(random_() % 5);
        if (maybe()) e.stereo.eyeDistance = maybe() ? 0 : unit();
        if (maybe()) e.stereo.convergence = 0.01 + unit();
        e.size = {pixels(), pixels()};
        if (maybe()) e.play = play();
        if (app::sweepOf(e) && maybe()) {
            e.oneTick = true;
            e.play.tick =
                static_cast<std::int64_t>(random_()) & std::numeric_limits<std::int64_t>::max();
            e.play.tick %= app::ticksOf(*app::sweepOf(e));
        }
        return e;
    }

 private:
    static constexpr const char* kFiles[] = {"/data/run/fire.nc", "/data/run/b/c d.nc",
                                             "/other/é 世界.nc",  "/data/x.nc",
                                             "/data/run/'q'.nc",  "/data/r\xe9n/100%41.nc"};
    static constexpr const char* kNames[] = {"T", "air temperature", "θ", "a\"b\\c\n", "0"};

    template <typename T, std::size_t N>
    T pick(const T (&from)[N]) {
        return from[random_() % N];
    }
    int pixels() { return 1 + static_cast<int>(random_() % 16384); }
    bool maybe() { return random_() % 2 == 0; }
    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    double number() {
        const double awkward[] = {0,       -0.0, 1.0 / 3, 1e300,  -1e300, 5e-324,
                                  600,     0.1,  -2.5,    1e-300, 1e20,   9007199254740993.0,
                                  1e15 + 1};
        return random_() % 3 == 0 ? awkward[random_() % std::size(awkward)]
                                  : std::ldexp(unit() - 0.5, static_cast<int>(random_() % 80) - 40);
    }
    timeseries::Number exact() {
        if (random_() % 4 == 0) return (std::int64_t{1} << 60) + static_cast<int>(random_() % 9);
        if (random_() % 8 == 0) return std::numeric_limits<std::uint64_t>::max() - random_() % 9;
        return number();
    }
    timeseries::RangeSet ranges() {
        for (;;) {
            std::vector<timeseries::Range> some(1 + random_() % 3);
            for (auto& range : some) {
                range = {{exact(), maybe()}, {exact(), maybe()}};
                if (timeseries::compare(range.lo.value, range.hi.value) > 0)
                    std::swap(range.lo, range.hi);
                if (random_() % 6 == 0) range.lo = {-app::kInfinity, random_() % 4 == 0};
                if (random_() % 6 == 0) range.hi = {app::kInfinity, random_() % 4 == 0};
            }
            if (timeseries::RangeSet set(some); !set.empty()) return set;
        }
    }
    app::LayerChoice styled(timeseries::RangeSet set) {
        app::LayerChoice layer{std::move(set), {}, {}};
        if (maybe()) layer.opacity = unit();
        if (random_() % 3 == 0) layer.model = maybe() ? app::Model::Points : app::Model::Cells;
        layer.visible = random_() % 4 != 0;
        switch (random_() % 3) {
            case 0:
                layer.color = glm::dvec3(random_() % 256, random_() % 256, random_() % 256) / 255.0;
                break;
            case 1: {
                app::MapChoice map{
                    *render::colorMapNamed(render::colorMapNames()[random_() % 4]), {}, {}};
                if (maybe()) map.lo = number();
                if (maybe()) map.hi = number();
                layer.color = map;
                break;
            }
            default:
                break;
        }
        return layer;
    }
    app::ViewChoice view() {
        app::ViewChoice view{720 * unit() - 360, 180 * unit() - 90, {}};
        if (maybe()) view.distance = 0.01 + 9 * unit();
        if (maybe()) view.target = {2 * unit() - 1, 2e6 * unit() - 1e6, unit()};
        if (maybe()) view.projection = app::Projection::Orthographic;
        if (maybe()) view.shift = glm::dvec2(2 * unit() - 1, 2 * unit() - 1);
        return view;
    }
    app::PlayChoice play() {
        app::PlayChoice play;
        if (maybe()) play.time.first = random_() % 40;
        if (maybe()) play.time.last = play.time.first + random_() % 40;
        if (maybe()) play.time.stride = 1 + random_() % 9;
        play.time.ending = static_cast<timeseries::Ending>(random_() % 3);
        if (maybe()) play.time.direction = timeseries::Direction::Backward;
        if (maybe()) play.time.pace = timeseries::Pace::RealTimes;
        if (maybe()) play.time.stepsPerSecond = 60 * unit();
        if (maybe()) play.time.timeUnitsPerSecond = maybe() ? 0 : 1e9 * unit();
        play.timeMoves = maybe();
        play.sweepMoves = maybe();
        if (maybe()) play.tick = static_cast<std::int64_t>(random_() % (1 << 30));
        return play;
    }
    app::ClipBox clip() {
        app::ClipBox box{};
        for (int a = 0; a < 3; ++a) {
            const double x = number(), y = number();
            box.lo[a] = maybe() ? std::min(x, y) : -std::numeric_limits<double>::infinity();
            box.hi[a] = maybe() ? std::max(x, y) : std::numeric_limits<double>::infinity();
        }
        return box;
    }
    std::mt19937_64 random_;
};

}  // namespace tests

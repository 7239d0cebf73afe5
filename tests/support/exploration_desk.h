// An Exploration of scripted worlds, and what a front end does with it.
#pragma once

#include <map>

#include "app/choices/sweep_edits.h"
#include "app/exploration/exploration.h"
#include "tests/support/scripted_reader.h"
#include "tests/support/selection_oracle.h"

namespace tests {

// An Exploration of worlds by file name, and a front end that sleeps until it is woken.
struct ExplorationDesk {
    explicit ExplorationDesk(std::map<std::string, World> made = {{"a", {}}},
                             std::uint64_t budgetBytes = std::uint64_t{1} << 30)
        : worlds(std::make_shared<std::map<std::string, World>>(std::move(made))),
          exploration(
              {.budgetBytes = budgetBytes,
               .wake = [script = script] { script->wake(); },
               .openDataset =
                   [script = script, worlds = worlds](auto named, const std::string& variable) {
                       const std::string name = named.front().string();
                       const auto world = worlds->find(name);
                       if (world == worlds->end())
                           throw timeseries::FileError(name + ": cannot be opened");
                       return scriptedDataset(world->second, script, name, variable);
                   }}) {}

    // Frames in which no time passes, each after something came, until it holds.
    template <typename Condition>
    void until(const Condition& holds) {
        for (exploration.advance({}); !holds(); exploration.advance({})) script->waitForWake();
    }
    void startOpening(const std::string& file) {
        exploration.open(std::vector<std::filesystem::path>{file});
    }
    void untilOpened() {
        until([&] { return !exploration.opening(); });
    }
    void open(const std::string& file) {
        startOpening(file);
        untilOpened();
    }
    void untilShown(std::size_t step) {
        until([&] { return exploration.shown()->step == step; });
    }
    void untilAllSeen() {
        until([&] {
            const timeseries::Series& series = *exploration.series();
            for (std::size_t i = 0; i < series.stepCount(); ++i)
                if (series.summary(i) == nullptr) return false;
            return true;
        });
    }
    void choose(const std::string& variable) {
        app::Explorer next = exploration.explorer();
        next.variable = variable;
        exploration.edit(next);
    }
    // A window of values plus or minus delta begins to go through the ranges.
    void sweep(const char* ranges, double delta = 0,
               timeseries::SweepPath path = timeseries::SweepPath::Swing) {
        app::Explorer next = exploration.explorer();
        app::setSweep(
            next,
            timeseries::SweepSettings{
                .animation = timeseries::RangeSet::parse(ranges), .delta = delta, .path = path});
        exploration.edit(next);
    }
    std::size_t asked() const { return exploration.explorer().steps->first; }
    std::size_t shownStep() const { return exploration.shown()->step; }
    std::vector<std::string> errors() const {
        std::vector<std::string> texts;
        for (const app::Exploration::Message& m : exploration.messages())
            if (m.isError) texts.push_back(m.text);
        return texts;
    }

    std::shared_ptr<Script> script = std::make_shared<Script>();
    // May become others while nothing is being opened.
    std::shared_ptr<std::map<std::string, World>> worlds;
    app::Exploration exploration;
};

inline app::LayerChoice layer(const char* ranges, bool visible = true) {
    return {.ranges = timeseries::RangeSet::parse(ranges),
            .color = glm::dvec3(1, 0, 0),
            .opacity = 0.5,
            .visible = visible};
}

// As PointCounts says it, value by value.
inline app::PointCounts bruteForce(const World& world, const app::Shown& shown) {
    const app::Explorer& e = shown.explorer;
    const auto at = std::ranges::find(world.variables, e.variable) - world.variables.begin();
    const auto kept = e.keep.value_or(timeseries::RangeSet::everything());
    app::PointCounts counts;
    counts.layers.resize(e.layers.size());
    std::optional<timeseries::Range> window;
    if (const auto* const sweep = app::sweepOf(e))
        window = timeseries::ValueSweep(*sweep).window(e.play.tick);
    for (std::size_t i = 0; i < world.edge * world.edge * world.edge; ++i) {
        const float value = world.value(static_cast<std::size_t>(at), shown.step, i);
        ++counts.total;
        if (!oracle::holds(kept.ranges(), value)) continue;
        ++counts.kept;
        bool selected = false;
        for (std::size_t k = 0; k < e.layers.size(); ++k) {
            const bool holds = k == 0 && window ? oracle::holds(*window, value)
                                                : oracle::holds(e.layers[k].ranges.ranges(), value);
            if (!holds) continue;
            ++counts.layers[k];
            selected = selected || e.layers[k].visible;
        }
        if (selected) ++counts.selected;
    }
    return counts;
}

}  // namespace tests

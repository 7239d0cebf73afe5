#include "app/exploration/chosen_data.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/choices/choice_text.h"
#include "app/choices/clip_flaw.h"
#include "app/choices/first_look.h"
#include "app/choices/map_flaw.h"
#include "app/files/chosen_axes.h"
#include "app/files/progress.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"

namespace app {
namespace {

Steps sample(StepSource& source, const std::vector<std::size_t>& steps) {
    Steps sampled;
    for (const std::size_t step : {steps.front(), steps[steps.size() / 2], steps.back()})
        sampled[step] = source.get(step, step);
    return sampled;
}

std::optional<timeseries::Range> endsOfAll(const Explorer& e, StepSource& source,
                                           const std::vector<std::size_t>& steps) {
    Progress progress("step", steps.size());
    std::optional<timeseries::Range> all;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        progress.at(i);
        const std::size_t next = steps[std::min(i + 1, steps.size() - 1)];
        try {
            all = around(all, endsOf(e, *source.get(steps[i], next)));
        } catch (const timeseries::FileError&) {
            // Told when its turn comes.
        }
    }
    return all;
}

}  // namespace

ChosenData openChosen(const Explorer& choices) {
    Explorer e = choices;
    OpenDataset dataset = openDataset(e.files, e.variable);
    e.variable = dataset.variable.name;
    chooseAxes(dataset, e.axes);
    const auto expectClip = [&](const timeseries::Grid& grid) {
        if (!e.clip) return;
        if (const std::string flaw = clipFlaw(*e.clip, grid); !flaw.empty())
            throw ChoiceError(flaw);
    };
    const bool mayMove = dataset.variable.grid->mesh() && dataset.stepCount() > 1;
    if (!mayMove) expectClip(*dataset.variable.grid);
    if (e.map == render::Map::Globe)
        if (const std::string flaw = globeFlaw(*dataset.variable.grid); !flaw.empty())
            throw ChoiceError(flaw);
    lookFirst(e, *dataset.variable.grid);
    findStepThen(dataset, e);
    if (!e.steps) e.steps = StepChoice{dataset.defaultStep, dataset.defaultStep};
    std::vector<std::size_t> steps = stepsOf(dataset, *e.steps);
    auto source = std::make_unique<StepSource>(
        dataset, e.keep.value_or(timeseries::RangeSet::everything()), rangesNeeded(e));
    if (mayMove && e.clip && steps.size() == 1)
        expectClip(source->get(steps.front(), steps.front())->grid());
    if (sweepsOn(e))
        if (const auto all = endsOfAll(e, *source, steps)) endSweeps(e, *all);
    if (needsSamples(e)) e = resolved(e, sample(*source, steps));
    return {std::move(dataset), std::move(e), std::move(steps), std::move(source)};
}

}  // namespace app

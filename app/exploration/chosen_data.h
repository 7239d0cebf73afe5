// Data opened as an explorer's choices ask for them, by those who wait: for commands without a
// window.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/choices/explorer.h"
#include "app/exploration/step_source.h"
#include "app/files/dataset.h"

namespace app {

struct ChosenData {
    Dataset dataset;
    Explorer explorer;  // resolved, its variable and steps named
    std::vector<std::size_t> steps;
    std::unique_ptr<StepSource> source;
};

// Where something is left to choose from the data, it is chosen from the first, middle and last of
// the steps; where a sweep goes on as far as the data do, that is asked of each step. Throws
// FileError; ChoiceError for choices that do not fit the data.
ChosenData openChosen(const Explorer& choices);

}  // namespace app

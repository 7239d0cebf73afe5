// A dataset made by hand, as an Exploration shows one: for those who draw what is shown.
#pragma once

#include "app/exploration/exploration.h"
#include "tests/support/scenes.h"

namespace tests {

// Steps of noise (each other noise) on n^3 points, values in [0, 1); nothing reads them.
struct ShownSteps {
    explicit ShownSteps(std::size_t n, std::size_t count = 2) {
        dataset.variable.name = "noise";
        dataset.variable.time = std::make_shared<const timeseries::TimeAxis>(
            timeseries::TimeAxis{"time", "s", "", std::vector(count, timeseries::TimePoint{})});
        for (std::size_t i = 0; i < count; ++i)
            steps.push_back(std::make_shared<const timeseries::SortedStep>(
                noise(cube(n), static_cast<unsigned>(i + 1))));
        dataset.variable.grid = steps[0]->sharedGrid();
        explorer.files = {"noise.nc"};
        explorer.size = {200, 150};
        explorer.model = app::Model::Points;  // most tests are of them
        explorer.layers = {layer("0.1:0.4", app::MapChoice{{}, 0.1, 0.4}),
                           layer("0.8:0.9", glm::dvec3(255, 128, 0) / 255.0)};
    }
    static app::LayerChoice layer(const char* ranges,
                                  std::variant<glm::dvec3, app::MapChoice> color) {
        return {.ranges = timeseries::RangeSet::parse(ranges), .color = color, .opacity = 0.2};
    }
    app::Shown shown(std::size_t step = 0) const { return {explorer, dataset, step, steps[step]}; }

    app::Dataset dataset;
    app::Explorer explorer;
    std::vector<std::shared_ptr<const timeseries::SortedStep>> steps;
};

}  // namespace tests

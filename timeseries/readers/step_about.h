// What a sorted step on disk says of itself where there is no other file behind it: what it is of,
// when, and where its points lie.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/index/step_file.h"

namespace timeseries {

// Points along an axis: told by how they are spaced, any number of them takes no byte of the file.
constexpr std::size_t kMostAlong = std::size_t{1} << 24;

struct StepAbout {
    struct Place {
        std::string name, units;
        double origin = 0, spacing = 1;   // of point i: origin + i spacing
        std::vector<double> coordinates;  // or where each one is, instead
        std::vector<double> evenly(std::size_t points) const {
            std::vector<double> at(points);
            for (std::size_t i = 0; i < points; ++i)
                at[i] = origin + static_cast<double>(i) * spacing;
            return at;
        }
    };
    std::string variable, units;
    double time = 0;
    std::string timeUnits;
    std::array<Place, 3> axes;
};

// For writeStep() and its like. REQUIRES: finite numbers.
std::string textOf(const StepAbout& about);
// None where the text is another one. Throws StepFileError for what it should not say.
std::optional<StepAbout> stepAboutOf(const StepFile& file);

}  // namespace timeseries

#include "timeseries/readers/step_about.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace timeseries {
namespace {

using nlohmann::ordered_json;

StepAbout::Place placeOf(const ordered_json& json) {
    StepAbout::Place place;
    place.name = json.at("name").get<std::string>();
    place.units = json.at("units").get<std::string>();
    if (json.contains("coordinates")) {
        place.coordinates = json.at("coordinates").get<std::vector<double>>();
    } else {
        place.origin = json.at("origin").get<double>();
        place.spacing = json.at("spacing").get<double>();
    }
    return place;
}

}  // namespace

std::string textOf(const StepAbout& about) {
    ordered_json axes = ordered_json::array();
    for (const StepAbout::Place& place : about.axes) {
        ordered_json axis{{"name", place.name}, {"units", place.units}};
        if (place.coordinates.empty()) {
            axis["origin"] = place.origin;
            axis["spacing"] = place.spacing;
        } else {
            axis["coordinates"] = place.coordinates;
        }
        axes.push_back(std::move(axis));
    }
    const ordered_json json{{"alone",
                             {{"variable", about.variable},
                              {"units", about.units},
                              {"time", about.time},
                              {"timeUnits", about.timeUnits},
                              {"axes", std::move(axes)}}}};
    return json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

std::optional<StepAbout> stepAboutOf(const StepFile& file) try {
    const ordered_json json = ordered_json::parse(file.about());
    if (!json.contains("alone")) return std::nullopt;
    const ordered_json& alone = json.at("alone");
    StepAbout about;
    about.variable = alone.at("variable").get<std::string>();
    about.units = alone.at("units").get<std::string>();
    about.time = alone.at("time").get<double>();
    about.timeUnits = alone.at("timeUnits").get<std::string>();
    for (std::size_t a = 0; a < 3; ++a) about.axes[a] = placeOf(alone.at("axes").at(a));
    return about;
} catch (const ordered_json::exception& error) {
    throw DamagedStepError(
        fmt::format("{}: expected what the step is of, found {}", file.name(), error.what()));
}

}  // namespace timeseries

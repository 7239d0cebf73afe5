#include "timeseries/readers/cf/cf_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "timeseries/readers/cf/cf_mpas.h"
#include "timeseries/readers/cf/cf_seam.h"
#include "timeseries/readers/cf/cf_values.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/placed_by_index.h"
#include "timeseries/readers/text/units.h"

namespace timeseries {
namespace {

// Greater values lie lower: CF 1.10, section 4.3, asks for `positive` unless the units are those of
// pressure.
bool pointsDown(const NcVariable& coordinate) {
    const std::string positive = lower(coordinate.text("positive"));
    if (!positive.empty()) return positive == "down";
    return sameDimension(coordinate.text("units"), "Pa") ||
           coordinate.text("standard_name") == "depth";
}

// Measured in degrees or metres, not counted: it places points though 2-D coordinates exist too
// (rotated poles and map projections, CF 1.10, section 5.6).
bool measured(const NcVariable* coordinate) {
    if (!coordinate) return false;
    const std::string units = lower(coordinate->text("units"));
    // By its name, for to udunits a degree is a number like 1.
    return units.starts_with("deg") || units.starts_with("rad") || sameDimension(units, "m");
}

Axis axisOf(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
            std::size_t position, std::vector<std::string>& notes) {
    const NcDimension& dimension = file.header().dimension(variable, position);
    const NcVariable* coordinate = fileAxes.coordinateOf(variable, position);
    std::optional<Axis> ofMpas = coordinate ? std::nullopt : mpasDepthsOf(file, variable, position);
    if (!coordinate && !ofMpas) {
        notePlacedByIndex(notes, dimension.name, "coordinates");
        return {dimension.name, "index", indexCoordinates(dimension.length), false};
    }
    Axis axis = ofMpas ? std::move(*ofMpas)
                       : Axis{std::string(coordinate->baseName()), coordinate->text("units"),
                              valuesOf(file, *coordinate), pointsDown(*coordinate)};
    if (coordinate && isLongitude(*coordinate)) goOnAcrossTheSeam(axis.coordinates);
    if (const std::string why = flawOf(axis.coordinates); !why.empty()) {
        notes.push_back(axis.name + " is placed by index: " + why);
        axis.units = "index";
        axis.coordinates = indexCoordinates(dimension.length);
    }
    return axis;
}

// Levels that stand for heights which depend on another field (CF 1.10, section 4.3.3).
void noteLevels(const NcHeader& header, const FileAxes& fileAxes, const NcVariable& variable,
                std::size_t position, std::vector<std::string>& notes) {
    const NcVariable* level = fileAxes.coordinateOf(variable, position);
    if (!level) return;
    std::vector<const NcVariable*> candidates{level};
    for (const std::string& name : words(variable.text("coordinates")))
        if (const NcVariable* other = header.find(name, variable.group))
            if (other != level && other->dimensions == level->dimensions)
                candidates.push_back(other);
    for (const NcVariable* candidate : candidates) {
        const std::string terms = candidate->text("formula_terms");
        const std::string units = candidate->text("units"), kind = candidate->text("standard_name");
        const bool hybrid = !terms.empty() || lower(units).starts_with("hybrid") ||
                            lower(units) == "sigma_level" || kind.starts_with("ocean_s") ||
                            (kind.starts_with("atmosphere_") && kind.ends_with("_coordinate"));
        if (!hybrid) continue;
        notes.push_back(fmt::format(
            "{} is a level, not a height: used as it is{}", level->baseName(),
            terms.empty() ? "" : fmt::format("; {} has formula terms {}", candidate->name, terms)));
        return;
    }
}

// Of the space that listed places lie in.
Axis listedAxis(const NcHeader& header, const ColumnPlaces& list, bool isX) {
    const std::string& name = isX ? list.x : list.y;
    const NcVariable& place = *header.find(name, "");
    std::string units = list.units.empty() ? place.text("units") : list.units;
    if (degreesIn(units) != 1) {  // as they are read
        const auto kind = kindByAttributes(place);
        const bool isOnEarth = !list.units.empty() || kind == (isX ? AxisKind::X : AxisKind::Y);
        units = !isOnEarth ? "degrees" : isX ? "degrees_east" : "degrees_north";
    }
    const std::string& own = isX ? list.xName : list.yName;
    return {own.empty() ? std::string(place.baseName()) : own, units, {0.0}, false};
}

// Where each column has heights of its own: unless there are too many of them.
void takeHeights(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                 const Roles& roles, bool upright, FoundColumns& found,
                 std::vector<std::string>& notes) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 26;  // 24 bytes each, of every step
    const NcHeader& header = file.header();
    const auto formula = heightFormulaOf(header, variable, roles);
    if (!formula) return;
    std::uint64_t points = 1;
    for (const auto& position : {roles.x, roles.y, roles.z}) {
        if (!position) continue;  // of a list
        const std::uint64_t length = header.dimension(variable, *position).length;
        if (length == 0 || points > kMost / length) {
            notes.push_back("its heights by formula are not worked out for more than 2^26 points");
            return;
        }
        points *= length;
    }
    if (upright) {
        const NcVariable* const x = fileAxes.coordinateOf(variable, *roles.x);
        const NcVariable* const y = fileAxes.coordinateOf(variable, *roles.y);
        if (!x || !y) return;
        found.places = {.x = x->name, .y = y->name, .upright = true};
    }
    found.places->heights = formula;
    found.places->inTime = found.places->inTime || formula->inTime;
}

}  // namespace

VariableAxes axesOf(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                    const Roles& roles, std::span<const NcVariable* const> geographic,
                    const std::optional<ColumnPlaces>& list, std::vector<std::string>& notes) {
    const NcHeader& header = file.header();
    const std::array positions{roles.x, roles.y, roles.z};
    const std::array<const char*, 3> names{"x", "y", "z"};
    FoundColumns found{list, ""};
    if (!list && roles.x && roles.y &&
        !(measured(fileAxes.coordinateOf(variable, *roles.x)) &&
          measured(fileAxes.coordinateOf(variable, *roles.y))))
        found = columnsOf(header, variable, roles, geographic);
    if (!found.told.empty() && !found.places)
        notes.push_back("drawn in index space: 2-D coordinates " + found.told);

    const bool upright = !found.places && found.told.empty();
    if (roles.x && roles.z && (list || (roles.y && (found.places || upright))))
        takeHeights(file, fileAxes, variable, roles, upright, found, notes);
    const bool hasHeights = found.places && found.places->heights;
    std::vector<std::string> ofLevels;  // which place nothing then
    VariableAxes result{{}, found.places, {}};
    if (upright && roles.x && roles.y)
        result.earth = earthOf(header, fileAxes, variable, roles, geographic);
    std::array<Axis, 3>& axes = result.axes;
    for (std::size_t i = 0; i < 3; ++i) {
        if (i < 2 && list) {
            axes[i] = listedAxis(header, *list, i == 0);
            continue;
        }
        if (!positions[i]) {
            axes[i] = {names[i], "index", {0.0}, false};
            continue;
        }
        const NcDimension& dimension = header.dimension(variable, *positions[i]);
        if (dimension.length > kMaxAxis)
            file.fail("dimension '" + dimension.name + "'",
                      fmt::format("expected at most 2^24 points along an axis, found {}",
                                  dimension.length));
        if (i < 2 && found.places && !found.places->upright) {
            const NcVariable& place = *header.find(i == 0 ? found.places->x : found.places->y, "");
            axes[i] = {std::string(place.baseName()), place.text("units"),
                       indexCoordinates(dimension.length), false};
        } else if (i < 2 && !found.told.empty())
            axes[i] = {dimension.name, "index", indexCoordinates(dimension.length), false};
        else
            axes[i] = axisOf(file, fileAxes, variable, *positions[i],
                             i == 2 && hasHeights ? ofLevels : notes);
    }
    if (roles.z && !hasHeights) noteLevels(header, fileAxes, variable, *roles.z, notes);
    return result;
}

}  // namespace timeseries

#include "timeseries/readers/cf/cf_columns.h"

#include <algorithm>
#include <array>

#include "timeseries/readers/cf/cf_seam.h"
#include "timeseries/readers/cf/cf_terms.h"
#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

constexpr std::size_t kShownCoordinates = 8;

// Not of the levels.
bool spansColumns(const NcHeader& header, const NcVariable& coordinate, const NcVariable& variable,
                  const Roles& roles) {
    Roles flat = roles;
    flat.z.reset();
    return timeseries::spansNoMore(header, coordinate, variable, flat);
}

}  // namespace

FoundColumns columnsOf(const NcHeader& header, const NcVariable& variable, const Roles& roles,
                       std::span<const NcVariable* const> geographic) {
    const std::size_t x = variable.dimensions[*roles.x], y = variable.dimensions[*roles.y];
    FoundColumns found;
    std::size_t told = 0;
    std::array<std::vector<const NcVariable*>, 2> all, named;
    const std::vector<std::string> names = words(variable.text("coordinates"));
    for (const NcVariable* other : geographic) {
        const auto& d = other->dimensions;
        const bool spans = std::ranges::find(d, x) != d.end() && std::ranges::find(d, y) != d.end();
        if (!spans || d.size() > 3) continue;
        if (++told <= kShownCoordinates)
            found.told += (found.told.empty() ? "" : " and ") + header.declaration(*other);
        if (!spansColumns(header, *other, variable, roles)) continue;
        const std::size_t which = kindByAttributes(*other) == AxisKind::X ? 0 : 1;
        all[which].push_back(other);
        const auto isIt = [&](const std::string& name) {
            return header.find(name, variable.group) == other;
        };
        if (std::ranges::any_of(names, isIt)) named[which].push_back(other);
    }
    if (told > kShownCoordinates) found.told += " and others";
    const auto only = [&](std::size_t which) -> const NcVariable* {
        if (named[which].size() == 1) return named[which][0];
        return named[which].empty() && all[which].size() == 1 ? all[which][0] : nullptr;
    };
    if (const NcVariable* lon = only(0), *lat = only(1); lon && lat)
        found.places = {.x = lon->name,
                        .y = lat->name,
                        .inTime = hasTime(*lon, variable, roles) || hasTime(*lat, variable, roles)};
    return found;
}

std::shared_ptr<const Mesh> meshOf(const CfFile& file, const NcVariable& variable,
                                   const Roles& roles, const ColumnPlaces& columns, const Axis& z,
                                   std::size_t step) {
    const NcVariable* const lon = file.header().find(columns.x, "");
    const NcVariable* const lat = file.header().find(columns.y, "");
    if (!lon || !lat || !spansColumns(file.header(), *lon, variable, roles) ||
        !spansColumns(file.header(), *lat, variable, roles))
        file.fail("variable '" + variable.name + "'", "expected the places of its columns, " +
                                                          columns.x + " and " + columns.y +
                                                          ", as when the series was opened");
    const TermValues xs = termOf(file, *lon, variable, roles, step),
                     ys = termOf(file, *lat, variable, roles, step);
    MeshPlaces places{
        .size = {file.header().dimension(variable, *roles.x).length,
                 file.header().dimension(variable, *roles.y).length, z.coordinates.size()},
        .at = {},
        .levels = columns.heights ? std::vector<double>() : z.coordinates,
        .period = {turnIn(lon->text("units")), 0, 0}};
    for (std::size_t j = 0; j < places.size[1]; ++j)
        for (std::size_t i = 0; i < places.size[0]; ++i)
            places.at.emplace_back(xs.at(i, j, 0), ys.at(i, j, 0), 0);
    goOnAcrossTheSeam(places.at, places.size, places.period.x);
    if (!columns.heights) return std::make_shared<const Mesh>(places);
    const auto heights = heightsOf(file, variable, roles, *columns.heights, step);
    const std::size_t count = places.at.size();
    places.at.reserve(heights.size());
    for (std::size_t n = count; n < heights.size(); ++n) places.at.push_back(places.at[n - count]);
    for (std::size_t n = 0; n < heights.size(); ++n) places.at[n].z = heights[n];
    return std::make_shared<const Mesh>(std::move(places));
}

}  // namespace timeseries

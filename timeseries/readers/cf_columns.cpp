#include "timeseries/readers/cf_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "timeseries/readers/cf_packing.h"
#include "timeseries/readers/cf_values.h"
#include "timeseries/readers/units.h"

namespace timeseries {
namespace {

constexpr std::size_t kShownCoordinates = 8;

// Nothing but the two dimensions and, perhaps, the variable's time or what is as long as 1.
bool spansNoMore(const NcHeader& header, const NcVariable& coordinate, const NcVariable& variable,
                 const Roles& roles) {
    for (std::size_t i = 0; i < coordinate.dimensions.size(); ++i) {
        const std::size_t d = coordinate.dimensions[i];
        const bool isTime = roles.t && d == variable.dimensions[*roles.t];
        if (d != variable.dimensions[*roles.x] && d != variable.dimensions[*roles.y] && !isTime &&
            header.dimension(coordinate, i).length != 1)
            return false;
    }
    return coordinate.type.has_value();
}

bool hasTime(const NcVariable& coordinate, const NcVariable& variable, const Roles& roles) {
    return roles.t && std::ranges::find(coordinate.dimensions, variable.dimensions[*roles.t]) !=
                          coordinate.dimensions.end();
}

// [y][x], x fastest, of one step; not a number where the file has none.
std::vector<double> planeOf(const NetcdfFile& file, const NcVariable& coordinate,
                            const NcVariable& variable, const Roles& roles, std::size_t step) {
    const Packing packing = packingOf(
        coordinate, [&](const std::string& what) { file.failAttribute(coordinate, what); });
    const std::size_t rank = coordinate.dimensions.size();
    std::vector<std::size_t> start(rank), count(rank, 1);
    StridedLayout layout{{1, 1, 1}, {0, 0, 0}};
    std::size_t stride = 1;
    for (std::size_t i = rank; i-- > 0;) {
        const std::size_t d = coordinate.dimensions[i];
        const std::size_t length = file.header().dimension(coordinate, i).length;
        const bool isX = d == variable.dimensions[*roles.x],
                   isY = d == variable.dimensions[*roles.y];
        if (isX || isY) {
            count[i] = length;
            layout.size[isX ? 0 : 1] = length;
            layout.stride[isX ? 0 : 1] = stride;
            stride *= length;
        } else if (roles.t && d == variable.dimensions[*roles.t]) {
            start[i] = std::min(step, length - 1);
        }
    }
    if (const std::string why = file.tooLarge(coordinate, stride); !why.empty())
        throw std::invalid_argument(why);
    Field plane;
    unpack(
        packing, layout, [&](void* values) { file.read(coordinate, start, count, values); }, plane);
    std::vector<double> values;
    std::visit([&](const auto& all) { values.assign(all.begin(), all.end()); }, plane.values);
    for (std::size_t i = 0; i < plane.missing.size(); ++i)
        if (plane.missing[i]) values[i] = std::nan("");
    return values;
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
        if (!spansNoMore(header, *other, variable, roles)) continue;
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

std::shared_ptr<const Mesh> meshOf(const NetcdfFile& file, const NcVariable& variable,
                                   const Roles& roles, const ColumnPlaces& columns, const Axis& z,
                                   std::size_t step) {
    const NcVariable* const lon = file.header().find(columns.x, "");
    const NcVariable* const lat = file.header().find(columns.y, "");
    if (!lon || !lat || !spansNoMore(file.header(), *lon, variable, roles) ||
        !spansNoMore(file.header(), *lat, variable, roles))
        file.fail("variable '" + variable.name + "'", "expected the places of its columns, " +
                                                          columns.x + " and " + columns.y +
                                                          ", as when the series was opened");
    const auto xs = planeOf(file, *lon, variable, roles, step),
               ys = planeOf(file, *lat, variable, roles, step);
    MeshPlaces places{
        .size = {file.header().dimension(variable, *roles.x).length,
                 file.header().dimension(variable, *roles.y).length, z.coordinates.size()},
        .at = {},
        .levels = z.coordinates,
        .period = {turnIn(lon->text("units")), 0, 0}};
    places.at.reserve(xs.size());
    for (std::size_t i = 0; i < std::min(xs.size(), ys.size()); ++i)
        places.at.emplace_back(xs[i], ys[i], 0);
    return std::make_shared<const Mesh>(std::move(places));
}

}  // namespace timeseries

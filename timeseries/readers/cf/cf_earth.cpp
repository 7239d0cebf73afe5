#include "timeseries/readers/cf/cf_earth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "timeseries/readers/cf/cf_columns.h"
#include "timeseries/readers/cf/cf_seam.h"
#include "timeseries/readers/cf/cf_terms.h"
#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

// Of a variable's grid_mapping: "pole", or "pole: rlon rlat other: lon lat".
std::optional<RotatedPole> poleOf(const NcHeader& header, const NcVariable& variable) {
    for (std::string name : words(variable.text("grid_mapping"))) {
        if (name.ends_with(':')) name.pop_back();
        const NcVariable* const mapping = header.find(name, variable.group);
        if (!mapping || mapping->text("grid_mapping_name") != "rotated_latitude_longitude")
            continue;
        const auto number = [&](const char* attribute) {
            const std::vector<double> numbers = mapping->numbers(attribute);
            return numbers.size() == 1 && std::isfinite(numbers[0]) ? std::optional(numbers[0])
                                                                    : std::nullopt;
        };
        const auto longitude = number("grid_north_pole_longitude"),
                   latitude = number("grid_north_pole_latitude");
        if (longitude && latitude)
            return RotatedPole{*longitude, *latitude,
                               number("north_pole_grid_longitude").value_or(0)};
    }
    return std::nullopt;
}

// x fastest.
struct Lattice {
    std::vector<double> x, y;  // the axes' own coordinates, in degrees where they are angles
    std::vector<double> longitudes{}, latitudes{};

    void add(const glm::dvec2& at) {
        longitudes.push_back(at.x);
        latitudes.push_back(at.y);
    }
    // To a hundredth of a step, wherever there is a place.
    bool isAsItsAxes() const {
        const auto tolerance = [](const std::vector<double>& c) {
            return 0.01 * std::abs(c.back() - c.front()) / static_cast<double>(c.size());
        };
        const double eastward = tolerance(x), northward = tolerance(y);
        for (std::size_t n = 0; n < longitudes.size(); ++n) {
            const double east = longitudes[n] - x[n % x.size()];
            if (std::abs(east - 360 * std::round(east / 360)) > eastward ||
                std::abs(latitudes[n] - y[n / x.size()]) > northward)
                return false;
        }
        return true;
    }
};

const NcVariable& coordinateIn(const CfFile& file, const std::string& name) {
    const NcVariable* const found = file.header().find(name, "");
    if (!found) file.fail("variable '" + name + "'", "expected it, as when the series was opened");
    return *found;
}

void read(const CfFile& file, const NcVariable& variable, const Roles& roles,
          const EarthTold::Columns& names, Lattice& into) {
    const NcVariable &lon = coordinateIn(file, names.longitude),
                     &lat = coordinateIn(file, names.latitude);
    const TermValues x = termOf(file, lon, variable, roles, 0),
                     y = termOf(file, lat, variable, roles, 0);
    const double eastward = degreesIn(lon.text("units")), northward = degreesIn(lat.text("units"));
    for (std::size_t j = 0; j < into.y.size(); ++j)
        for (std::size_t i = 0; i < into.x.size(); ++i)
            into.add({eastward * x.at(i, j, 0), northward * y.at(i, j, 0)});
}

std::vector<double> coordinatesOf(const CfFile& file, const std::string& name) {
    const NcVariable& coordinate = coordinateIn(file, name);
    std::vector<double> values = valuesOf(file, coordinate);
    for (double& value : values) value *= degreesIn(coordinate.text("units"));
    return values;
}

}  // namespace

std::optional<EarthTold> earthOf(const NcHeader& header, const FileAxes& fileAxes,
                                 const NcVariable& variable, const Roles& roles,
                                 std::span<const NcVariable* const> geographic) {
    const NcVariable* const x = fileAxes.coordinateOf(variable, *roles.x);
    const NcVariable* const y = fileAxes.coordinateOf(variable, *roles.y);
    if (!x || !y) return std::nullopt;
    std::vector<const NcVariable*> ofTheEarth;
    std::ranges::copy_if(geographic, std::back_inserter(ofTheEarth), [](const NcVariable* each) {
        return isLongitude(*each) || isLatitude(*each);
    });
    if (const auto places = columnsOf(header, variable, roles, ofTheEarth).places) {
        if (places->inTime) return std::nullopt;
        return EarthTold{EarthTold::Columns{places->x, places->y}, x->name, y->name};
    }
    const auto isAngle = [](const NcVariable& v) { return turnIn(v.text("units")) > 0; };
    const auto pole = poleOf(header, variable);
    if (!pole || !isAngle(*x) || !isAngle(*y)) return std::nullopt;
    return EarthTold{*pole, x->name, y->name};
}

namespace {

std::shared_ptr<const EarthPlaces> placesOf(const CfFile& file, const NcVariable& variable,
                                            const Roles& roles, const EarthTold& told) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 23;  // 16 bytes each while the file is open
    Lattice lattice{coordinatesOf(file, told.x), coordinatesOf(file, told.y)};
    if (lattice.x.empty() || lattice.y.size() > kMost / lattice.x.size())
        throw std::invalid_argument("there are more than 2^23 of them");
    if (const auto* const pole = std::get_if<RotatedPole>(&told.by)) {
        for (const double y : lattice.y)
            for (const double x : lattice.x) lattice.add(pole->onEarth({x, y}));
    } else {
        read(file, variable, roles, std::get<EarthTold::Columns>(told.by), lattice);
    }
    const bool isGeographic =
        isLongitude(*file.header().find(told.x, "")) && isLatitude(*file.header().find(told.y, ""));
    if (isGeographic && lattice.isAsItsAxes()) return nullptr;
    goOnAcrossTheSeam(lattice.longitudes, lattice.latitudes);
    std::vector<glm::dvec2> columns;
    columns.reserve(lattice.longitudes.size());
    for (std::size_t n = 0; n < lattice.longitudes.size(); ++n)
        columns.emplace_back(lattice.longitudes[n], lattice.latitudes[n]);
    return std::make_shared<const EarthPlaces>(std::move(columns));
}

}  // namespace

const CfEarth::Places& CfEarth::of(const CfFile& file, const NcVariable& variable,
                                   const Roles& roles, const EarthTold& told) {
    const auto before = std::ranges::find(read_, told, &Read::told);
    if (before != read_.end()) return before->places;
    Read read{told, {}};
    const auto fail = [&](const std::exception& error) { read.places.flaw = error.what(); };
    try {
        read.places.earth = placesOf(file, variable, roles, told);
    } catch (const FileError& error) {
        fail(error);
    } catch (const std::invalid_argument& error) {
        fail(error);
    }
    return read_.emplace_back(std::move(read)).places;
}

}  // namespace timeseries

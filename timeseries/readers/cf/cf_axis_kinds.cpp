#include "timeseries/readers/cf/cf_axis_kinds.h"

#include <algorithm>
#include <array>

#include "timeseries/readers/text/time_units.h"
#include "timeseries/readers/text/units.h"

namespace timeseries {
namespace {

using enum AxisKind;

bool isOneOf(std::string_view text, std::initializer_list<std::string_view> list) {
    return std::ranges::find(list, text) != list.end();
}

std::optional<AxisKind> byAxis(const NcVariable& v) {
    const std::string axis = lower(v.text("axis"));
    if (axis == "x") return X;
    if (axis == "y") return Y;
    if (axis == "z") return Z;
    if (axis == "t") return T;
    if (axis == "e") return Other;  // ensemble, as GrADS writes it
    return std::nullopt;
}

std::optional<AxisKind> byStandardName(const NcVariable& v) {
    const std::string name = standardName(v);
    if (isOneOf(name, {"longitude", "grid_longitude", "projection_x_coordinate",
                       "projection_x_angular_coordinate"}))
        return X;
    if (isOneOf(name, {"latitude", "grid_latitude", "projection_y_coordinate",
                       "projection_y_angular_coordinate"}))
        return Y;
    if (name == "time") return T;
    if (isOneOf(name, {"realization", "radiation_wavelength", "radiation_frequency"}) ||
        isOfForecast(v))
        return Other;
    if (isOneOf(name, {"depth", "altitude", "height", "air_pressure", "air_potential_temperature",
                       "model_level_number", "sea_water_pressure", "geopotential_height"}) ||
        name.starts_with("atmosphere_") || name.starts_with("ocean_s_coordinate") ||
        name.starts_with("ocean_sigma") || name.starts_with("ocean_double_sigma") ||
        name.starts_with("height_above_") || name.starts_with("depth_below_"))
        return v.dimensions.size() == 1 ? std::optional(Z) : std::nullopt;
    return std::nullopt;
}

bool isInDegreesEast(const NcVariable& v) {
    return isOneOf(lower(v.text("units")),
                   {"degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese"});
}

bool isInDegreesNorth(const NcVariable& v) {
    return isOneOf(lower(v.text("units")), {"degrees_north", "degree_north", "degree_n",
                                            "degrees_n", "degreen", "degreesn"});
}

std::optional<AxisKind> byUnits(const NcVariable& v) {
    const std::string units = lower(v.text("units"));
    // CF 1.10, sections 4.1 and 4.2.
    if (isInDegreesEast(v)) return X;
    if (isInDegreesNorth(v)) return Y;
    if (looksLikeTimeUnits(units)) return T;
    // CF 1.10, section 4.3: pressure is vertical; level, layer and sigma_level are the units of
    // dimensionless levels.
    if (isOneOf(units, {"level", "layer", "sigma_level", "hybrid_sigma_pressure"})) return Z;
    if (sameDimension(v.text("units"), "Pa")) return Z;
    return std::nullopt;
}

// A name alone, "depth" also as "depthu" or "depth_2".
struct NameRule {
    std::string_view name;
    AxisKind kind;
    bool prefix;
};
constexpr std::array kNames{
    NameRule{"time", T, true},
    NameRule{"t", T, false},
    NameRule{"ocean_time", T, false},
    NameRule{"record", T, false},
    NameRule{"bnds", Other, false},
    NameRule{"bounds", Other, false},
    NameRule{"nv", Other, false},
    NameRule{"nbnd", Other, true},
    NameRule{"nb2", Other, false},
    NameRule{"bound", Other, false},
    NameRule{"tbnds", Other, false},
    NameRule{"axis_nbounds", Other, false},
    NameRule{"ncorner", Other, true},
    NameRule{"corner", Other, true},
    NameRule{"nvert", Other, true},
    NameRule{"vertices", Other, false},
    NameRule{"comp", Other, true},
    NameRule{"vector", Other, true},
    NameRule{"member", Other, true},
    NameRule{"ens", Other, true},
    NameRule{"realization", Other, false},
    NameRule{"number", Other, false},
    NameRule{"ncells", List, true},
    NameRule{"cell", List, false},
    NameRule{"cells", List, false},
    NameRule{"node", List, false},
    NameRule{"nodes", List, false},
    NameRule{"nod2", List, true},
    NameRule{"nod3", List, true},
    NameRule{"nodes_2d", List, false},
    NameRule{"nodes_3d", List, false},
    NameRule{"elem", List, false},
    NameRule{"lon", X, true},
    NameRule{"rlon", X, false},
    NameRule{"x", X, false},
    NameRule{"west_east", X, true},
    NameRule{"xi_", X, true},
    NameRule{"ni", X, false},
    NameRule{"nx", X, false},
    NameRule{"nlon", X, false},
    NameRule{"i", X, false},
    NameRule{"xc", X, false},
    NameRule{"xh", X, false},
    NameRule{"xq", X, false},
    NameRule{"grid_longitude", X, false},
    NameRule{"lat", Y, true},
    NameRule{"rlat", Y, false},
    NameRule{"y", Y, false},
    NameRule{"south_north", Y, true},
    NameRule{"eta_rho", Y, false},
    NameRule{"eta_u", Y, false},
    NameRule{"eta_v", Y, false},
    NameRule{"eta_psi", Y, false},
    NameRule{"nj", Y, false},
    NameRule{"ny", Y, false},
    NameRule{"nlat", Y, false},
    NameRule{"j", Y, false},
    NameRule{"yc", Y, false},
    NameRule{"yh", Y, false},
    NameRule{"yq", Y, false},
    NameRule{"grid_latitude", Y, false},
    NameRule{"lev", Z, true},
    NameRule{"ilev", Z, false},
    NameRule{"plev", Z, true},
    NameRule{"mlev", Z, false},
    NameRule{"z", Z, false},
    NameRule{"z_", Z, true},
    NameRule{"zt", Z, false},
    NameRule{"zl", Z, false},
    NameRule{"zi", Z, false},
    NameRule{"depth", Z, true},
    NameRule{"height", Z, true},
    NameRule{"alt", Z, false},
    NameRule{"altitude", Z, false},
    NameRule{"pressure", Z, true},
    NameRule{"isobaric", Z, true},
    NameRule{"sigma", Z, true},
    NameRule{"s_rho", Z, false},
    NameRule{"s_w", Z, false},
    NameRule{"bottom_top", Z, true},
    NameRule{"model_level", Z, true},
    NameRule{"layer", Z, true},
    NameRule{"nz", Z, false},
    NameRule{"k", Z, false},
};

}  // namespace

std::string standardName(const NcVariable& v) {
    const std::string all = v.text("standard_name");
    return all.substr(0, all.find(' '));  // modifiers follow a blank
}

bool isOfForecast(const NcVariable& v) {
    return isOneOf(standardName(v), {"forecast_period", "forecast_reference_time"});
}

bool isLongitude(const NcVariable& coordinate) {
    return isInDegreesEast(coordinate) || standardName(coordinate) == "longitude";
}

bool isLatitude(const NcVariable& coordinate) {
    return isInDegreesNorth(coordinate) || standardName(coordinate) == "latitude";
}

std::optional<AxisKind> kindByAttributes(const NcVariable& coordinate) {
    if (const auto kind = byAxis(coordinate)) return kind;
    if (const auto kind = byStandardName(coordinate)) return kind;
    if (const auto kind = byUnits(coordinate)) return kind;
    const std::string positive = lower(coordinate.text("positive"));
    if (positive == "up" || positive == "down") return Z;
    return std::nullopt;
}

std::optional<AxisKind> kindByName(std::string_view name) {
    const std::string low = lower(name);
    for (const NameRule& rule : kNames)
        if (rule.prefix ? low.starts_with(rule.name) : low == rule.name) return rule.kind;
    return std::nullopt;
}

}  // namespace timeseries

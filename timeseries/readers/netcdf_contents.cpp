#include "timeseries/readers/netcdf_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace timeseries {
namespace {

// The variables that others name as their coordinates or bounds.
std::set<std::string> auxiliaries(const NcHeader& header) {
    std::set<std::string> names;
    for (const NcVariable& variable : header.variables)
        for (const char* attribute : {"coordinates", "bounds", "climatology"})
            for (const std::string& name : words(variable.text(attribute)))
                if (const NcVariable* found = header.find(name, variable.group))
                    names.insert(found->name);
    return names;
}

// Exodus II meshes are netCDF files too, but their arrays are lists of nodes and elements.
bool exodus(const NcHeader& header) {
    const auto has = [&](std::string_view name) {
        return std::ranges::find(header.dimensions, name, &NcDimension::name) !=
               header.dimensions.end();
    };
    return has("num_dim") && has("num_nodes") && has("num_el_blk");
}

// The connectivity of an unstructured mesh (UGRID 1.0), which is no data.
bool mesh(const NcVariable& variable) { return variable.find("cf_role") != nullptr; }

// Longitudes and latitudes, of any rank.
std::vector<const NcVariable*> geographicOf(const NcHeader& header) {
    std::vector<const NcVariable*> found;
    for (const NcVariable& variable : header.variables) {
        const auto kind = kindByAttributes(variable);
        if (kind == AxisKind::X || kind == AxisKind::Y) found.push_back(&variable);
    }
    return found;
}

std::uint64_t stepPoints(const NcHeader& header, const NcVariable& variable, const Roles& roles) {
    double points = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        if (roles.t != i) points *= static_cast<double>(header.dimension(variable, i).length);
    return static_cast<std::uint64_t>(std::min(points, 1e18));
}

// Why a variable with enough spatial dimensions cannot be drawn; "" when it can.
std::string obstacle(const NetcdfFile& file, const NcVariable& variable, const Roles& roles) {
    const NcHeader& header = file.header();
    for (const std::size_t i : roles.extra) {
        const NcDimension& extra = header.dimension(variable, i);
        return fmt::format("the dimension {} of {} is none of x, y, z and time", extra.name,
                           extra.length);
    }
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        if (header.dimension(variable, i).length == 0)
            return fmt::format("the dimension {} is empty", header.dimension(variable, i).name);
    return file.tooLarge(variable, stepPoints(header, variable, roles));
}

FileVariable describe(const NetcdfFile& file, const NcVariable& variable, const Roles& roles,
                      std::span<const NcVariable* const> geographic) {
    const NcHeader& header = file.header();
    FileVariable result;
    result.name = variable.name;
    result.longName = variable.text("long_name");
    if (result.longName.empty()) result.longName = variable.text("standard_name");
    result.units = variable.text("units");
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        result.lengths.push_back(header.dimension(variable, i).length);
    result.type = *variable.type;
    result.roles = roles;
    result.packing =
        packingOf(variable, [&](const std::string& what) { file.failAttribute(variable, what); });
    result.times = timesOf(file, variable, roles);
    result.axes = axesOf(file, variable, roles, geographic, result.notes);
    return result;
}

}  // namespace

FileContents contentsOf(const NetcdfFile& file) {
    const NcHeader& header = file.header();
    if (exodus(header))
        file.fail("", "expected fields on a grid, found a finite-element mesh (Exodus II)");
    const std::set<std::string> named = auxiliaries(header);
    FileContents contents;
    const std::vector<const NcVariable*> geographic = geographicOf(header);
    std::string passedOver;
    for (const NcVariable& variable : header.variables) {
        if (!variable.type || named.contains(variable.name) || mesh(variable) ||
            std::ranges::binary_search(geographic, &variable))
            continue;
        const Roles roles = rolesOf(header, variable);
        if (roles.spatial() < 2) continue;
        const std::string why = obstacle(file, variable, roles);
        if (!why.empty()) {
            passedOver += fmt::format("; {}: {}", header.declaration(variable), why);
            continue;
        }
        try {
            contents.variables.push_back(describe(file, variable, roles, geographic));
        } catch (const AttributeError& error) {
            contents.damaged.push_back({variable.name, error.what()});
        }
    }
    if (!contents.variables.empty()) return contents;
    if (!contents.damaged.empty()) throw FileError(contents.damaged.front().why);
    file.fail("", "expected a numeric variable with at least two spatial dimensions, found none" +
                      passedOver);
}

}  // namespace timeseries

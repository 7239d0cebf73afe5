#include "timeseries/readers/netcdf/netcdf_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "timeseries/readers/cf/cf_lists.h"
#include "timeseries/readers/cf/cf_members.h"
#include "timeseries/readers/cf/cf_mpas.h"
#include "timeseries/readers/netcdf/netcdf_others.h"
#include "timeseries/readers/other_formats.h"

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

// The connectivity of an unstructured mesh (UGRID 1.0), which is no data.
bool isConnectivity(const NcVariable& variable) { return variable.find("cf_role") != nullptr; }

// Why what lies on a mesh is not read.
std::string meshNotRead(const NcHeader& header, const NcVariable& variable, const Roles& roles) {
    std::string places;
    if (roles.list) {
        const NcDimension& along = header.dimension(variable, *roles.list);
        places = fmt::format(" ({} places listed along {})", along.length, along.name);
    }
    return fmt::format(
        "expected values on a grid, found them on an unstructured mesh{} of which the file tells "
        "neither bounds (CF) nor faces (UGRID, MPAS)",
        places);
}

// Status codes and classes (CF 1.11, section 3.5, "Flags").
bool isCategories(const NcVariable& variable) {
    return variable.find("flag_values") || variable.find("flag_masks") ||
           variable.find("flag_meanings");
}

// None of bit fields, of which several may be set, and where not each value has one name.
std::vector<ClassName> classesOf(const NcVariable& variable, const Packing& packing) {
    const std::vector<double> values = variable.numbers("flag_values");  // as they are stored
    std::vector<std::string> names = words(variable.text("flag_meanings"));
    std::vector<ClassName> classes;
    if (variable.find("flag_masks") || names.size() != values.size()) return classes;
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::ranges::replace(names[i], '_', ' ');
        classes.push_back(
            {packing.unpack(toDouble(asMeant(packing, values[i]))), std::move(names[i])});
    }
    return classes;
}

// Longitudes and latitudes, of any rank.
std::vector<const NcVariable*> geographicOf(const NcHeader& header) {
    std::vector<const NcVariable*> found;
    for (const NcVariable& variable : header.variables) {
        const auto kind = kindByAttributes(variable);
        if (kind == AxisKind::X || kind == AxisKind::Y) found.push_back(&variable);
    }
    return found;
}

// The variables that may be drawn.
std::vector<const NcVariable*> fieldsOf(const NcHeader& header,
                                        std::span<const NcVariable* const> geographic) {
    const std::set<std::string> named = auxiliaries(header);
    std::vector<const NcVariable*> fields;
    for (const NcVariable& variable : header.variables)
        if (variable.type && !named.contains(variable.name) && !isConnectivity(variable) &&
            !isOfMpasMesh(header, variable) && !std::ranges::binary_search(geographic, &variable))
            fields.push_back(&variable);
    return fields;
}

std::uint64_t stepPoints(const NcHeader& header, const NcVariable& variable, const Roles& roles) {
    double points = 1;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        if (roles.t != i && std::ranges::find(roles.extra, i) == roles.extra.end())
            points *= static_cast<double>(header.dimension(variable, i).length);
    return static_cast<std::uint64_t>(std::min(points, 1e18));
}

// Why a variable with enough spatial dimensions cannot be drawn; "" when it can.
std::string obstacle(const CfFile& file, const NcVariable& variable, const Roles& roles) {
    const NcHeader& header = file.header();
    double members = 1;
    for (const std::size_t i : roles.extra) {
        const NcDimension& extra = header.dimension(variable, i);
        members *= static_cast<double>(extra.length);
        if (members > kMostMembers)
            return fmt::format(
                "the dimension {} of {} is none of x, y, z and time, and a variable is shown as "
                "{} at most",
                extra.name, extra.length, kMostMembers);
    }
    std::size_t lengths = 0;
    bool named = true;
    for (const std::size_t d : variable.dimensions) {
        lengths += header.dimensions[d].length > 1;
        named = named && header.dimensions[d].isNamed();
    }
    if (!named && lengths < 3) return "in HDF5 without named dimensions a field has three";
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        if (header.dimension(variable, i).length == 0)
            return fmt::format("the dimension {} is empty", header.dimension(variable, i).name);
    return file.tooLarge(variable, stepPoints(header, variable, roles));
}

FileVariable describe(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                      const Roles& roles, std::span<const NcVariable* const> geographic,
                      const std::optional<ColumnPlaces>& list) {
    const NcHeader& header = file.header();
    FileVariable result;
    result.name = result.stored = variable.name;
    result.longName = variable.text("long_name");
    if (result.longName.empty()) result.longName = variable.text("standard_name");
    result.units = variable.text("units");
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        result.lengths.push_back(header.dimension(variable, i).length);
    result.type = *variable.type;
    result.categories = isCategories(variable);
    result.roles = roles;
    result.packing =
        packingOf(variable, [&](const std::string& what) { file.failAttribute(variable, what); });
    result.classes = classesOf(variable, result.packing);
    result.times = timesOf(file, fileAxes, variable, roles);
    if (roles.t && !fileAxes.isToldAsTime(variable, *roles.t))
        result.notes.push_back(
            fmt::format("{} is taken for time: the file does not say what it is, and it comes "
                        "before the others",
                        header.dimension(variable, *roles.t).name));
    result.axes = axesOf(file, fileAxes, variable, roles, geographic, list, result.notes);
    return result;
}

FileVariable asMember(FileVariable variable, Member member) {
    variable.at = std::move(member.at);
    if (member.key.empty()) return variable;
    variable.name += ':' + member.key;
    if (!variable.longName.empty()) variable.longName += ", " + member.told;
    return variable;
}

}  // namespace

FileContents contentsOf(const CfFile& file) {
    const NcHeader& header = file.header();
    if (const OtherNetcdf* const other = otherNetcdf(header))
        file.fail("",
                  fmt::format("expected a grid as in the files beside it, found {}", other->what));
    const std::vector<const NcVariable*> geographic = geographicOf(header);
    const std::vector<const NcVariable*> fields = fieldsOf(header, geographic);
    const FileAxes fileAxes(header, fields);
    FileContents contents;
    contents.damaged.assign(file.damaged().begin(), file.damaged().end());
    std::string passedOver;
    std::vector<DamagedVariable> leftOut;  // told where others are there
    for (const NcVariable* field : fields) {
        const NcVariable& variable = *field;
        Roles roles = fileAxes.rolesOf(variable);
        std::optional<ColumnPlaces> list;
        if (roles.list || saysMesh(header, variable)) {
            const auto found = listOf(header, variable, roles, geographic);
            if (!found) {
                contents.damaged.push_back(
                    {variable.name, file.sentence("variable '" + variable.name + "'",
                                                  meshNotRead(header, variable, roles))});
                continue;
            }
            list = found->places;
            roles = found->roles;
        }
        if (roles.spatial() < 2 && !list) continue;
        const std::string why = obstacle(file, variable, roles);
        if (!why.empty()) {
            // Plain HDF5 has tables and lists beside fields.
            if (header.format == kPlainHdf5 && variable.dimensions.size() <= 2) continue;
            passedOver += fmt::format("; {}: {}", header.declaration(variable), why);
            leftOut.push_back(
                {variable.name, file.sentence("variable '" + variable.name + "'", why)});
            continue;
        }
        try {
            const FileVariable whole = describe(file, fileAxes, variable, roles, geographic, list);
            for (Member& member : membersOf(file, fileAxes, variable, roles))
                contents.variables.push_back(asMember(whole, std::move(member)));
        } catch (const AttributeError& error) {
            contents.damaged.push_back({variable.name, error.what()});
        }
    }
    std::stable_partition(contents.variables.begin(), contents.variables.end(),
                          [](const FileVariable& each) { return each.at.empty(); });
    if (!contents.variables.empty()) {
        contents.damaged.insert(contents.damaged.end(), leftOut.begin(), leftOut.end());
        return contents;
    }
    if (!contents.damaged.empty()) throw FileError(contents.damaged.front().why);
    if (header.format == kPlainHdf5)
        throw FileError(notReadSentence(
            file.path(), "an HDF5 file that no NetCDF wrote, without an array of three dimensions" +
                             passedOver));
    file.fail("", "expected a numeric variable with at least two spatial dimensions, found none" +
                      passedOver);
}

}  // namespace timeseries

#include "timeseries/readers/cf/cf_members.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

// What the places along a dimension are called: by its coordinate where that tells them apart.
std::vector<std::string> placesAlong(const CfFile& file, const NcDimension& dimension,
                                     const NcVariable* coordinate) {
    std::vector<std::string> texts;
    if (coordinate)
        for (const double value : valuesOf(file, *coordinate))
            if (std::isfinite(value)) texts.push_back(fmt::format("{:.6g}", value));
    if (std::set(texts.begin(), texts.end()).size() == dimension.length) return texts;
    texts.clear();
    for (std::uint64_t i = 0; i < dimension.length; ++i) texts.push_back(std::to_string(i));
    return texts;
}

}  // namespace

std::vector<Member> membersOf(const CfFile& file, const FileAxes& fileAxes,
                              const NcVariable& variable, const Roles& roles) {
    std::vector<Member> members(1);
    std::vector<std::size_t> positions = roles.extra;
    std::ranges::sort(positions);
    for (const std::size_t position : positions) {
        const NcDimension& dimension = file.header().dimension(variable, position);
        const NcVariable* const coordinate = fileAxes.coordinateOf(variable, position);
        const auto texts = placesAlong(file, dimension, coordinate);
        const std::string units = coordinate ? coordinate->text("units") : "";
        const std::string name =
            dimension.isNamed() ? dimension.name.substr(dimension.name.rfind('/') + 1) : "";
        std::vector<Member> longer;
        for (const Member& before : members)
            for (std::uint64_t i = 0; i < dimension.length; ++i) {
                Member& member = longer.emplace_back(before);
                member.at.emplace_back(position, i);
                if (!member.key.empty()) {
                    member.key += ',';
                    member.told += ", ";
                }
                member.key += name.empty() ? texts[i] : fmt::format("{}={}", name, texts[i]);
                member.told += name.empty() ? texts[i] : fmt::format("{} {}", name, texts[i]);
                if (!units.empty() && units != "1") member.told += ' ' + units;
            }
        members = std::move(longer);
    }
    return members;
}

}  // namespace timeseries

#include "timeseries/readers/cf/cf_axes.h"

#include <algorithm>
#include <set>
#include <utility>

#include "timeseries/readers/text/time_units.h"

namespace timeseries {
namespace {

using enum AxisKind;

// Of plain HDF5 what is unlimited may grow, and means nothing else.
bool isRecord(const NcDimension& dimension) { return dimension.unlimited && dimension.isNamed(); }

bool tellsAnAxis(const NcVariable& variable) {
    return kindByAttributes(variable).value_or(Other) != Other;
}

}  // namespace

// Two dimensions of one kind: the one told by better evidence keeps it, then the one further right.
struct FileAxes::Claim {
    std::optional<AxisKind> kind;
    int evidence;  // 2 by attributes, 1 by name, 0 a forecast's
};

FileAxes::FileAxes(const NcHeader& header, std::span<const NcVariable* const> fields)
    : header_(header), dimensions_(header.dimensions.size()) {
    for (const NcVariable& variable : header.variables) byName_.emplace(variable.name, &variable);
    findCoordinates();
    findLists();
    findTimes(fields);
}

// As NcHeader::find.
const NcVariable* FileAxes::find(std::string_view name, std::string_view group) const {
    for (const std::string& path : namesMeant(name, group))
        if (const auto at = byName_.find(path); at != byName_.end()) return at->second;
    return nullptr;
}

void FileAxes::findCoordinates() {
    std::set<std::pair<std::string, std::string>> seen;  // most variables of a file name the same
    for (const NcVariable& variable : header_.variables) {
        const std::string names = variable.text("coordinates");
        if (!names.empty() && seen.emplace(variable.group, names).second)
            for (const std::string& name : words(names)) {
                const NcVariable* found = find(name, variable.group);
                if (!found || found->dimensions.size() != 1 ||
                    !found->isAlong(found->dimensions[0]) || !tellsAnAxis(*found))
                    continue;
                auto& all = dimensions_[found->dimensions[0]].coordinates;
                if (std::ranges::find(all, found) == all.end()) all.push_back(found);
            }
        if (variable.dimensions.size() == 1 && variable.isAlong(variable.dimensions[0]) &&
            looksLikeTimeUnits(lower(variable.text("units"))) && kindByAttributes(variable) == T)
            dimensions_[variable.dimensions[0]].times.push_back(&variable);
    }
}

// A longitude and a latitude along one dimension place its points one by one, unless these move in
// time.
void FileAxes::findLists() {
    std::vector<bool> own(dimensions_.size()), x = own, y = own;
    for (const NcVariable& variable : header_.variables) {
        if (variable.dimensions.size() != 1 || !variable.isAlong(variable.dimensions[0])) continue;
        const std::size_t d = variable.dimensions[0];
        const auto kind = kindByAttributes(variable);
        if (variable.baseName() == header_.dimensions[d].name) own[d] = true;
        if (kind == X) x[d] = true;
        if (kind == Y) y[d] = true;
    }
    for (std::size_t d = 0; d < dimensions_.size(); ++d)
        dimensions_[d].list = x[d] && y[d] && !own[d] && dimensions_[d].times.empty() &&
                              kindByName(header_.dimensions[d].name) != T;
}

// The first of four dimensions is time when nothing says what it is: in variables without height
// too.
void FileAxes::findTimes(std::span<const NcVariable* const> fields) {
    for (const NcVariable* field : fields) {
        const Roles roles = rolesOf(*field);
        if (!roles.t || roles.spatial() < 3 || !roles.extra.empty()) continue;
        const std::size_t d = field->dimensions[*roles.t];
        if (header_.dimensions[d].isNamed()) dimensions_[d].time = true;
    }
}

const NcVariable* FileAxes::coordinateOf(const NcVariable& variable, std::size_t position) const {
    const std::size_t dimension = variable.dimensions[position];
    const NcVariable* own = find(header_.dimensions[dimension].name, variable.group);
    if (own && own->isAlong(dimension)) {
        const NcVariable* const valid =
            isOfForecast(*own) ? validTimeAlong(dimension) : nullptr;  // what is foretold is then
        return valid ? valid : own;
    }
    // An auxiliary coordinate (CF 1.10, section 5) stands in, if it tells which axis it is.
    const Dimension& known = dimensions_[dimension];
    for (const std::string& name : words(variable.text("coordinates"))) {
        const NcVariable* auxiliary = find(name, variable.group);
        if (auxiliary && auxiliary->isAlong(dimension) && tellsAnAxis(*auxiliary)) return auxiliary;
    }
    if (known.coordinates.size() == 1) return known.coordinates[0];
    // Times that nobody names: of scans along y too, where y is told by its name.
    const bool free = kindByName(header_.dimensions[dimension].name).value_or(T) == T;
    return free && known.coordinates.empty() && known.times.size() == 1 ? known.times[0] : nullptr;
}

const NcVariable* FileAxes::validTimeAlong(std::size_t dimension) const {
    const NcVariable* valid = nullptr;
    for (const NcVariable* time : dimensions_[dimension].times) {
        if (standardName(*time) != "time") continue;
        if (valid) return nullptr;
        valid = time;
    }
    return valid;
}

const NcVariable* FileAxes::textsAlong(const NcVariable& variable, std::size_t position) const {
    const std::size_t dimension = variable.dimensions[position];
    const std::string& own = header_.dimensions[dimension].name;
    for (const std::string_view name : {std::string_view(own), kTextTimes[0], kTextTimes[1]}) {
        const NcVariable* found = find(name, variable.group);
        if (!found || found->type || found->dimensions.empty()) continue;
        if (found->dimensions.size() <= 2 && found->dimensions[0] == dimension) return found;
    }
    return nullptr;
}

std::optional<AxisKind> FileAxes::kindFromAttributes(const NcVariable& variable,
                                                     std::size_t position) const {
    const Dimension& known = dimensions_[variable.dimensions[position]];
    if (known.list) return List;
    if (const NcVariable* coordinate = coordinateOf(variable, position))
        if (const auto kind = kindByAttributes(*coordinate)) return kind;
    // Several that agree, though none of them is the one.
    std::set<AxisKind> kinds;
    for (const NcVariable* each : known.coordinates) kinds.insert(*kindByAttributes(*each));
    if (kinds.size() == 1) return *kinds.begin();
    return std::nullopt;
}

FileAxes::Claim FileAxes::claimOf(const NcVariable& variable, std::size_t position) const {
    if (const auto told = kindFromAttributes(variable, position)) {
        const NcVariable* const coordinate = coordinateOf(variable, position);
        const bool isForecast = told == Other && coordinate && isOfForecast(*coordinate);
        return isForecast ? Claim{T, 0} : Claim{told, 2};
    }
    const auto named = kindByName(header_.dimension(variable, position).name);
    const bool times = !dimensions_[variable.dimensions[position]].times.empty();
    return {named || !times ? named : T, 1};
}

// As the first of its dimensions: where it stands elsewhere, it is something else.
bool FileAxes::isTimeElsewhere(const NcVariable& variable, std::size_t position) const {
    return position == 0 && dimensions_[variable.dimensions[position]].time;
}

bool FileAxes::isToldAsTime(const NcVariable& variable, std::size_t position) const {
    return claimOf(variable, position).kind == T || isRecord(header_.dimension(variable, position));
}

Roles FileAxes::rolesOf(const NcVariable& variable) const {
    const std::size_t rank = variable.dimensions.size();
    std::vector<Claim> claims;
    for (std::size_t i = 0; i < rank; ++i) claims.push_back(claimOf(variable, i));

    Roles roles;
    const auto slot = [&](AxisKind kind) -> std::optional<std::size_t>& {
        return kind == X ? roles.x : kind == Y ? roles.y : kind == Z ? roles.z : roles.t;
    };
    for (const int evidence : {2, 1, 0})
        for (std::size_t i = rank; i-- > 0;) {
            const Claim& claim = claims[i];
            if (!claim.kind || *claim.kind == Other || *claim.kind == List ||
                claim.evidence != evidence)
                continue;
            // Of two claims by the same evidence, one that is longer than 1 wins.
            auto& place = slot(*claim.kind);
            const bool better = place && claims[*place].evidence == evidence &&
                                header_.dimension(variable, *place).length == 1 &&
                                header_.dimension(variable, i).length > 1;
            if (!place || better) place = i;
        }

    const auto taken = [&](std::size_t i) {
        return roles.x == i || roles.y == i || roles.z == i || roles.t == i;
    };
    // What is left goes by position: the unlimited dimension is time, the last ones are x, y, z.
    for (std::size_t i = 0; i < rank; ++i)
        if (!taken(i) && !claims[i].kind && !roles.t &&
            (isRecord(header_.dimension(variable, i)) || isTimeElsewhere(variable, i)))
            roles.t = i;
    for (std::size_t i = rank; i-- > 0;) {
        if (claims[i].kind == List) roles.list = i;
        if (taken(i) || header_.dimension(variable, i).length == 1) continue;
        // Two or three numbers a point, where nothing has a name.
        const bool isVector = rank > 3 && i + 1 == rank &&
                              !header_.dimension(variable, i).isNamed() &&
                              header_.dimension(variable, i).length <= 3;
        // A second time is no height.
        if (isVector || claims[i].kind == Other || claims[i].kind == List || claims[i].kind == T)
            roles.extra.push_back(i);
        else if (!roles.x)
            roles.x = i;
        else if (!roles.y)
            roles.y = i;
        else if (!roles.z)
            roles.z = i;
        else if (!roles.t && i == 0)
            roles.t = i;
        else
            roles.extra.push_back(i);
    }
    return roles;
}

}  // namespace timeseries

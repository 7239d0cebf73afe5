#include "timeseries/readers/cf/cf_terms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "timeseries/readers/cf/cf_packing.h"

namespace timeseries {
namespace {

// 0 to 2 for x to z; nothing of other dimensions.
std::optional<std::size_t> axisOf(std::size_t dimension, const NcVariable& variable,
                                  const Roles& roles) {
    const std::array positions{roles.x, roles.y, roles.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (positions[axis] && dimension == variable.dimensions[*positions[axis]]) return axis;
    return std::nullopt;
}

// Of the levels above places in a list.
std::optional<Roles> levelsBeside(const NcHeader& header, const NcVariable& term,
                                  const NcVariable& variable, const Roles& roles) {
    if (!roles.z) return std::nullopt;
    const NcDimension& levels = header.dimension(variable, *roles.z);
    Roles own;
    for (std::size_t i = 0; i < term.dimensions.size(); ++i) {
        const std::size_t d = term.dimensions[i];
        const NcDimension& each = header.dimensions[d];
        if (roles.t && d == variable.dimensions[*roles.t])
            own.t = i;
        else if (d == variable.dimensions[*roles.list])
            own.x = i;
        else if (!own.z && each.name == levels.name + "P1" && each.length == levels.length + 1)
            own.z = i;
        else
            return std::nullopt;
    }
    if (!own.x || !own.z) return std::nullopt;
    return own;
}

bool isTime(std::size_t dimension, const NcVariable& variable, const Roles& roles) {
    return roles.t && dimension == variable.dimensions[*roles.t];
}

}  // namespace

bool spansNoMore(const NcHeader& header, const NcVariable& term, const NcVariable& variable,
                 const Roles& roles) {
    for (std::size_t i = 0; i < term.dimensions.size(); ++i) {
        const std::size_t d = term.dimensions[i];
        if (!axisOf(d, variable, roles) && !isTime(d, variable, roles) &&
            header.dimension(term, i).length != 1)
            return false;
    }
    return term.type.has_value();
}

std::optional<Roles> rolesBeside(const NcHeader& header, const NcVariable& term,
                                 const NcVariable& variable, const Roles& roles) {
    if (!term.type) return std::nullopt;
    if (roles.list) return levelsBeside(header, term, variable, roles);
    Roles own;
    std::vector<std::size_t> horizontal;  // positions in the term
    for (std::size_t i = 0; i < term.dimensions.size(); ++i) {
        const std::size_t d = term.dimensions[i];
        if (isTime(d, variable, roles))
            own.t = i;
        else if (roles.z && d == variable.dimensions[*roles.z])
            own.z = i;
        else
            horizontal.push_back(i);
    }
    if (horizontal.size() != 2 || term.dimensions[horizontal[0]] == term.dimensions[horizontal[1]])
        return std::nullopt;
    const bool xLast = *roles.y < *roles.x;
    own.x = horizontal[xLast ? 1 : 0];
    own.y = horizontal[xLast ? 0 : 1];
    bool between = false;
    for (const bool isX : {true, false}) {
        const std::size_t its = term.dimensions[isX ? *own.x : *own.y],
                          here = variable.dimensions[isX ? *roles.x : *roles.y],
                          across = variable.dimensions[isX ? *roles.y : *roles.x];
        if (its == here) continue;
        const std::uint64_t there = header.dimensions[its].length,
                            length = header.dimensions[here].length;
        const bool apart = there == length + 1 || there + 1 == length;
        const AxisKind kind = isX ? AxisKind::X : AxisKind::Y;
        if (its == across || (!apart && there != length) ||
            kindByName(header.dimensions[its].name).value_or(kind) != kind)
            return std::nullopt;
        between = between || apart;
    }
    return between ? std::optional(own) : std::nullopt;
}

bool hasTime(const NcVariable& term, const NcVariable& variable, const Roles& roles) {
    return std::ranges::any_of(term.dimensions,
                               [&](std::size_t d) { return isTime(d, variable, roles); });
}

TermValues termOf(const CfFile& file, const NcVariable& term, const NcVariable& variable,
                  const Roles& roles, std::size_t step) {
    const Packing packing =
        packingOf(term, [&](const std::string& what) { file.failAttribute(term, what); });
    const std::size_t rank = term.dimensions.size();
    std::vector<std::size_t> start(rank), count(rank, 1);
    TermValues result;
    std::size_t stride = 1;
    for (std::size_t i = rank; i-- > 0;) {
        const std::size_t d = term.dimensions[i], length = file.header().dimension(term, i).length;
        if (const auto axis = axisOf(d, variable, roles)) {
            count[i] = length;
            result.stride[*axis] = stride;
            stride *= length;
        } else if (isTime(d, variable, roles)) {
            if (length == 0) throw std::invalid_argument(term.name + " has no step");
            start[i] = std::min(step, length - 1);
        }
    }
    if (const std::string why = file.tooLarge(term, stride); !why.empty())
        throw std::invalid_argument(why);
    Field field;
    unpack(
        packing, {{stride, 1, 1}, {1, stride, stride}},
        [&](void* values) { file.read(term, start, count, values); }, field);
    std::visit([&](const auto& all) { result.values.assign(all.begin(), all.end()); },
               field.values);
    for (std::size_t i = 0; i < field.missing.size(); ++i)
        if (field.missing[i]) result.values[i] = std::nan("");
    return result;
}

TermValues termBeside(const CfFile& file, const NcVariable& term, const Roles& own,
                      const std::array<std::size_t, 3>& size, std::size_t step) {
    const std::array positions{own.x, own.y, own.z};
    std::array<std::size_t, 3> lengths{1, 1, 1}, moved{1, 1, 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!positions[axis]) continue;
        lengths[axis] = file.header().dimension(term, *positions[axis]).length;
        moved[axis] = size[axis];
        const std::size_t longer = std::max(lengths[axis], size[axis]);
        if (lengths[axis] == 0 || longer - std::min(lengths[axis], size[axis]) > 1)
            throw std::invalid_argument(term.name + " is of other places");
    }
    const TermValues there = termOf(file, term, term, own, step);
    // The two that a place lies between, or one where it is.
    const auto between = [&](std::size_t axis, std::size_t at) -> std::array<std::size_t, 2> {
        if (moved[axis] == lengths[axis]) return {at, at};
        if (moved[axis] < lengths[axis]) return {at, at + 1};
        return {at > 0 ? at - 1 : 0, std::min(at, lengths[axis] - 1)};
    };
    TermValues result{{}, {1, own.y ? moved[0] : 0, own.z ? moved[0] * moved[1] : 0}};
    result.values.reserve(moved[0] * moved[1] * moved[2]);
    for (std::size_t k = 0; k < moved[2]; ++k)
        for (std::size_t j = 0; j < moved[1]; ++j)
            for (std::size_t i = 0; i < moved[0]; ++i) {
                double sum = 0, count = 0;
                for (const std::size_t z : between(2, k))
                    for (const std::size_t y : between(1, j))
                        for (const std::size_t x : between(0, i)) {
                            const double value = there.at(x, y, z);
                            if (!std::isfinite(value)) continue;
                            sum += value;
                            ++count;
                        }
                result.values.push_back(count > 0 ? sum / count : std::nan(""));
            }
    return result;
}

}  // namespace timeseries

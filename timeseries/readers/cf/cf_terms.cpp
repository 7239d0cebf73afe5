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

}  // namespace timeseries

#include "timeseries/readers/cf/netcdf_header.h"

#include <algorithm>

namespace timeseries {

std::string_view NcVariable::baseName() const {
    const std::string_view all = name;
    return group.empty() ? all : all.substr(group.size() + 1);
}

std::optional<std::size_t> NcVariable::positionOf(std::optional<std::size_t> dimension) const {
    const auto found = std::ranges::find(dimensions, dimension);
    if (found == dimensions.end()) return std::nullopt;
    return static_cast<std::size_t>(found - dimensions.begin());
}

const NcAttribute* NcAttributes::find(std::string_view attribute) const {
    const auto at = std::ranges::find(attributes, attribute, &NcAttribute::name);
    return at == attributes.end() ? nullptr : &*at;
}

std::string NcAttributes::text(std::string_view attribute) const {
    const NcAttribute* found = find(attribute);
    const auto* text = found ? std::get_if<std::string>(&found->value) : nullptr;
    return text ? *text : "";
}

std::vector<double> NcAttributes::numbers(std::string_view attribute) const {
    std::vector<double> numbers;
    const NcAttribute* found = find(attribute);
    if (const auto* all = found ? std::get_if<std::vector<Number>>(&found->value) : nullptr)
        for (const Number& number : *all) numbers.push_back(toDouble(number));
    return numbers;
}

const NcVariable* NcHeader::find(std::string_view name, std::string_view group) const {
    while (true) {
        const std::string path =
            group.empty() ? std::string(name) : std::string(group) + '/' + std::string(name);
        const auto at = std::ranges::find(variables, path, &NcVariable::name);
        if (at != variables.end()) return &*at;
        if (group.empty()) return nullptr;
        const auto slash = group.rfind('/');
        group = slash == std::string_view::npos ? "" : group.substr(0, slash);
    }
}

const NcGroup* NcHeader::findGroup(std::string_view name) const {
    const auto at = std::ranges::find(groups, name, &NcGroup::name);
    return at == groups.end() ? nullptr : &*at;
}

std::string NcHeader::declaration(const NcVariable& variable) const {
    std::string text = variable.name + '(';
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        text += (i ? ", " : "") + dimension(variable, i).name;
    return text + ')';
}

}  // namespace timeseries

#include "timeseries/readers/cf/netcdf_header.h"

#include <algorithm>

#include "timeseries/readers/text/words.h"

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
    return text ? oneLine(*text) : "";
}

std::vector<double> NcAttributes::numbers(std::string_view attribute) const {
    std::vector<double> numbers;
    const NcAttribute* found = find(attribute);
    if (const auto* all = found ? std::get_if<std::vector<Number>>(&found->value) : nullptr)
        for (const Number& number : *all) numbers.push_back(toDouble(number));
    return numbers;
}

std::vector<std::string> namesMeant(std::string_view name, std::string_view group) {
    if (name.starts_with('/')) return {std::string(name.substr(1))};
    const auto leave = [&] {
        const auto slash = group.rfind('/');
        group = slash == group.npos ? "" : group.substr(0, slash);
    };
    const auto here = [&] {
        return std::string(group) + (group.empty() ? "" : "/") + std::string(name);
    };
    bool says = false;
    for (; name.starts_with("./") || name.starts_with("../"); says = true) {
        if (name.starts_with("../")) {
            if (group.empty()) return {};
            leave();
        }
        name.remove_prefix(name.find('/') + 1);
    }
    std::vector<std::string> names{here()};
    while (!says && !group.empty()) {
        leave();
        names.push_back(here());
    }
    return names;
}

const NcVariable* NcHeader::find(std::string_view name, std::string_view group) const {
    for (const std::string& path : namesMeant(name, group)) {
        const auto at = std::ranges::find(variables, path, &NcVariable::name);
        if (at != variables.end()) return &*at;
    }
    return nullptr;
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

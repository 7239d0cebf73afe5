#include "timeseries/readers/components.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <type_traits>
#include <utility>

namespace timeseries {
namespace {

constexpr std::uint64_t kMost = 1024, kMostOfMagnitude = 3;

}  // namespace

std::vector<ComponentVariable> componentsOf(const std::string& name, ValueType type,
                                            std::uint64_t count) {
    const std::string stored(typeName(type));
    if (count == 1) return {{{1, 0}, name, type, stored}};
    std::vector<ComponentVariable> all;
    if (count < 1 || count > kMost) return all;
    const std::string several = fmt::format("{}, {} components", stored, count);
    if (count <= kMostOfMagnitude)
        all.push_back({{count, std::nullopt},
                       name + " magnitude",
                       ValueType::F64,
                       several + "; magnitude in float64"});
    for (std::uint64_t i = 0; i < count; ++i)
        all.push_back({{count, i}, fmt::format("{}[{}]", name, i), type, several});
    return all;
}

double lengthOf(double x, double y, double z) {
    constexpr double kLeast = 1e-290;  // below, squares have lost digits
    const double squares = x * x + y * y + z * z;
    const bool isUsual = std::isnan(squares) || (squares >= kLeast && std::isfinite(squares));
    return isUsual ? std::sqrt(squares) : std::hypot(x, y, z);
}

Values componentOf(Values rows, const Component& component) {
    const std::uint64_t n = component.of;
    if (n == 1) return rows;
    return std::visit(
        [&](const auto& all) -> Values {
            const std::uint64_t count = all.size() / n;
            if (component.which) {
                std::decay_t<decltype(all)> values(count);
                for (std::uint64_t i = 0; i < count; ++i) values[i] = all[n * i + *component.which];
                return values;
            }
            std::vector<double> values(count);
            for (std::uint64_t i = 0; i < count; ++i) {
                const auto at = [&](std::uint64_t c) {
                    return c < n ? static_cast<double>(all[n * i + c]) : 0.0;
                };
                values[i] = lengthOf(at(0), at(1), at(2));
            }
            return values;
        },
        rows);
}

void tellApart(std::span<Variable> variables) {
    std::set<std::string> names;
    std::map<std::string, std::size_t> last;
    for (Variable& variable : variables) {
        const std::string called = variable.name;
        while (!names.insert(variable.name).second) {
            std::size_t& number = last.try_emplace(called, 1).first->second;
            variable.name = fmt::format("{} ({})", called, ++number);
        }
    }
}

}  // namespace timeseries

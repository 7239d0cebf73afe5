#include "timeseries/readers/netcdf/openpmd_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "timeseries/readers/netcdf/netcdf_rows.h"

namespace timeseries {
namespace {

constexpr std::array<const char*, 3> kPosition{"position/x", "position/y", "position/z"},
    kOffset{"positionOffset/x", "positionOffset/y", "positionOffset/z"};

const OpenPmdComponent* find(const std::vector<OpenPmdComponent>& components,
                             std::string_view name) {
    const auto at = std::ranges::find(components, name, &OpenPmdComponent::name);
    return at == components.end() ? nullptr : &*at;
}

}  // namespace

bool isOpenPmdPlace(const OpenPmdComponent& component) {
    return component.name.starts_with("position/") || component.name.starts_with("positionOffset/");
}

std::uint64_t openPmdParticles(const NetcdfFile& file,
                               const std::vector<OpenPmdComponent>& components) {
    for (const char* name : kPosition)
        if (const OpenPmdComponent* const along = find(components, name))
            return openPmdNumbersOf(file, *along).count;
    return 0;
}

Values openPmdValuesOf(const NetcdfFile& file, const OpenPmdComponent& component,
                       std::uint64_t particles) {
    const OpenPmdNumbers numbers = openPmdNumbersOf(file, component);
    if (numbers.lengths != std::vector{particles})
        failComponent(file, component,
                      fmt::format("expected a number of each of {} particles, found {} along {} "
                                  "dimensions",
                                  particles, numbers.count, numbers.lengths.size()));
    if (!component.array) return openPmdConstant(component, numbers);
    return rowsOf(file, *component.array, 0, particles, 1);
}

std::vector<glm::dvec3> openPmdPlacesOf(const NetcdfFile& file,
                                        const std::vector<OpenPmdComponent>& components) {
    const std::uint64_t particles = openPmdParticles(file, components);
    std::vector<glm::dvec3> places(particles, glm::dvec3(0));
    for (int c = 0; c < 3; ++c)
        for (const auto& names : {kPosition, kOffset}) {
            const auto* const along = find(components, names[static_cast<std::size_t>(c)]);
            if (!along) continue;
            const double unit = openPmdNumber(file, *along, *along->own, "unitSI", 1);
            if (unit == 0) failComponent(file, *along, "expected unitSI, a number that is not 0");
            const auto numbers = asDoubles(openPmdValuesOf(file, *along, particles));
            for (std::uint64_t i = 0; i < particles; ++i) places[i][c] += unit * numbers[i];
        }
    return places;
}

}  // namespace timeseries

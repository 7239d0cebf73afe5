#include "timeseries/readers/netcdf/netcdf_rows.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "timeseries/grid/with_type.h"

namespace timeseries {

Values rowsOf(const NetcdfFile& file, const NcVariable& variable, std::uint64_t first,
              std::uint64_t rows, std::uint64_t columns) {
    const auto& header = file.header();
    const std::size_t rank = variable.dimensions.size();
    const std::string place = "variable '" + variable.name + "'";
    const std::uint64_t length = rank > 0 ? header.dimension(variable, 0).length : 0;
    const std::uint64_t width = rank == 2 ? header.dimension(variable, 1).length : 1;
    if (!variable.type || rank < 1 || rank > 2 || width != columns)
        file.fail(place, fmt::format("expected rows of {} numbers", columns));
    if (first > length || rows > length - first)
        file.fail(place, fmt::format("expected {} rows from row {} on, found {} in all", rows,
                                     first, length));
    if (const std::string why = file.tooLarge(variable, rows * columns); !why.empty())
        file.fail(place, why);
    return withType(*variable.type, [&]<typename T>(T) -> Values {
        std::vector<T> values(rows * columns);
        const std::array<std::size_t, 2> start{first, 0}, count{rows, columns};
        if (!values.empty())
            file.read(variable, std::span(start).first(rank), std::span(count).first(rank),
                      values.data());
        return values;
    });
}

std::vector<double> asDoubles(const Values& values) {
    return std::visit([](const auto& all) { return std::vector<double>(all.begin(), all.end()); },
                      values);
}

std::vector<glm::dvec3> placesOf(const Values& rows) {
    std::vector<glm::dvec3> places;
    std::visit(
        [&](const auto& at) {
            places.reserve(at.size() / 3);
            for (std::size_t i = 0; i + 2 < at.size(); i += 3)
                places.emplace_back(at[i], at[i + 1], at[i + 2]);
        },
        rows);
    return places;
}

std::vector<glm::dvec3> placesOf(const NetcdfFile& file, const NcVariable& variable,
                                 std::uint64_t first, std::uint64_t rows) {
    return placesOf(rowsOf(file, variable, first, rows, 3));
}

}  // namespace timeseries

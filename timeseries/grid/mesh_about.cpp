#include "timeseries/grid/mesh_about.h"

#include <algorithm>
#include <functional>

#include "timeseries/grid/cell_types.h"
#include "timeseries/together.h"

namespace timeseries {

std::optional<std::uint8_t> MeshAbout::typeOf(std::uint64_t cell) const {
    if (points != Points::Cells || cells.empty()) return std::nullopt;
    return types.empty() ? cells.front().type : types[cell];
}

TypeCounts countTypes(std::span<const std::uint8_t> types) {
    std::vector<TypeCounts> counts(threadsFor(types.size(), 1 << 12));
    const auto threads = static_cast<unsigned>(counts.size());
    together(threads, [&](unsigned k) {
        for (std::size_t i = types.size() * k / threads; i < types.size() * (k + 1) / threads; ++i)
            ++counts[k][types[i]];
    });
    for (std::size_t k = 1; k < threads; ++k)
        for (std::size_t type = 0; type < counts[k].size(); ++type)
            counts[0][type] += counts[k][type];
    return counts[0];
}

MeshAbout aboutCells(MeshAbout::Points points, std::span<const std::uint8_t> types) {
    const TypeCounts counts = countTypes(types);
    MeshAbout about;
    about.points = points;
    std::size_t several = 0;
    for (std::size_t number = 0; number < counts.size(); ++number) {
        const std::uint64_t count = counts[number];
        if (count == 0) continue;
        ++several;
        const auto type = static_cast<std::uint8_t>(number);
        const auto same = std::ranges::find_if(about.cells, [&](const MeshAbout::Kind& kind) {
            return cellName(kind.type, 2) == cellName(type, 2);
        });
        if (same == about.cells.end())
            about.cells.push_back({type, count});
        else
            same->count += count;
    }
    std::ranges::stable_sort(about.cells, std::greater(), &MeshAbout::Kind::count);
    if (points == MeshAbout::Points::Cells && several > 1)
        about.types.assign(types.begin(), types.end());
    return about;
}

}  // namespace timeseries

#include "timeseries/readers/face_tables.h"

#include <algorithm>

namespace timeseries {

void addFaces(const FaceTables& tables, UnstructuredGrid& grid) {
    const auto& [corners, ends, faces, cellEnds] = tables;
    grid.faceEnds.resize(grid.types.size() - cellEnds.size(), grid.faces.size());
    std::uint64_t next = 0, left = 2 * corners.size();
    for (const std::uint64_t each : cellEnds) {
        const std::uint64_t end = std::min<std::uint64_t>(each, faces.size());
        if (next < each)
            grid.faces.push_back(
                static_cast<std::uint32_t>(std::min<std::uint64_t>(each - next, kNoPoint)));
        for (; next < end; ++next) {
            const std::uint64_t face = faces[next];
            const std::uint64_t first = face > 0 && face <= ends.size() ? ends[face - 1] : 0,
                                last = face < ends.size() ? ends[face] : 0;
            if (!(first < last && last <= corners.size() && last - first <= left)) {
                grid.faces.insert(grid.faces.end(), {1, kNoPoint});
                continue;
            }
            left -= last - first;
            grid.faces.push_back(static_cast<std::uint32_t>(last - first));
            grid.faces.insert(grid.faces.end(),
                              corners.begin() + static_cast<std::ptrdiff_t>(first),
                              corners.begin() + static_cast<std::ptrdiff_t>(last));
        }
        grid.faceEnds.push_back(grid.faces.size());
    }
}

}  // namespace timeseries

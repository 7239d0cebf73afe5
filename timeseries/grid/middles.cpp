#include "timeseries/grid/middles.h"

#include <algorithm>

namespace timeseries {

std::vector<double> middlesOf(const std::vector<double>& coordinates) {
    if (coordinates.size() < 2) return coordinates;
    std::vector<double> middles;
    for (std::size_t i = 1; i < coordinates.size(); ++i)
        middles.push_back(coordinates[i - 1] + (coordinates[i] - coordinates[i - 1]) / 2);
    return middles;
}

std::vector<glm::dvec3> middlesOf(const std::vector<glm::dvec3>& places,
                                  const std::array<std::size_t, 3>& size) {
    const auto cellsAlong = [&](std::size_t axis) {
        return std::max<std::size_t>(size[axis], 2) - 1;
    };
    std::vector<glm::dvec3> middles;
    middles.reserve(cellsAlong(0) * cellsAlong(1) * cellsAlong(2));
    for (std::size_t k = 0; k < cellsAlong(2); ++k)
        for (std::size_t j = 0; j < cellsAlong(1); ++j)
            for (std::size_t i = 0; i < cellsAlong(0); ++i) {
                glm::dvec3 sum(0);
                for (unsigned corner = 0; corner < 8; ++corner) {
                    const auto of = [&](std::size_t cell, std::size_t axis) {
                        const bool isFar = size[axis] > 1 && (corner >> axis & 1) != 0;
                        return cell + (isFar ? 1 : 0);
                    };
                    sum += places[of(i, 0) + size[0] * (of(j, 1) + size[1] * of(k, 2))] / 8.0;
                }
                middles.push_back(sum);
            }
    return middles;
}

}  // namespace timeseries

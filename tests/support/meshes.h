// Curvilinear grids whose places are a formula of their indices.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "timeseries/grid/grid.h"

namespace tests {

// place(i, j, k) of doubles.
template <typename Place>
timeseries::MeshPlaces placesOf(std::array<std::size_t, 3> size, const Place& place) {
    timeseries::MeshPlaces places{.size = size, .at = {}};
    for (std::size_t k = 0; k < size[2]; ++k)
        for (std::size_t j = 0; j < size[1]; ++j)
            for (std::size_t i = 0; i < size[0]; ++i)
                places.at.push_back(
                    place(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
    return places;
}

inline std::shared_ptr<const timeseries::Grid> gridOf(timeseries::MeshPlaces places) {
    return std::make_shared<timeseries::Grid>(
        std::array{timeseries::Axis{"x", "m", {}}, timeseries::Axis{"y", "m", {}},
                   timeseries::Axis{"z", "m", {}}},
        std::make_shared<const timeseries::Mesh>(std::move(places)));
}

template <typename Place>
std::shared_ptr<const timeseries::Grid> curvilinear(std::array<std::size_t, 3> size,
                                                    const Place& place) {
    return gridOf(placesOf(size, place));
}

// Columns that lean to each other, at these levels.
inline std::shared_ptr<const timeseries::Grid> columns(std::vector<double> levels) {
    auto places = placesOf({9, 7, 1}, [](double i, double j, double) {
        if (i == 3 && j == 2) return glm::dvec3(std::nan(""), 0, 0);
        return glm::dvec3(i + 0.2 * std::sin(j), j + 0.1 * i, 0);
    });
    places.size[2] = levels.size();
    places.levels = std::move(levels);
    return gridOf(std::move(places));
}

// Rings of 36 points about an axis, as far apart from each other as the first is from 1, a disk of
// three layers.
inline std::shared_ptr<const timeseries::Grid> rings(std::size_t count, double first) {
    return curvilinear({36, count, 3}, [&](double i, double j, double k) {
        const double angle = i * std::numbers::pi / 18, r = first + j;
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), k);
    });
}

// Twisted, stretched, and with a hole.
inline std::shared_ptr<const timeseries::Grid> twisted() {
    return curvilinear({9, 8, 7}, [](double i, double j, double k) {
        if (i == 4 && j == 4 && k == 3) return glm::dvec3(std::nan(""));
        const double a = 0.15 * k, x = i - 4, y = 1.2 * j - 4;
        return glm::dvec3(x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a),
                          0.05 * k * (k + 8));
    });
}

}  // namespace tests

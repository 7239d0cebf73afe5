// Curvilinear grids whose places are a formula of their indices.
#pragma once

#include <array>
#include <memory>
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

}  // namespace tests

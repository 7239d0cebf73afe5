// Where the cells of a structured grid have their middles.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace timeseries {

// Of an axis of one point, that one.
std::vector<double> middlesOf(const std::vector<double>& coordinates);
// Of a curvilinear grid of so many points along each index, the first fastest; an index of one
// point has one layer of cells. REQUIRES: places as many as that.
std::vector<glm::dvec3> middlesOf(const std::vector<glm::dvec3>& places,
                                  const std::array<std::size_t, 3>& size);

}  // namespace timeseries

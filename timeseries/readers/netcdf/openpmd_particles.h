// Where the particles of an openPMD species lie (openPMD standard 1.1.0, "Particle Records").
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "timeseries/readers/netcdf/openpmd_records.h"

namespace timeseries {

// What `position` and `positionOffset` are made of, which is no data.
bool isOpenPmdPlace(const OpenPmdComponent& component);

// How many particles a species has; 0 where none of its components says where they lie. Throws
// AttributeError.
std::uint64_t openPmdParticles(const NetcdfFile& file,
                               const std::vector<OpenPmdComponent>& components);

// In metres; along a coordinate that the species does not have 0. Throws FileError.
std::vector<glm::dvec3> openPmdPlacesOf(const NetcdfFile& file,
                                        const std::vector<OpenPmdComponent>& components);

// One number of each of so many particles, as stored. Throws FileError.
Values openPmdValuesOf(const NetcdfFile& file, const OpenPmdComponent& component,
                       std::uint64_t particles);

}  // namespace timeseries

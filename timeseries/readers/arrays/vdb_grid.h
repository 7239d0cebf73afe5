// What an OpenVDB file says of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "timeseries/grid/field.h"

namespace timeseries {

// Voxels from one to the other, both of them in it.
struct VdbBox {
    std::array<std::int32_t, 3> first{}, last{};
    std::array<std::uint64_t, 3> size() const;
    // None where it is none, or larger than a step may be.
    std::optional<std::uint64_t> count() const;
    void add(const VdbBox& other);  // then holds that, too
    friend bool operator==(const VdbBox&, const VdbBox&) = default;
};

struct VdbGrid {
    std::string name;           // as the file tells apart grids that are called alike
    std::string type;           // "Tree_float_5_4_3"
    ValueType value{};          // of a number
    std::uint64_t numbers = 1;  // of a voxel
    bool isHalf = false;        // as the file holds them
    std::string kind = {};      // its class: "fog volume", "level set"
    VdbBox box = {};            // of what is active
    // The middle of voxel (i, j, k) is origin + i steps[0] + j steps[1] + k steps[2].
    glm::dmat3 steps{1.0};
    glm::dvec3 origin{0.0};
};

}  // namespace timeseries

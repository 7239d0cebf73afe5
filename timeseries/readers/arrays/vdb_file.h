// What an OpenVDB file says of its grids, and their values. OpenVDB's own headers stay behind it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/reader.h"

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

class VdbFile {
 public:
    // OpenVDB crashes on some damaged files, so that a new one's header is read in a copy of this
    // process first, as are voxels; a known one was read before. Throws FileError.
    enum class Header { New, Known };
    VdbFile(const std::filesystem::path& path, Header header);

    const std::vector<VdbGrid>& grids() const { return grids_; }
    const std::vector<DamagedVariable>& damaged() const { return damaged_; }
    // Of a box that holds the grid's, x fastest, the numbers of a voxel one behind the other.
    // REQUIRES: it has a count().
    Values read(const VdbGrid& grid, const VdbBox& box) const;

 private:
    void readHeader();
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    // In a copy of this process, which may take as much memory as the file's bytes account for and
    // so many bytes more.
    void tryInCopy(std::string_view place, std::uint64_t more,
                   const std::function<void()>& work) const;
    // What OpenVDB throws becomes a FileError.
    void told(std::string_view place, const std::function<void()>& work) const;

    std::filesystem::path path_;
    std::vector<VdbGrid> grids_;
    std::vector<DamagedVariable> damaged_;
};

}  // namespace timeseries

// Where the points of a curvilinear grid lie, one by one, and the cells that they stand for. Pure
// geometry: no values.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/pages.h"

namespace timeseries {

// What is known of each point; a coordinate that is not finite says that it has no place.
struct MeshPlaces {
    std::array<std::size_t, 3> size{1, 1, 1};  // points along the indices i, j, k
    // [k][j][i], i fastest, in the file's space, of all points; or [j][i] when there are `levels`.
    std::vector<glm::dvec3> at;
    // [k]: what each level adds to the third coordinate of the places below, strictly ascending or
    // descending. None: all are in `at`.
    std::vector<double> levels = {};
    // After how much each coordinate comes round to itself, as longitude does; 0: never.
    glm::dvec3 period{0};
};

class Mesh {
 public:
    // Throws std::invalid_argument when the places are not as many as `size` says, none is finite,
    // or no cell of them has a volume.
    explicit Mesh(MeshPlaces places);

    const std::array<std::size_t, 3>& size() const { return size_; }
    std::uint64_t count() const;
    // In the file's space: to a 2^24th of the mesh's extent. Not finite where the point has none.
    glm::dvec3 position(std::uint64_t index) const;
    // Columns: the steps along i, j and k that the point stands for, half the way between its
    // neighbours, or the whole way to the only one that has a place. An index of one point is as
    // thick as the mean of the cells is wide.
    glm::dmat3 cell(std::uint64_t index) const;
    // Begins to load what both are made of: points that are asked for by value lie anywhere.
    void prefetch(std::uint64_t index) const {
        const std::uint64_t row = size_[0], slice = row * size_[1], stored = stored_;
        const std::uint64_t at = levels_.empty() ? index : index % stored;
        for (const std::uint64_t way : {std::uint64_t{0}, row, slice}) {
            __builtin_prefetch(at_.data() + (at >= way ? at - way : 0));
            __builtin_prefetch(at_.data() + (at + way < stored ? at + way : at));
        }
    }
    // Of that cell; 0 when it is folded: turned inside out beside most of the others.
    double volume(const glm::dmat3& cell) const;

    // The least and greatest of each coordinate.
    const glm::dvec3& lo() const { return lo_; }
    const glm::dvec3& hi() const { return hi_; }
    double meanVolume() const { return meanVolume_; }  // of the cells that have one
    // Lengths of the rows of cell(), at most: a cell's splat reaches no farther along a coordinate
    // than this, times its radius.
    const glm::dvec3& widest() const { return widest_; }
    std::uint64_t folded() const { return folded_; }  // points whose cells are
    std::uint64_t flat() const { return flat_; }      // whose cells have no volume
    std::uint64_t absent() const { return absent_; }  // that have no place
    std::uint64_t bytes() const;

    friend bool operator==(const Mesh& a, const Mesh& b) {
        return a.size_ == b.size_ && a.origin_ == b.origin_ && a.levels_ == b.levels_ &&
               a.period_ == b.period_ && std::ranges::equal(a.stored(), b.stored());
    }

 private:
    void takePlaces(const MeshPlaces& places);
    struct Sums;
    void measure();
    void addLevels(Sums& sums) const;
    std::span<const glm::vec3> stored() const { return {at_.data(), stored_}; }
    glm::dvec3 placeAt(const std::array<std::size_t, 3>& ijk) const;
    glm::dmat3 stepsAt(const std::array<std::size_t, 3>& ijk) const;

    std::array<std::size_t, 3> size_;
    glm::dvec3 origin_{0};  // `at_` and `levels_` are relative to it: floats keep what they can
    std::uint64_t stored_ = 0;
    Pages<glm::vec3> at_;  // [stored_]
    std::vector<double> levels_;
    glm::dvec3 period_{0};
    glm::dvec3 lo_{0}, hi_{0}, widest_{0};
    double meanVolume_ = 0, thickness_ = 0;
    double sign_ = 1;  // of the determinants of most cells
    std::uint64_t folded_ = 0, flat_ = 0, absent_ = 0;
};

// What of a mesh is not drawn as it is, a sentence each.
std::vector<std::string> notesOf(const Mesh& mesh);

}  // namespace timeseries

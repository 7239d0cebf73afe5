// The solid cells of an unstructured grid whose points have the values, and how they are parted
// into tetrahedra, between whose corners the field is linear.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/unstructured.h"

namespace timeseries {

// A cell is the cone from the least of its corners over those faces that lack it, and a face the
// fan from the least of its own (Dompierre, Labbe, Vallet, Camarero, "How to subdivide pyramids,
// prisms and hexahedra into tetrahedra", 1999): by the points' numbers alone, so that two cells
// part the face between them alike, whatever their shapes. Of curved cells the corners count.
class SolidCells {
 public:
    // Null where no cell is a solid. Surfaces, lines and points beside them take no space, and are
    // left out, as is a cell with a corner beyond the first `points`. REQUIRES: no flaw.
    static std::shared_ptr<const SolidCells> of(const UnstructuredGrid& grid, std::uint64_t points);

    std::uint64_t count() const { return types_.size(); }
    // Of a cell, the points at its corners: those of all of its tetrahedra.
    std::span<const std::uint32_t> corners(std::uint64_t cell) const {
        return listOf(corners_, ends_, cell);
    }
    // Begin to load where its corners stand, and then these: cells that are asked for by value lie
    // anywhere.
    void prefetchEnds(std::uint64_t cell) const {
        asm volatile("");  // or compilers take this for a function without an effect
        __builtin_prefetch(ends_.data() + (cell == 0 ? 0 : cell - 1));
    }
    void prefetchCorners(std::uint64_t cell) const {
        asm volatile("");
        __builtin_prefetch(corners(cell).data());
    }
    // use(std::array<std::uint32_t, 4>): the points at a tetrahedron's corners, the cell's least
    // first.
    template <typename Use>
    void forEachTet(std::uint64_t cell, const Use& use) const;
    // How far corners of a cell are apart along each coordinate, at most.
    const glm::dvec3& longest() const { return longest_; }
    std::uint64_t tets() const { return tets_; }  // of all cells
    std::uint64_t bytes() const;
    friend bool operator==(const SolidCells&, const SolidCells&) = default;

 private:
    void add(const UnstructuredGrid& grid, std::uint64_t cell, std::uint64_t points);
    void measure(std::span<const glm::dvec3> points);

    // Lists as UnstructuredGrid has them, but that faces are not counted.
    PageVector<std::uint8_t> types_;
    PageVector<std::uint64_t> ends_, faceEnds_;
    PageVector<std::uint32_t> corners_, faces_;
    glm::dvec3 longest_{0};
    std::uint64_t tets_ = 0;
};

template <typename Use>
void SolidCells::forEachTet(std::uint64_t cell, const Use& use) const {
    const auto all = corners(cell);
    const std::uint32_t apex = *std::ranges::min_element(all);
    // The points of a face, so many, round it.
    const auto overFace = [&](std::size_t size, const auto& pointAt) {
        std::size_t least = 0;
        for (std::size_t i = 0; i < size; ++i) {
            if (pointAt(i) == apex) return;
            if (pointAt(i) < pointAt(least)) least = i;
        }
        for (std::size_t i = 1; i + 1 < size; ++i)
            use(std::array{apex, pointAt(least), pointAt((least + i) % size),
                           pointAt((least + i + 1) % size)});
    };
    if (types_[cell] == kPolyhedron) {
        const auto list = listOf(faces_, faceEnds_, cell);
        std::size_t at = 0;
        while (at < list.size()) {
            overFace(list[at], [&](std::size_t i) { return list[at + 1 + i]; });
            at += 1 + list[at];
        }
        return;
    }
    const CellType& type = *cellTypeOf(types_[cell]);
    std::size_t at = 0;
    for (const std::uint8_t size : type.faceSizes) {
        overFace(size, [&](std::size_t i) { return all[type.faces[at + i]]; });
        at += size;
    }
}

}  // namespace timeseries

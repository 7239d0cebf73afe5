// The solid cells of an unstructured grid, or the prisms between columns of points, and how they
// are parted into tetrahedra, between whose corners the field is linear.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
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
    // Of a grid whose cells have the values: each is parted about its middle, which is the point
    // that stands for it and has its number in the file. The grid's own points, its nodes, are
    // numbered on from the last cell: timeseries/index/node_values.h says what the field has there.
    // Cells whose nodes are in one place share the first (but of large grids that tell of no parts,
    // and where hardly more points than cells say the same), and where bricks of two sizes meet,
    // they do face to face, for the larger ones are polyhedra there.
    static std::shared_ptr<const SolidCells> aboutMiddles(const UnstructuredGrid& grid);
    bool haveMiddles() const { return firstNode_ > 0; }
    // The number of the first node; 0 where there are none. REQUIRES of the point that stands for a
    // cell: haveMiddles().
    std::uint64_t firstNode() const { return firstNode_; }
    std::uint32_t middle(std::uint64_t cell) const { return corners_[ends_[cell] - 1]; }

    // Three columns that stand beside each other, the least first.
    using Foot = std::array<std::uint32_t, 3>;
    using Feet = std::shared_ptr<const std::vector<Foot>>;
    // A prism above each foot between one level of so many columns and the next: the point of a
    // column at level k has the number k * columns + column. `longest` as below, of who knows the
    // places. Null where there is none, or more than numbers of 32 bits tell.
    static std::shared_ptr<const SolidCells> ofColumns(Feet feet, std::uint64_t columns,
                                                       std::size_t levels,
                                                       const glm::dvec3& longest);
    // How far a foot's columns are apart along the first two coordinates, at most; of those that
    // are about a pole, where the first is a longitude that comes round after `turn`, across that.
    static glm::dvec2 longestOf(std::span<const Foot> feet, double turn,
                                const std::function<glm::dvec2(std::uint32_t column)>& at);
    // Whether columns so far apart along the first coordinate are on two sides of a pole: on a
    // flat map nothing is between them.
    static bool isAboutPole(double way, double turn) {
        constexpr double kMost = 0.26;
        return turn > 0 && way > kMost * turn;
    }
    // Null where they are no prisms between columns.
    const Feet& feet() const { return feet_; }

    std::uint64_t count() const { return feet_ ? feet_->size() * layers_ : types_.size(); }
    // Of a cell, the points at its corners: those of all of its tetrahedra. It may be `room` that
    // holds them.
    using Room = std::array<std::uint32_t, 6>;
    std::span<const std::uint32_t> corners(std::uint64_t cell, Room& room) const {
        return feet_ ? prism(cell, room) : listOf(corners_, ends_, cell);
    }
    // A point among them: the middle, if it has one, or the first, which of a prism is the least,
    // too.
    std::uint32_t firstCorner(std::uint64_t cell) const {
        Room room;
        return haveMiddles() ? middle(cell) : corners(cell, room).front();
    }
    // Begin to load where its corners stand, and then these: cells that are asked for by value lie
    // anywhere.
    void prefetchEnds(std::uint64_t cell) const {
        asm volatile("");  // or compilers take this for a function without an effect
        if (feet_)
            __builtin_prefetch(feet_->data() + cell % feet_->size());
        else
            __builtin_prefetch(ends_.data() + (cell == 0 ? 0 : cell - 1));
    }
    void prefetchCorners(std::uint64_t cell) const {
        asm volatile("");
        if (!feet_) __builtin_prefetch(listOf(corners_, ends_, cell).data());
    }
    // use(node) for each that the cell has, once. REQUIRES: haveMiddles().
    template <typename Use>
    void forEachNode(std::uint64_t cell, const Use& use) const;
    // use(size, pointAt): a face of so many points, pointAt(i) round it.
    template <typename Use>
    void forEachFace(std::uint64_t cell, const Use& use) const;
    // use(std::array<std::uint32_t, 4>): the points at a tetrahedron's corners, the cell's least
    // first.
    template <typename Use>
    void forEachTet(std::uint64_t cell, const Use& use) const;
    // How far corners of a cell are apart along each coordinate, at most.
    const glm::dvec3& longest() const { return longest_; }
    std::uint64_t tets() const { return tets_; }  // of all cells
    std::uint64_t bytes() const;
    // Whether the same points are corners of the same cells, wherever they lie.
    bool joinsAs(const SolidCells& other) const;
    friend bool operator==(const SolidCells& a, const SolidCells& b) {
        return a.joinsAs(b) && a.longest_ == b.longest_;
    }

 private:
    static std::shared_ptr<SolidCells> ofSolids(const UnstructuredGrid& grid, std::uint64_t points,
                                                std::uint32_t firstNode);
    void takeAll(const UnstructuredGrid& grid, std::uint64_t points);
    void add(const UnstructuredGrid& grid, std::uint64_t cell, std::uint64_t points);
    void addFaces(std::span<const std::uint32_t> list);
    template <typename Use>
    void forEachFaceCorner(const Use& use);
    void measure(std::span<const glm::dvec3> points);
    std::uint64_t tetsOf(std::uint64_t cell) const;
    std::span<const std::uint32_t> prism(std::uint64_t cell, Room& room) const {
        const std::uint64_t layer = cell / feet_->size();
        const Foot& foot = (*feet_)[cell % feet_->size()];
        for (std::size_t i = 0; i < 3; ++i) {
            room[i] = static_cast<std::uint32_t>(layer * columns_ + foot[i]);
            room[i + 3] = static_cast<std::uint32_t>((layer + 1) * columns_ + foot[i]);
        }
        return room;
    }

    // Lists as UnstructuredGrid has them, but that faces are not counted.
    PageVector<std::uint8_t> types_;
    PageVector<std::uint64_t> ends_, faceEnds_;
    PageVector<std::uint32_t> corners_, faces_;
    std::uint32_t firstNode_ = 0;
    Feet feet_;
    std::uint64_t columns_ = 0, layers_ = 0;
    glm::dvec3 longest_{0};
    std::uint64_t tets_ = 0;
};

template <typename Use>
void SolidCells::forEachFace(std::uint64_t cell, const Use& use) const {
    const std::uint8_t ofType = feet_ ? kWedgeCell : types_[cell];
    if (ofType == kPolyhedron) {
        const auto list = listOf(faces_, faceEnds_, cell);
        std::size_t at = 0;
        while (at < list.size()) {
            use(std::size_t{list[at]}, [&](std::size_t i) { return list[at + 1 + i]; });
            at += 1 + list[at];
        }
        return;
    }
    Room room;
    const auto all = corners(cell, room);
    const CellType& type = *cellTypeOf(ofType);
    std::size_t at = 0;
    for (const std::uint8_t size : type.faceSizes) {
        use(std::size_t{size}, [&](std::size_t i) { return all[type.faces[at + i]]; });
        at += size;
    }
}

template <typename Use>
void SolidCells::forEachNode(std::uint64_t cell, const Use& use) const {
    constexpr std::size_t kMostOfAShape = 12;  // collapsed ones have some twice
    const auto nodes = listOf(corners_, ends_, cell);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const bool isAgain = nodes.size() <= kMostOfAShape + 1 &&
                             std::ranges::find(nodes.first(i), nodes[i]) != nodes.begin() + i;
        if (!isAgain) use(nodes[i]);
    }
}

template <typename Use>
void SolidCells::forEachTet(std::uint64_t cell, const Use& use) const {
    Room room;
    const std::uint32_t apex = *std::ranges::min_element(corners(cell, room));
    forEachFace(cell, [&](std::size_t size, const auto& pointAt) {
        std::size_t least = 0;
        for (std::size_t i = 0; i < size; ++i) {
            if (pointAt(i) == apex) return;
            if (pointAt(i) < pointAt(least)) least = i;
        }
        for (std::size_t i = 1; i + 1 < size; ++i)
            use(std::array{apex, pointAt(least), pointAt((least + i) % size),
                           pointAt((least + i + 1) % size)});
    });
}

}  // namespace timeseries

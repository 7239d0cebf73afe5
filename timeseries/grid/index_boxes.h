// Boxes of the cells of a lattice, as adaptive meshes are made of: which of them meet, and which
// cells of one others cover. Whole numbers alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace timeseries {

struct IndexBox {
    std::array<std::int64_t, 3> first{}, last{};  // empty where first > last along an axis

    bool isEmpty() const;
    bool holds(const IndexBox& other) const;
    // REQUIRES: not empty.
    std::array<std::uint64_t, 3> size() const;
    std::uint64_t count() const;  // at most 2^62
    // Of a cell among its own, x fastest.
    std::uint64_t placeOf(const std::array<std::int64_t, 3>& cell) const;
    friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

IndexBox common(const IndexBox& a, const IndexBox& b);
// The least that holds both.
IndexBox around(const IndexBox& a, const IndexBox& b);

// Of the cells of a box, x fastest, those that another has too become true. `covered` stays as it
// is where there are none, and else is made as long as the box has cells.
void cover(std::vector<bool>& covered, const IndexBox& box, const IndexBox& by);

// Many boxes, to be asked for those about a place: a tree of bounds, halved at the middle of their
// longest side (J. L. Bentley, Multidimensional binary search trees, 1975).
class IndexBoxes {
 public:
    // REQUIRES: they stay, none is empty, fewer than 2^32.
    explicit IndexBoxes(std::span<const IndexBox> boxes);
    // Calls use(which) for each that has a cell of the box, until it says false.
    void forEachMeeting(const IndexBox& box, const std::function<bool(std::size_t)>& use) const;

 private:
    struct Node {
        IndexBox bounds;
        std::uint32_t first, count;  // in order_
        std::uint32_t second = 0;  // the node of the second half, the first's follows; 0: no halves
    };
    void add(std::uint32_t first, std::uint32_t count);

    std::span<const IndexBox> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace timeseries

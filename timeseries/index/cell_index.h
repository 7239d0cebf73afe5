// The cells of a grid by the values that a field takes in them: which cells an interval of values
// reaches into is a few contiguous runs, found by binary search, as it is for points.
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/range_set.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/together.h"

namespace timeseries {

// A cell is the box between eight neighbouring points. Beyond the outermost points lie half cells,
// whose outer corners repeat the points' values, so that cells fill what the points stand for:
// along each axis there is one more of them than of points, and cell i lies between points i - 1
// and i. Cells are numbered x fastest.
//
// They are kept in classes of half their range of values, two an octave, each in order of the
// middle of that range: in a class of ranges up to 2 H, the cells that reach into [a, b] have their
// middles in [a - H, b + H]. Memory: 8 bytes a cell that is kept, and the field's values.
class CellIndex {
 public:
    // Whether the cells of such a grid, and its values, take kMostBytes or less. They are few
    // enough to be numbered then.
    static constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;
    static bool canIndex(const Grid& grid, ValueType type);
    // Looks at every value, on so many threads. Cells without a finite corner are left out, and so
    // are those that select() would not give for `among`: who asks for little waits for little.
    // REQUIRES: canIndex(*field->grid, its type).
    explicit CellIndex(std::shared_ptr<const Field> field, unsigned threads = sharingThreads(),
                       std::vector<Interval<double>> among = {kAllNumbers});
    explicit CellIndex(Field field, unsigned threads = sharingThreads(),
                       std::vector<Interval<double>> among = {kAllNumbers})
        : CellIndex(std::make_shared<const Field>(std::move(field)), threads, std::move(among)) {}

    const Field& field() const { return *field_; }
    const std::shared_ptr<const Field>& sharedField() const { return field_; }
    // Whether each of these lies in one of those among which it has cells.
    bool holds(std::span<const Interval<double>> intervals) const;
    glm::uvec3 size() const { return size_; }  // cells along the axes
    std::uint64_t count() const { return list_.size(); }

    // Places in the list: disjoint, ascending, none empty. They hold every cell that reaches into
    // one of these, and few others: the same ones, in the same order, of every index that has them.
    // Two binary searches for each class and interval. REQUIRES: holds(intervals).
    std::vector<Run> select(std::span<const Interval<double>> intervals) const;
    // Half the range of values in a cell that this share of the cells of these runs has or less, to
    // half an octave; 0 where there are none.
    double halfRange(std::span<const Run> runs, double share) const;
    // Its number, of a place in the list.
    std::uint32_t cell(std::uint64_t place) const {
        return static_cast<std::uint32_t>(list_[place]);
    }
    // Corners are numbered x fastest: the point, along the axes, whose value a corner has.
    glm::uvec3 pointAt(const glm::uvec3& cell, unsigned corner) const {
        const glm::uvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::uvec3 up = glm::max(cell + side, glm::uvec3(1)) - 1u;
        return glm::min(up, size_ - 2u);
    }
    // Of a cell; NaN where a value is missing or not finite.
    std::array<double, 8> corners(const glm::uvec3& cell) const;
    // Begins to fetch what corners() of that cell will read: cells of like values lie all over the
    // field.
    void prefetch(std::uint32_t cell) const;
    std::uint64_t bytes() const;

 private:
    struct Class {
        double halfRange;  // at most, of the cells in it
        std::uint64_t first, count;
    };
    class Rows;
    class Wanted;

    std::shared_ptr<const Field> field_;
    std::vector<Interval<double>> among_;
    glm::uvec3 size_{0};
    std::vector<Class> classes_;       // none empty
    std::vector<std::uint64_t> list_;  // ordered middle << 32 | number
};

// Ranges of a field's own type as ranges of the field between its points, ascending. Those of whole
// numbers reach half a number farther: what was rounded to 7 was anything from 6.5 to 7.5.
std::vector<Interval<double>> betweenPoints(const RangeSet& ranges, ValueType type);

}  // namespace timeseries

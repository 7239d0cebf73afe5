// The cells of a grid by the values that a field takes in them: which cells an interval of values
// reaches into is a few contiguous runs, found by binary search, as it is for points.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/cell_corners.h"
#include "timeseries/index/range_set.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/together.h"

namespace timeseries {

// Cells as CellCorners has them, numbered x fastest, or solid ones (timeseries/grid/solid_cells.h)
// as their grid lists them, are kept in classes of half their range of
// values, two an octave, each in order of the middle of that range: in a class of ranges up to 2 H,
// the cells that reach into [a, b] have their middles in [a - H, b + H]. Memory: 8 bytes a cell
// that is kept, and the field's values.
class CellIndex {
 public:
    // Whether the cells of such a grid, and its values, take kMostBytes or less. They are few
    // enough to be numbered then.
    static constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;
    static bool canIndex(const Grid& grid, ValueType type);
    // What the values of such a field take, and all its cells beside them.
    struct Bytes {
        double values, cells;
    };
    static Bytes bytesOf(const Grid& grid, ValueType type);
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
    // Of points that have neighbours.
    const CellCorners& cornersOf() const { return corners_; }
    // Cells along the indices; of solid ones all are along the first.
    glm::uvec3 size() const { return size_; }
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
    // Begins to fetch what the corners of that cell have: cells of like values lie all over the
    // field.
    void prefetch(std::uint32_t cell) const;
    std::uint64_t bytes() const;

 private:
    struct Class {
        double halfRange;  // at most, of the cells in it
        std::uint64_t first, count;
    };
    class Wanted;

    std::shared_ptr<const Field> field_;
    std::vector<Interval<double>> among_;
    CellCorners corners_;
    glm::uvec3 size_;
    std::vector<Class> classes_;       // none empty
    std::vector<std::uint64_t> list_;  // ordered middle << 32 | number
};

// Ranges of a field's own type as ranges of the field between its points, ascending. Those of whole
// numbers reach half a number farther: what was rounded to 7 was anything from 6.5 to 7.5.
std::vector<Interval<double>> betweenPoints(const RangeSet& ranges, ValueType type);

}  // namespace timeseries

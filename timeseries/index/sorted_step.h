// One time step with its points sorted by value (Crawfis 1996, "Fast volume rendering of data
// slices"): any value range is then one run of consecutive points, found by two binary searches.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/range_set.h"
#include "timeseries/together.h"

namespace timeseries {

// Consecutive points of a SortedStep: [first, first + count).
struct Run {
    std::uint64_t first = 0, count = 0;
    friend bool operator==(const Run&, const Run&) = default;
};

// A query that reaches outside the ranges that were kept. what() is one sentence.
struct OutsideKeptError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

// Values as they lie in memory, of the types of Values in its order.
using ValueSpan = std::variant<std::span<const std::uint8_t>, std::span<const std::int8_t>,
                               std::span<const std::uint16_t>, std::span<const std::int16_t>,
                               std::span<const std::uint32_t>, std::span<const std::int32_t>,
                               std::span<const std::uint64_t>, std::span<const std::int64_t>,
                               std::span<const float>, std::span<const double>>;

// What a step knows of its points, each in order of value. Of the step, which must outlive them.
struct Columns {
    ValueSpan values;                          // ascending
    std::span<const std::uint32_t> gridIndex;  // ties ascend, too
};

// So many quantiles are kept of a step, in memory and on disk.
constexpr std::size_t kStepQuantiles = 1024 + 1;

// The whole step before anything was dropped.
struct StepStatistics {
    std::uint64_t points = 0;   // valid: neither missing nor NaN
    std::uint64_t missing = 0;  // marked missing, or NaN
    Number min, max;            // of the valid points, infinities included; NaN when there is none
    Number finiteMin, finiteMax;  // infinities aside; NaN when there is none
};

template <typename T>
class LazyColumn;      // timeseries/index/lazy_column.h
class CellIndex;       // timeseries/index/cell_index.h
class Mesh;            // timeseries/grid/mesh.h
class PointGradients;  // timeseries/index/point_gradients.h
class StepFile;        // timeseries/index/step_file.h

// Of a field, the values of so many planes along its last index, without a grid, in the memory of
// planes that were read before; not once the field is not the same any more.
using PlanesOf = std::function<bool(std::size_t first, std::size_t count, Field& planes)>;

// Immutable, but for what nobody can tell: points are put in order where somebody first looks.
// Every member is safe to call from any thread. Memory: sizeof(value) + 4 bytes a kept point; 4,
// and 16 a value that there is, of large steps of 8 and 16 bits whose values are not asked for. Any
// member may throw std::bad_alloc.
class SortedStep {
 public:
    // Points ascend by value; equal values (also -0 and +0) ascend by grid index. Values outside
    // `kept` are dropped. Throws std::length_error for a field of more than 2^32 points. So many
    // threads build it, and put points in order later.
    static SortedStep build(const Field& field, const RangeSet& kept = RangeSet::everything(),
                            unsigned threads = sharingThreads());
    // Gives the field's values back while it takes them: of a step that is large for the machine
    // the two never are there whole at once.
    static SortedStep build(Field&& field, const RangeSet& kept = RangeSet::everything(),
                            unsigned threads = sharingThreads());

    // For those who will ask for cells, or for the field, of all values, and for points in `kept`
    // alone: the field is held until there are cells of it, where there can be.
    static SortedStep buildWithField(Field field, const RangeSet& kept = RangeSet::everything(),
                                     unsigned threads = sharingThreads());

    // What a step on disk was made of. Called from any thread.
    struct Source {
        // Makes the same step anew, and tells `why`.
        std::function<SortedStep(const std::string& why)> again;
        // The field itself, if it is still the one; may be empty.
        std::function<std::optional<Field>()> field = {};
        // Opens it for reading parts; gives nothing where these are not sooner read than all. May
        // be empty.
        std::function<PlanesOf()> planes = {};
    };
    // A step that was written to a file, of which it reads what is looked at. When the file turns
    // out to be damaged, the step is made anew, once, and what is shown is then from there. Throws
    // StepFileError when the file is of another grid. Members may then throw what `again` throws.
    static SortedStep stored(std::shared_ptr<const StepFile> file, std::shared_ptr<const Grid> grid,
                             bool categories, Source source, unsigned threads = sharingThreads());
    // A step of which nothing else is known than its file: `again` throws what was wrong.
    static SortedStep ofFile(std::shared_ptr<const StepFile> file, std::shared_ptr<const Grid> grid,
                             bool categories);
    // Null unless it is read from a file.
    const std::shared_ptr<const StepFile>& file() const { return file_; }
    // This step with fewer points in memory: those in `runs`, which ascend, and of the others that
    // are there those last looked at, by so many bytes in all. It copies them; cells are shared.
    // REQUIRES: file().
    SortedStep reopened(std::span<const Run> runs = {}, std::uint64_t bytes = 0) const;
    // All values in the grid's order: of the source, which is soon read, where there is one.
    // Missing points are marked or NaN. REQUIRES: all values were kept, or a source.
    Field field() const;
    // The field without reading, where there are cells of it or it is held for them; else null.
    std::shared_ptr<const Field> fieldIfThere() const;
    // That, else field(); with its values at nodes (timeseries/index/node_values.h).
    std::shared_ptr<const Field> sharedField() const;
    // Of the source of field(); of one thread. May give nothing.
    PlanesOf openPlanes() const { return source_.planes ? source_.planes() : PlanesOf(); }

    // Disjoint, ascending, none empty. Two binary searches a range, and half a millisecond where an
    // end of a range falls among points of which none was asked for yet.
    // Throws OutsideKeptError when `ranges`, in the field's type, is not inside what was kept.
    std::vector<Run> select(const RangeSet& ranges) const;
    // The sum of select()'s counts; touches no point.
    std::uint64_t count(const RangeSet& ranges) const;
    // How many of the kept points have values less than this one.
    std::uint64_t countBelow(double value) const;

    // What of `ranges` was kept, in the field's type: select() takes it whatever the rounding of
    // its bounds.
    RangeSet keptPart(const RangeSet& ranges) const;

    std::uint64_t size() const { return size_; }
    bool ofCategories() const { return ofCategories_; }
    // Of all points, which puts all in order: a few times what building took.
    Columns columns() const;
    // Of all points, but only those in `runs` may be read: a step may not have put the others in
    // order yet.
    Columns columns(std::span<const Run> runs) const;
    std::span<const std::uint32_t> gridIndex() const { return columns().gridIndex; }
    std::uint32_t gridIndex(std::uint64_t point) const;
    Number value(std::uint64_t point) const;
    ValueType type() const { return static_cast<ValueType>(columns_.index()); }
    const Grid& grid() const { return *grid_; }
    const std::shared_ptr<const Grid>& sharedGrid() const { return grid_; }
    const RangeSet& kept() const { return kept_; }
    const StepStatistics& statistics() const { return statistics_; }
    // Of memory held, that of cells and gradients too, and of a mesh if it is this step's alone.
    std::uint64_t bytes() const;
    // Of memory held by points, and what those in `runs`, which ascend, take when they are there.
    std::uint64_t pointBytes() const;
    std::uint64_t pointBytes(std::span<const Run> runs) const;

    // The cells between the points that reach into these ranges (betweenPoints), made when they are
    // first asked for; that takes as long as looking at every value twice, and 8 bytes a cell
    // beside the values. Who asks for others than the first did gets all. Null unless
    // canHaveCells().
    std::shared_ptr<const CellIndex> cells(std::vector<Interval<double>> among = {
                                               kAllNumbers}) const;
    // Null as long as nobody has made them.
    std::shared_ptr<const CellIndex> cellsIfMade(const std::vector<Interval<double>>& among = {
                                                     kAllNumbers}) const;
    // Nobody is to make them any more: there is no memory for them.
    void giveUpCells() const;
    bool cellsAreGivenUp() const;
    // How the field changes about its points on this mesh, its grid's or what a map makes of that:
    // made when it is first asked for, and kept until that of another is. REQUIRES: canHaveCells().
    std::shared_ptr<const PointGradients> gradients(const std::shared_ptr<const Mesh>& mesh) const;
    // Null as long as nobody has made them.
    std::shared_ptr<const PointGradients> gradientsIfMade(
        const std::shared_ptr<const Mesh>& mesh) const;
    // Why there are none, in a few words; "" where there can be.
    std::string_view whyNoCells() const;
    bool canHaveCells() const { return whyNoCells().empty(); }

    // The points between the infinities: all but the first and the last ones that are infinite.
    Run finite() const;

    // Value at the fractions 0, 1/(n-1), ..., 1 of the kept points that are finite (nearest rank);
    // empty when there is none.
    std::vector<double> quantiles(std::size_t n) const;

 private:
    SortedStep() = default;
    template <typename Passed>
    static SortedStep buildOf(const Field& field, const RangeSet& kept, unsigned threads,
                              const Passed& passed);
    std::string_view whyNothingBetween() const;  // points, whatever was kept
    std::shared_ptr<const Grid> grid_;
    // In the order of Values' alternatives.
    template <typename... T>
    using Shared = std::variant<std::shared_ptr<const LazyColumn<T>>...>;
    Shared<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t, std::int32_t,
           std::uint64_t, std::int64_t, float, double>
        columns_;
    std::uint64_t size_ = 0;
    unsigned threads_ = 1;
    bool ofCategories_ = false;
    RangeSet kept_;
    StepStatistics statistics_;
    std::shared_ptr<const StepFile> file_;
    Source source_;
    class LazyCells;
    std::shared_ptr<LazyCells> cells_;
};

}  // namespace timeseries

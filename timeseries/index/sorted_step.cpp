#include "timeseries/index/sorted_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/with_type.h"
#include "timeseries/index/cell_index.h"
#include "timeseries/index/lazy_cells.h"
#include "timeseries/index/lazy_column.h"
#include "timeseries/index/node_values.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_file.h"
#include "timeseries/index/step_statistics.h"
#include "timeseries/index/stored_column.h"

namespace timeseries {
namespace {

constexpr std::string_view kTooMany = "so many cells would not fit the memory";

// Of points without neighbours.
std::string_view whyNoSolids(const MeshAbout& about) {
    using enum MeshAbout::Points;
    if (about.points == Scattered || about.points == Particles)
        return "nothing is known between points that lie by themselves";
    const auto isSolid = [](const MeshAbout::Kind& kind) {
        const CellType* const type = cellTypeOf(kind.type);
        return type && type->dimension == 3;
    };
    if (std::ranges::any_of(about.cells, isSolid)) return kTooMany;
    return "the values are of surfaces, or of columns on them, not of solid cells";
}

// REQUIRES: both as RangeSet::toIntervals gives them.
template <typename T>
bool inside(const Interval<T>& query, const std::vector<Interval<T>>& kept) {
    for (const Interval<T>& k : kept)
        if (k.lo <= query.lo && query.hi <= k.hi) return true;
    return false;
}

template <typename T, typename Visit>
void forEachRun(const LazyColumn<T>& points, const RangeSet& ranges, const RangeSet& kept,
                const Visit& visit) {
    const auto keptIntervals = kept.toIntervals<T>();
    for (const Interval<T>& query : ranges.toIntervals<T>()) {
        if (!inside(query, keptIntervals))
            throw OutsideKeptError(fmt::format(
                "range {} reaches outside what was kept, {}: keep more, or ask inside it",
                ranges.text(), kept.empty() ? "nothing" : kept.text()));
        const Run run = points.find(query);
        if (run.count > 0) visit(run);
    }
}

// The values of T that both ranges hold, by the bounds as they are written where these say it. A
// range that holds nothing, or none, where there are no such values.
template <typename T>
std::optional<Range> commonPart(const Range& a, const Range& b) {
    Interval<T> x, y, both;
    if (!toInterval(a, x) || !toInterval(b, y)) return std::nullopt;
    const Interval<T> common{std::max(x.lo, y.lo), std::min(x.hi, y.hi)};
    const Range written{x.lo < y.lo ? b.lo : a.lo, y.hi < x.hi ? b.hi : a.hi};
    if (toInterval(written, both)) return written;  // no, if its bounds cross though T joins them
    return Range{{numberOf(common.lo)}, {numberOf(common.hi)}};
}

// The least value of T that is not less than this one; none where all are less.
template <typename T>
std::optional<T> leastNotBelow(double value) {
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_floating_point_v<T>) {
        const T near = static_cast<T>(value);
        return static_cast<double>(near) < value ? std::nextafter(near, Limits::infinity()) : near;
    } else {
        const double whole = std::ceil(value);
        if (whole >= std::ldexp(1.0, Limits::digits)) return std::nullopt;
        return whole <= static_cast<double>(Limits::min()) ? Limits::min() : static_cast<T>(whole);
    }
}

// More of them look into most of a step's buckets.
constexpr std::size_t kFewQuantiles = 64;

}  // namespace

template <typename Passed>
SortedStep SortedStep::buildOf(const Field& field, const RangeSet& kept, unsigned threads,
                               const Passed& passed) {
    SortedStep step;
    step.grid_ = field.grid;
    step.kept_ = kept;
    step.threads_ = threads;
    step.ofCategories_ = field.categories;
    step.cells_ = std::make_shared<LazyCells>();
    std::visit(
        [&]<typename T>(const std::vector<T>& all) {
            expectOneList(all.size());
            const auto intervals = kept.toIntervals<T>();
            Partition<T> points =
                partition<T>(all, field.missing, intervals,
                             {.threads = threads, .passed = passed(std::span<const T>(all))});
            step.statistics_ = statisticsOf(all.size(), points);
            step.size_ = points.points();
            step.columns_ = std::make_shared<const LazyColumn<T>>(std::move(points), threads);
        },
        field.values);
    return step;
}

SortedStep SortedStep::build(const Field& field, const RangeSet& kept, unsigned threads) {
    using Passed = std::function<void(std::size_t, std::size_t)>;
    return buildOf(field, kept, threads, [](const auto&) { return Passed(); });
}

SortedStep SortedStep::build(Field&& field, const RangeSet& kept, unsigned threads) {
    Field consumed = std::move(field);
    return buildOf(consumed, kept, threads, []<typename T>(std::span<const T> values) {
        return [at = const_cast<T*>(values.data())](std::size_t first, std::size_t last) {
            giveBack(at + first, (last - first) * sizeof(T));
        };
    });
}

SortedStep SortedStep::buildWithField(Field field, const RangeSet& kept, unsigned threads) {
    SortedStep step = build(field, kept, threads);
    if (step.whyNothingBetween().empty())
        step.cells_ = std::make_shared<LazyCells>(std::move(field));
    return step;
}

SortedStep SortedStep::stored(std::shared_ptr<const StepFile> file,
                              std::shared_ptr<const Grid> grid, bool categories, Source source,
                              unsigned threads) {
    if (!std::ranges::equal(file->size(), grid->size()))
        throw StepFileError(fmt::format("{} is the index of another grid", file->name()));
    SortedStep step;
    step.grid_ = std::move(grid);
    step.kept_ = RangeSet::everything();
    step.threads_ = threads;
    step.ofCategories_ = categories;
    step.cells_ = std::make_shared<LazyCells>();
    step.statistics_ = file->statistics();
    step.size_ = step.statistics_.points;
    withType(file->type(), [&]<typename T>(T) {
        step.columns_ =
            std::shared_ptr<const LazyColumn<T>>(storedColumn<T>(file, source.again, threads));
    });
    step.file_ = std::move(file);
    step.source_ = std::move(source);
    return step;
}

SortedStep SortedStep::reopened(std::span<const Run> runs, std::uint64_t bytes) const {
    SortedStep step = *this;
    std::visit(
        [&]<typename T>(const std::shared_ptr<const LazyColumn<T>>& points) {
            auto fewer = storedColumn<T>(file_, source_.again, threads_);
            fewer->takeOver(*points, runs, bytes);
            step.columns_ = std::shared_ptr<const LazyColumn<T>>(std::move(fewer));
        },
        columns_);
    return step;
}

SortedStep SortedStep::ofFile(std::shared_ptr<const StepFile> file,
                              std::shared_ptr<const Grid> grid, bool categories) {
    const auto never = [](const std::string& why) -> SortedStep { throw StepFileError(why); };
    return stored(std::move(file), std::move(grid), categories, {never});
}

std::vector<Run> SortedStep::select(const RangeSet& ranges) const {
    std::vector<Run> runs;
    std::visit(
        [&](const auto& points) {
            forEachRun(*points, ranges, kept_, [&](const Run& run) { runs.push_back(run); });
        },
        columns_);
    return runs;
}

std::uint64_t SortedStep::count(const RangeSet& ranges) const {
    std::uint64_t count = 0;
    std::visit(
        [&](const auto& points) {
            forEachRun(*points, ranges, kept_, [&](const Run& run) { count += run.count; });
        },
        columns_);
    return count;
}

std::uint64_t SortedStep::countBelow(double value) const {
    if (std::isnan(value)) return 0;
    return std::visit(
        [&]<typename T>(const std::shared_ptr<const LazyColumn<T>>& points) {
            const std::optional<T> least = leastNotBelow<T>(value);
            return least ? points->below(orderedKey(*least)) : points->size();
        },
        columns_);
}

RangeSet SortedStep::keptPart(const RangeSet& ranges) const {
    std::vector<Range> parts;
    std::visit(
        [&]<typename T>(const std::shared_ptr<const LazyColumn<T>>&) {
            for (const Range& range : ranges.ranges())
                for (const Range& kept : kept_.ranges())
                    if (const auto part = commonPart<T>(range, kept)) parts.push_back(*part);
        },
        columns_);
    return RangeSet(std::move(parts));
}

Columns SortedStep::columns() const {
    const Run all{0, size_};
    return columns({&all, 1});
}

Columns SortedStep::columns(std::span<const Run> runs) const {
    return std::visit(
        [&](const auto& points) {
            for (const Run& run : runs) points->order(run);
            return Columns{points->values(), points->gridIndex()};
        },
        columns_);
}

std::uint32_t SortedStep::gridIndex(std::uint64_t point) const {
    const Run only{point, 1};
    return columns({&only, 1}).gridIndex[point];
}

Number SortedStep::value(std::uint64_t point) const {
    const Run only{point, 1};
    return std::visit([&](auto values) { return numberOf(values[point]); },
                      columns({&only, 1}).values);
}

std::uint64_t SortedStep::bytes() const {
    return pointBytes() + cells_->bytes() + (grid_->ofOneStep() ? grid_->mesh()->bytes() : 0);
}

std::uint64_t SortedStep::pointBytes() const {
    return std::visit([](const auto& points) { return points->bytes(); }, columns_);
}

std::uint64_t SortedStep::pointBytes(std::span<const Run> runs) const {
    return std::visit([&](const auto& points) { return points->bytes(runs); }, columns_);
}

std::shared_ptr<const CellIndex> SortedStep::cells(std::vector<Interval<double>> among) const {
    if (!canHaveCells()) return nullptr;
    return cells_->get(std::move(among), threads_, [this] { return field(); });
}

std::shared_ptr<const CellIndex> SortedStep::cellsIfMade(
    const std::vector<Interval<double>>& among) const {
    return cells_->ifMade(among);
}

void SortedStep::giveUpCells() const { cells_->giveUp(); }
bool SortedStep::cellsAreGivenUp() const { return cells_->areGivenUp(); }

std::shared_ptr<const PointGradients> SortedStep::gradients(
    const std::shared_ptr<const Mesh>& mesh) const {
    if (auto made = gradientsIfMade(mesh)) return made;
    return cells_->gradients(mesh, threads_, *sharedField());
}

std::shared_ptr<const PointGradients> SortedStep::gradientsIfMade(
    const std::shared_ptr<const Mesh>& mesh) const {
    return cells_->gradientsIfMade(mesh);
}

std::string_view SortedStep::whyNoCells() const {
    if (const std::string_view why = whyNothingBetween(); !why.empty()) return why;
    const bool isAllThere = size_ == statistics_.points || cells_->fieldIfThere();
    return isAllThere ? "" : "cells need every value kept";
}

std::string_view SortedStep::whyNothingBetween() const {
    if (ofCategories_) return "nothing lies between categories";
    // Whole numbers of 64 bits that doubles, of which what lies between is made, do not tell apart.
    constexpr std::int64_t kTold = std::int64_t{1} << 53;
    const bool mayBeWide = type() == ValueType::I64 || type() == ValueType::U64;
    if (mayBeWide && size_ > 0 &&
        (compare(statistics_.min, -kTold) < 0 || compare(statistics_.max, kTold) > 0))
        return "whole numbers beyond 2^53 are told apart by points alone";
    if (const auto& mesh = grid_->mesh()) {
        if (!mesh->hasNeighbours() && !mesh->solids()) return whyNoSolids(mesh->about());
        if (mesh->hasNeighbours() && std::ranges::count(mesh->size(), 1u) > 1)
            return "nothing lies between points of a line";
    }
    return CellIndex::canIndex(*grid_, type()) ? "" : kTooMany;
}

Field SortedStep::field() const {
    if (source_.field)
        if (auto read = source_.field()) {
            read->grid = grid_;
            return std::move(*read);
        }
    Field out;
    out.grid = grid_;
    const std::uint64_t count = out.grid->count();
    const Columns all = columns();
    std::visit(
        [&]<typename T>(std::span<const T> sorted) {
            constexpr bool kHasNan = std::is_floating_point_v<T>;
            std::vector<T> values(count);
            if constexpr (kHasNan)
                std::ranges::fill(values, std::numeric_limits<T>::quiet_NaN());
            else if (sorted.size() < count)
                out.missing.assign(count, true);
            for (std::size_t i = 0; i < sorted.size(); ++i) {
                values[all.gridIndex[i]] = sorted[i];
                if (!out.missing.empty()) out.missing[all.gridIndex[i]] = false;
            }
            out.values = std::move(values);
        },
        all.values);
    return out;
}

std::shared_ptr<const Field> SortedStep::fieldIfThere() const { return cells_->fieldIfThere(); }

std::shared_ptr<const Field> SortedStep::sharedField() const {
    if (auto there = cells_->fieldBetween(threads_)) return there;
    return withNodeValues(std::make_shared<const Field>(field()), threads_);
}

Run SortedStep::finite() const {
    return std::visit(
        [&]<typename T>(const std::shared_ptr<const LazyColumn<T>>& points) {
            if constexpr (std::is_floating_point_v<T>) {
                constexpr T kMost = std::numeric_limits<T>::max();
                return points->find(Interval<T>{-kMost, kMost});
            } else {
                return Run{0, points->size()};
            }
        },
        columns_);
}

std::vector<double> SortedStep::quantiles(std::size_t n) const {
    std::vector<double> out;
    if (file_ && n == file_->quantiles().size()) return file_->quantiles();
    const Run among = finite();
    if (among.count == 0) return out;
    if (n > kFewQuantiles) columns();  // all at once, on all threads
    for (const std::uint64_t rank : quantileRanks(among, n)) out.push_back(toDouble(value(rank)));
    return out;
}

}  // namespace timeseries

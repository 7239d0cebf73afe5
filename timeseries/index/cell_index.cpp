#include "timeseries/index/cell_index.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "timeseries/grid/pages.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/grid/with_type.h"
#include "timeseries/index/cell_extents.h"
#include "timeseries/index/node_values.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/value_sort.h"

namespace timeseries {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr float kMostFloat = std::numeric_limits<float>::max();

// Two classes an octave: of a float, the exponent and the first bit of the mantissa.
constexpr int kClassBits = 22;
constexpr std::size_t kClasses = std::size_t{1} << (31 - kClassBits);

// Of the least float that is no less; of more than all floats, infinity.
std::size_t classOf(double halfRange) {
    const auto nearest = static_cast<float>(halfRange);
    const std::uint32_t next = static_cast<double>(nearest) < halfRange ? 1 : 0;
    return (std::bit_cast<std::uint32_t>(nearest) + next) >> kClassBits;
}
// The greatest half range of a class; double's rounding of the halves is in it.
double mostOf(std::size_t ofClass) {
    const auto next = static_cast<std::uint32_t>(ofClass + 1) << kClassBits;
    const double most = static_cast<double>(std::bit_cast<float>(next));
    return std::isfinite(most) ? most : kInfinite;
}

// Rounds as it orders: no greater number has a smaller key.
std::uint32_t keyOf(double middle) {
    const double most = static_cast<double>(kMostFloat);
    return orderedKey(static_cast<float>(std::clamp(middle, -most, most)));
}

// Where a sum of doubles may truly lie.
double below(double x) { return x - std::abs(x) * 4 * std::numeric_limits<double>::epsilon(); }
double above(double x) { return x + std::abs(x) * 4 * std::numeric_limits<double>::epsilon(); }

// Ascending and disjoint, what any of them holds.
std::vector<Interval<double>> joined(std::vector<Interval<double>> all) {
    std::ranges::sort(all, {}, &Interval<double>::lo);
    std::vector<Interval<double>> out;
    for (const Interval<double>& each : all)
        if (!out.empty() && each.lo <= out.back().hi)
            out.back().hi = std::max(out.back().hi, each.hi);
        else
            out.push_back(each);
    return out;
}

// Null where the cells are those of points that have neighbours.
const SolidCells* solidsOf(const Grid& grid) {
    return grid.mesh() ? grid.mesh()->solids().get() : nullptr;
}

// Keys of the middles of a class's cells that reach into an interval, and of few others.
std::pair<std::uint32_t, std::uint32_t> keysOf(const Interval<double>& interval, double halfRange) {
    return {keyOf(below(interval.lo - halfRange)), keyOf(above(interval.hi + halfRange))};
}

}  // namespace

// What of each class is kept.
class CellIndex::Wanted {
 public:
    explicit Wanted(const std::vector<Interval<double>>& among)
        : all_(among == std::vector{kAllNumbers}) {
        if (all_ || among.empty()) return;
        first_ = among.front().lo;
        last_ = among.back().hi;
        for (std::size_t c = 0; c < kClasses; ++c)
            for (const Interval<double>& interval : among)
                keys_[c].push_back(keysOf(interval, mostOf(c)));
    }
    bool isAll() const { return all_; }
    // False for most of those that are not, at a glance.
    bool near(double half, double middle) const {
        // A class's greatest half range is less than twice the least; a key is a float.
        const double reach = 2 * half + 1e-6 * std::abs(middle) + 1e-37;
        return all_ | ((middle + reach >= first_) & (middle - reach <= last_));
    }
    bool operator()(std::size_t ofClass, std::uint32_t key) const {
        return all_ || std::ranges::any_of(keys_[ofClass], [&](const auto& keys) {
                   return key >= keys.first && key <= keys.second;
               });
    }

 private:
    bool all_;
    double first_ = kInfinite, last_ = -kInfinite;
    std::array<std::vector<std::pair<std::uint32_t, std::uint32_t>>, kClasses> keys_;
};

bool CellIndex::canIndex(const Grid& grid, ValueType type) {
    const Bytes bytes = bytesOf(grid, type);
    return bytes.cells + bytes.values <= kMostBytes;
}

CellIndex::Bytes CellIndex::bytesOf(const Grid& grid, ValueType type) {
    double cells = 1;
    for (const std::size_t points : grid.size()) cells *= static_cast<double>(points) + 1;
    if (const SolidCells* solids = solidsOf(grid)) cells = static_cast<double>(solids->count());
    const auto size = withType(type, [](auto value) { return sizeof value; });
    const std::uint64_t nodes = grid.mesh() ? grid.mesh()->corners() - grid.mesh()->count() : 0;
    return {static_cast<double>(grid.count() * size + nodes * sizeof(double)),
            cells * sizeof(list_[0])};
}

CellIndex::CellIndex(std::shared_ptr<const Field> field, unsigned threads,
                     std::vector<Interval<double>> among)
    : field_(withNodeValues(std::move(field), threads)),
      among_(joined(std::move(among))),
      corners_(*field_),
      size_(corners_.size()) {
    const SolidCells* const solids = solidsOf(*field_->grid);
    if (solids) size_ = {solids->count(), 1, 1};
    const std::uint64_t rows = std::uint64_t{size_.y} * size_.z;
    threads = std::max(threads, 1u);
    const Wanted wanted(among_);
    const auto isNear = [&](const auto& cells, std::uint64_t place) {
        double half = 0, middle = 0;
        const bool isThere = cells.at(place, half, middle);
        return isThere & wanted.near(half, middle);  // a branch would be foreseen wrong too often
    };
    const auto take = [&](const auto& cells, std::uint64_t place, std::uint64_t number,
                          const auto& use) {
        double half = 0, middle = 0;
        cells.at(place, half, middle);
        const std::size_t ofClass = classOf(half);
        const std::uint32_t key = keyOf(middle);
        if (wanted(ofClass, key)) use(number, ofClass, key);
    };
    const auto look = [&](unsigned k, const auto& use) {
        if (solids) {
            const SolidExtents cells(*field_, *solids);
            for (std::uint64_t i = solids->count() * k / threads;
                 i < solids->count() * (k + 1) / threads; ++i)
                if (isNear(cells, i)) take(cells, i, i, use);
            return;
        }
        const auto lookAt = [&](auto cells) {
            std::vector<std::uint32_t> near(size_.x);
            for (std::uint64_t r = rows * k / threads; r < rows * (k + 1) / threads; ++r) {
                const glm::uvec3 at = indicesOf(static_cast<std::uint32_t>(r * size_.x), size_);
                cells.look(at.y, at.z);
                std::size_t count = 0;
                for (std::uint32_t i = 0; i < size_.x; ++i) {
                    near[count] = i;
                    count += isNear(cells, i);
                }
                for (std::size_t i = 0; i < count; ++i)
                    take(cells, near[i], r * size_.x + near[i], use);
            }
        };
        withType(field_->type(), [&]<typename T>(T) {
            constexpr bool kFitsFloat = std::is_same_v<T, float> || sizeof(T) <= 2;
            lookAt(RowExtents<std::conditional_t<kFitsFloat, float, double>>(*field_));
        });
    };
    // All of them are looked at twice; of some it is kept which they are, or it would take as long.
    struct Found {
        std::uint32_t cell, key;
        std::uint16_t ofClass;
    };
    constexpr std::size_t kAtOnce = (kWorthLargePages + sizeof(Found) - 1) / sizeof(Found);
    std::vector<std::vector<std::vector<Found>>> found(threads);
    // How many of each class a thread has, then where its first goes.
    std::vector<std::vector<std::uint64_t>> next(threads, std::vector<std::uint64_t>(kClasses));
    sharing(threads, [&](unsigned k) {
        look(k, [&](std::uint64_t cell, std::size_t of, std::uint32_t key) {
            ++next[k][of];
            if (wanted.isAll()) return;
            if (found[k].empty() || found[k].back().size() == kAtOnce)
                found[k].emplace_back().reserve(kAtOnce);
            found[k].back().push_back(
                {static_cast<std::uint32_t>(cell), key, static_cast<std::uint16_t>(of)});
        });
    });
    const auto forEachCell = [&](unsigned k, const auto& use) {
        if (wanted.isAll()) return look(k, use);
        for (const std::vector<Found>& some : found[k])
            for (const Found& each : some) use(each.cell, each.ofClass, each.key);
        found[k] = {};
    };
    std::uint64_t first = 0;
    for (std::size_t c = 0; c < kClasses; ++c) {
        const std::uint64_t begin = first;
        for (auto& counts : next) first += std::exchange(counts[c], first);
        if (first > begin) classes_.push_back({mostOf(c), begin, first - begin});
    }
    resizePopulated(list_, first);
    sharing(threads, [&](unsigned k) {
        forEachCell(k, [&](std::uint64_t cell, std::size_t of, std::uint32_t key) {
            list_[next[k][of]++] = std::uint64_t{key} << 32 | cell;
        });
    });
    // The largest first, or one thread would be left alone with it.
    std::vector<Class> order = classes_;
    std::ranges::sort(order, std::greater(), &Class::count);
    std::atomic<std::size_t> taken{0};
    sharing(threads, [&](unsigned) {
        for (std::size_t i = taken++; i < order.size(); i = taken++)
            sortPacked(std::span(list_).subspan(order[i].first, order[i].count));
    });
}

bool CellIndex::holds(std::span<const Interval<double>> intervals) const {
    return std::ranges::all_of(intervals, [&](const Interval<double>& asked) {
        return std::ranges::any_of(among_, [&](const Interval<double>& has) {
            return has.lo <= asked.lo && asked.hi <= has.hi;
        });
    });
}

std::vector<Run> CellIndex::select(std::span<const Interval<double>> intervals) const {
    std::vector<Run> runs;
    for (const Class& c : classes_) {
        const auto begin = list_.begin() + static_cast<std::ptrdiff_t>(c.first);
        const auto end = begin + static_cast<std::ptrdiff_t>(c.count);
        const auto middle = [](std::uint64_t packed) {
            return static_cast<std::uint32_t>(packed >> 32);
        };
        const std::size_t ofClass = runs.size();
        for (const Interval<double>& i : intervals) {
            const auto [lo, hi] = keysOf(i, c.halfRange);
            const auto from = std::ranges::lower_bound(begin, end, lo, {}, middle);
            const auto to = std::ranges::upper_bound(from, end, hi, {}, middle);
            if (from == to) continue;
            const Run run{static_cast<std::uint64_t>(from - list_.begin()),
                          static_cast<std::uint64_t>(to - from)};
            // Intervals ascend, so what meets is the last.
            Run* last = runs.size() > ofClass ? &runs.back() : nullptr;
            if (last && run.first <= last->first + last->count)
                last->count = std::max(last->count, run.first + run.count - last->first);
            else
                runs.push_back(run);
        }
    }
    return runs;
}

double CellIndex::halfRange(std::span<const Run> runs, double share) const {
    std::vector<std::uint64_t> counts(classes_.size());
    std::uint64_t all = 0;
    for (const Run& run : runs)
        for (std::size_t k = 0; k < classes_.size(); ++k) {
            const std::uint64_t first = std::max(run.first, classes_[k].first);
            const std::uint64_t last =
                std::min(run.first + run.count, classes_[k].first + classes_[k].count);
            if (first >= last) continue;
            counts[k] += last - first;
            all += last - first;
        }
    std::vector<std::size_t> order(classes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return classes_[k].halfRange; });
    std::uint64_t passed = 0;
    for (const std::size_t k : order) {
        passed += counts[k];
        if (counts[k] > 0 && static_cast<double>(passed) >= share * static_cast<double>(all))
            return classes_[k].halfRange;
    }
    return 0;
}

void CellIndex::prefetch(std::uint32_t cell) const {
    const std::array<std::uint64_t, 8> points = corners_.pointsOf(indicesOf(cell, size_));
    std::visit(
        [&](const auto& values) {
            for (const std::size_t c : {0u, 2u, 4u, 6u}) {
                asm volatile("");  // or compilers take this for a function without an effect
                __builtin_prefetch(&values[points[c]]);
            }
        },
        field_->values);
}

std::uint64_t CellIndex::bytes() const { return field_->bytes() + list_.size() * sizeof(list_[0]); }

std::vector<Interval<double>> betweenPoints(const RangeSet& ranges, ValueType type) {
    std::vector<Interval<double>> out;
    withType(type, [&]<typename T>(T) {
        constexpr double kRounding = std::is_integral_v<T> ? 0.5 : 0;
        for (const Interval<T>& i : ranges.toIntervals<T>())
            out.push_back(
                {static_cast<double>(i.lo) - kRounding, static_cast<double>(i.hi) + kRounding});
    });
    return out;
}

}  // namespace timeseries

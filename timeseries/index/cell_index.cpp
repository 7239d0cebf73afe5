#include "timeseries/index/cell_index.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/value_sort.h"

namespace timeseries {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr float kMostFloat = std::numeric_limits<float>::max();

// Two classes an octave: of a float, the exponent and the first bit of the mantissa.
constexpr int kClassBits = 22;
constexpr std::size_t kClasses = std::size_t{1} << (31 - kClassBits);

// The least float that is no less; of more than all floats, infinity.
float roundedUp(double x) {
    if (x > static_cast<double>(kMostFloat)) return std::numeric_limits<float>::infinity();
    const auto nearest = static_cast<float>(x);
    return static_cast<double>(nearest) < x
               ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}
std::size_t classOf(double halfRange) {
    return std::bit_cast<std::uint32_t>(roundedUp(halfRange)) >> kClassBits;
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

std::uint32_t neighbour(std::uint32_t cell, std::uint32_t side, std::uint32_t points) {
    return std::min(cell + side > 0 ? cell + side - 1 : 0, points - 1);
}

// NaN where the value is missing or not finite.
template <typename T>
double finiteOr(T value, bool isMissing) {
    const auto x = static_cast<double>(value);
    return isMissing || !std::isfinite(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}

glm::uvec3 pointsOf(const Field& field) {
    const auto size = field.grid->size();
    return {size[0], size[1], size[2]};
}

}  // namespace

// What a row of cells along x takes from its four rows of points.
struct CellIndex::Row {
    std::vector<double> least, greatest;  // of the four, at each point; inf, -inf where none is

    explicit Row(std::size_t points) : least(points), greatest(points) {}
    // Half the range, and the middle, of the cell between two points; false where nothing is
    // finite.
    bool at(std::size_t cell, double& half, double& middle) const {
        const std::size_t from = cell > 0 ? cell - 1 : 0, to = std::min(cell, least.size() - 1);
        const double lo = std::min(least[from], least[to]);
        const double hi = std::max(greatest[from], greatest[to]);
        half = 0.5 * hi - 0.5 * lo;
        middle = 0.5 * hi + 0.5 * lo;
        return lo <= hi;
    }
};

bool CellIndex::canIndex(const Grid& grid, ValueType type) {
    double cells = 1;
    for (const std::size_t points : grid.size()) cells *= static_cast<double>(points) + 1;
    const auto size = withType(type, [](auto value) { return sizeof value; });
    return cells * sizeof(list_[0]) + static_cast<double>(grid.count() * size) <= kMostBytes;
}

void CellIndex::rowOfCells(std::uint64_t row, Row& into) const {
    const glm::uvec3 points = pointsOf(field_);
    const auto j = static_cast<std::uint32_t>(row % size_.y);
    const auto k = static_cast<std::uint32_t>(row / size_.y);
    std::fill(into.least.begin(), into.least.end(), kInfinite);
    std::fill(into.greatest.begin(), into.greatest.end(), -kInfinite);
    std::visit(
        [&](const auto& values) {
            for (std::uint32_t side = 0; side < 4; ++side) {
                const std::uint64_t y = neighbour(j, side & 1, points.y);
                const std::uint64_t z = neighbour(k, side >> 1, points.z);
                const std::uint64_t first = points.x * (y + points.y * z);
                for (std::size_t i = 0; i < points.x; ++i) {
                    const bool isMissing = !field_.missing.empty() && field_.missing[first + i];
                    const double v = finiteOr(values[first + i], isMissing);
                    into.least[i] = v < into.least[i] ? v : into.least[i];  // NaN is neither
                    into.greatest[i] = v > into.greatest[i] ? v : into.greatest[i];
                }
            }
        },
        field_.values);
}

CellIndex::CellIndex(Field field, unsigned threads)
    : field_(std::move(field)), size_(pointsOf(field_) + 1u) {
    const std::uint64_t rows = std::uint64_t{size_.y} * size_.z;
    threads = std::max(threads, 1u);
    const auto forEachCell = [&](unsigned k, const auto& use) {
        Row row(size_.x - 1);
        for (std::uint64_t r = rows * k / threads; r < rows * (k + 1) / threads; ++r) {
            rowOfCells(r, row);
            double half = 0, middle = 0;
            for (std::uint32_t i = 0; i < size_.x; ++i)
                if (row.at(i, half, middle)) use(r * size_.x + i, classOf(half), middle);
        }
    };
    // How many of each class a thread has, then where its first goes.
    std::vector<std::vector<std::uint64_t>> next(threads, std::vector<std::uint64_t>(kClasses));
    sharing(threads, [&](unsigned k) {
        forEachCell(k, [&](std::uint64_t, std::size_t of, double) { ++next[k][of]; });
    });
    std::uint64_t first = 0;
    for (std::size_t c = 0; c < kClasses; ++c) {
        const std::uint64_t begin = first;
        for (auto& counts : next) first += std::exchange(counts[c], first);
        if (first > begin) classes_.push_back({mostOf(c), begin, first - begin});
    }
    list_.resize(first);
    sharing(threads, [&](unsigned k) {
        forEachCell(k, [&](std::uint64_t cell, std::size_t of, double middle) {
            list_[next[k][of]++] = std::uint64_t{keyOf(middle)} << 32 | cell;
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
            const std::uint32_t lo = keyOf(below(i.lo - c.halfRange));
            const std::uint32_t hi = keyOf(above(i.hi + c.halfRange));
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
    const glm::vec<3, std::uint64_t> points(size_ - 1u);
    const glm::uvec3 at = indicesOf(cell, size_);
    std::visit(
        [&](const auto& values) {
            for (const unsigned c : {0u, 2u, 4u, 6u}) {
                asm volatile("");  // or compilers take this for a function without an effect
                const glm::uvec3 p = pointAt(at, c);
                __builtin_prefetch(&values[p.x + points.x * (p.y + points.y * p.z)]);
            }
        },
        field_.values);
}

std::array<double, 8> CellIndex::corners(const glm::uvec3& cell) const {
    const glm::vec<3, std::uint64_t> points(size_ - 1u);
    std::array<double, 8> out{};
    std::visit(
        [&](const auto& values) {
            for (unsigned c = 0; c < 8; ++c) {
                const glm::uvec3 p = pointAt(cell, c);
                const std::uint64_t at = p.x + points.x * (p.y + points.y * p.z);
                out[c] = finiteOr(values[at], !field_.missing.empty() && field_.missing[at]);
            }
        },
        field_.values);
    return out;
}

std::uint64_t CellIndex::bytes() const {
    const std::uint64_t values =
        std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, field_.values);
    return values + field_.missing.size() / 8 + list_.size() * sizeof(list_[0]);
}

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

// What a range selects, said again in another way than timeseries/ says it: no conversion of
// bounds, no searching, only comparisons of one value with two bounds. Slow and plain on purpose.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "timeseries/index/range_set.h"

namespace oracle {

// Every double, int64 and uint64 is a long double, so comparisons of Numbers are exact in it.
static_assert(std::numeric_limits<long double>::digits >= 64);
using Real = long double;

inline Real real(const timeseries::Number& number) {
    return std::visit([](auto v) { return static_cast<Real>(v); }, number);
}

// Whether the real number x (or an infinity) lies in the range.
inline bool holdsReal(const timeseries::Range& range, Real x) {
    const Real lo = real(range.lo.value), hi = real(range.hi.value);
    return (range.lo.open ? lo < x : lo <= x) && (range.hi.open ? x < hi : x <= hi);
}

// The bound as a value of type T sees it: integers see it as it is; floating types see the nearest
// T, but a finite bound beyond T's largest finite value by half a step stays beyond it.
template <typename T>
Real seenBy(const timeseries::Bound& bound) {
    const Real x = real(bound.value);
    if constexpr (std::is_integral_v<T>) return x;
    if (std::isnan(x) || std::isinf(x)) return x;
    const T largest = std::numeric_limits<T>::max();
    const Real most = static_cast<Real>(largest);
    if (std::fabs(x) > most) {
        const Real step = most - static_cast<Real>(std::nextafter(largest, T(0)));
        return std::fabs(x) - most < step / 2 ? std::copysign(most, x) : x;
    }
    return static_cast<Real>(static_cast<T>(x));
}

template <typename T>
bool holds(const timeseries::Range& range, T value) {
    // Rounding must not turn lo > hi into a range.
    if (!(real(range.lo.value) <= real(range.hi.value))) return false;
    const Real x = static_cast<Real>(value);  // a NaN compares false with everything
    const Real lo = seenBy<T>(range.lo), hi = seenBy<T>(range.hi);
    return (range.lo.open ? lo < x : lo <= x) && (range.hi.open ? x < hi : x <= hi);
}

template <typename T>
bool holds(std::span<const timeseries::Range> ranges, T value) {
    for (const timeseries::Range& range : ranges)
        if (holds(range, value)) return true;
    return false;
}

// The value of T next to `value` in the direction of `sign`, or `value` itself at the end.
template <typename T>
T neighbour(T value, int sign) {
    if constexpr (std::is_floating_point_v<T>) {
        return std::nextafter(value, sign > 0 ? std::numeric_limits<T>::infinity()
                                              : -std::numeric_limits<T>::infinity());
    } else {
        if (sign > 0)
            return value == std::numeric_limits<T>::max() ? value : static_cast<T>(value + 1);
        return value == std::numeric_limits<T>::min() ? value : static_cast<T>(value - 1);
    }
}

// Values of T around a bound: the nearest and two on each side.
template <typename T>
void addNear(const timeseries::Number& number, std::vector<T>& values) {
    const Real x = real(number);
    if (std::isnan(x)) return;
    T middle{};
    if constexpr (std::is_floating_point_v<T>) {
        middle = static_cast<T>(x);
    } else {
        const Real lowest = std::numeric_limits<T>::min(), highest = std::numeric_limits<T>::max();
        middle = x <= lowest    ? std::numeric_limits<T>::min()
                 : x >= highest ? std::numeric_limits<T>::max()
                                : static_cast<T>(std::floor(x));
    }
    const T below = neighbour(middle, -1), above = neighbour(middle, 1);
    for (T v : {neighbour(below, -1), below, middle, above, neighbour(above, 1)})
        values.push_back(v);
}

// Whether every value of T in `inner` is in `outer`. The lowest value that is not is T's lowest,
// the first of an inner range or the one after an outer range: looking near all bounds is enough.
template <typename T>
bool inside(std::span<const timeseries::Range> inner, std::span<const timeseries::Range> outer) {
    std::vector<T> candidates;
    addNear<T>(-std::numeric_limits<double>::infinity(), candidates);
    for (auto ranges : {inner, outer})
        for (const timeseries::Range& range : ranges) {
            addNear<T>(range.lo.value, candidates);
            addNear<T>(range.hi.value, candidates);
        }
    for (T v : candidates)
        if (holds(inner, v) && !holds(outer, v)) return false;
    return true;
}

// Of any bits, floats too.
template <typename T>
T anyValue(std::mt19937_64& random) {
    if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    else if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<double>(random());
    else
        return static_cast<T>(random());
}

// Numbers where selection goes wrong, in every type that states them exactly.
inline std::vector<timeseries::Number> awkwardNumbers() {
    using D = std::numeric_limits<double>;
    using F = std::numeric_limits<float>;
    std::vector<timeseries::Number> numbers{D::infinity(),
                                            -D::infinity(),
                                            D::max(),
                                            D::lowest(),
                                            D::min(),
                                            -D::min(),
                                            D::denorm_min(),
                                            -D::denorm_min(),
                                            0.0,
                                            -0.0,
                                            0.5,
                                            -0.5,
                                            0.1,
                                            1.5,
                                            -1.5,
                                            1e-300,
                                            -1e-300,
                                            1 + 1e-12,
                                            1 - 1e-12,
                                            1e300,
                                            -1e300,
                                            126.5,
                                            127.5,
                                            254.5,
                                            255.5,
                                            -128.5};
    for (double f :
         {static_cast<double>(F::max()), static_cast<double>(F::lowest()),
          static_cast<double>(F::denorm_min()), -static_cast<double>(F::denorm_min()),
          static_cast<double>(F::min()), 0x1p53, -0x1p53, 0x1p60, 0x1p63, -0x1p63, 0x1p64}) {
        numbers.push_back(f);
        numbers.push_back(std::nextafter(f, D::infinity()));
        numbers.push_back(std::nextafter(f, -D::infinity()));
    }
    const std::int64_t two53 = std::int64_t{1} << 53, two60 = std::int64_t{1} << 60;
    // The last two but for the ends: half the way between floats, and one more. By way of a double,
    // which drops that one, the latter would be rounded twice.
    for (std::int64_t i :
         {std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, std::int64_t{2}, std::int64_t{127},
          std::int64_t{-128}, std::int64_t{255}, -two60, two53 - 1, two53, two53 + 1, two60 - 1,
          two60, two60 + 1, two60 + 2, two60 + (two60 >> 24), two60 + (two60 >> 24) + 1,
          std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
        numbers.push_back(i);
    for (std::uint64_t u :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{65535},
          static_cast<std::uint64_t>(two60) + 1, std::uint64_t{1} << 63,
          (std::uint64_t{1} << 63) + 1, std::numeric_limits<std::uint64_t>::max() - 1,
          std::numeric_limits<std::uint64_t>::max()})
        numbers.push_back(u);
    return numbers;
}

// Values of T where selection goes wrong; NaN is not among them.
template <typename T>
std::vector<T> awkwardValues() {
    using L = std::numeric_limits<T>;
    std::vector<T> values;
    for (const timeseries::Number& number : awkwardNumbers()) {
        const Real x = real(number);
        if constexpr (std::is_floating_point_v<T>) {
            values.push_back(static_cast<T>(x));
        } else if (x >= static_cast<Real>(L::min()) && x <= static_cast<Real>(L::max())) {
            values.push_back(static_cast<T>(std::floor(x)));
        }
    }
    for (T v : {L::lowest(), L::max(), neighbour(L::lowest(), 1), neighbour(L::max(), -1)})
        values.push_back(v);
    if constexpr (std::is_floating_point_v<T>) values.push_back(-T{0});
    return values;
}

inline timeseries::Number randomNumber(std::mt19937_64& random,
                                       const std::vector<timeseries::Number>& numbers) {
    return numbers[random() % numbers.size()];
}

// Mostly lo <= hi, so that most ranges hold something.
inline timeseries::Range randomRange(std::mt19937_64& random,
                                     const std::vector<timeseries::Number>& numbers) {
    timeseries::Range range{{randomNumber(random, numbers), random() % 2 == 0},
                            {randomNumber(random, numbers), random() % 2 == 0}};
    if (random() % 8 != 0 && real(range.lo.value) > real(range.hi.value))
        std::swap(range.lo, range.hi);
    return range;
}

inline std::vector<timeseries::Range> randomRanges(std::mt19937_64& random, std::size_t most,
                                                   const std::vector<timeseries::Number>& numbers) {
    std::vector<timeseries::Range> ranges(random() % (most + 1));
    for (timeseries::Range& range : ranges) range = randomRange(random, numbers);
    return ranges;
}

// "[1 i64, 2.5 f64)", for messages: independent of RangeSet::text, which is under test.
inline std::string describe(const timeseries::Range& range) {
    std::ostringstream out;
    out.precision(21);
    const char* const kinds[] = {" f64", " i64", " u64"};
    out << (range.lo.open ? "(" : "[") << real(range.lo.value) << kinds[range.lo.value.index()]
        << ", " << real(range.hi.value) << kinds[range.hi.value.index()]
        << (range.hi.open ? ")" : "]");
    return out.str();
}

inline std::string describe(std::span<const timeseries::Range> ranges) {
    std::string text = "{";
    for (const timeseries::Range& range : ranges) text.append(" ").append(describe(range));
    return text.append(" }");
}

}  // namespace oracle

// The text form of a RangeSet, both ways.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "timeseries/range_set.h"

namespace timeseries {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail(std::string_view piece, std::string_view why) {
    throw RangeSyntaxError(fmt::format("range '{}': {}", piece, why));
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <typename T>
std::optional<T> whole(std::string_view text, std::errc& error) {
    T value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    error = code;
    if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// `piece` is what the user wrote around the number: it is quoted when the number cannot be read.
Number number(std::string_view text, std::string_view piece) {
    text = trimmed(text);
    if (text == "min") return -kInfinity;
    if (text == "max") return kInfinity;
    std::string_view digits = text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::errc error{};
    if (const auto i = whole<std::int64_t>(digits, error)) return *i;
    if (const auto u = whole<std::uint64_t>(digits, error)) return *u;
    const auto d = whole<double>(digits, error);
    if (!d && error == std::errc::result_out_of_range)
        fail(piece, fmt::format("'{}' is too large or too small for a double", text));
    if (!d || digits.starts_with('+')) fail(piece, fmt::format("'{}' is not a number", text));
    if (std::isnan(*d)) fail(piece, "NaN bounds nothing");
    return *d;
}

// Exact for integers: 2^60 ~ 1 has integer ends. Past the 64-bit types the ends are doubles.
Number sum(const Number& a, const Number& b, int sign) {
    if (std::holds_alternative<double>(a) || std::holds_alternative<double>(b))
        return toDouble(a) + sign * toDouble(b);
    const auto wide = [](const Number& n) {
        return std::visit([](auto x) { return static_cast<__int128>(x); }, n);
    };
    const __int128 exact = wide(a) + sign * wide(b);
    if (exact >= std::numeric_limits<std::int64_t>::min() &&
        exact <= std::numeric_limits<std::int64_t>::max())
        return static_cast<std::int64_t>(exact);
    if (exact > 0 && exact <= std::numeric_limits<std::uint64_t>::max())
        return static_cast<std::uint64_t>(exact);
    return static_cast<double>(exact);
}

Range around(std::string_view inner, std::size_t tilde, std::string_view piece) {
    const Number centre = number(inner.substr(0, tilde), piece);
    const Number delta = number(inner.substr(tilde + 1), piece);
    if (!std::isfinite(toDouble(centre)) || !std::isfinite(toDouble(delta)))
        fail(piece, "c~d needs a finite contour value c and a finite half width d");
    if (toDouble(delta) < 0) fail(piece, "the half width d of c~d is negative");
    return {{sum(centre, delta, -1)}, {sum(centre, delta, +1)}};
}

Range range(std::string_view piece) {
    std::string_view inner = piece;
    bool loOpen = false, hiOpen = false;
    const bool bracket = inner.starts_with('[') || inner.starts_with('(');
    if (bracket) {
        if (inner.size() < 2 || (inner.back() != ']' && inner.back() != ')'))
            fail(piece, "the bracket is not closed by ']' or ')'");
        loOpen = inner.front() == '(';
        hiOpen = inner.back() == ')';
        inner = inner.substr(1, inner.size() - 2);
    }
    if (inner.find_first_of("[]()") != std::string_view::npos)
        fail(piece, "a bracket stands where none is expected");
    Range out;
    if (const auto tilde = inner.find('~'); tilde != std::string_view::npos) {
        out = around(inner, tilde, piece);
    } else if (const auto at = inner.find_first_of(bracket ? ":," : ":");
               at != std::string_view::npos) {
        out = {{number(inner.substr(0, at), piece)}, {number(inner.substr(at + 1), piece)}};
    } else {
        const std::string_view only = trimmed(inner);
        if (only.empty() || only == "min" || only == "max")
            fail(piece, "expected lo:hi, [lo,hi), c~d or a number");
        out = {{number(only, piece)}, {number(only, piece)}};
    }
    out.lo.open = loOpen;
    out.hi.open = hiOpen;
    const auto order = compare(out.lo.value, out.hi.value);
    if (order == std::partial_ordering::greater) fail(piece, "the low end lies above the high end");
    if (order == std::partial_ordering::equivalent && (loOpen || hiOpen))
        fail(piece, "both ends are the same and one is open, so it holds no value");
    return out;
}

}  // namespace

RangeSet RangeSet::parse(std::string_view text) {
    std::vector<Range> ranges;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size()) {
            if (text[i] == '[' || text[i] == '(') ++depth;
            if (text[i] == ']' || text[i] == ')') --depth;
            if (text[i] != ',' || depth > 0) continue;
        }
        const std::string_view piece = trimmed(text.substr(begin, i - begin));
        if (piece.empty()) fail(text, "expected lo:hi, [lo,hi), c~d or a number");
        ranges.push_back(range(piece));
        begin = i + 1;
    }
    return RangeSet(std::move(ranges));
}

std::string RangeSet::text() const {
    const auto bound = [](const Number& value, double unbounded, std::string_view word) {
        const auto* d = std::get_if<double>(&value);
        return d && *d == unbounded ? std::string(word) : toText(value);
    };
    std::string text;
    for (const Range& r : ranges_) {
        const std::string lo = bound(r.lo.value, -kInfinity, "min");
        const std::string hi = bound(r.hi.value, kInfinity, "max");
        if (!text.empty()) text += ',';
        if (r.lo.open || r.hi.open) {
            text += fmt::format("{}{},{}{}", r.lo.open ? '(' : '[', lo, hi, r.hi.open ? ')' : ']');
        } else {
            text += fmt::format("{}:{}", lo, hi);
        }
    }
    return text;
}

}  // namespace timeseries

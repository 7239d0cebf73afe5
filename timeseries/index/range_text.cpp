// The text form of a RangeSet, both ways.
#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "timeseries/index/range_set.h"

namespace timeseries {
namespace {

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

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Legends have a minus sign of their own (U+2212), which may come back by way of the clipboard.
constexpr std::string_view kMinusSign = "\u2212";

// From here on doubles are whole numbers, and not all of them.
constexpr double kWholeDoubles = 0x1p53;

// Of "9007199254740993.0" the whole number before its point, behind which nothing but 0 stands;
// none of other texts. What is written with an exponent is a double.
std::optional<std::string_view> wholePart(std::string_view text) {
    const auto point = text.find('.');
    if (point == text.npos || text.find_first_not_of('0', point + 1) != text.npos)
        return std::nullopt;
    return text.substr(0, point);
}
bool hasFraction(std::string_view text) {
    return text.find('.') != text.npos && text.find_first_of("eE") == text.npos;
}

// A number of the data; none where the text is not one. NaN is told apart by the caller.
std::optional<Number> finiteOrNot(std::string_view text, std::errc& error) {
    std::string ascii;
    if (text.starts_with(kMinusSign)) {
        ascii = fmt::format("-{}", text.substr(kMinusSign.size()));
        text = ascii;
    }
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('+') || text.starts_with('-')) return std::nullopt;
    }
    if (const auto i = whole<std::int64_t>(text, error)) return *i;
    if (const auto u = whole<std::uint64_t>(text, error)) return *u;
    const auto d = whole<double>(text, error);
    if (!d) return std::nullopt;
    if (std::abs(*d) >= kWholeDoubles && std::isfinite(*d))
        if (const auto digits = wholePart(text)) {
            std::errc ignored{};  // what no whole number holds is a double
            if (const auto i = whole<std::int64_t>(*digits, ignored)) return *i;
            if (const auto u = whole<std::uint64_t>(*digits, ignored)) return *u;
        }
    return *d;
}

bool isNumber(std::string_view text) {
    std::errc ignored{};
    return finiteOrNot(trimmed(text), ignored).has_value();
}

// "800" of "800 K": a number before what may be a unit; "" of another text.
std::string_view beforeUnit(std::string_view text) {
    constexpr std::size_t kLongest = 80;
    for (std::size_t end = std::min(text.size(), kLongest); end-- > 1;) {
        const std::string_view rest = text.substr(end), unit = trimmed(rest);
        if (unit.empty() || !isDigit(text[end - 1]) || !isNumber(text.substr(0, end))) continue;
        const auto first = static_cast<unsigned char>(unit.front());
        const bool isWord = std::isalpha(first) || first == '%' || first >= 0x80;
        // 1e, 0x and 1to2 are other slips.
        const bool isSlip = unit.starts_with("to") ||
                            (unit.size() == rest.size() && unit.find_first_of("eExX") == 0);
        return isWord && !isSlip ? text.substr(0, end) : std::string_view();
    }
    return {};
}

// `piece` is what the user wrote around the number: it is quoted when the number cannot be read.
Number number(std::string_view text, std::string_view piece) {
    text = trimmed(text);
    if (text == "min") return -kInfinity;
    if (text == "max") return kInfinity;
    std::errc error{};
    const auto n = finiteOrNot(text, error);
    if (!n && error == std::errc::result_out_of_range)
        fail(piece, fmt::format("'{}' is too large or too small for a double", text));
    if (!n) {
        const bool hasComma =
            piece.find(',') != piece.npos && text.find_first_of(",:") != text.npos;
        if (const std::string_view alone = beforeUnit(text); !alone.empty())
            fail(piece,
                 fmt::format("'{}' is not a number: units are left out, write {}", text, alone));
        fail(piece, fmt::format("'{}' is not a number{}", text,
                                hasComma ? ", for decimals stand behind a point" : ""));
    }
    if (std::isnan(toDouble(*n))) fail(piece, "NaN bounds nothing");
    const auto* d = std::get_if<double>(&*n);
    if (d && std::abs(*d) >= kWholeDoubles && hasFraction(text) && !wholePart(text))
        fail(piece,
             fmt::format("'{}' has a fraction, and values so large have none: leave it out", text));
    // As a double it would be the least of them, which it is not.
    if (d && *d == -0x1p63 && text.find_first_of("eE") == text.npos)
        fail(piece,
             fmt::format("'{}' is below all whole numbers of 64 bits: write min, or an exponent",
                         text));
    return *n;
}

// Digits behind the point of a number as it is written: 2 of "1.25", 3 of "1e-3"; 0 of what has
// none.
int decimalsOf(std::string_view text) {
    text = trimmed(text);
    const std::size_t e = std::min(text.find_first_of("eE"), text.size());
    int exponent = 0;
    if (e < text.size()) {
        const std::size_t sign = text.substr(e + 1).starts_with('+') ? 1 : 0;
        std::from_chars(text.data() + e + 1 + sign, text.data() + text.size(), exponent);
    }
    const std::size_t point = std::min(text.substr(0, e).find('.'), e);
    const int digits = point < e ? static_cast<int>(e - point) - 1 : 0;
    return std::max(0, digits - std::clamp(exponent, -400, 400));
}

// What the decimals that were written give, not the doubles nearest to them: 0.7 + 0.1 is 0.8.
double decimalSum(double a, double b, int decimals) {
    const double sum = a + b;
    const double most =
        std::max({std::abs(a), std::abs(b), std::abs(sum)}) * std::pow(10, decimals);
    if (decimals == 0 || !(most < kWholeDoubles / 4)) return sum;  // more digits than doubles have
    const std::string text = fmt::format("{:.{}f}", sum, decimals);
    double rounded = sum;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
}

// Exact for integers: 2^60 ~ 1 has integer ends, and so has 2^60 ~ 1.5, for there are no halves
// between its values. Past the 64-bit types the ends are doubles.
Number sum(const Number& a, const Number& b, int sign, int decimals) {
    const auto* delta = std::get_if<double>(&b);
    if (delta && !std::holds_alternative<double>(a) && *delta < kWholeDoubles &&
        std::abs(toDouble(a)) >= kWholeDoubles)
        return sum(a, static_cast<std::int64_t>(*delta), sign, 0);
    if (std::holds_alternative<double>(a) || std::holds_alternative<double>(b))
        return decimalSum(toDouble(a), sign * toDouble(b), decimals);
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

// "c~d", "c ± d": where the sign stands, and how long it is.
struct Separator {
    std::size_t at, length;
};
std::optional<Separator> aroundIn(std::string_view inner) {
    for (const std::string_view sign : {"~", "\u00b1"})
        if (const auto at = inner.find(sign); at != inner.npos) return Separator{at, sign.size()};
    return std::nullopt;
}

Range around(std::string_view inner, Separator sign, std::string_view piece) {
    const std::string_view c = inner.substr(0, sign.at), d = inner.substr(sign.at + sign.length);
    const Number centre = number(c, piece), delta = number(d, piece);
    const int decimals = std::max(decimalsOf(c), decimalsOf(d));
    if (!std::isfinite(toDouble(centre)) || !std::isfinite(toDouble(delta)))
        fail(piece, "c~d needs a finite contour value c and a finite half width d");
    if (toDouble(delta) < 0) fail(piece, "the half width d of c~d is negative");
    return {{sum(centre, delta, -1, decimals)}, {sum(centre, delta, +1, decimals)}};
}

// ">600", "<= 5": open or closed at its number, without bound on the other side. None without a
// sign.
std::optional<Range> comparison(std::string_view piece) {
    struct Sign {
        std::string_view text;
        bool above, open;
    };
    static constexpr std::array<Sign, 6> kSigns = {{{">=", true, false},
                                                    {"\u2265", true, false},
                                                    {">", true, true},
                                                    {"<=", false, false},
                                                    {"\u2264", false, false},
                                                    {"<", false, true}}};
    for (const Sign& sign : kSigns) {
        if (!piece.starts_with(sign.text)) continue;
        const Bound at{number(piece.substr(sign.text.size()), piece), sign.open};
        return sign.above ? Range{at, {kInfinity}} : Range{{-kInfinity}, at};
    }
    return std::nullopt;
}

// Where lo ends and hi begins; none where nothing stands between them.
std::optional<Separator> separatorIn(std::string_view inner, bool bracketed) {
    if (const auto at = inner.find_first_of(bracketed ? ":," : ":"); at != std::string_view::npos)
        return Separator{at, 1};
    constexpr std::string_view kTo = " to ";
    if (const auto at = inner.find(kTo); at != std::string_view::npos)
        return Separator{at, kTo.size()};
    return std::nullopt;
}

// "600-800" and "600..800" as they are to be spelt; none where the text does not look like these.
// They are not read: after a number, a minus may as well be a sign.
std::optional<std::string> respelt(std::string_view text) {
    for (const std::string_view between : {"..", "\u2013", "-"})
        for (auto at = text.find(between, 1); at < text.size(); at = text.find(between, at + 1)) {
            const std::string_view lo = trimmed(text.substr(0, at));
            const std::string_view hi = trimmed(text.substr(at + between.size()));
            if (isNumber(lo) && isNumber(hi)) return fmt::format("{}:{}", lo, hi);
        }
    return std::nullopt;
}

Range alone(std::string_view text, std::string_view piece) {
    text = trimmed(text);
    if (text.empty() || text == "min" || text == "max")
        fail(piece, "expected lo:hi, [lo,hi), c~d or a number");
    if (!isNumber(text))
        if (const auto spelling = respelt(text)) fail(piece, "a range is written " + *spelling);
    return {{number(text, piece)}, {number(text, piece)}};
}

Range bounds(std::string_view piece) {
    if (const auto compared = comparison(piece)) return *compared;
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
    if (const auto sign = aroundIn(inner))
        out = around(inner, *sign, piece);
    else if (const auto between = separatorIn(inner, bracket))
        out = {{number(inner.substr(0, between->at), piece)},
               {number(inner.substr(between->at + between->length), piece)}};
    else
        out = alone(inner, piece);
    out.lo.open = loOpen;
    out.hi.open = hiOpen;
    return out;
}

Range range(std::string_view piece) {
    const Range out = bounds(piece);
    const auto order = compare(out.lo.value, out.hi.value);
    if (order == std::partial_ordering::greater) fail(piece, "the low end lies above the high end");
    if (order == std::partial_ordering::equivalent && (out.lo.open || out.hi.open))
        fail(piece, "both ends are the same and one is open, so it holds no value");
    return out;
}

// The parts between the commas that stand outside brackets, as they were written.
std::vector<std::string_view> piecesOf(std::string_view text) {
    std::vector<std::string_view> pieces;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size()) {
            if (text[i] == '[' || text[i] == '(') ++depth;
            if (text[i] == ']' || text[i] == ')') --depth;
            if (text[i] != ',' || depth > 0) continue;
        }
        pieces.push_back(text.substr(begin, i - begin));
        begin = i + 1;
    }
    return pieces;
}

bool isRangeText(std::string_view text) {
    try {
        RangeSet::parse(text);
        return true;
    } catch (const RangeSyntaxError&) {
        return false;
    }
}

// A comma directly between digits beside a whole number that stands alone may be a decimal one:
// 600,5:700 and 600:700,5. Not so 300:400,900:max, nor three numbers or more, which are a list of
// values. What may be either is asked for in other words.
void refuseDecimalCommas(std::string_view text, const std::vector<std::string_view>& pieces) {
    if (pieces.size() > 2 && std::ranges::all_of(pieces, isNumber)) return;
    const auto isWhole = [](std::string_view piece) {
        if (piece.starts_with('-') || piece.starts_with('+')) piece.remove_prefix(1);
        return !piece.empty() && std::ranges::all_of(piece, isDigit);
    };
    const auto mayBeOne = [&](std::string_view before, std::string_view after) {
        return !before.empty() && isDigit(before.back()) && !after.empty() &&
               isDigit(after.front()) && (isWhole(before) || isWhole(after));
    };
    bool decimal = false;
    std::string joined, apart;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool maybe = i > 0 && mayBeOne(pieces[i - 1], pieces[i]);
        decimal = decimal || maybe;
        joined += i == 0 ? "" : maybe ? "." : ",";
        joined += pieces[i];
        apart += i == 0 ? "" : ",";
        apart += isWhole(pieces[i]) ? fmt::format("{0}:{0}", pieces[i]) : std::string(pieces[i]);
    }
    if (!decimal) return;
    std::vector<std::string> spellings{joined, apart};
    std::erase_if(spellings, [](const std::string& s) { return !isRangeText(s); });
    if (!spellings.empty())
        fail(text, fmt::format("a comma stands between ranges, a point before decimals; write {}",
                               fmt::join(spellings, " or ")));
}

// Together, values above one number and values below a greater one are all there are.
void refuseAllFromBothSides(std::string_view text, const std::vector<std::string_view>& pieces,
                            const std::vector<Range>& ranges) {
    if (pieces.size() != 2) return;
    const bool first = pieces[0].starts_with('>') || pieces[0].starts_with("\u2265");
    const Range &above = ranges[first ? 0 : 1], &below = ranges[first ? 1 : 0];
    if (!comparison(pieces[0]) || !comparison(pieces[1]) || toDouble(above.hi.value) != kInfinity ||
        toDouble(below.lo.value) != -kInfinity ||
        compare(above.lo.value, below.hi.value) != std::partial_ordering::less)
        return;
    fail(text, fmt::format("a comma joins ranges, so that these hold every value; write {}{},{}{} "
                           "for the values between",
                           above.lo.open ? '(' : '[', toText(above.lo.value),
                           toText(below.hi.value), below.hi.open ? ')' : ']'));
}

}  // namespace

RangeSet RangeSet::parse(std::string_view text) {
    std::vector<std::string_view> pieces = piecesOf(text);
    refuseDecimalCommas(text, pieces);
    std::vector<Range> ranges;
    for (std::string_view& piece : pieces) {
        piece = trimmed(piece);
        if (piece.empty()) fail(text, "expected lo:hi, [lo,hi), c~d or a number");
        ranges.push_back(range(piece));
    }
    refuseAllFromBothSides(text, pieces, ranges);
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

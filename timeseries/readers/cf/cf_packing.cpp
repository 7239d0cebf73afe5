#include "timeseries/readers/cf/cf_packing.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/text/number_text.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

using Malformed = std::function<void(const std::string&)>;

bool wide(ValueType type) { return type == ValueType::I64 || type == ValueType::U64; }

// The other signedness, for the attribute _Unsigned: classic files have no unsigned types.
ValueType withSign(ValueType type, bool isUnsigned) {
    switch (type) {
        case ValueType::U8:
        case ValueType::I8:
            return isUnsigned ? ValueType::U8 : ValueType::I8;
        case ValueType::U16:
        case ValueType::I16:
            return isUnsigned ? ValueType::U16 : ValueType::I16;
        case ValueType::U32:
        case ValueType::I32:
            return isUnsigned ? ValueType::U32 : ValueType::I32;
        case ValueType::U64:
        case ValueType::I64:
            return isUnsigned ? ValueType::U64 : ValueType::I64;
        default:
            return type;
    }
}

const std::vector<Number>* numbersOf(const NcVariable& variable, const char* name,
                                     std::size_t count, const Malformed& malformed) {
    const NcAttribute* attribute = variable.find(name);
    if (!attribute) return nullptr;
    const auto* numbers = std::get_if<std::vector<Number>>(&attribute->value);
    if (!numbers)
        malformed(fmt::format("{}: expected a number, found the text \"{}\"", name,
                              std::get<std::string>(attribute->value)));
    if (count != 0 && numbers->size() != count)
        malformed(fmt::format("{}: expected {} number{}, found {}", name, count,
                              count == 1 ? "" : "s", numbers->size()));
    return numbers;
}

// Of an attribute that is text, the numbers that it spells; none where a word is no number.
std::vector<double> spelt(const NcVariable& variable, const char* name) {
    std::vector<double> numbers;
    for (const std::string& word : words(variable.text(name))) {
        const auto number = numberOfText<double>(word);
        if (!number) return {};
        numbers.push_back(*number);
    }
    return numbers;
}

// A number of an attribute as a T of the variable; with `wrap`, the bits of the other signedness
// (_FillValue = -1b of an unsigned byte is 255). Nothing when no T equals it.
template <typename T>
std::optional<T> storedNumber(const Number& number, bool wrap) {
    if constexpr (std::is_floating_point_v<T>) {
        const T nearest = nearestFloat<T>(toDouble(number));
        const bool overflow = std::isinf(nearest) && std::isfinite(toDouble(number));
        return overflow ? std::nullopt : std::optional(nearest);
    } else {
        Number n = number;
        if (const double* d = std::get_if<double>(&n)) {
            if (!(std::abs(*d) < 18446744073709551616.0) || *d != std::floor(*d))
                return std::nullopt;
            if (*d >= 9223372036854775808.0)
                n = static_cast<std::uint64_t>(*d);
            else if (*d >= -9223372036854775808.0)
                n = static_cast<std::int64_t>(*d);
            else
                return std::nullopt;
        }
        const auto as = [&](auto value) -> std::optional<T> {
            if (std::in_range<T>(value)) return static_cast<T>(value);
            using Other = std::conditional_t<std::is_signed_v<T>, std::make_unsigned_t<T>,
                                             std::make_signed_t<T>>;
            if (wrap && std::in_range<Other>(value)) return static_cast<T>(value);
            return std::nullopt;
        };
        if (const auto* i = std::get_if<std::int64_t>(&n)) return as(*i);
        return as(std::get<std::uint64_t>(n));
    }
}

void readScale(const NcVariable& variable, const Malformed& malformed, Packing& packing) {
    ValueType widest = ValueType::I8;
    const auto one = [&](const char* name, double& value) {
        const auto* numbers = numbersOf(variable, name, 1, malformed);
        if (!numbers) return;
        value = toDouble(numbers->front());
        if (!std::isfinite(value))
            malformed(fmt::format("{}: expected a finite number, found {}", name,
                                  toText(numbers->front())));
        const ValueType type = *variable.find(name)->type;
        packing.scaled = true;
        if (type == ValueType::F32 && widest != ValueType::F64) widest = ValueType::F32;
        if (type != ValueType::F32) widest = ValueType::F64;
    };
    one("scale_factor", packing.scale);
    one("add_offset", packing.offset);
    packing.unpacked = packing.stored;
    if (!packing.scaled) return;
    // 64-bit integers that are multiplied by one stay exact. Integer scales count as doubles.
    const bool identity = packing.scale == 1 && packing.offset == 0;
    if (identity && wide(packing.stored)) {
        packing.scaled = false;
        return;
    }
    // CF 1.10, section 8.1: the attributes' type, float only for integers of at most 16 bits, which
    // it holds exactly. A float variable is not made narrower nor wider than the wider of the two.
    const bool small = packing.stored < ValueType::U32;
    const bool toFloat = widest == ValueType::F32 && (small || packing.stored == ValueType::F32);
    packing.unpacked = toFloat ? ValueType::F32 : ValueType::F64;
}

// The number in the digits of its own type: a float 0.1, not 0.10000000149011612.
std::string asWritten(const NcVariable& variable, const char* attribute, double otherwise) {
    const NcAttribute* found = variable.find(attribute);
    if (!found) return fmt::format("{}", otherwise);
    const double value = toDouble(std::get<std::vector<Number>>(found->value).front());
    return found->type == ValueType::F32 ? fmt::format("{}", static_cast<float>(value))
                                         : fmt::format("{}", value);
}

void readMissing(const NcVariable& variable, const Malformed& malformed, Packing& packing) {
    const bool wrap = packing.stored != *variable.type;
    const auto add = [&](const char* name, const Number& number) {
        withType(packing.stored, [&](auto t) {
            const auto stored = storedNumber<decltype(t)>(number, wrap);
            // A missing_value that repeats the fill is common, and tells nothing.
            if (!stored ||
                std::ranges::find(packing.missing, numberOf(*stored)) != packing.missing.end())
                return;
            packing.missing.push_back(numberOf(*stored));
            packing.missingText +=
                fmt::format("{}{} {}", packing.missingText.empty() ? "" : ", ", name, +*stored);
        });
    };
    const auto* fill = numbersOf(variable, "_FillValue", 1, malformed);
    if (fill) add("_FillValue", fill->front());
    if (const auto texts = spelt(variable, "missing_value"); !texts.empty())
        for (const double number : texts) add("missing_value", numberOf(number));
    else if (const auto* list = numbersOf(variable, "missing_value", 0, malformed))
        for (const Number& number : *list) add("missing_value", number);
    // The library fills by the type it stores, and knows nothing of _Unsigned.
    if (!fill && variable.filled)
        if (const auto number = defaultFill(*variable.type)) add("netCDF's default fill", *number);
}

void readValidRange(const NcVariable& variable, const Malformed& malformed, Packing& packing) {
    const bool wrap = packing.stored != *variable.type;
    const auto bound = [&](const char* name, const Number& number, std::optional<Number>& to) {
        if (const double* d = std::get_if<double>(&number); d && std::isnan(*d)) return;
        // In unpacked values when its type is that of the scale, and wider than what is stored
        // (NetCDF User's Guide, valid_range).
        const ValueType type = *variable.find(name)->type;
        const bool isWider = floating(packing.stored)
                                 ? packing.stored != packing.unpacked && type == packing.unpacked
                                 : floating(type);
        packing.validUnpacked = packing.scaled && isWider;
        to = number;
        if (packing.validUnpacked) return;
        withType(packing.stored, [&](auto t) {
            if (const auto stored = storedNumber<decltype(t)>(number, wrap)) to = numberOf(*stored);
        });
    };
    if (const auto* range = numbersOf(variable, "valid_range", 2, malformed)) {
        bound("valid_range", (*range)[0], packing.validMin);
        bound("valid_range", (*range)[1], packing.validMax);
    } else {
        if (const auto* lo = numbersOf(variable, "valid_min", 1, malformed))
            bound("valid_min", lo->front(), packing.validMin);
        if (const auto* hi = numbersOf(variable, "valid_max", 1, malformed))
            bound("valid_max", hi->front(), packing.validMax);
    }
    if (!packing.validMin && !packing.validMax) return;
    packing.missingText +=
        fmt::format("{}outside {}..{}{}", packing.missingText.empty() ? "" : ", ",
                    packing.validMin ? toText(*packing.validMin) : "-inf",
                    packing.validMax ? toText(*packing.validMax) : "inf",
                    packing.scaled && !packing.validUnpacked ? " as stored" : "");
}

// The bounds as closed ends in T: what compare() finds between them and no more.
template <typename T>
struct ValidInterval {
    T lo = std::numeric_limits<T>::lowest(), hi = std::numeric_limits<T>::max();
    bool empty = false;

    ValidInterval(const std::optional<Number>& min, const std::optional<Number>& max) {
        if constexpr (std::is_floating_point_v<T>) {
            lo = min ? nearestFloat<T>(toDouble(*min)) : -std::numeric_limits<T>::infinity();
            hi = max ? nearestFloat<T>(toDouble(*max)) : std::numeric_limits<T>::infinity();
        } else {
            if (min && compare(*min, numberOf(lo)) > 0) {
                if (compare(*min, numberOf(hi)) > 0)
                    empty = true;
                else
                    lo = inward(*min, true);
            }
            if (max && compare(*max, numberOf(hi)) < 0) {
                if (compare(*max, numberOf(std::numeric_limits<T>::lowest())) < 0)
                    empty = true;
                else
                    hi = inward(*max, false);
            }
        }
    }
    bool holds(T v) const { return !empty && lo <= v && v <= hi; }

 private:
    static T inward(const Number& bound, bool up) {
        if (const double* d = std::get_if<double>(&bound))
            return static_cast<T>(up ? std::ceil(*d) : std::floor(*d));
        if (const auto* i = std::get_if<std::int64_t>(&bound)) return static_cast<T>(*i);
        return static_cast<T>(std::get<std::uint64_t>(bound));
    }
};

// Stored numbers that stand for nothing. Equality, not nearness: real data lies close to fills.
template <typename Stored>
class MissingTest {
 public:
    explicit MissingTest(const Packing& packing)
        : valid_(packing.validUnpacked ? std::nullopt : packing.validMin,
                 packing.validUnpacked ? std::nullopt : packing.validMax) {
        for (const Number& number : packing.missing)
            if (const auto value = storedNumber<Stored>(number, false)) fills_.push_back(*value);
    }
    bool operator()(Stored v) const {
        // NaN is missing without being marked (field.h), and equals no fill.
        if (v != v) return false;
        return !valid_.holds(v) || std::ranges::find(fills_, v) != fills_.end();
    }

 private:
    ValidInterval<Stored> valid_;
    std::vector<Stored> fills_;
};

void mark(Field& field, std::size_t point, std::size_t points) {
    field.missing.resize(points, false);  // at the first
    field.missing[point] = true;
}

template <typename Stored, typename Value>
void unpackInto(const Packing& packing, const StridedLayout& layout,
                const std::vector<Stored>& stored, Field& field, std::vector<Value>& values) {
    const MissingTest<Stored> missing(packing);
    const ValidInterval<Value> valid(packing.validUnpacked ? packing.validMin : std::nullopt,
                                     packing.validUnpacked ? packing.validMax : std::nullopt);
    const auto scale = static_cast<Value>(packing.scale);
    const auto offset = static_cast<Value>(packing.offset);
    std::size_t point = 0;
    forEachPlace(layout, [&](std::size_t place) {
        const Stored number = stored[place];
        Value value = static_cast<Value>(number);
        if (packing.scaled) value = static_cast<Value>(value * scale + offset);
        values[point] = value;
        if (missing(number) || (value == value && !valid.holds(value)))
            mark(field, point, values.size());
        ++point;
    });
}

// The stored numbers are in the field's own order; an axis of one point may have any stride.
bool inOrder(const StridedLayout& layout) {
    std::size_t expected = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        if (layout.size[i] != 1 && layout.stride[i] != expected) return false;
        expected *= layout.size[i];
    }
    return true;
}

}  // namespace

std::optional<Number> defaultFill(ValueType stored) {
    switch (stored) {
        case ValueType::I16:
            return Number(std::int64_t{NC_FILL_SHORT});
        case ValueType::U16:
            return Number(std::int64_t{NC_FILL_USHORT});
        case ValueType::I32:
            return Number(std::int64_t{NC_FILL_INT});
        case ValueType::U32:
            return Number(std::int64_t{NC_FILL_UINT});
        case ValueType::I64:
            return Number(std::int64_t{NC_FILL_INT64});
        case ValueType::U64:
            return Number(std::uint64_t{NC_FILL_UINT64});
        case ValueType::F32:
            return Number(static_cast<double>(NC_FILL_FLOAT));
        case ValueType::F64:
            return Number(NC_FILL_DOUBLE);
        default:
            return std::nullopt;
    }
}

Packing packingOf(const NcVariable& variable, const Malformed& malformed) {
    Packing packing;
    packing.stored = *variable.type;
    // CF 1.10, section 2.2, keeps this attribute of the NetCDF User's Guide.
    const std::string sign = lower(variable.text("_Unsigned"));
    if (sign == "true" || sign == "false")
        packing.stored = withSign(packing.stored, sign == "true");
    readScale(variable, malformed, packing);
    readMissing(variable, malformed, packing);
    readValidRange(variable, malformed, packing);
    packing.storedAs = typeName(packing.stored);
    if (packing.scaled)
        packing.storedAs +=
            fmt::format(" packed, scale {}, offset {}", asWritten(variable, "scale_factor", 1.0),
                        asWritten(variable, "add_offset", 0.0));
    return packing;
}

Number asMeant(const Packing& packing, const Number& stored) {
    if (floating(packing.stored)) return stored;
    Number meant = stored;
    withType(packing.stored, [&](auto t) {
        if (const auto n = storedNumber<decltype(t)>(stored, true)) meant = numberOf(*n);
    });
    return meant;
}

void unpack(const Packing& packing, const StridedLayout& layout,
            const std::function<void(void*)>& read, Field& field) {
    const std::size_t points = layout.size[0] * layout.size[1] * layout.size[2];
    withType(packing.stored, [&](auto s) {
        using Stored = decltype(s);
        if (!packing.scaled && inOrder(layout)) {
            std::vector<Stored> values(points);
            read(values.data());
            const MissingTest<Stored> missing(packing);
            for (std::size_t i = 0; i < points; ++i)
                if (missing(values[i])) mark(field, i, points);
            field.values = std::move(values);
            return;
        }
        std::vector<Stored> stored(points);
        read(stored.data());
        const auto into = [&](auto v) {
            std::vector<decltype(v)> values(points);
            unpackInto(packing, layout, stored, field, values);
            field.values = std::move(values);
        };
        if (!packing.scaled)
            into(Stored{});
        else if (packing.unpacked == ValueType::F32)
            into(float{});
        else
            into(double{});
    });
}

}  // namespace timeseries

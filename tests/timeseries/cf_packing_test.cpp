// How stored numbers become values and which are missing, without a file: every type and bound
// against exact comparison.
#include "timeseries/readers/cf/cf_packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace timeseries {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <typename T>
class CfPackingOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(CfPackingOf, Types);

template <typename T>
ValueType valueType() {
    return static_cast<ValueType>(Values(std::vector<T>{}).index());
}

template <typename T>
Number number(T value) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<double>(value);
    if constexpr (std::is_same_v<T, std::uint64_t>) return value;
    return static_cast<std::int64_t>(value);
}

template <typename T>
std::vector<T> storedValues() {
    using Limits = std::numeric_limits<T>;
    std::vector<T> values{0, 1, 2, 100, Limits::lowest(), Limits::max()};
    if constexpr (std::is_floating_point_v<T>) {
        for (const double v : {-0.5, 0.5, 127.5, -kInf, kInf, kNan}) values.push_back(T(v));
        values.push_back(std::nextafter(Limits::max(), T(0)));
    } else {
        values.push_back(static_cast<T>(Limits::lowest() + 1));
        values.push_back(static_cast<T>(Limits::max() - 1));
        if constexpr (std::is_signed_v<T>) values.push_back(-1);
    }
    return values;
}

// What an attribute may say: of every type, near every type's limits, and between integers.
std::vector<Number> attributeNumbers() {
    std::vector<Number> all{kNan, -kInf, kInf, -0.5, 0.5, 127.5, -1e300, 1e300, 100.0};
    for (const int bits : {7, 8, 15, 16, 31, 32, 63, 64})
        for (const double sign : {-1.0, 1.0}) {
            all.emplace_back(sign * std::ldexp(1.0, bits));
            if (bits < 63)
                for (const int off : {-1, 0, 1})
                    all.emplace_back(static_cast<std::int64_t>(sign * std::ldexp(1.0, bits)) + off);
        }
    for (const std::int64_t n :
         {std::int64_t{-1}, std::int64_t{0}, std::int64_t{1},
          std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
        all.emplace_back(n);
    all.emplace_back(std::numeric_limits<std::uint64_t>::max());
    for (const double sign : {-1.0, 1.0}) {
        const double mostFloat = std::numeric_limits<float>::max();
        all.emplace_back(sign * mostFloat);
        // Beyond it, but nearer to it than to what the next one would be; and not.
        all.emplace_back(sign * std::nextafter(mostFloat, kInf));
        all.emplace_back(sign * 3.40282346638529e+38);
        all.emplace_back(sign * std::nextafter(0x1.ffffffp+127, 0.0));
        all.emplace_back(sign * 0x1.ffffffp+127);
        all.emplace_back(sign * std::ldexp(1.1, 63));
        all.emplace_back(sign * std::numeric_limits<double>::max());
    }
    return all;
}

NcAttribute attribute(const char* name, std::vector<Number> numbers,
                      ValueType type = ValueType::F64) {
    return {name, std::move(numbers), type};
}

NcVariable variableOf(ValueType type, std::vector<NcAttribute> attributes) {
    NcVariable variable;
    variable.name = "v";
    variable.type = type;
    variable.attributes = std::move(attributes);
    variable.filled = false;
    return variable;
}

Packing packed(const NcVariable& variable) {
    return packingOf(variable, [](const std::string& what) { throw std::runtime_error(what); });
}

template <typename T>
Field unpacked(const Packing& packing, const std::vector<T>& stored) {
    Field field;
    unpack(
        packing, {{stored.size(), 1, 1}, {1, stored.size(), stored.size()}},
        [&](void* to) { std::memcpy(to, stored.data(), stored.size() * sizeof(T)); }, field);
    return field;
}

bool isMissing(const Field& field, std::size_t i) {
    return !field.missing.empty() && field.missing[i];
}

// A bound as the variable's own type has it: exact for integers, the nearest for floats.
template <typename T>
std::partial_ordering against(T value, const Number& bound) {
    if constexpr (std::is_same_v<T, float>) {
        // The processor rounds as IEEE 754 says.
        volatile double d = toDouble(bound);
        return static_cast<double>(value) <=> static_cast<double>(static_cast<float>(d));
    }
    if constexpr (std::is_same_v<T, double>) return value <=> toDouble(bound);
    return compare(number(value), bound);
}

std::string told(const Number& n) { return toText(n); }

TYPED_TEST(CfPackingOf, OutsideTheValidRangeIsExactlyWhatComparesSo) {
    const auto values = storedValues<TypeParam>();
    std::vector<std::optional<Number>> bounds{std::nullopt};
    for (const Number& n : attributeNumbers()) bounds.emplace_back(n);
    for (const auto& lo : bounds) {
        for (const auto& hi : bounds) {
            std::vector<NcAttribute> attributes;
            if (lo) attributes.push_back(attribute("valid_min", {*lo}));
            if (hi) attributes.push_back(attribute("valid_max", {*hi}));
            const Field field =
                unpacked(packed(variableOf(valueType<TypeParam>(), attributes)), values);
            for (std::size_t i = 0; i < values.size(); ++i) {
                const bool below = lo && against(values[i], *lo) < 0;
                const bool above = hi && against(values[i], *hi) > 0;
                ASSERT_EQ(isMissing(field, i), below || above)
                    << +values[i] << " in " << (lo ? told(*lo) : "-") << " to "
                    << (hi ? told(*hi) : "-");
            }
        }
    }
}

TYPED_TEST(CfPackingOf, AFillIsExactlyWhatEqualsIt) {
    const auto values = storedValues<TypeParam>();
    for (const char* name : {"_FillValue", "missing_value"}) {
        for (const Number& fill : attributeNumbers()) {
            const Field field = unpacked(
                packed(variableOf(valueType<TypeParam>(), {attribute(name, {fill})})), values);
            for (std::size_t i = 0; i < values.size(); ++i) {
                // A finite number beyond a float's limits is no infinity.
                const bool beyond = std::isfinite(toDouble(fill)) && [&] {
                    if constexpr (std::is_floating_point_v<TypeParam>) return std::isinf(values[i]);
                    return false;
                }();
                ASSERT_EQ(isMissing(field, i), !beyond && against(values[i], fill) == 0)
                    << name << ' ' << told(fill) << " and " << +values[i];
            }
        }
    }
}

TEST(CfPacking, AFillOfTheOtherSignednessIsItsBits) {
    const auto check = [](ValueType declared, const char* isUnsigned, auto first) {
        using Stored = decltype(first);
        std::vector<Stored> values(256);
        std::iota(values.begin(), values.end(), std::numeric_limits<Stored>::min());
        for (std::int64_t fill = -300; fill < 600; ++fill) {
            NcVariable variable = variableOf(declared, {attribute("_FillValue", {fill})});
            variable.attributes.push_back({"_Unsigned", std::string(isUnsigned), std::nullopt});
            const Field field = unpacked(packed(variable), values);
            for (std::size_t i = 0; i < values.size(); ++i)
                ASSERT_EQ(isMissing(field, i), fill >= -128 && fill < 256 &&
                                                   static_cast<std::uint8_t>(fill) ==
                                                       static_cast<std::uint8_t>(values[i]))
                    << fill << " and " << +values[i];
        }
    };
    check(ValueType::I8, "true", std::uint8_t{});
    check(ValueType::U8, "false", std::int8_t{});
    // Without the attribute, or with the signedness it has, no bits are read another way.
    const std::vector<std::uint8_t> all{255};
    EXPECT_FALSE(isMissing(
        unpacked(packed(variableOf(ValueType::U8, {attribute("_FillValue", {-1.0})})), all), 0));
}

TEST(CfPacking, UnsignedChangesTheSignednessOfIntegersOnly) {
    const std::vector<std::pair<ValueType, ValueType>> integers{{ValueType::I8, ValueType::U8},
                                                                {ValueType::I16, ValueType::U16},
                                                                {ValueType::I32, ValueType::U32},
                                                                {ValueType::I64, ValueType::U64}};
    const auto stored = [](ValueType type, const std::string& isUnsigned) {
        NcVariable variable = variableOf(type, {});
        variable.attributes.push_back({"_Unsigned", isUnsigned, std::nullopt});
        return packed(variable).stored;
    };
    for (const auto& [is, isNot] : integers) {
        for (const ValueType type : {is, isNot}) {
            EXPECT_EQ(stored(type, "true"), isNot);
            EXPECT_EQ(stored(type, "False"), is);
            EXPECT_EQ(stored(type, "perhaps"), type);
        }
    }
    for (const ValueType type : {ValueType::F32, ValueType::F64})
        for (const char* isUnsigned : {"true", "false"}) EXPECT_EQ(stored(type, isUnsigned), type);
}

TEST(CfPacking, ScalesAreToldInTheDigitsOfTheirType) {
    const auto told = [](ValueType type) {
        const double third = type == ValueType::F32 ? static_cast<double>(1 / 3.0f) : 1 / 3.0;
        return packed(variableOf(ValueType::I16, {attribute("scale_factor", {third}, type)}))
            .storedAs;
    };
    EXPECT_EQ(told(ValueType::F32), "int16 packed, scale 0.33333334, offset 0");
    EXPECT_EQ(told(ValueType::F64), "int16 packed, scale 0.3333333333333333, offset 0");
    EXPECT_EQ(packed(variableOf(ValueType::I16, {attribute("add_offset", {5.0})})).storedAs,
              "int16 packed, scale 1, offset 5");
}

TEST(CfPacking, AnAttributeOfAnotherLengthOrKindIsMalformed) {
    const auto flaw = [](const NcAttribute& attribute) -> std::string {
        try {
            packed(variableOf(ValueType::I16, {attribute}));
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "nothing";
    };
    for (const char* one : {"scale_factor", "add_offset", "_FillValue", "valid_min", "valid_max"}) {
        EXPECT_EQ(flaw(attribute(one, {1.0})), "nothing");
        EXPECT_EQ(flaw(attribute(one, {1.0, 2.0})),
                  std::string(one) + ": expected 1 number, found 2");
    }
    EXPECT_EQ(flaw(attribute("valid_range", {1.0})), "valid_range: expected 2 numbers, found 1");
    EXPECT_EQ(flaw({"missing_value", std::string("none"), std::nullopt}),
              "missing_value: expected a number, found the text \"none\"");
    EXPECT_EQ(flaw(attribute("scale_factor", {kInf})),
              "scale_factor: expected a finite number, found inf");
}

TEST(CfPacking, UnpackedTypesAreThoseOfCf) {
    const std::vector<std::optional<ValueType>> types{std::nullopt, ValueType::F32, ValueType::F64,
                                                      ValueType::I32};
    for (const ValueType stored :
         {ValueType::U8, ValueType::I8, ValueType::U16, ValueType::I16, ValueType::U32,
          ValueType::I32, ValueType::U64, ValueType::I64, ValueType::F32, ValueType::F64}) {
        for (const auto& scale : types) {
            for (const auto& offset : types) {
                for (const double factor : {1.0, 2.0}) {
                    std::vector<NcAttribute> attributes;
                    if (scale) attributes.push_back(attribute("scale_factor", {factor}, *scale));
                    if (offset) attributes.push_back(attribute("add_offset", {0.0}, *offset));
                    const Packing packing = packed(variableOf(stored, attributes));
                    const bool wide = stored == ValueType::I64 || stored == ValueType::U64;
                    const bool identity = factor == 1.0 || !scale;
                    const bool scaled = (scale || offset) && !(wide && identity);
                    const bool narrow = stored == ValueType::F32 || stored == ValueType::U8 ||
                                        stored == ValueType::I8 || stored == ValueType::U16 ||
                                        stored == ValueType::I16;
                    const bool floats = scale.value_or(ValueType::F32) == ValueType::F32 &&
                                        offset.value_or(ValueType::F32) == ValueType::F32;
                    EXPECT_EQ(packing.scaled, scaled);
                    EXPECT_EQ(packing.unpacked, !scaled            ? stored
                                                : floats && narrow ? ValueType::F32
                                                                   : ValueType::F64);
                }
            }
        }
    }
}

TEST(CfPacking, AValidRangeOfTheScalesTypeIsOfUnpackedValues) {
    std::vector<std::int16_t> stored(65536);
    std::iota(stored.begin(), stored.end(), std::numeric_limits<std::int16_t>::min());
    for (const bool asStored : {false, true}) {
        const auto type = asStored ? ValueType::I16 : ValueType::F64;
        const Packing packing = packed(variableOf(
            ValueType::I16, {attribute("scale_factor", {0.5}), attribute("add_offset", {10.0}),
                             attribute("valid_range", {-7.0, 1000.0}, type)}));
        EXPECT_EQ(packing.validUnpacked, !asStored);
        const Field field = unpacked(packing, stored);
        const auto& values = std::get<std::vector<double>>(field.values);
        for (std::size_t i = 0; i < stored.size(); ++i) {
            ASSERT_EQ(values[i], stored[i] * 0.5 + 10);
            const double compared = asStored ? stored[i] : values[i];
            ASSERT_EQ(isMissing(field, i), compared < -7 || compared > 1000) << stored[i];
        }
    }
}

TEST(CfPacking, AnUnpackedBoundIsNotReadAsBits) {
    std::vector<std::uint8_t> stored(256);
    std::iota(stored.begin(), stored.end(), 0);
    NcVariable variable = variableOf(
        ValueType::I8, {attribute("scale_factor", {0.5}), attribute("add_offset", {-20.0}),
                        attribute("valid_min", {-1.0}), attribute("valid_max", {90.0})});
    variable.attributes.push_back({"_Unsigned", std::string("true"), std::nullopt});
    const Field field = unpacked(packed(variable), stored);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const double value = stored[i] * 0.5 - 20;
        ASSERT_EQ(isMissing(field, i), value < -1 || value > 90) << value;
    }
}

TEST(CfPacking, NumbersInTheFieldsOrderAreReadStraightIntoIt) {
    const auto straight = [](const StridedLayout& layout,
                             std::vector<NcAttribute> attributes = {}) {
        const void* told = nullptr;
        Field field;
        unpack(
            packed(variableOf(ValueType::F32, std::move(attributes))), layout,
            [&](void* to) { told = to; }, field);
        return std::get<std::vector<float>>(field.values).data() == told;
    };
    EXPECT_TRUE(straight({{4, 3, 2}, {1, 4, 12}}));
    EXPECT_TRUE(straight({{4, 1, 2}, {1, 0, 4}})) << "one point has any stride";
    EXPECT_FALSE(straight({{4, 3, 2}, {1, 8, 4}}));
    EXPECT_FALSE(straight({{4, 3, 2}, {6, 2, 1}}));
    EXPECT_FALSE(
        straight({{4, 3, 2}, {1, 4, 12}}, {attribute("scale_factor", {2.0}, ValueType::F32)}));
}

TEST(CfPacking, EveryMissingNumberIsToldOnce) {
    const auto text = [](const std::vector<NcAttribute>& attributes) {
        return packed(variableOf(ValueType::I16, attributes)).missingText;
    };
    EXPECT_EQ(text({attribute("_FillValue", {5.0}),
                    attribute("missing_value", {5.0, 7.0, 7.5, 7.0, 1e9})}),
              "_FillValue 5, missing_value 7");
    EXPECT_EQ(text({attribute("valid_min", {5.0})}), "outside 5..inf");
    EXPECT_EQ(text({attribute("missing_value", {2.0}), attribute("valid_max", {5.0})}),
              "missing_value 2, outside -inf..5");
    EXPECT_EQ(text({attribute("scale_factor", {2.0}),
                    attribute("valid_range", {std::int64_t{1}, std::int64_t{5}}, ValueType::I16)}),
              "outside 1..5 as stored");
}

}  // namespace
}  // namespace timeseries

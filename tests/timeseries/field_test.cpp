#include "timeseries/grid/field.h"

#include <gtest/gtest.h>

namespace timeseries {
namespace {

TEST(Field, TypeFollowsTheValuesHeld) {
    const std::pair<Values, ValueType> cases[] = {{std::vector<std::uint8_t>{}, ValueType::U8},
                                                  {std::vector<std::int8_t>{}, ValueType::I8},
                                                  {std::vector<std::uint16_t>{}, ValueType::U16},
                                                  {std::vector<std::int16_t>{}, ValueType::I16},
                                                  {std::vector<std::uint32_t>{}, ValueType::U32},
                                                  {std::vector<std::int32_t>{}, ValueType::I32},
                                                  {std::vector<std::uint64_t>{}, ValueType::U64},
                                                  {std::vector<std::int64_t>{}, ValueType::I64},
                                                  {std::vector<float>{}, ValueType::F32},
                                                  {std::vector<double>{}, ValueType::F64}};
    for (const auto& [values, type] : cases)
        EXPECT_EQ((Field{nullptr, values, {}}.type()), type) << typeName(type);
}

TEST(Field, TypeNamesAreThoseOfNumpy) {
    EXPECT_EQ(typeName(ValueType::U8), "uint8");
    EXPECT_EQ(typeName(ValueType::I8), "int8");
    EXPECT_EQ(typeName(ValueType::U16), "uint16");
    EXPECT_EQ(typeName(ValueType::I16), "int16");
    EXPECT_EQ(typeName(ValueType::U32), "uint32");
    EXPECT_EQ(typeName(ValueType::I32), "int32");
    EXPECT_EQ(typeName(ValueType::U64), "uint64");
    EXPECT_EQ(typeName(ValueType::I64), "int64");
    EXPECT_EQ(typeName(ValueType::F32), "float32");
    EXPECT_EQ(typeName(ValueType::F64), "float64");
}

}  // namespace
}  // namespace timeseries

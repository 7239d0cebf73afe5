#include "app/reading.h"

#include <gtest/gtest.h>

#include <limits>

namespace app {
namespace {

using timeseries::ValueType;

TEST(ReadingText, AValueHasTheDigitsOfItsOwnType) {
    // The nearest float to 0.1 is not 0.1; of a float it is written so all the same.
    EXPECT_EQ(valueText(static_cast<double>(0.1f), ValueType::F32, "K"), "0.1 K");
    EXPECT_EQ(valueText(0.1, ValueType::F64, "K"), "0.1 K");
    EXPECT_EQ(valueText(0.1 + 0.2, ValueType::F64, ""), "0.30000000000000004");
    EXPECT_EQ(valueText(std::numeric_limits<std::uint64_t>::max(), ValueType::U64, "1"),
              "18446744073709551615");
}

TEST(ReadingText, APlaceHasItsIndexAndItsUnitWhereThatIsOne) {
    EXPECT_EQ(placeText({"x", "m", {0.25, 0.5}, false}, 0.5, 1), "0.5 m   [1]");
    EXPECT_EQ(placeText({"i", "index", {0, 1, 2}, false}, 2, 2), "2   [2]");
}

}  // namespace
}  // namespace app

#include "tests/support/fragment_order.h"

#include <gtest/gtest.h>

namespace render {
namespace {

// Where splats hide half of what is behind a cell and more, the nearest ones stand in each other's
// place, above all those that an eye among them sees large.
TEST(FragmentOrder, OfASmoothFieldIsSeenWhereSplatsAreInTheOrderOfTheirCentres) {
    for (const auto& [opacity, outside, within, face] : {std::array{0.02, 1e-3, 1e-3, 1e-3},
                                                         {0.1, 1e-3, 1e-3, 1e-3},
                                                         {0.5, 1e-3, 5e-3, 1e-3},
                                                         {1.0, 3e-3, 8e-2, 5e-3}}) {
        const tests::SmoothScene smooth(opacity);
        EXPECT_LE(smooth.offFrom(smooth.fromOutside()), outside) << opacity;
        EXPECT_LE(smooth.offFrom(smooth.within()), within) << opacity;
        EXPECT_LE(smooth.offFrom(smooth.alongAFace()), face) << opacity;
    }
}

}  // namespace
}  // namespace render

// Where the volume stands in the room, by what the runtime knows of the floor.
#include <glm/geometric.hpp>

#include "app/headset/standing.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/front_end.h"

namespace app::headset {
namespace {

// Monado's head begins 1.6 m above its floor, and there its LOCAL has the origin
// (u_space_overseer's legacy setup): eyes, as OpenXR says of LOCAL.
constexpr double kEyes = 1.6;

glm::dvec3 beforeEyesAt(double height) { return {0, height - kVolumeBelowEye, -kVolumeAhead}; }

TEST_F(FrontEndWithHands, TheVolumeStandsBeforeEyesThatAreAboveTheFloor) {
    EXPECT_LT(glm::distance(volume(), beforeEyesAt(kEyes)), 1e-4);
}

class WithoutAFloor : public FrontEndWithHands {
    void SetUp() override {
        if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
        FrontEndWithHands::SetUp();
    }
    tests::ApiLayer layer_{tests::kNoFloor};
};

// Eyes are taken to be 1.5 m above a floor that is not known; the volume stands before them all the
// same.
TEST_F(WithoutAFloor, TheVolumeStandsBeforeTheEyes) {
    EXPECT_LT(glm::distance(volume(), beforeEyesAt(1.5)), 1e-4);
}

}  // namespace
}  // namespace app::headset

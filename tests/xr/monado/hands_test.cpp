// Hands as Monado's remote driver moves them: what is sent is what arrives.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/headset.h"
#include "tests/support/monado_service.h"
#include "tests/support/remote_devices.h"
#include "tests/xr/monado/api_layer.h"

namespace xr {
namespace {

class RemoteHeadset : public testing::Test {
 protected:
    void SetUp() override {
        session_ = tests::openHeadset(context_);
        ASSERT_TRUE(session_);
        devices_.head().centre = tests::place({0, 1.6, 0});
        for (int h = 0; h < 2; ++h)
            devices_.hand(h).place = tests::place({h == 0 ? -0.3 : 0.3, 1.1, -0.4});
        devices_.send();
        ASSERT_TRUE(tests::framesUntilFocused(*session_));
    }

    // Frames until the hands are as the devices were sent to be; fails when they never are.
    template <typename Holds>
    std::array<Hand, 2> handsOnce(Holds holds) {
        devices_.send();
        std::array<Hand, 2> hands;
        EXPECT_TRUE(tests::framesUntil(
            *session_, [&](auto& frame) { hands = frame.hands(); }, [&] { return holds(hands); }));
        return hands;
    }

    tests::MonadoService service_{tests::Monado::Remote};
    tests::RemoteDevices devices_{service_.remotePort()};
    render::gl::HeadlessContext context_;
    std::unique_ptr<Session> session_;
};

// Index controllers as they are; and as Touch, where nothing is suggested for an Index: Monado
// gives them as such.
class Controllers : public RemoteHeadset, public testing::WithParamInterface<const char*> {
 protected:
    void SetUp() override {
        if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
        layer_.emplace(GetParam());
        RemoteHeadset::SetUp();
    }
    std::optional<tests::ApiLayer> layer_;
};
INSTANTIATE_TEST_SUITE_P(Monado, Controllers, testing::Values("", tests::kNoIndex),
                         [](const auto& test) {
                             return std::string(*test.param == 0 ? "Index" : "Touch");
                         });

bool isAt(const std::optional<Pose>& pose, const glm::dvec3& position) {
    return pose && glm::distance(pose->position, position) < 1e-4;
}

TEST_F(RemoteHeadset, HandsAreWhereTheyAreMoved) {
    const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, -1)));
    const glm::dvec3 left(-0.25, 1.3, -0.55), right(0.4, 0.9, -0.2);
    devices_.hand(0).place = tests::place(left, turn);
    devices_.hand(1).place = tests::place(right);
    const auto hands =
        handsOnce([&](const auto& h) { return isAt(h[0].grip, left) && isAt(h[1].grip, right); });
    ASSERT_TRUE(hands[0].grip && hands[0].aim);
    EXPECT_GT(std::abs(glm::dot(hands[0].grip->orientation, turn)), 1 - 1e-6);
}

TEST_F(RemoteHeadset, TheHeadIsWhereItIsMoved) {
    const glm::dvec3 at(0.2, 1.45, 0.3);
    devices_.head().centre = tests::place(at);
    devices_.send();
    std::optional<Pose> head;
    EXPECT_TRUE(tests::framesUntil(
        *session_, [&](auto& frame) { head = frame.head(); }, [&] { return isAt(head, at); }));
}

TEST_P(Controllers, EachPartOfAControllerIsOneIntention) {
    const auto onlyLeft = [](bool Hand::*part) {
        return [=](const std::array<Hand, 2>& h) { return h[0].*part && !(h[1].*part); };
    };
    const auto none = [](const std::array<Hand, 2>& h) {
        return !h[0].grab && !h[0].select && !h[0].menu && !h[0].swing && !h[0].bring;
    };
    auto& left = devices_.hand(0);
    left.squeezeForce = left.squeeze = 1;
    handsOnce(onlyLeft(&Hand::grab));
    left.squeezeForce = left.squeeze = 0;
    handsOnce(none);
    left.trigger = 1, left.triggerClick = 1;
    handsOnce(onlyLeft(&Hand::select));
    left.trigger = 0, left.triggerClick = 0;
    handsOnce(none);
    left.aClick = 1;
    handsOnce(onlyLeft(&Hand::menu));
    left.aClick = 0;
    handsOnce(none);
    left.bClick = 1;
    handsOnce(onlyLeft(&Hand::swing));
    left.bClick = 0;
    handsOnce(none);
    left.stickClick = 1;
    handsOnce(onlyLeft(&Hand::bring));
}

TEST_P(Controllers, SticksAreReadByHand) {
    devices_.hand(0).stick = {0.5f, -0.25f};
    devices_.hand(1).stick = {-1, 1};
    handsOnce([](const auto& h) {
        return glm::distance(h[0].stick, {0.5, -0.25}) < 1e-3 &&
               glm::distance(h[1].stick, {-1, 1}) < 1e-3;
    });
}

TEST_P(Controllers, HelpNamesThePartsOfTheController) {
    const std::string& text = session_->controls().text;
    ASSERT_TRUE(tests::framesUntil(
        *session_, [](auto&) {}, [&] { return !text.empty(); }));
    for (const char* line :
         {"Grab the volume: ", "Play, pause, click: ", "Help and panel: ", "Swing the sweep: ",
          "Bring the volume here: ", "Move value or time: "})
        EXPECT_THAT(text, testing::HasSubstr(line));
    EXPECT_TRUE(session_->controls().sticks);
    EXPECT_FALSE(session_->controls().oneButton);
}

}  // namespace
}  // namespace xr

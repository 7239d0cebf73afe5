// A life with the simulated headset. What its devices do is Monado's, of drivers/simulated.
#include "xr/session.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/headset.h"
#include "tests/support/monado_service.h"

namespace xr {
namespace {

class SimulatedHeadset : public testing::Test {
 protected:
    tests::MonadoService service_{tests::Monado::Null};
    render::gl::HeadlessContext context_;
};

// OpenXR 1.1, figure "Session Lifecycle", without loss.
const std::set<std::pair<State, State>> kSteps{
    {State::Unknown, State::Idle},         {State::Idle, State::Ready},
    {State::Ready, State::Synchronized},   {State::Synchronized, State::Visible},
    {State::Visible, State::Focused},      {State::Focused, State::Visible},
    {State::Visible, State::Synchronized}, {State::Synchronized, State::Stopping},
    {State::Stopping, State::Idle},        {State::Idle, State::Exiting}};

TEST_F(SimulatedHeadset, GoesThroughItsStatesInOrder) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    std::vector<State> states{State::Unknown};
    int frames = 0;
    const auto end = std::chrono::steady_clock::now() + ui::kDeadline;
    while (!session->ended() && std::chrono::steady_clock::now() < end) {
        const auto frame = session->beginFrame();
        if (session->state().state() != states.back()) states.push_back(session->state().state());
        if (!frame) continue;
        tests::submitColor(*frame);
        if (session->state().focused() && ++frames == 5) session->requestExit();
    }
    EXPECT_THAT(states, testing::Contains(State::Focused));
    EXPECT_EQ(states.back(), State::Exiting);
    for (std::size_t i = 1; i < states.size(); ++i)
        EXPECT_TRUE(kSteps.count({states[i - 1], states[i]}))
            << static_cast<int>(states[i - 1]) << " to " << static_cast<int>(states[i]);
}

TEST_F(SimulatedHeadset, ShowsTheEyesOfTheSwayingHead) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    EXPECT_THAT(session->runtimeName(), testing::HasSubstr("Monado"));
    std::chrono::nanoseconds last{0};
    double lowest = 10, highest = 0;
    const auto look = [&](Session::Frame& frame) {
        EXPECT_GT(frame.displayTime(), last);
        last = frame.displayTime();
        ASSERT_TRUE(frame.shouldRender());
        const auto eyes = frame.eyes(1);
        ASSERT_EQ(eyes.size(), 2u);
        ASSERT_TRUE(frame.head());
        const glm::dvec3 left = eyes[0].stageFromEye.position,
                         right = eyes[1].stageFromEye.position;
        // 63 mm apart, along the head's x, either side of it.
        const Pose headFromStage = inverse(*frame.head());
        const auto inHead = [&](const Pose& p) { return (headFromStage * p).position; };
        EXPECT_LT(glm::distance(inHead(eyes[0].stageFromEye), {-0.0315, 0, 0}), 1e-4);
        EXPECT_LT(glm::distance(inHead(eyes[1].stageFromEye), {0.0315, 0, 0}), 1e-4);
        lowest = std::min(lowest, (left.y + right.y) / 2);
        highest = std::max(highest, (left.y + right.y) / 2);
        for (const Eye& eye : eyes) {
            EXPECT_EQ(eye.size, glm::ivec2(320, 240));
            EXPECT_NE(eye.framebuffer, 0u);
            EXPECT_LT(eye.fov.left, 0);
            EXPECT_LT(eye.fov.down, 0);
            EXPECT_GT(eye.fov.right, 0);
            EXPECT_GT(eye.fov.up, 0);
        }
    };
    // 1.6 m + 5 cm sin(pi t / 2), to its ends and not beyond.
    EXPECT_TRUE(
        tests::framesUntil(*session, look, [&] { return lowest < 1.552 && highest > 1.648; }));
    EXPECT_GT(lowest, 1.5499);
    EXPECT_LT(highest, 1.6501);
}

// Monado's default (u_visibility_mask.c) cuts the corners off: an eighth of each side.
TEST_F(SimulatedHeadset, TellsWhatItsLensesHide) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    const auto frame = session->beginFrame();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->eyes(1).size(), 2u);
    for (const Eye& eye : frame->eyes(1)) {
        ASSERT_TRUE(eye.hidden);
        const render::View view = viewOf(eye.stageFromEye, eye.fov, {}, 0.1, 10, eye.size);
        std::vector<bool> hidden(std::size_t(eye.size.x) * eye.size.y);
        for (const auto& [at, size] : hiddenPixels(*eye.hidden, view))
            for (int x = at.x; x < at.x + size.x; ++x)
                hidden[std::size_t(at.y) * eye.size.x + x] = true;
        for (int y = 0; y < eye.size.y; ++y)
            for (int x = 0; x < eye.size.x; ++x) {
                // Pixels from the nearest border, in eighths of the side.
                const double beyond = 1 - 8.0 * std::min(x + 1, eye.size.x - x) / eye.size.x -
                                      8.0 * std::min(y + 1, eye.size.y - y) / eye.size.y;
                const double pixel = 8.0 / eye.size.x + 8.0 / eye.size.y;
                const bool is = hidden[std::size_t(y) * eye.size.x + x];
                ASSERT_TRUE(is ? beyond > 0 : beyond < pixel) << x << ' ' << y;
            }
    }
    tests::submitColor(*frame);
}

// Monado offers one, the period's; a rate that it does not have is refused, and no loss.
TEST_F(SimulatedHeadset, OffersRefreshRatesAndMayRefuseOne) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_EQ(session->refreshRates().size(), 1u);
    const double rate = session->refreshRates()[0];
    for (const double asked : {rate, 7 * rate}) {
        session->requestRefreshRate(asked);
        std::chrono::duration<double> period{0};
        ASSERT_TRUE(tests::framesUntil(
            *session, [&](auto& frame) { period = frame.period(); },
            [&] { return session->state().focused() && period.count() > 0; }));
        EXPECT_NEAR(period.count() * rate, 1, 0.01);
    }
}

TEST_F(SimulatedHeadset, DrawsAShareOfItsImages) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    for (const double scale : {0.5, 0.71, 1.0}) {
        const auto frame = session->beginFrame();
        ASSERT_TRUE(frame);
        const auto eyes = frame->eyes(scale);
        ASSERT_EQ(eyes.size(), 2u);
        EXPECT_EQ(eyes[0].size, glm::ivec2(std::ceil(320 * scale), std::ceil(240 * scale)));
        tests::submitColor(*frame);
    }
}

TEST_F(SimulatedHeadset, GoesOnAfterFramesThatWereNotSubmitted) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    ASSERT_TRUE(session->beginFrame());
    {
        const auto drawnInVain = session->beginFrame();
        ASSERT_TRUE(drawnInVain);
        ASSERT_EQ(drawnInVain->eyes(1).size(), 2u);
    }
    int frames = 0;
    EXPECT_TRUE(tests::framesUntil(
        *session, [&](auto&) { ++frames; }, [&] { return frames == 10; }));
}

TEST_F(SimulatedHeadset, LosesFocusToASecondClientAndGetsItBack) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    FILE* second = popen(SECOND_CLIENT, "w");
    ASSERT_TRUE(second);
    const auto noLook = [](auto&) {};
    EXPECT_TRUE(tests::framesUntil(*session, noLook, [&] { return !session->state().visible(); }));
    bool held = false;
    for (int i = 0; i < 5; ++i) {
        const auto frame = session->beginFrame();
        if (!frame) continue;
        for (const Hand& hand : frame->hands()) held = held || hand.grab || hand.select;
    }
    EXPECT_FALSE(held);
    EXPECT_EQ(pclose(second), 0);
    EXPECT_TRUE(tests::framesUntilFocused(*session));
}

TEST_F(SimulatedHeadset, TellsWhatASimpleControllerDoes) {
    const auto session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    std::array<Hand, 2> hands;
    ASSERT_TRUE(tests::framesUntil(
        *session, [&](auto& frame) { hands = frame.hands(); },
        [&] { return hands[0].grip && hands[1].grip && !session->controls().text.empty(); }));
    // Monado's simulated controllers rest at (-/+0.2, 1.3, -0.5), and sway a little.
    for (int h = 0; h < 2; ++h) {
        ASSERT_TRUE(hands[h].grip && hands[h].aim);
        EXPECT_LT(glm::distance(hands[h].grip->position, {h == 0 ? -0.2 : 0.2, 1.3, -0.5}), 0.05);
        EXPECT_FALSE(hands[h].grab || hands[h].select || hands[h].menu);
        EXPECT_EQ(hands[h].stick, glm::dvec2(0));
    }
    EXPECT_EQ(session->controls().text,
              "Grab the volume: Select\nPlay, pause, click: Select\nHelp and panel: Menu");
    EXPECT_TRUE(session->controls().oneButton);
    EXPECT_FALSE(session->controls().sticks);
    session->vibrate(0, 0.5, std::chrono::milliseconds(20));
}

}  // namespace
}  // namespace xr

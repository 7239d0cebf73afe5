// The runtime dies, or stops, before each kind of call: the session ends in bounded time with one
// sentence, and the same process can have another one.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "tests/support/headset.h"
#include "tests/support/monado_service.h"
#include "tests/ui/waiting.h"

namespace xr {
namespace {

enum class Before { Begin, Eyes, Submit, EndWithoutSubmit, Vibrate, Exit };
enum class Fate { Killed, Stopped };
using Clock = std::chrono::steady_clock;

// Short, so that the tests are.
constexpr Patience kPatience{.calls = std::chrono::seconds(3),
                             .withDrawing = std::chrono::seconds(3)};

class Loss : public testing::TestWithParam<std::tuple<Before, Fate>> {
 protected:
    Before before() const { return std::get<0>(GetParam()); }
    Fate fate() const { return std::get<1>(GetParam()); }

    // Once.
    void strike(Before call) {
        if (call != before() || struck_) return;
        if (fate() == Fate::Killed)
            service_->kill();
        else
            service_->stop();
        struck_ = Clock::now();
    }

    // A frame as a program has it, with the blow where it is to fall.
    void frame(Session& session) {
        strike(Before::Exit);
        if (before() == Before::Exit) session.requestExit();
        strike(Before::Vibrate);
        if (before() == Before::Vibrate) session.vibrate(1, 1, std::chrono::milliseconds(10));
        strike(Before::Begin);
        const auto begun = session.beginFrame();
        if (!begun) return;
        strike(Before::Eyes);
        begun->eyes(1);
        strike(Before::EndWithoutSubmit);
        if (before() == Before::EndWithoutSubmit) return;
        strike(Before::Submit);
        tests::submitColor(*begun);
    }

    std::unique_ptr<tests::MonadoService> service_ =
        std::make_unique<tests::MonadoService>(tests::Monado::Null);
    render::gl::HeadlessContext context_;
    std::optional<Clock::time_point> struck_;
};

TEST_P(Loss, EndsTheSessionInBoundedTime) {
    auto session = tests::openHeadset(context_, kPatience);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    std::string why;
    try {
        while (true) frame(*session);
    } catch (const LostError& error) {
        why = error.what();
    }
    EXPECT_THAT(why, testing::HasSubstr("the headset's runtime Monado"));
    EXPECT_THAT(why,
                testing::HasSubstr(fate() == Fate::Killed ? "went away" : "has not answered for"));
    EXPECT_THROW(session->beginFrame(), LostError);
    EXPECT_THROW(session->requestExit(), LostError);
    session.reset();
    EXPECT_LT(Clock::now() - *struck_, ui::kDeadline) << "patience is waited for once, not a call";

    service_.reset();
    service_ = std::make_unique<tests::MonadoService>(tests::Monado::Null);
    session = tests::openHeadset(context_);
    ASSERT_TRUE(session);
    EXPECT_TRUE(tests::framesUntilFocused(*session));
}

std::string name(const testing::TestParamInfo<std::tuple<Before, Fate>>& test) {
    constexpr std::array kCalls{"Begin", "Eyes", "Submit", "EndWithoutSubmit", "Vibrate", "Exit"};
    const auto [before, fate] = test.param;
    return fmt::format("{}Before{}", fate == Fate::Killed ? "Killed" : "Stopped",
                       kCalls[static_cast<std::size_t>(before)]);
}

INSTANTIATE_TEST_SUITE_P(Monado, Loss,
                         testing::Combine(testing::Values(Before::Begin, Before::Eyes,
                                                          Before::Submit, Before::EndWithoutSubmit,
                                                          Before::Vibrate, Before::Exit),
                                          testing::Values(Fate::Killed, Fate::Stopped)),
                         name);

TEST(NoService, IsSaidToBeToStart) {
    tests::MonadoService service(tests::Monado::Null);
    service.kill();
    const auto answer = Session::ask();
    ASSERT_TRUE(std::holds_alternative<NoHeadset>(answer));
    EXPECT_EQ(std::get<NoHeadset>(answer).why,
              "the OpenXR runtime of " MONADO_MANIFEST
              " does not answer: its service is to be started first");
}

TEST(NoService, OneThatIsStoppedIsNotWaitedForLong) {
    tests::MonadoService service(tests::Monado::Null);
    service.stop();
    const auto begin = Clock::now();
    const auto answer = Session::ask();
    ASSERT_TRUE(std::holds_alternative<NoHeadset>(answer));
    EXPECT_EQ(std::get<NoHeadset>(answer).why,
              "the OpenXR runtime of " MONADO_MANIFEST
              " does not answer for 3 s when it is asked for a headset");
    EXPECT_LT(Clock::now() - begin, ui::kDeadline);
}

TEST(Service, IsAHeadset) {
    tests::MonadoService service(tests::Monado::Null);
    EXPECT_TRUE(std::holds_alternative<Session::Offer>(Session::ask()));
}

}  // namespace
}  // namespace xr

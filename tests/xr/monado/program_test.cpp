// `isochron FILE --display headset` as a user starts it, with a runtime that may go.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/support/monado_service.h"
#include "tests/support/remote_devices.h"
#include "tests/ui/driver.h"
#include "tests/ui/slow_file.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/program.h"

#include <X11/Xlib.h>  // whose words, like None, are others' too

namespace {

using tests::Program;

using nlohmann::json;

// What a window's user prefers is none of a headset's.
TEST(HeadsetProgram, EndsInGoodOrderOnASignal) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program(
        {.display = "headset", .preferences = R"({"uiScale": 1.5, "frameMilliseconds": 50})"});
    program.untilItSavesItsSession();
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_EQ(program.session(), "") << "nothing is left to be offered";
    const json preferences = json::parse(program.preferences());
    EXPECT_EQ(preferences.at("uiScale"), 1.5);
    EXPECT_EQ(preferences.at("frameMilliseconds"), 50);
    EXPECT_EQ(preferences.at("recentFiles").size(), 1u);
}

TEST(HeadsetProgram, AutoIsAHeadsetWhereOneAnswers) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program({.display = "auto"});
    program.untilItSavesItsSession();
    program.signal(SIGINT);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
}

// A program in a headset with hands, in which a step has been taken so short ago that it is not
// saved yet.
class HeadsetProgramWithHands : public testing::Test {
 protected:
    void SetUp() override {
        if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
        layer_.emplace();
        devices_.head().centre = tests::place({0, 1.6, 0});
        for (int h = 0; h < 2; ++h)
            devices_.hand(h).place = tests::place({h == 0 ? -0.3 : 0.3, 1.1, -0.4});
        devices_.send();
    }
    void start(std::optional<std::string> screen = {}) {
        program_.emplace(Program::Start{
            .display = "headset", .screen = std::move(screen), .more = {"--step", "12"}});
        program_->untilItSavesItsSession();
        saved_ = json::parse(program_->session());
        ASSERT_EQ(saved_.at("steps"), "12");
        // Until the runtime gives hands.
        frames(10);
        devices_.hand(0).stick = {1, 0};
        devices_.send();
        frames(2);
        devices_.hand(0).stick = {0, 0};
        devices_.send();
        frames(2);
    }
    // So many more are submitted.
    void frames(std::size_t count) {
        const std::size_t until = layer_->submitted().size() + 2 * count;
        program_->until("frames", [&] { return layer_->submitted().size() >= until; });
    }
    // As it was saved, but for the step.
    void expectTheStepKept() {
        json expected = saved_;
        expected["steps"] = "13";
        EXPECT_EQ(json::parse(program_->session()), expected);
    }

    tests::MonadoService service_{tests::Monado::Remote};
    tests::RemoteDevices devices_{service_.remotePort()};
    std::optional<tests::ApiLayer> layer_;
    std::optional<Program> program_;
    json saved_;
};

TEST_F(HeadsetProgramWithHands, LostWithoutADisplayItLeavesItsSessionAsItWasInTheLastFrame) {
    start();
    service_.kill();
    EXPECT_EQ(program_->exitCode(), 1);
    EXPECT_THAT(program_->said(), testing::HasSubstr("no display"));
    EXPECT_THAT(program_->said(), testing::HasSubstr("Monado"));
    expectTheStepKept();
}

TEST_F(HeadsetProgramWithHands, WhereTheDisplayGoesItLeavesItsSessionAsItWasInTheLastFrame) {
    const ui::Screen screen(tests::testFolder());
    start(screen.name());
    // As a server that dies: the connection is closed.
    const auto window = screen.windowOf(program_->id());
    ASSERT_TRUE(window) << "the mirror";
    XKillClient(screen.connection(), *window);
    XFlush(screen.connection());
    EXPECT_EQ(program_->exitCode(), 1);
    EXPECT_THAT(program_->said(), testing::HasSubstr("isochron: the display has gone away"));
    expectTheStepKept();
}

TEST(HeadsetProgram, LostWithADisplayItGoesOnInAWindowAsItWas) {
    tests::MonadoService service(tests::Monado::Window);
    Program program({.display = "auto", .screen = getenv("DISPLAY")});
    program.untilItSavesItsSession();
    json before = json::parse(program.session());
    service.kill();
    program.untilItSays("in a window, because");
    // A picture has its window's size.
    program.until("the window's session is saved",
                  [&] { return json::parse(program.session()).at("size") != before.at("size"); });
    json after = json::parse(program.session());
    after.erase("size"), before.erase("size");
    EXPECT_EQ(after, before);
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_EQ(program.session(), "");
}

// And from there into the headset, once its service is there again.
TEST(HeadsetProgram, FromAWindowAKeyLeadsIntoTheHeadset) {
    if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
    std::optional<tests::MonadoService> service(std::in_place, tests::Monado::Null);
    const tests::ApiLayer layer;
    const ui::Screen screen(tests::testFolder());
    const auto variable = [](const char* name) { return std::optional<std::string>(getenv(name)); };
    ui::Driver desk(screen, tests::testFolder(), {tests::demo().string()},
                    {{"XR_RUNTIME_JSON", variable("XR_RUNTIME_JSON")},
                     {"XDG_RUNTIME_DIR", variable("XDG_RUNTIME_DIR")}});
    desk.waitForTitle("pool_fire_T.nc");
    EXPECT_TRUE(layer.submitted().empty());
    desk.pressOnly("ctrl+h");
    desk.waitFor("frames in the headset", [&] { return layer.submitted().size() >= 4; });
    desk.process().signal(SIGTERM);
    EXPECT_EQ(desk.process().exitCode(), 0) << desk.process().errors();
}

// `end` ends the service while a file is read that takes many seconds.
void goesOnInAWindowAsItReads(const std::function<void(tests::MonadoService&)>& end) {
    if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
    tests::MonadoService service(tests::Monado::Window);
    const tests::ApiLayer layer;
    Program program({.display = "auto",
                     .screen = getenv("DISPLAY"),
                     .more = {"--step", "400"},
                     .file = ui::writeSlowFile(tests::testFolder() / "slow.nrrd")});
    program.until("the headset gets pictures", [&] { return layer.submitted().size() >= 4; });
    ASSERT_EQ(program.session(), "") << "it still reads";
    end(service);
    program.untilItSays("in a window, because the headset's runtime Monado");
    program.untilItSavesItsSession();
    EXPECT_THAT(program.session(), testing::HasSubstr("slow.nrrd"));
    EXPECT_THAT(program.session(), testing::HasSubstr("\"steps\": \"400\""));
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
}

TEST(HeadsetProgram, GoesOnInAWindowWhenTheServiceIsKilledAsItReads) {
    goesOnInAWindowAsItReads([](tests::MonadoService& service) { service.kill(); });
}

TEST(HeadsetProgram, GoesOnInAWindowWhenTheServiceIsStoppedAsItReads) {
    goesOnInAWindowAsItReads([](tests::MonadoService& service) { service.stop(); });
}

}  // namespace

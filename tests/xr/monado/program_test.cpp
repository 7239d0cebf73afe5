// `isochron FILE --display headset` as a user starts it, with a runtime that may go.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <csignal>
#include <functional>

#include "tests/support/monado_service.h"
#include "tests/ui/slow_file.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/program.h"

namespace {

using tests::Program;

TEST(HeadsetProgram, EndsInGoodOrderOnASignal) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program({.display = "headset"});
    program.untilItSavesItsSession();
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_EQ(program.session(), "") << "nothing is left to be offered";
}

TEST(HeadsetProgram, AutoIsAHeadsetWhereOneAnswers) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program({.display = "auto"});
    program.untilItSavesItsSession();
    program.signal(SIGINT);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
}

TEST(HeadsetProgram, LostWithoutADisplayItSaysSoAndLeavesItsSession) {
    tests::MonadoService service(tests::Monado::Null);
    Program program({.display = "headset"});
    program.untilItSavesItsSession();
    service.kill();
    EXPECT_EQ(program.exitCode(), 1);
    EXPECT_THAT(program.said(), testing::HasSubstr("no display"));
    EXPECT_THAT(program.said(), testing::HasSubstr("Monado"));
    EXPECT_NE(program.session(), "");
}

TEST(HeadsetProgram, LostWithADisplayItGoesOnInAWindow) {
    tests::MonadoService service(tests::Monado::Window);
    Program program({.display = "auto", .screen = getenv("DISPLAY")});
    program.untilItSavesItsSession();
    service.kill();
    program.untilItSays("in a window, because");
    EXPECT_NE(program.session(), "");
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_EQ(program.session(), "");
}

// `end` ends the service while a file is read that takes many seconds.
void goesOnInAWindowAsItReads(const std::function<void(tests::MonadoService&)>& end) {
    if (!tests::ApiLayer::isBuilt()) GTEST_SKIP();
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

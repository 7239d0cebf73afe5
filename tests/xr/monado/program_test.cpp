// `isochron FILE --display headset` as a user starts it.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>

#include "tests/support/files.h"
#include "tests/support/monado_service.h"
#include "tests/ui/process.h"
#include "tests/ui/waiting.h"

namespace {

enum class Screen { None, OfTheService };

// The program on the shipped demo, its user's files in the test's folder.
class Program {
 public:
    explicit Program(const char* display, Screen screen = Screen::None)
        : folder_(tests::freshFolder()), process_(startOf(display, screen)) {}

    // Once data are shown, the session is saved for a crash.
    void untilItSavesItsSession() {
        ui::waitUntil("the session is saved", [&] { return saved() || hasEnded(); });
    }
    void untilItSays(const char* what) {
        ui::waitUntil(what, [&] { return said().find(what) != std::string::npos || hasEnded(); });
    }
    bool saved() const {
        const auto state = folder_ / "isochron";
        if (!std::filesystem::exists(state)) return false;
        for (const auto& file : std::filesystem::directory_iterator(state))
            if (file.path().extension() == ".json" &&
                tests::readBytes(file.path()).find("pool_fire_T.nc\"") != std::string::npos &&
                tests::readBytes(file.path()).find("\"layers\"") != std::string::npos)
                return true;
        return false;
    }
    void signal(int number) const { process_.signal(number); }
    int exitCode() { return process_.exitCode(); }
    std::string said() const { return process_.errors(); }

 private:
    ui::Process::Start startOf(const char* display, Screen screen) const {
        ui::Process::Start start{
            .program = PROGRAM,
            .arguments = {SOURCE_DIR "/datasets/pool_fire_T.nc", "--display", display},
            .folder = folder_,
            .environment = {{"XDG_STATE_HOME", folder_}, {"XDG_CONFIG_HOME", folder_}}};
        if (screen == Screen::None) start.environment["DISPLAY"] = std::nullopt;
        return start;
    }
    bool hasEnded() {
        if (process_.isRunning()) return false;
        throw std::runtime_error("the program has ended: " + said());
    }

    std::filesystem::path folder_;
    ui::Process process_;
};

TEST(HeadsetProgram, EndsInGoodOrderOnASignal) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program("headset");
    program.untilItSavesItsSession();
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_FALSE(program.saved()) << "nothing is left to be offered";
}

TEST(HeadsetProgram, AutoIsAHeadsetWhereOneAnswers) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program("auto");
    program.untilItSavesItsSession();
    program.signal(SIGINT);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
}

TEST(HeadsetProgram, LostWithoutADisplayItSaysSoAndLeavesItsSession) {
    tests::MonadoService service(tests::Monado::Null);
    Program program("headset");
    program.untilItSavesItsSession();
    service.kill();
    EXPECT_EQ(program.exitCode(), 1);
    EXPECT_THAT(program.said(), testing::HasSubstr("no display"));
    EXPECT_THAT(program.said(), testing::HasSubstr("Monado"));
    EXPECT_TRUE(program.saved());
}

TEST(HeadsetProgram, LostWithADisplayItGoesOnInAWindow) {
    tests::MonadoService service(tests::Monado::Window);
    Program program("auto", Screen::OfTheService);
    program.untilItSavesItsSession();
    service.kill();
    program.untilItSays("in a window, because");
    EXPECT_TRUE(program.saved());
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_FALSE(program.saved());
}

TEST(HeadsetProgram, WithoutAServiceItSaysWhy) {
    tests::MonadoService service(tests::Monado::Null);
    service.kill();
    Program program("headset");
    EXPECT_EQ(program.exitCode(), 1);
    EXPECT_THAT(program.said(), testing::HasSubstr("service"));
}

}  // namespace

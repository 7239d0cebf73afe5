// `isochron FILE --display headset` as a user starts it.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/support/files.h"
#include "tests/support/monado_service.h"

namespace {

using namespace std::chrono_literals;

enum class Screen { None, OfTheService };

// The program on the shipped demo, its user's files in the test's folder.
class Program {
 public:
    explicit Program(const char* display, Screen screen = Screen::None)
        : folder_(tests::freshFolder()) {
        pid_ = fork();
        if (pid_ != 0) return;
        if (screen == Screen::None) unsetenv("DISPLAY");
        setenv("XDG_STATE_HOME", folder_.c_str(), 1);
        setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
        const int said = open((folder_ / "said").c_str(), O_WRONLY | O_CREAT, 0600);
        dup2(said, STDERR_FILENO);
        execl(PROGRAM, PROGRAM, SOURCE_DIR "/datasets/pool_fire_T.nc", "--display", display,
              nullptr);
        _exit(127);
    }
    ~Program() {
        if (pid_ == 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    // Once data are shown, the session is saved for a crash.
    bool savesItsSession() const {
        return comes([&] { return saved(); });
    }
    bool says(const char* what) const {
        return comes([&] { return said().find(what) != std::string::npos; });
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
    void signal(int number) const { kill(pid_, number); }
    int exitCode() {
        int status = 0;
        waitpid(std::exchange(pid_, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    std::string said() const { return tests::readBytes(folder_ / "said"); }

 private:
    template <typename Holds>
    static bool comes(const Holds& holds) {
        for (const auto end = std::chrono::steady_clock::now() + 30s;
             std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(20ms))
            if (holds()) return true;
        return false;
    }

    std::filesystem::path folder_;
    pid_t pid_ = 0;
};

TEST(HeadsetProgram, EndsInGoodOrderOnASignal) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program("headset");
    ASSERT_TRUE(program.savesItsSession()) << program.said();
    program.signal(SIGTERM);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
    EXPECT_FALSE(program.saved()) << "nothing is left to be offered";
}

TEST(HeadsetProgram, AutoIsAHeadsetWhereOneAnswers) {
    const tests::MonadoService service(tests::Monado::Null);
    Program program("auto");
    ASSERT_TRUE(program.savesItsSession()) << program.said();
    program.signal(SIGINT);
    EXPECT_EQ(program.exitCode(), 0) << program.said();
}

TEST(HeadsetProgram, LostWithoutADisplayItSaysSoAndLeavesItsSession) {
    tests::MonadoService service(tests::Monado::Null);
    Program program("headset");
    ASSERT_TRUE(program.savesItsSession()) << program.said();
    service.kill();
    EXPECT_EQ(program.exitCode(), 1);
    EXPECT_THAT(program.said(), testing::HasSubstr("no display"));
    EXPECT_THAT(program.said(), testing::HasSubstr("Monado"));
    EXPECT_TRUE(program.saved());
}

TEST(HeadsetProgram, LostWithADisplayItGoesOnInAWindow) {
    tests::MonadoService service(tests::Monado::Window);
    Program program("auto", Screen::OfTheService);
    ASSERT_TRUE(program.savesItsSession()) << program.said();
    service.kill();
    ASSERT_TRUE(program.says("in a window, because")) << program.said();
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

#include "app/choices/autosave.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "app/choices/session.h"
#include "tests/support/files.h"

namespace app {
namespace {

using namespace std::chrono_literals;

Explorer exampleAt(const std::filesystem::path& folder, double azimuth) {
    Explorer e;
    e.files = {folder / "run_1.nc"};
    e.view.azimuthDegrees = azimuth;
    return e;
}

// What another process does with an Autosave, until it ends with 0.
template <typename Act>
void inAnotherProcess(const Act& act) {
    const pid_t child = fork();
    if (child == 0) {
        act();
        _exit(0);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
}

TEST(Autosave, IsASessionWrittenAtMostEverySoOften) {
    const auto folder = tests::freshFolder() / "made" / "here";
    Autosave autosave(folder);
    const Autosave::Clock::time_point start{};
    EXPECT_EQ(autosave.save(Explorer{}, start), std::nullopt);  // nothing to lose
    EXPECT_FALSE(std::filesystem::exists(folder));
    const auto written = [&] { return readSession(autosave.file()).view.azimuthDegrees; };
    EXPECT_EQ(autosave.save(exampleAt(folder, 1), start), std::nullopt);
    EXPECT_EQ(readSession(autosave.file()), exampleAt(folder, 1));
    autosave.save(exampleAt(folder, 2), start + Autosave::kPause - 1ns);
    EXPECT_EQ(written(), 1);
    autosave.save(exampleAt(folder, 3), start + Autosave::kPause);
    EXPECT_EQ(written(), 3);
    // What has not changed is not written again.
    std::filesystem::remove(autosave.file());
    autosave.save(exampleAt(folder, 3), start + 10 * Autosave::kPause);
    EXPECT_FALSE(std::filesystem::exists(autosave.file()));
}

TEST(Autosave, TellsHowLongAChangeWaitsToBeWritten) {
    const auto folder = tests::freshFolder();
    Autosave autosave(folder);
    const Autosave::Clock::time_point start{};
    EXPECT_EQ(autosave.untilSaved(Explorer{}, start), std::nullopt);
    EXPECT_EQ(autosave.untilSaved(exampleAt(folder, 1), start), 0ns);
    autosave.save(exampleAt(folder, 1), start);
    EXPECT_EQ(autosave.untilSaved(exampleAt(folder, 1), start + 1s), std::nullopt);
    EXPECT_EQ(autosave.untilSaved(exampleAt(folder, 2), start + 1s), Autosave::kPause - 1s);
    EXPECT_EQ(autosave.untilSaved(exampleAt(folder, 2), start + 2 * Autosave::kPause), 0ns);
}

TEST(Autosave, IsOfferedOnceItsProcessIsGone) {
    const auto folder = tests::freshFolder();
    Autosave own(folder);
    own.save(exampleAt(folder, 1), {});
    EXPECT_TRUE(leftSessions(folder).empty());  // this process is there
    inAnotherProcess([&] { Autosave(folder).save(exampleAt(folder, 2), {}); });
    inAnotherProcess([&] {
        Autosave autosave(folder);
        autosave.save(exampleAt(folder, 3), {});
        autosave.discard();
    });
    const auto left = leftSessions(folder);
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].explorer, exampleAt(folder, 2));
}

// A name in Latin-1.
TEST(Autosave, IsOfferedWhateverBytesItsFilesNamesHave) {
    const auto folder = tests::freshFolder();
    Explorer e;
    e.files = {folder / "n\xe9.nc"};
    inAnotherProcess([&] { Autosave(folder).save(e, {}); });
    const auto left = leftSessions(folder);
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].explorer, e);
}

TEST(Autosave, AnotherProcessOfTheSameNumberIsNotMistakenForIt) {
    const auto folder = tests::freshFolder();
    Autosave own(folder);
    own.save(exampleAt(folder, 1), {});
    // As a process of this number that was started at another time has left it.
    const auto left = folder / fmt::format("autosave-{}-1.json", getpid());
    std::filesystem::copy(own.file(), left);
    ASSERT_EQ(leftSessions(folder).size(), 1u);
    EXPECT_EQ(leftSessions(folder)[0].file, left);
}

TEST(Autosave, NewestAreOfferedFirstAndWhatIsNoSessionNotAtAll) {
    const auto folder = tests::freshFolder();
    for (double azimuth : {1.0, 2.0, 3.0})
        inAnotherProcess([&] { Autosave(folder).save(exampleAt(folder, azimuth), {}); });
    const auto now = std::filesystem::file_time_type::clock::now();
    for (const LeftSession& each : leftSessions(folder))
        std::filesystem::last_write_time(
            each.file,
            now + std::chrono::seconds(static_cast<int>(each.explorer.view.azimuthDegrees)));
    tests::writeBytes(folder / "autosave-1-1.json", "{");
    tests::writeBytes(folder / "autosave-x.json", "{}");
    tests::writeBytes(folder / "notes.txt", "mine");
    std::vector<double> azimuths;
    for (const LeftSession& each : leftSessions(folder))
        azimuths.push_back(each.explorer.view.azimuthDegrees);
    EXPECT_THAT(azimuths, testing::ElementsAre(3, 2, 1));
    EXPECT_TRUE(leftSessions(folder / "gone").empty());
}

TEST(Autosave, ADiskThatCannotBeWrittenIsToldOnce) {
    const auto folder = tests::freshFolder();
    tests::writeBytes(folder / "file", "");
    Autosave autosave(folder / "file");  // no folder
    const auto told = autosave.save(exampleAt(folder, 1), {});
    ASSERT_TRUE(told);
    EXPECT_THAT(*told, testing::HasSubstr("autosave-"));
    EXPECT_EQ(autosave.save(exampleAt(folder, 2), Autosave::Clock::time_point{} + 60s),
              std::nullopt);
}

}  // namespace
}  // namespace app

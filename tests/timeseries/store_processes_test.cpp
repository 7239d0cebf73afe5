// A store that several processes use at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/rounds.h"
#include "tests/support/step_stores.h"

namespace timeseries {
namespace {

using namespace step_stores;
using step_stores::StepStores;
using testing::IsEmpty;

// Copies of this process that do something again and again, until this one ends them, or ends.
class OtherProcesses {
 public:
    OtherProcesses() {
        if (::pipe(untilClosed_.data()) != 0 || ::pipe(begun_.data()) != 0)
            throw std::runtime_error("no pipe");
    }
    OtherProcesses(const OtherProcesses&) = delete;
    OtherProcesses& operator=(const OtherProcesses&) = delete;
    ~OtherProcesses() {
        (void)end();
        for (const int end : {untilClosed_[0], begun_[0], begun_[1]}) ::close(end);
    }

    void start(const std::function<void()>& again) {
        const pid_t child = ::fork();
        if (child < 0) throw std::runtime_error("no process");
        if (child > 0) return children_.push_back(child);
        ::close(untilClosed_[1]);
        pollfd closed{untilClosed_[0], POLLIN, 0};
        try {
            again();
            if (::write(begun_[1], "", 1) != 1) ::_exit(1);
            do again();
            while (::poll(&closed, 1, 0) == 0);
        } catch (...) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    // Until each has done it once.
    void waitForAll() const {
        constexpr int kPatience = 60'000;  // ms
        pollfd begun{begun_[0], POLLIN, 0};
        char byte;
        for (std::size_t i = 0; i < children_.size(); ++i)
            if (::poll(&begun, 1, kPatience) != 1 || ::read(begun_[0], &byte, 1) != 1)
                throw std::runtime_error("one has not begun");
    }
    // Whether none of them failed.
    bool end() {
        if (untilClosed_[1] >= 0) ::close(std::exchange(untilClosed_[1], -1));
        bool allDid = true;
        for (const pid_t child : std::exchange(children_, {})) {
            int status = -1;
            ::waitpid(child, &status, 0);
            allDid = allDid && status == 0;
        }
        return allDid;
    }

 private:
    std::array<int, 2> untilClosed_{}, begun_{};
    std::vector<pid_t> children_;
};

// One writes it from its list over what is there, the other takes all away and writes it from its
// field.
TEST_F(StepStores, OfProcessesThatWriteOneStepAllHaveItWholeOrNotAtAll) {
    ASSERT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    const StepOrigin of = origin();
    const fs::path path = store->pathOf(of);
    const std::string whole = tests::readBytes(path);
    const auto stamp = store->stampOf(of);
    ASSERT_TRUE(stamp);
    const Field field = openReader(std::span(&file, 1))->read(0, 0);
    const SortedStep step = SortedStep::build(field);
    const auto opened = std::chrono::system_clock::now();
    const auto expectAll = [](StepStore::Wrote wrote) {
        if (wrote != StepStore::Wrote::All) throw std::runtime_error("not written");
    };
    OtherProcesses writers;
    writers.start([&] { expectAll(store->write(of, *stamp, step, opened)); });
    writers.start([&] {
        store->clear();
        expectAll(store->write(of, *stamp, opened,
                               [&](WholeFile& to) { return writeField(field, stamp->text, to); }));
    });
    writers.waitForAll();
    int stored = 0;
    for (int look = 0; look < tests::rounds(100); ++look) {
        const std::string bytes = tests::readBytes(path);
        ASSERT_TRUE(bytes.empty() || bytes == whole) << bytes.size() << " of " << whole.size();
        const auto shown = maker()->make(0);
        expectField(*shown, 100);
        stored += shown->file() ? 1 : 0;
    }
    EXPECT_GT(stored, 0);
    EXPECT_TRUE(writers.end());
    EXPECT_THAT(store->takeNotes(), IsEmpty());
    EXPECT_TRUE(tests::readBytes(path) == whole);
    EXPECT_EQ(files(), 1u);  // none that is unfinished
    EXPECT_TRUE(store->find(of));
}

}  // namespace
}  // namespace timeseries

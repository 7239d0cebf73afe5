#include "timeseries/series/step_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/step_stores.h"

namespace timeseries {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::shared_ptr<const Grid> onePoint() {
    const Axis one{.name = "x", .units = "m", .coordinates = {0.0}};
    return std::make_shared<const Grid>(std::array{one, one, one});
}

// What a test and its reader share: it lives longer than the loader.
struct Script {
    std::atomic<int> reads = 0;
    std::atomic<bool> destroyed = false;
    std::vector<std::size_t> order;  // the loader's thread writes it; read it when idle
    bool gated = false;              // each read announces itself and waits to be let go
    std::counting_semaphore<> begun{0}, go{0};
    std::function<void(std::size_t)> onRead = [](std::size_t) {};
};

// Step s holds one point, of value s.
class ScriptedReader : public Reader {
 public:
    ScriptedReader(Script& script, std::size_t steps) : script_(script) {
        auto time = std::make_shared<TimeAxis>();
        time->points.resize(steps);
        variables_.push_back({.name = "v",
                              .longName = "",
                              .units = "",
                              .type = ValueType::F64,
                              .storedAs = "",
                              .missing = "",
                              .grid = onePoint(),
                              .time = time,
                              .notes = {}});
    }
    ~ScriptedReader() override { script_.destroyed = true; }
    std::string format() const override { return "scripted"; }
    std::span<const std::filesystem::path> files() const override { return {}; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t, std::size_t step) override {
        script_.order.push_back(step);
        ++script_.reads;
        if (script_.gated) {
            script_.begun.release();
            script_.go.acquire();
        }
        script_.onRead(step);
        return {.grid = variables_[0].grid,
                .values = std::vector<double>{static_cast<double>(step)},
                .missing = {}};
    }

 private:
    Script& script_;
    std::vector<Variable> variables_;
};

StepLoader loaderOf(Script& script, std::size_t steps = 100) {
    return StepLoader(std::make_unique<ScriptedReader>(script, steps), 0, RangeSet::everything());
}

std::size_t stepOf(const LoadResult& result) {
    return std::visit([](const auto& r) { return r.step; }, result);
}

// All results until nothing is left to come.
std::vector<std::size_t> drain(StepLoader& loader) {
    std::vector<std::size_t> steps;
    while (const auto result = loader.waitAndPoll()) steps.push_back(stepOf(*result));
    return steps;
}

TEST(StepLoader, DeliversTheMostUrgentFirst) {
    Script script;
    StepLoader loader = loaderOf(script);
    loader.want({5, 2, 9, 0});
    EXPECT_THAT(drain(loader), ElementsAre(5, 2, 9, 0));
}

TEST(StepLoader, DeliversTheStepSortedAndCutToWhatIsKept) {
    Script script;
    StepLoader loader(std::make_unique<ScriptedReader>(script, 10), 0, RangeSet::parse("4:9"));
    loader.want({3, 4});
    const auto three = std::get<Loaded>(*loader.waitAndPoll());
    EXPECT_EQ(three.step, 3u);
    EXPECT_EQ(three.sorted->size(), 0u);
    const auto four = std::get<Loaded>(*loader.waitAndPoll());
    ASSERT_EQ(four.sorted->size(), 1u);
    EXPECT_EQ(toDouble(four.sorted->value(0)), 4);
}

TEST(StepLoader, HoldsTheFieldWhereItIsAskedTo) {
    for (const Ready ready : {Ready::Asked, Ready::WithField, Ready::Whole}) {
        Script script;
        StepLoader loader(
            std::make_unique<ScriptedReader>(script, 10), 0, RangeSet::everything(), [] {}, ready);
        loader.want({4});
        const auto loaded = std::get<Loaded>(*loader.waitAndPoll());
        const std::uint64_t beside = loaded.sorted->bytes() - loaded.sorted->pointBytes();
        EXPECT_EQ(beside, ready == Ready::WithField ? loaded.sorted->field().bytes() : 0);
    }
}

// What is kept is told of, and nothing else; what is asked for is a matter of room.
TEST(StepLoader, PutsInOrderWhatIsAskedForAndKept) {
    const RangeSet everything = RangeSet::everything(), upTo4 = RangeSet::parse("min:4");
    const auto points = [&](const RangeSet& kept, const RangeSet& asked, std::size_t step) {
        Script script;
        StepLoader loader(
            std::make_unique<ScriptedReader>(script, 10), 0, kept, [] {}, Ready::WithField, {},
            asked);
        loader.want({step});
        return std::get<Loaded>(*loader.waitAndPoll()).sorted->size();
    };
    EXPECT_EQ(points(everything, upTo4, 4), 1u);
    EXPECT_EQ(points(everything, upTo4, 5), 0u);
    EXPECT_EQ(points(upTo4, everything, 5), 0u);
    EXPECT_EQ(points(everything, everything, 5), 1u);
}

TEST(StepLoader, HasNothingWhenNothingIsWanted) {
    Script script;
    StepLoader loader = loaderOf(script);
    EXPECT_EQ(loader.poll(), std::nullopt);
    EXPECT_EQ(loader.waitAndPoll(), std::nullopt);  // at once: nothing could come
    EXPECT_EQ(script.reads, 0);
}

TEST(StepLoader, DropsWhatIsNoLongerWantedUnlessBegun) {
    Script script;
    script.gated = true;
    StepLoader loader = loaderOf(script);
    loader.want({1, 2, 3});
    script.begun.acquire();  // 1 is being read
    loader.want({7, 3});
    script.go.release(3);
    EXPECT_THAT(drain(loader), ElementsAre(1, 7, 3));
    EXPECT_THAT(script.order, ElementsAre(1, 7, 3));
}

TEST(StepLoader, DoesNotReadTwiceWhatIsUnderWay) {
    Script script;
    script.gated = true;
    StepLoader loader = loaderOf(script);
    loader.want({1, 1, 2, 1});
    script.begun.acquire();
    for (int frame = 0; frame < 10; ++frame) loader.want({1, 2});
    script.go.release();     // 1 is done, and not polled
    script.begun.acquire();  // 2 is being read
    for (int frame = 0; frame < 10; ++frame) loader.want({1, 2});
    script.go.release();
    EXPECT_THAT(drain(loader), ElementsAre(1, 2));
    EXPECT_EQ(script.reads, 2);
}

TEST(StepLoader, ReadsADeliveredStepAgainOnlyWhenWantedAgain) {
    Script script;
    StepLoader loader = loaderOf(script);
    loader.want({4});
    EXPECT_THAT(drain(loader), ElementsAre(4));
    EXPECT_THAT(drain(loader), ElementsAre());
    EXPECT_EQ(script.reads, 1);
    loader.want({4});
    EXPECT_THAT(drain(loader), ElementsAre(4));
    EXPECT_EQ(script.reads, 2);
}

TEST(StepLoader, FailuresBecomeWordsAndTheNextStepIsRead) {
    Script script;
    script.onRead = [](std::size_t step) {
        if (step == 0) throw FileError("a.nc: step 0 is cut off at byte 17");
        if (step == 1) throw std::bad_alloc();
        if (step == 2) throw std::logic_error("odd");
    };
    StepLoader loader = loaderOf(script);
    loader.want({0, 1, 2, 3});
    const auto why = [&](std::size_t step) {
        const auto result = loader.waitAndPoll();
        EXPECT_EQ(stepOf(*result), step);
        return std::get<Failed>(*result).why;
    };
    EXPECT_EQ(why(0), "a.nc: step 0 is cut off at byte 17");
    EXPECT_THAT(why(1), HasSubstr("memory"));
    EXPECT_EQ(why(2), "odd");
    EXPECT_TRUE(std::holds_alternative<Loaded>(*loader.waitAndPoll()));
}

TEST(StepLoader, RefusesAStepTheSeriesDoesNotHave) {
    Script script;
    StepLoader loader = loaderOf(script, 10);
    EXPECT_EQ(loader.stepCount(), 10u);
    EXPECT_THROW(loader.want({3, 10}), std::out_of_range);
    EXPECT_EQ(loader.waitAndPoll(), std::nullopt);
}

TEST(StepLoader, StaysFewResultsAhead) {
    Script script;
    script.gated = true;
    StepLoader loader = loaderOf(script);
    loader.want({0, 1, 2, 3, 4});
    script.go.release(5);
    script.begun.acquire();
    script.begun.acquire();
    // Two results wait: the third read does not begin before one is polled.
    EXPECT_FALSE(script.begun.try_acquire());
    EXPECT_EQ(stepOf(*loader.waitAndPoll()), 0u);
    script.begun.acquire();
    EXPECT_THAT(drain(loader), ElementsAre(1, 2, 3, 4));
}

TEST(StepLoader, PollDoesNotWaitForARunningRead) {
    Script script;
    script.gated = true;
    StepLoader loader = loaderOf(script);
    loader.want({0});
    script.begun.acquire();
    EXPECT_EQ(loader.poll(), std::nullopt);
    EXPECT_EQ(loader.waitAndPoll(0ns), std::nullopt);
    EXPECT_EQ(loader.waitAndPoll(1ms), std::nullopt);
    script.go.release();
    EXPECT_EQ(stepOf(*loader.waitAndPoll(1h)), 0u);
}

TEST(StepLoader, DestructionWaitsForTheRunningReadAndForNoWish) {
    Script script;
    script.gated = true;
    {
        StepLoader loader = loaderOf(script);
        std::vector<std::size_t> all(100);
        std::iota(all.begin(), all.end(), std::size_t{0});
        loader.want(all);
        script.begun.acquire();
        // Let go before or while the loader ends: a read or two more may begin, never all.
        script.go.release(100);
    }
    EXPECT_TRUE(script.destroyed);
    EXPECT_LE(script.reads, 2);  // as many as may wait to be polled
}

// Six steps of a file each, sorted by a loader that has a store.
class StepLoaderWrites : public step_stores::StepStores {
 protected:
    static constexpr std::size_t kSteps = 6, kAhead = 2;  // that wait to be polled
    StepLoaderWrites() {
        std::vector<fs::path> paths;
        for (std::size_t s = 0; s < kSteps; ++s)
            paths.push_back(step_stores::nrrdOf(folder / ("f_" + std::to_string(s) + ".nrrd"), 50));
        loader_.emplace(
            openReader(paths), 0, RangeSet::everything(), [this] { came_.release(); }, Ready::Asked,
            timeseries::StepStores{{store}, store, 1});
    }
    void wantAll(StepLoader::Haste haste) {
        loader_->want({0, 1, 2, 3, 4, 5}, haste);
        for (std::size_t i = 0; i < kAhead; ++i) came_.acquire();
    }
    enum class Each { Stays, Leaves };
    void takeAll(Each each) {
        std::size_t steps = 0;
        for (; auto result = loader_->waitAndPoll(); ++steps)
            if (each == Each::Stays) held_.push_back(std::get<Loaded>(*result).sorted);
        ASSERT_EQ(steps, kSteps);
    }
    void expectAllWritten() const {
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (store->list().size() < kSteps && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(1ms);
        EXPECT_EQ(store->list().size(), kSteps);
    }

    std::counting_semaphore<> came_{0};
    std::vector<std::shared_ptr<const SortedStep>> held_;
    std::optional<StepLoader> loader_;
};

// What somebody waits for comes first: the second result is there, and the first step unwritten.
TEST_F(StepLoaderWrites, OnceNothingIsAskedFor) {
    wantAll(StepLoader::Haste::Waited);
    EXPECT_EQ(store->list().size(), 0u);
    takeAll(Each::Stays);
    expectAllWritten();
}

TEST_F(StepLoaderWrites, AlsoThoseThatHaveLeftMemory) {
    const auto before = std::chrono::steady_clock::now();
    wantAll(StepLoader::Haste::Waited);
    takeAll(Each::Leaves);
    expectAllWritten();
    EXPECT_GE(std::chrono::steady_clock::now() - before, StepLoader::kCalm);
}

TEST_F(StepLoaderWrites, TheseNotBeforeASecondWithoutWishes) {
    wantAll(StepLoader::Haste::Waited);
    takeAll(Each::Leaves);
    auto last = std::chrono::steady_clock::now();
    for (int i = 0; i < 30; ++i) {
        std::this_thread::sleep_for(10ms);
        last = std::chrono::steady_clock::now();
        loader_->want({0}, StepLoader::Haste::Waited);
        EXPECT_TRUE(loader_->waitAndPoll());
    }
    expectAllWritten();
    EXPECT_GE(std::chrono::steady_clock::now() - last, StepLoader::kCalm);
}

TEST_F(StepLoaderWrites, AsTheyComeWhereNobodyWaits) {
    wantAll(StepLoader::Haste::Nobody);
    EXPECT_GE(store->list().size(), 1u) << "with four steps to come";
    takeAll(Each::Stays);
    expectAllWritten();
}

TEST(StepLoader, DestructionEndsWhileResultsWait) {
    Script script;
    script.gated = true;
    {
        StepLoader loader = loaderOf(script);
        loader.want({0, 1, 2, 3});
        script.go.release(4);
        script.begun.acquire();
        script.begun.acquire();
    }
    EXPECT_TRUE(script.destroyed);
    EXPECT_EQ(script.reads, 2);
}

TEST(StepLoader, DestructionWithoutWorkEnds) {
    Script script;
    { const StepLoader loader = loaderOf(script); }
    EXPECT_TRUE(script.destroyed);
}

TEST(StepLoader, ManyWishesUnderWayEndWithTheLastOnes) {
    // Wishes change while the loader reads: whatever came before, the last wishes are all
    // delivered.
    Script script;
    StepLoader loader = loaderOf(script);
    std::size_t delivered = 0;
    for (std::size_t frame = 0; frame < 2000; ++frame) {
        loader.want({frame % 100, (frame + 1) % 100, (frame + 2) % 100});
        while (loader.poll()) ++delivered;
    }
    loader.want({50, 60, 70});
    std::vector<std::size_t> steps = drain(loader);
    ASSERT_GE(steps.size(), 3u);
    EXPECT_THAT(steps, testing::IsSupersetOf({50u, 60u, 70u}));
    EXPECT_EQ(static_cast<std::size_t>(script.reads), delivered + steps.size());
}

}  // namespace
}  // namespace timeseries

#include "app/live_steps.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/scripted_reader.h"

namespace app {
namespace {

// On which threads steps were freed.
class Freed {
 public:
    void note() {
        const std::lock_guard lock(mutex_);
        threads_.push_back(std::this_thread::get_id());
    }
    std::vector<std::thread::id> threads() const {
        const std::lock_guard lock(mutex_);
        return threads_;
    }

 private:
    mutable std::mutex mutex_;
    std::vector<std::thread::id> threads_;
};

// Each step has a grid of its own, which goes with it.
class NotingReader : public tests::ScriptedReader {
 public:
    NotingReader(std::shared_ptr<tests::Script> script, std::shared_ptr<Freed> freed)
        : ScriptedReader({}, std::move(script)), freed_(std::move(freed)) {}
    timeseries::Field read(std::size_t variable, std::size_t step) override {
        timeseries::Field field = ScriptedReader::read(variable, step);
        field.grid = {field.grid.get(),
                      [freed = freed_, grid = field.grid](const auto*) { freed->note(); }};
        return field;
    }

 private:
    std::shared_ptr<Freed> freed_;
};

TEST(LiveSteps, WhatTheBudgetDropsIsFreedByAnotherThreadWhoeverLooksAtItLast) {
    const auto script = std::make_shared<tests::Script>();
    const auto freed = std::make_shared<Freed>();
    Dataset dataset = tests::scriptedDataset({}, script, "a", "");
    dataset.reader = std::make_unique<NotingReader>(script, freed);
    // A budget of one step.
    LiveSteps steps(dataset, timeseries::RangeSet::everything(), 1, [script] { script->wake(); });
    std::shared_ptr<const timeseries::SortedStep> shown;
    std::size_t came = 0;
    steps.want({3});
    while (came < 10) {
        for (const LiveSteps::Arrival& arrival : steps.poll()) {
            if (arrival.step == 3) shown = arrival.sorted;
            if (arrival.step == 3) steps.want({4});
            ++came;
        }
        if (came < 10) script->waitForWake();
    }
    // All were dropped but 4, which is wished, and 3, which is shown.
    while (freed->threads().size() < 8) steps.poll();
    EXPECT_EQ(shown->size(), 64u);
    shown.reset();
    while (freed->threads().size() < 9) steps.poll();
    for (const std::thread::id thread : freed->threads())
        EXPECT_NE(thread, std::this_thread::get_id());
}

}  // namespace
}  // namespace app

#include "app/exploration/live_steps.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <semaphore>
#include <thread>

#include "app/files/step_cache.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"
#include "tests/support/scripted_reader.h"
#include "tests/support/variable.h"
#include "timeseries/index/step_file.h"
#include "timeseries/readers/step_about.h"
#include "timeseries/series/whole_file.h"

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

// Ten steps and a budget of one. Once all have come, step 4 is in it and step 3, which it has
// dropped, is shown; the others are freed.
class LiveStepsDropping : public testing::Test {
 protected:
    void SetUp() override {
        steps_->want({3});
        for (std::size_t came = 0; came < 10;) {
            for (const LiveSteps::Arrival& arrival : steps_->poll()) {
                if (arrival.step == 3) shown_ = arrival.sorted;
                if (arrival.step == 3) steps_->want({4});
                ++came;
            }
            if (came < 10) script_->waitForWake();
        }
        while (freed_->threads().size() < 8) steps_->poll();
    }
    void expectFreedElsewhere() const {
        for (const std::thread::id thread : freed_->threads())
            EXPECT_NE(thread, std::this_thread::get_id());
    }
    OpenDataset dataset() const {
        OpenDataset dataset = tests::scriptedDataset({}, script_, "a", "");
        dataset.reader = std::make_unique<NotingReader>(script_, freed_);
        return dataset;
    }

    std::shared_ptr<tests::Script> script_ = std::make_shared<tests::Script>();
    std::shared_ptr<Freed> freed_ = std::make_shared<Freed>();
    OpenDataset dataset_ = dataset();
    std::optional<LiveSteps> steps_{std::in_place, dataset_, timeseries::RangeSet::everything(), 1,
                                    [script = script_] { script->wake(); }};
    std::shared_ptr<const timeseries::SortedStep> shown_;
};

// Of 300 sorted steps the one that is wished, then those that nobody has seen: as many as come
// before a frame asks for them. No more of their files stay open than may.
TEST(LiveSteps, ManyStepsOnDiskComeInAFrame) {
    constexpr std::size_t kSteps = 300, kAtOnce = timeseries::StepLoader::kMostAhead;
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < kSteps; ++i) {
        timeseries::StepAbout about;
        about.variable = "u";
        about.time = static_cast<double>(i);
        paths.push_back(tests::testFolder() / fmt::format("u_{:03}.isostep", i));
        timeseries::WholeFile file(paths.back());
        timeseries::writeStep(tests::noise(tests::cube(4)), textOf(about), file);
        file.finish();
    }
    OpenDataset dataset = openDataset(paths, "");
    std::counting_semaphore<> came{0};
    LiveSteps steps(dataset, timeseries::RangeSet::everything(), std::uint64_t{1} << 30,
                    [&] { came.release(); });
    const auto poll = [&](std::size_t many) {
        for (std::size_t i = 0; i < many; ++i)
            if (!came.try_acquire_for(std::chrono::seconds(20))) return i;
        return steps.poll().size();
    };
    steps.want({150});
    ASSERT_EQ(poll(1), 1u);
    for (std::size_t left = kSteps - 1, many; left > 0; left -= many) {
        many = std::min(left, kAtOnce);
        ASSERT_EQ(poll(many), many);
    }
    int open = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
        EXPECT_NE(steps.series().summary(i), nullptr) << i;
        open += steps.series().isStored(i);
    }
    EXPECT_EQ(open, timeseries::Series::kMostOpen);
    EXPECT_TRUE(steps.series().isStored(150));
}

// Of eight million points, as many as are worth keeping, or a few fewer.
void writeField(const std::filesystem::path& file, std::size_t edge) {
    std::string bytes(edge * edge * edge, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 101);
    tests::writeBytes(file, fmt::format("NRRD0004\ntype: uchar\ndimension: 3\nsizes: {0} {0} {0}\n"
                                        "encoding: raw\n\n",
                                        edge) +
                                bytes);
}

// Its first step, come.
class Opened {
 public:
    explicit Opened(const std::filesystem::path& file)
        : dataset_(openDataset(std::vector{file}, "")),
          steps(dataset_, timeseries::RangeSet::everything(), std::uint64_t{1} << 30,
                [this] { came_.release(); }) {
        steps.want({0});
        EXPECT_TRUE(came_.try_acquire_for(std::chrono::seconds(60)));
        EXPECT_EQ((arrivals_ = steps.poll()).size(), 1u);
    }

 private:
    OpenDataset dataset_;
    std::counting_semaphore<> came_{0};
    std::vector<LiveSteps::Arrival> arrivals_;  // shown as long as this lives

 public:
    LiveSteps steps;
};

TEST(LiveSteps, WhereNothingCanBeKeptThatIsToldOnce) {
    const tests::Variable cache("XDG_CACHE_HOME", std::nullopt), home("HOME", std::nullopt);
    const auto notesOf = [](std::size_t edge, const char* choice) {
        const std::filesystem::path file = tests::freshFolder() / "f.nrrd";
        writeField(file, edge);
        chooseStepCache(choice);
        Opened opened(file);
        const std::vector<std::string> notes = opened.steps.takeNotes();
        EXPECT_TRUE(opened.steps.takeNotes().empty());
        chooseStepCache("");
        return notes;
    };
    EXPECT_THAT(
        notesOf(200, ""),
        testing::ElementsAre(testing::HasSubstr("neither XDG_CACHE_HOME nor HOME names a folder")));
    EXPECT_THAT(notesOf(199, ""), testing::IsEmpty()) << "too small to be kept anywhere";
    EXPECT_THAT(notesOf(200, "off"), testing::IsEmpty());
}

// Whose file is settled.
TEST(LiveSteps, WhatAWindowSortedIsOpenedTheNextTime) {
    const std::filesystem::path folder = tests::freshFolder(), file = folder / "f.nrrd";
    writeField(file, 200);
    struct Cache {
        explicit Cache(const std::filesystem::path& in) { chooseStepCache(in.string()); }
        ~Cache() { chooseStepCache(""); }
    };
    const Cache cache(folder / "steps");
    std::this_thread::sleep_for(timeseries::StepStore::kSettled);
    const auto isStored = [&] {
        const Opened opened(file);
        // While it is shown, and nothing is asked for.
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (stepCache()->isEmpty() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return opened.steps.series().isStored(0);
    };
    EXPECT_FALSE(isStored());
    EXPECT_TRUE(isStored());
}

TEST_F(LiveStepsDropping, FreesByAnotherThreadWhoeverLooksAtItLast) {
    EXPECT_EQ(shown_->size(), 64u);
    shown_.reset();
    while (freed_->threads().size() < 9) steps_->poll();
    expectFreedElsewhere();
}

TEST_F(LiveStepsDropping, EndsWithoutFreeingAnythingItself) {
    shown_.reset();
    steps_.reset();
    while (freed_->threads().size() < 10) std::this_thread::yield();
    expectFreedElsewhere();
}

}  // namespace
}  // namespace app

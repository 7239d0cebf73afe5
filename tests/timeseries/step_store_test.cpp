#include "timeseries/series/step_store.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "tests/support/step_stores.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {
namespace {

using namespace step_stores;
using step_stores::StepStores;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(StepStores, AStepIsSortedOnceAndThenOpened) {
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Before);
    const auto step = maker()->make(0);
    ASSERT_TRUE(step->file());
    expectField(*step, 100);
    const std::string about = StepStore::aboutOf(store->list().at(0).path);
    EXPECT_THAT(about, HasSubstr("field.nrrd"));
    EXPECT_THAT(about, HasSubstr("\"readers\": \""));  // another program may read it otherwise
    EXPECT_EQ(files(), 1u);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

TEST_F(StepStores, ASourceThatChangedIsSortedAnew) {
    (void)maker()->keep(0);
    nrrdOf(file, 50);
    const auto step = maker()->make(0);
    EXPECT_FALSE(step->file());
    expectField(*step, 50);
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("field.nrrd: it has changed since")));
    EXPECT_FALSE(maker()->make(0)->file());
    EXPECT_THAT(store->takeNotes(), IsEmpty()) << "once";
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    expectField(*maker()->make(0), 50);
    EXPECT_EQ(files(), 1u);
}

// Who opened it before has points of before, and is to open it again: nothing is sorted.
TEST_F(StepStores, ASourceThatChangedWhileItIsOpenIsNotSaidToBeSortedAnew) {
    const auto opened = maker();
    ASSERT_EQ(opened->keep(0), StepMaker::Kept::Written);
    nrrdOf(file, 50);
    const auto isTold = testing::ThrowsMessage<FileError>(HasSubstr(kHasChanged));
    EXPECT_THAT([&] { (void)opened->make(0); }, isTold);
    EXPECT_THAT([&] { (void)opened->keep(0); }, isTold);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

// Another program may read a file otherwise: it has not changed.
TEST_F(StepStores, AStepOfAnotherProgramIsNotOfAChangedSource) {
    std::string about = store->stampOf(origin())->text;
    const auto readers = about.find("\"readers\": \"") + 12;
    ASSERT_LT(readers, about.size());
    about[readers] = about[readers] == '0' ? '1' : '0';
    fs::create_directories(store->folder());
    WholeFile other(store->pathOf(origin()));
    writeStep(*maker()->make(0), about, other);
    other.finish();
    EXPECT_FALSE(store->find(origin()));
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

TEST_F(StepStores, ASourceReplacedAtEqualSizeAndTimeIsSortedAnew) {
    (void)maker()->keep(0);
    const auto time = fs::last_write_time(file);
    const fs::path other = nrrdOf(folder / "other.nrrd", 50);
    fs::rename(other, file);
    fs::last_write_time(file, time);
    EXPECT_FALSE(maker()->make(0)->file());
    // Edited in place, its time set back.
    (void)maker()->keep(0);
    nrrdOf(file, 70);
    fs::last_write_time(file, time);
    const auto step = maker()->make(0);
    EXPECT_FALSE(step->file());
    expectField(*step, 70);
}

// As by a copy that was interrupted.
TEST_F(StepStores, ASourceThatWasCutShortIsNotTakenForWhole) {
    const StepOrigin of = origin();
    const auto opened = maker();
    ASSERT_EQ(opened->keep(0), StepMaker::Kept::Written);
    ASSERT_TRUE(store->find(of));
    fs::resize_file(file, fs::file_size(file) - 400);
    EXPECT_FALSE(store->find(of));
    const auto isTold = testing::ThrowsMessage<FileError>(HasSubstr("field.nrrd: "));
    EXPECT_THAT([&] { (void)opened->make(0); }, isTold);
    EXPECT_THAT([&] { (void)maker()->make(0); }, isTold);
}

TEST_F(StepStores, ASourceThatIsGoneIsNotFound) {
    (void)maker()->keep(0);
    const StepOrigin gone = origin();
    EXPECT_TRUE(store->find(gone));
    fs::remove(file);
    EXPECT_FALSE(store->find(gone));
}

TEST_F(StepStores, AnotherVariableOrStepIsAnotherFile) {
    (void)maker()->keep(0);
    StepOrigin other = origin();
    other.step = 1;
    EXPECT_FALSE(store->find(other));
    other = origin();
    other.variable = "fiel";
    EXPECT_FALSE(store->find(other));
    // Names that are joined are told apart.
    EXPECT_NE(store->pathOf({{"/a/b", "/c"}, 0, "v", ""}),
              store->pathOf({{"/a", "/b/c"}, 0, "v", ""}));
    EXPECT_NE(store->pathOf({{"/a"}, 2, "v", "1"}), store->pathOf({{"/a"}, 2, "v1", ""}));
}

// Which step of a series a file's is depends on the files beside it; what is kept does not.
TEST_F(StepStores, AStepIsOfItsFileWhateverSeriesItIsOpenedIn) {
    const auto series = [&](std::vector<fs::path> paths) {
        return std::make_unique<StepMaker>(openReader(paths), 0, RangeSet::everything(),
                                           timeseries::StepStores{{store}, store, 1});
    };
    // Two steps a file, of one value each.
    const auto twoSteps = [&](const char* name, float value) {
        std::vector<float> values(8, value);
        values.resize(16, value + 1);
        std::string bytes(values.size() * sizeof(float), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        tests::writeBytes(folder / name,
                          "NRRD0004\ntype: float\ndimension: 4\nsizes: 2 2 2 2\nkinds: space space "
                          "space time\nendian: little\nencoding: raw\n\n" +
                              bytes);
        return folder / name;
    };
    const fs::path a = twoSteps("a.nrrd", 10), b = twoSteps("b.nrrd", 20),
                   c = twoSteps("c.nrrd", 30);
    const auto valueOf = [](const SortedStep& step) { return toDouble(step.value(0)); };
    for (std::size_t step = 0; step < 6; ++step)
        EXPECT_EQ(series({a, b, c})->keep(step), StepMaker::Kept::Written);
    for (const auto& paths : std::vector<std::vector<fs::path>>{{a, c}, {b, c}, {c, b}, {c}, {b}})
        for (std::size_t step = 0; step < 2 * paths.size(); ++step) {
            const float first = paths[step / 2] == a ? 10 : paths[step / 2] == b ? 20 : 30;
            const auto made = series(paths)->make(step);
            EXPECT_EQ(valueOf(*made), first + static_cast<float>(step % 2));
            // And what is made anew from the source is the same step.
            EXPECT_EQ(std::get<std::vector<float>>(made->field().values)[0], valueOf(*made));
        }
    EXPECT_EQ(series({a, b, c})->keep(4), StepMaker::Kept::Before);
}

// Each with its own names of a series of thousands of files took longer than it takes to sort it.
TEST_F(StepStores, AStepThatIsOpenedHoldsNoNamesOfItsSeries) {
    constexpr std::size_t kFiles = 500, kSteps = 20;
    std::vector<fs::path> paths;
    for (std::size_t f = 0; f < kFiles; ++f) {
        paths.push_back(folder / fmt::format("tiny_{:04}.nrrd", f));
        tests::writeBytes(paths.back(),
                          "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" +
                              std::string(8, static_cast<char>('a' + f % 20)));
    }
    StepMaker series(openReader(paths), 0, RangeSet::everything(),
                     timeseries::StepStores{{store}, store, 1});
    for (std::size_t i = 0; i < kSteps; ++i) ASSERT_EQ(series.keep(i), StepMaker::Kept::Written);
    std::vector<std::shared_ptr<const SortedStep>> opened{series.make(0)};
    const std::size_t before = ::mallinfo2().uordblks;
    for (std::size_t i = 1; i < kSteps; ++i) opened.push_back(series.make(i));
    const std::size_t each = (::mallinfo2().uordblks - before) / (kSteps - 1);
    std::size_t names = 0;
    for (const fs::path& path : paths) names += path.native().size();
    for (const auto& step : opened) EXPECT_TRUE(step->file());
    EXPECT_LT(each, names);  // its quantiles, above all
}

// What changed a moment before it was opened may change again within the same tick of the clock.
TEST_F(StepStores, WhatHasJustChangedIsNotKept) {
    const auto careful = std::make_shared<StepStore>(folder / "steps", StoreKind::Cache);
    EXPECT_EQ(maker(careful)->keep(0), StepMaker::Kept::Changed);
    EXPECT_EQ(files(), 0u);
    // A clock that was set back: the file is of the future.
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Changed);
}

TEST_F(StepStores, WhatChangesBetweenReadingAndWritingIsNotKept) {
    agedBy(std::chrono::hours(1));
    const auto one = maker();
    const auto step = one->make(0);
    ASSERT_TRUE(one->hasUnwritten());
    nrrdOf(file, 50);
    one->writeOne(StepMaker::Again::Read, [](double) { return true; });
    EXPECT_EQ(files(), 0u);
    EXPECT_FALSE(one->hasUnwritten());
}

// Once, and none is written whole for nothing again.
TEST_F(StepStores, AStepThatIsLargerThanAllRoomIsTold) {
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, 1000, kAtOnce);
    const auto one = maker(small);
    const auto step = one->make(0);
    ASSERT_TRUE(one->hasUnwritten());
    EXPECT_FALSE(one->writeOne(StepMaker::Again::Read, [](double) { return true; }));
    EXPECT_EQ(files(), 0u);
    EXPECT_THAT(small->takeNotes(), testing::ElementsAre(testing::HasSubstr(
                                        "steps may take less than one of these steps does")));
    const auto again = one->make(0);
    EXPECT_FALSE(one->hasUnwritten());
}

TEST_F(StepStores, WhatIsStoppedIsWrittenLater) {
    const auto one = maker();
    const auto step = one->make(0);
    int asked = 0;
    one->writeOne(StepMaker::Again::Read, [&](double) { return ++asked == 1; });
    EXPECT_EQ(files(), 0u);
    EXPECT_TRUE(one->hasUnwritten());
    one->writeOne(StepMaker::Again::Read, [](double) { return true; });
    EXPECT_EQ(files(), 1u);
    EXPECT_FALSE(one->hasUnwritten());
}

// A step that memory has no room for, and that was sorted once more, is written once.
TEST_F(StepStores, WhatNobodyHoldsAnyMoreIsReadAgainAndWritten) {
    const auto one = maker();
    for (int i = 0; i < 2; ++i) (void)one->make(0);
    ASSERT_TRUE(one->hasUnwritten());
    EXPECT_TRUE(one->writeOne(StepMaker::Again::Read, [](double) { return true; }));
    EXPECT_FALSE(one->hasUnwritten());
    const auto step = maker()->make(0);
    EXPECT_TRUE(step->file());
    expectField(*step, 100);
}

TEST_F(StepStores, WhatNobodyHoldsAnyMoreIsLeftWhereItMayNotBeReadAgain) {
    const auto one = maker();
    auto step = one->make(0);
    EXPECT_TRUE(one->canWrite(StepMaker::Again::Leave));
    step.reset();
    EXPECT_FALSE(one->canWrite(StepMaker::Again::Leave));
    EXPECT_TRUE(one->writeOne(StepMaker::Again::Leave, [](double) { return true; }));
    EXPECT_TRUE(one->hasUnwritten());
    EXPECT_EQ(files(), 0u);
}

TEST_F(StepStores, WhatIsReadAgainIsNotSortedWhereSomebodyWaits) {
    const auto one = maker();
    (void)one->make(0);
    int asked = 0;
    EXPECT_TRUE(one->writeOne(StepMaker::Again::Read, [&](double) {
        EXPECT_FALSE(fs::exists(folder / "steps")) << "a file is begun";
        return ++asked == 1;
    }));
    EXPECT_EQ(asked, 2);
    EXPECT_TRUE(one->hasUnwritten());
    EXPECT_EQ(files(), 0u);
}

// A file's, of which each step is read once.
class ReadOnce : public Reader {
 public:
    enum class Sources { Known, Unknown };
    explicit ReadOnce(const fs::path& file, Sources sources = Sources::Known)
        : reader_(openReader(std::span(&file, 1))), sources_(sources) {
        openedAt = reader_->openedAt;
    }
    std::string format() const override { return reader_->format(); }
    std::span<const fs::path> files() const override { return reader_->files(); }
    std::span<const Variable> variables() const override { return reader_->variables(); }
    Field read(std::size_t variable, std::size_t step) override {
        if (wasRead_) throw std::system_error(EAGAIN, std::generic_category());
        wasRead_ = true;
        return reader_->read(variable, step);
    }
    StepSources sources(std::size_t variable, std::size_t step) override {
        return sources_ == Sources::Known ? reader_->sources(variable, step) : StepSources{};
    }
    StepGrids stepGrids(std::size_t) override { throw FileError("another step's"); }

 private:
    const std::unique_ptr<Reader> reader_;
    const Sources sources_;
    bool wasRead_ = false;
};

TEST_F(StepStores, WhatCannotBeReadAgainForWhateverReasonStaysAsItIs) {
    StepMaker one(std::make_unique<ReadOnce>(file), 0, RangeSet::everything(),
                  timeseries::StepStores{{store}, store, 1});
    (void)one.make(0);
    ASSERT_TRUE(one.hasUnwritten());
    EXPECT_TRUE(one.writeOne(StepMaker::Again::Read, [](double) { return true; }));
    EXPECT_FALSE(one.hasUnwritten());
    EXPECT_EQ(files(), 0u);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

TEST_F(StepStores, WhatIsLetGoOnceItIsToBeWrittenIsNotReadAgain) {
    StepMaker one(std::make_unique<ReadOnce>(file), 0, RangeSet::everything(),
                  timeseries::StepStores{{store}, store, 1});
    auto step = one.make(0);
    EXPECT_TRUE(one.writeOne(StepMaker::Again::Leave, [&](double) {
        step.reset();
        return true;
    }));
    EXPECT_EQ(files(), 1u);
}

TEST_F(StepStores, AStepWithoutOriginDoesNotFailForAnother) {
    StepMaker one(std::make_unique<ReadOnce>(file, ReadOnce::Sources::Unknown), 0,
                  RangeSet::everything(), timeseries::StepStores{{store}, store, 1});
    EXPECT_EQ(one.keep(0), StepMaker::Kept::Unknown);
    EXPECT_THROW((void)one.keepNoMore(0), FileError)
        << "that it has no origin is all that is known";
}

TEST_F(StepStores, AChangedStepIsSaidToBeSortedAnewWhereItIs) {
    agedBy(std::chrono::hours(2));
    ASSERT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    std::string bytes = tests::readBytes(file);
    std::fill(bytes.end() - 24 * 24 * 24 * sizeof(float), bytes.end(), '\xff');  // NaN
    tests::writeBytes(file, bytes);
    agedBy(std::chrono::hours(1));
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Empty);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
    nrrdOf(file, 50);
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    EXPECT_THAT(store->takeNotes(), testing::ElementsAre(testing::HasSubstr("sorted anew")));
}

// Of a simulation that was run again.
TEST_F(StepStores, WhatNobodyHoldsAnyMoreIsWrittenOverWhatItReplaces) {
    agedBy(std::chrono::hours(1));
    ASSERT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    const std::uint64_t bytes = store->list().at(0).bytes;
    nrrdOf(file, 50);
    // Its list in memory takes 8 bytes a point: more than is free, without what leaves for it.
    const auto small = std::make_shared<StepStore>(
        folder / "steps", StoreKind::Cache, std::uint64_t{24} * 24 * 24 * 8 + bytes / 2, kAtOnce);
    const auto one = maker(small);
    (void)one->make(0);
    ASSERT_TRUE(one->hasUnwritten());
    EXPECT_TRUE(one->writeOne(StepMaker::Again::Read, [](double) { return true; }));
    EXPECT_TRUE(maker(small)->make(0)->file());
    EXPECT_EQ(files(), 1u);
}

TEST_F(StepStores, WhatSomebodyHoldsIsWrittenFirst) {
    const std::vector<fs::path> both{nrrdOf(folder / "f1.nrrd", 50), nrrdOf(folder / "f2.nrrd", 9)};
    StepMaker series(openReader(both), 0, RangeSet::everything(),
                     timeseries::StepStores{{store}, store, 1});
    (void)series.make(0);
    const auto held = series.make(1);
    series.writeOne(StepMaker::Again::Read, [](double) { return true; });
    EXPECT_TRUE(series.hasUnwritten());
    EXPECT_TRUE(series.make(1)->file());
    fs::remove(both[0]);
    EXPECT_TRUE(series.writeOne(StepMaker::Again::Read, [](double) { return true; }))
        << "told where it is looked at";
    EXPECT_FALSE(series.hasUnwritten());
    EXPECT_EQ(files(), 1u);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

// A series that is larger than the cache may be would push itself out for ever.
TEST_F(StepStores, WhatNobodyHoldsAnyMoreTakesNoRoomOfOthers) {
    const fs::path other = nrrdOf(folder / "other.nrrd", 50);
    (void)maker()->keep(0);
    const std::uint64_t bytes = store->list().at(0).bytes;
    store->clear();
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, 3 * bytes / 2, kAtOnce);
    StepMaker first(openReader(std::span(&other, 1)), 0, RangeSet::everything(),
                    timeseries::StepStores{{small}, small, 1});
    ASSERT_EQ(first.keep(0), StepMaker::Kept::Written);
    const auto one = maker(small);
    (void)one->make(0);
    EXPECT_TRUE(one->writeOne(StepMaker::Again::Read, [](double) { return true; }));
    EXPECT_FALSE(one->hasUnwritten());
    EXPECT_TRUE(first.make(0)->file());
    EXPECT_EQ(files(), 1u);
    EXPECT_THAT(small->takeNotes(), IsEmpty());
}

TEST_F(StepStores, SmallStepsAndKeptRangesAreNotWritten) {
    auto reader = openReader(std::span(&file, 1));
    StepMaker small(std::move(reader), 0, RangeSet::everything(),
                    {{store}, store, 24 * 24 * 24 + 1});
    const auto step = small.make(0);
    EXPECT_FALSE(small.hasUnwritten());
    reader = openReader(std::span(&file, 1));
    StepMaker kept(std::move(reader), 0, RangeSet::parse("3:5"), {{store}, store, 1});
    EXPECT_EQ(kept.keep(0), StepMaker::Kept::Unknown);
    (void)maker()->keep(0);
    EXPECT_FALSE(kept.make(0)->file());  // also where all of it is there
}

// What lies between points is read from the source, without any block, as long as it is the one.
TEST_F(StepStores, TheFieldIsTheSourcesUnlessItChanged) {
    (void)maker()->keep(0);
    const auto expectAll = [](const Field& field) {
        const auto& values = std::get<std::vector<float>>(field.values);
        ASSERT_EQ(values.size(), 24u * 24 * 24);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(values[i], static_cast<float>(i % 100));
    };
    const auto step = maker()->make(0);
    const std::uint64_t before = step->bytes();
    const Field field = step->field();
    expectAll(field);
    EXPECT_EQ(field.grid, step->sharedGrid());
    EXPECT_EQ(step->bytes(), before);
    nrrdOf(file, 50);
    expectAll(step->field());
    EXPECT_GT(step->bytes(), before);
    fs::remove(file);
    expectAll(step->field());
}

// In a series whose first file has gained a step, as a run that goes on does, the second's are
// others.
TEST_F(StepStores, TheFieldOfAStepIsNeverThatOfAnotherStep) {
    const std::vector<fs::path> both{folder / "f1.nrrd", folder / "f2.nrrd"};
    const auto write = [&](std::size_t f, int steps, int m) {
        std::string bytes;
        for (int i = 0; i < steps * 24 * 24 * 24; ++i) {
            const auto value = static_cast<float>(i % (24 * 24 * 24) % m);
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        tests::writeBytes(both[f], fmt::format("NRRD0004\ntype: float\ndimension: 4\nsizes: 24 "
                                               "24 24 {}\nendian: little\nencoding: raw\n\n",
                                               steps) +
                                       bytes);
    };
    write(0, 2, 50);
    write(1, 2, 100);
    const auto series = [&] {
        return StepMaker(openReader(both), 0, RangeSet::everything(),
                         timeseries::StepStores{{store}, store, 1});
    };
    ASSERT_EQ(series().keep(2), StepMaker::Kept::Written);
    const auto step = series().make(2);  // the second file's first
    ASSERT_TRUE(step->file());
    write(0, 3, 50);
    const Field field = step->field();
    const auto& values = std::get<std::vector<float>>(field.values);
    ASSERT_EQ(values.size(), 24u * 24 * 24);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(values[i], static_cast<float>(i % 100)) << i;
}

TEST_F(StepStores, AStepStaysReadableWhenItsFileIsRemoved) {
    (void)maker()->keep(0);
    const auto step = maker()->make(0);
    EXPECT_GT(store->clear(), 0u);
    EXPECT_EQ(files(), 0u);
    expectField(*step, 100);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

}  // namespace
}  // namespace timeseries

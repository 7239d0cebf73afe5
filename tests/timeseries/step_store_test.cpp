#include "timeseries/series/step_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "tests/support/files.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::milliseconds kAtOnce{0};

// An .nrrd of 24^3 floats: f(i) = i mod m.
fs::path nrrdOf(const fs::path& path, int m) {
    std::string bytes(24 * 24 * 24 * sizeof(float), '\0');
    for (int i = 0; i < 24 * 24 * 24; ++i) {
        const auto value = static_cast<float>(i % m);
        std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
    }
    tests::writeBytes(path,
                      "NRRD0004\ntype: float\ndimension: 3\nsizes: 24 24 24\nendian: little\n"
                      "encoding: raw\n\n" +
                          bytes);
    return path;
}

class StepStores : public testing::Test {
 protected:
    fs::path folder = tests::freshFolder();
    fs::path file = nrrdOf(folder / "field.nrrd", 100);
    std::shared_ptr<StepStore> store = std::make_shared<StepStore>(
        folder / "steps", StoreKind::Cache, StepStore::kNoBudget, kAtOnce);

    std::unique_ptr<StepMaker> maker(std::shared_ptr<StepStore> in = nullptr) {
        if (!in) in = store;
        auto reader = openReader(std::span(&file, 1));
        return std::make_unique<StepMaker>(std::move(reader), 0, RangeSet::everything(),
                                           timeseries::StepStores{{in}, in, 1});
    }
    StepOrigin originOf(const fs::path& of) const {
        return {
            {of}, 0, of.stem().string(), openReader(std::span(&of, 1))->variables()[0].storedAs};
    }
    StepOrigin origin() const { return originOf(file); }
    std::size_t files() const {
        std::error_code none;
        return static_cast<std::size_t>(std::distance(
            fs::directory_iterator(folder / "steps", none), fs::directory_iterator()));
    }
};

void expectField(const SortedStep& step, int m) {
    const auto values = std::get<std::span<const float>>(step.columns().values);
    const auto index = step.columns().gridIndex;
    ASSERT_EQ(values.size(), 24u * 24 * 24);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(values[i], static_cast<float>(static_cast<int>(index[i]) % m));
}

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
    EXPECT_EQ(maker()->keep(0), StepMaker::Kept::Written);
    expectField(*maker()->make(0), 50);
    EXPECT_EQ(files(), 1u);
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

// What changed a moment before it was opened may change again within the same tick of the clock.
TEST_F(StepStores, WhatHasJustChangedIsNotKept) {
    const auto careful = std::make_shared<StepStore>(folder / "steps", StoreKind::Cache);
    EXPECT_EQ(maker(careful)->keep(0), StepMaker::Kept::Not);
    EXPECT_EQ(files(), 0u);
    // A clock that was set back: the file is of the future.
    const auto atOnce = maker();
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(atOnce->keep(0), StepMaker::Kept::Not);
}

TEST_F(StepStores, WhatChangesBetweenReadingAndWritingIsNotKept) {
    const auto one = maker();
    const auto step = one->make(0);
    ASSERT_TRUE(one->hasUnwritten());
    nrrdOf(file, 50);
    one->writeOne([](double) { return true; });
    EXPECT_EQ(files(), 0u);
    EXPECT_FALSE(one->hasUnwritten());
}

TEST_F(StepStores, WhatIsStoppedIsWrittenLater) {
    const auto one = maker();
    const auto step = one->make(0);
    int asked = 0;
    one->writeOne([&](double) { return ++asked == 1; });
    EXPECT_EQ(files(), 0u);
    EXPECT_TRUE(one->hasUnwritten());
    one->writeOne([](double) { return true; });
    EXPECT_EQ(files(), 1u);
    EXPECT_FALSE(one->hasUnwritten());
}

TEST_F(StepStores, WhatNobodyHoldsAnyMoreIsNotWritten) {
    const auto one = maker();
    (void)one->make(0);
    EXPECT_FALSE(one->hasUnwritten());
}

TEST_F(StepStores, SmallStepsAndKeptRangesAreNotWritten) {
    auto reader = openReader(std::span(&file, 1));
    StepMaker small(std::move(reader), 0, RangeSet::everything(),
                    {{store}, store, 24 * 24 * 24 + 1});
    const auto step = small.make(0);
    EXPECT_FALSE(small.hasUnwritten());
    reader = openReader(std::span(&file, 1));
    StepMaker kept(std::move(reader), 0, RangeSet::parse("3:5"), {{store}, store, 1});
    EXPECT_EQ(kept.keep(0), StepMaker::Kept::Not);
    (void)maker()->keep(0);
    EXPECT_FALSE(kept.make(0)->file());  // also where all of it is there
}

TEST_F(StepStores, WhatIsDamagedIsRemovedToldAndSortedAnew) {
    (void)maker()->keep(0);
    const fs::path path = store->pathOf(origin());
    std::string bytes = tests::readBytes(path);
    bytes[100] ^= 1;  // of the header
    tests::writeBytes(path, bytes);
    expectField(*maker()->make(0), 100);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("damaged")));
    // Found out later: by then it is shown.
    (void)maker()->keep(0);
    bytes = tests::readBytes(path);
    bytes[5000] ^= 1;
    tests::writeBytes(path, bytes);
    const auto step = maker()->make(0);
    ASSERT_TRUE(step->file());
    expectField(*step, 100);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("block 0")));
}

// Blocks of before are never joined with what the source is by now.
TEST_F(StepStores, WhatIsDamagedWhileItsSourceChangedIsToldInsteadOfShown) {
    (void)maker()->keep(0);
    const fs::path path = store->pathOf(origin());
    const auto step = maker()->make(0);
    std::string bytes = tests::readBytes(path);
    bytes[5000] ^= 1;
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << bytes;  // in place
    nrrdOf(file, 50);
    EXPECT_THAT([&] { (void)step->columns(); },
                testing::ThrowsMessage<FileError>(HasSubstr("it has changed since")));
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

TEST_F(StepStores, AStepStaysReadableWhenItsFileIsRemoved) {
    (void)maker()->keep(0);
    const auto step = maker()->make(0);
    EXPECT_GT(store->clear(), 0u);
    EXPECT_EQ(files(), 0u);
    expectField(*step, 100);
    EXPECT_THAT(store->takeNotes(), IsEmpty());
}

TEST_F(StepStores, TheBudgetKeepsWhatWasUsedLast) {
    (void)maker()->keep(0);
    const std::uint64_t size = store->list().at(0).bytes;
    const auto small =
        std::make_shared<StepStore>(folder / "steps", StoreKind::Cache, size * 5 / 2, kAtOnce);
    const fs::path first = file;
    for (const char* name : {"b.nrrd", "c.nrrd"}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_TRUE(small->find(originOf(first)));  // used
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        file = nrrdOf(folder / name, 100);
        EXPECT_EQ(maker(small)->keep(0), StepMaker::Kept::Written);
    }
    EXPECT_EQ(files(), 2u);
    EXPECT_TRUE(small->find(originOf(first)));
    EXPECT_FALSE(small->find(originOf(folder / "b.nrrd")));
    EXPECT_TRUE(small->find(originOf(folder / "c.nrrd")));
}

TEST_F(StepStores, BesideTheDataTheyMoveWithThem) {
    const auto beside = [&] {
        return std::make_shared<StepStore>(file.parent_path() / "isochron-index", StoreKind::Beside,
                                           StepStore::kNoBudget, kAtOnce);
    };
    EXPECT_EQ(maker(beside())->keep(0), StepMaker::Kept::Written);
    fs::create_directory(folder / "moved");
    fs::copy(folder / "isochron-index", folder / "moved/isochron-index");
    const auto time = fs::last_write_time(file);
    fs::copy_file(file, folder / "moved/field.nrrd");
    file = folder / "moved/field.nrrd";
    EXPECT_FALSE(maker(beside())->make(0)->file());
    fs::last_write_time(file, time);  // as cp -p and rsync -t leave it
    EXPECT_TRUE(maker(beside())->make(0)->file());
}

TEST_F(StepStores, AFolderThatCannotBeIsToldOnceAndTheProgramGoesOn) {
    tests::writeBytes(folder / "steps", "a file");
    const auto one = maker();
    const auto step = one->make(0);
    one->writeOne([](double) { return true; });
    EXPECT_THAT(store->takeNotes(), ElementsAre(HasSubstr("not kept")));
    const auto again = one->make(0);
    EXPECT_FALSE(one->hasUnwritten());
    expectField(*again, 100);
}

TEST_F(StepStores, AFullDiskLeavesNothing) {
    // RLIMIT_FSIZE fails a write as a full disk does, at every length.
    (void)maker()->keep(0);
    const auto whole = fs::file_size(store->pathOf(origin()));
    for (const std::uintmax_t most : {std::uintmax_t{1}, whole / 3, whole / 2, whole - 1}) {
        nrrdOf(file, 100);  // written anew: what is kept is of before
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{most, most};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            try {
                (void)maker()->keep(0);
                ::_exit(1);
            } catch (const StepFileError&) {
                ::_exit(0);
            }
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << most;
        EXPECT_EQ(files(), 1u);  // the one before
        EXPECT_FALSE(store->find(origin()));
    }
}

// Killed at any moment, a writer leaves the old file or the new one, and what it left is removed by
// the next.
TEST_F(StepStores, AWriterThatIsKilledLeavesTheOldOrTheNew) {
    std::mt19937_64 random(1);
    const auto begin = std::chrono::steady_clock::now();
    (void)maker()->keep(0);
    const auto whole = std::chrono::steady_clock::now() - begin;
    for (int i = 0; i < tests::rounds(60); ++i) {
        const int m = 20 + i;
        nrrdOf(file, m);
        const pid_t child = ::fork();
        if (child == 0) {
            (void)maker()->keep(0);
            ::_exit(0);
        }
        std::this_thread::sleep_for(whole * static_cast<double>(random() % 1000) / 500);
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        expectField(*maker()->make(0), m);
        EXPECT_THAT(store->takeNotes(), IsEmpty());
    }
    (void)maker()->keep(0);
    EXPECT_EQ(files(), 1u);
}

TEST_F(StepStores, ManyWritersAndReadersOfOneStepAllHaveIt) {
    std::vector<std::jthread> users;
    for (int k = 0; k < 4; ++k)
        users.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                if (i % 5 == 4) store->clear();
                const auto one = maker();
                (void)one->keep(0);
                expectField(*one->make(0), 100);
            }
        });
    users.clear();
    EXPECT_THAT(store->takeNotes(), IsEmpty());
    EXPECT_LE(files(), 1u);
}

TEST(WholeFile, LeavesNothingUnlessItIsFinished) {
    const fs::path folder = tests::freshFolder();
    {
        WholeFile file(folder / "a");
        file.write(5, std::as_bytes(std::span("abc", 3)));
        removeUnfinished(folder);  // it is being written
        EXPECT_FALSE(fs::exists(folder / "a"));
    }
    EXPECT_TRUE(fs::is_empty(folder));
    WholeFile file(folder / "a");
    file.write(2, std::as_bytes(std::span("abc", 3)));
    file.finish();
    EXPECT_EQ(tests::readBytes(folder / "a"), std::string("\0\0abc", 5));
    tests::writeBytes(folder / (std::string("b.1-1") + WholeFile::kSuffix), "left");
    removeUnfinished(folder);
    EXPECT_THAT(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace timeseries

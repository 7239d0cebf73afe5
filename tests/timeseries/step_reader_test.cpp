#include "timeseries/readers/step_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <semaphore>

#include "tests/support/files.h"
#include "tests/support/random_field.h"
#include "tests/support/read_variables.h"
#include "tests/support/step_bytes.h"
#include "timeseries/readers/step_about.h"
#include "timeseries/series/step_loader.h"
#include "timeseries/series/step_maker.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::refusalOf;

StepAbout aboutAt(double time) {
    StepAbout about;
    about.variable = "u";
    about.units = "m/s";
    about.time = time;
    about.timeUnits = "s";
    about.axes[0] = {"x", "km", -1, 0.25, {}};
    about.axes[1] = {"y", "km", 0, -2, {}};
    about.axes[2] = {"z", "hPa", 0, 1, {1000, 500, 100}};
    return about;
}

fs::path put(const fs::path& path, const std::vector<std::byte>& bytes) {
    tests::writeBytes(path, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    return path;
}

Field fieldOf(std::array<std::size_t, 3> size, unsigned seed) {
    std::mt19937_64 random(seed);
    return tests::randomField<float>(random, size, 2);
}

// Files of so many steps, fieldOf(size, 0) and on, half a second apart.
std::vector<fs::path> seriesOf(unsigned steps, std::array<std::size_t, 3> size) {
    std::vector<fs::path> paths;
    for (unsigned i = 0; i < steps; ++i)
        paths.push_back(
            put(tests::testFolder() / fmt::format("u_{:03}.isostep", i),
                tests::written(SortedStep::build(fieldOf(size, i)), textOf(aboutAt(0.5 * i)))));
    return paths;
}

TEST(StepReader, OpensWhatTheStepSaysOfItself) {
    const Field field = fieldOf({40, 30, 3}, 1);
    const SortedStep step = SortedStep::build(field);
    const fs::path path =
        put(tests::testFolder() / "u.isostep", tests::written(step, textOf(aboutAt(0.1))));
    const auto reader = openReader(std::span(&path, 1));
    const Variable& u = reader->variables()[0];
    EXPECT_EQ(u.name, "u");
    EXPECT_EQ(u.units, "m/s");
    EXPECT_EQ(u.type, ValueType::F32);
    EXPECT_EQ(u.time->units, "s");
    EXPECT_EQ(u.time->points[0].value, 0.1);
    const auto& axes = u.grid->axes();
    for (std::size_t i = 0; i < 40; ++i)
        EXPECT_EQ(axes[0].coordinates[i], -1 + static_cast<double>(i) * 0.25);
    EXPECT_EQ(axes[1].coordinates[29], -58);
    EXPECT_THAT(axes[2].coordinates, ElementsAre(1000, 500, 100));
    EXPECT_EQ(axes[2].units, "hPa");

    const Field read = reader->read(0, 0);
    const auto& expected = std::get<std::vector<float>>(field.values);
    const auto& values = std::get<std::vector<float>>(read.values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool missing =
            std::isnan(expected[i]) || (!field.missing.empty() && field.missing[i]);
        EXPECT_TRUE(missing ? std::isnan(values[i]) : values[i] == expected[i]) << i;
    }
}

TEST(StepReader, SeveralAreASeriesByTheirTimesAndAreNotSortedAgain) {
    const std::vector<fs::path> paths = seriesOf(5, {40, 30, 3});
    StepMaker maker(openReader(paths), 0, RangeSet::everything());
    ASSERT_EQ(maker.variable().time->points.size(), 5u);
    EXPECT_EQ(maker.variable().time->points[3].value, 1.5);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto step = maker.make(i);
        ASSERT_TRUE(step->file());
        EXPECT_EQ(step->sharedGrid(), maker.variable().grid);
        const SortedStep expected =
            SortedStep::build(fieldOf({40, 30, 3}, static_cast<unsigned>(i)));
        EXPECT_TRUE(std::ranges::equal(step->gridIndex(), expected.gridIndex()));
    }
    // Of some values alone it is sorted, from those of the file.
    const RangeSet some({Range{{Number(0.0)}, {Number(1.0)}}});
    StepMaker kept(openReader(paths), 0, some);
    EXPECT_EQ(kept.make(2)->size(), SortedStep::build(fieldOf({40, 30, 3}, 2)).count(some));
}

// So many that threads share them.
TEST(StepReader, OfHundredsTheFirstThatIsDamagedIsTold) {
    const std::vector<fs::path> paths = seriesOf(300, {4, 3, 3});
    const auto series = openReader(paths);
    const auto& points = series->variables()[0].time->points;
    ASSERT_EQ(points.size(), 300u);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(points[i].value, 0.5 * static_cast<double>(i));
    for (const std::size_t damaged : {200, 90}) fs::resize_file(paths[damaged], 100);
    EXPECT_THAT(refusalOf(paths), HasSubstr("u_090.isostep"));
}

// Who draws a step that came does not wait for the disk.
TEST(StepReader, WhatIsLookedAtIsReadBeforeAStepComes) {
    const std::vector<fs::path> paths = seriesOf(2, {300, 300, 3});
    const RangeSet some({Range{{Number(0.0)}, {Number(0.05)}}});
    StepLoader loader(
        openReader(paths), 0, RangeSet::everything(), [] {}, Ready::Whole);
    const auto come = [&](std::size_t step, const RangeSet& looked) {
        loader.want({step}, StepLoader::Haste::Waited, looked);
        return std::get<Loaded>(*loader.waitAndPoll()).sorted;
    };
    const auto none = come(0, {});
    ASSERT_TRUE(none->file());
    const std::uint64_t tables = none->pointBytes(), each = sizeof(float) + sizeof(std::uint32_t);
    EXPECT_LT(tables, 1000u);
    const auto read = come(1, some);
    const auto runs = read->select(some);
    ASSERT_GT(runs.front().count, 100u);
    const std::uint64_t before = read->pointBytes();
    EXPECT_GE(before, tables + runs.front().count * each);
    EXPECT_LT(before, read->size() * each);
    (void)read->columns(runs);
    EXPECT_EQ(read->pointBytes(), before);
}

// Of those that have their points in memory two wait, and no more.
TEST(StepReader, FewStepsWaitWithAllTheirPoints) {
    const std::vector<fs::path> paths = seriesOf(4, {300, 300, 3});
    std::counting_semaphore<> came{0};
    StepLoader loader(
        openReader(paths), 0, RangeSet::everything(), [&] { came.release(); }, Ready::Whole);
    loader.want({0, 1, 2, 3}, StepLoader::Haste::Waited, RangeSet::everything());
    for (int i = 0; i < 2; ++i) came.acquire();
    EXPECT_FALSE(came.try_acquire_for(std::chrono::milliseconds(200)));
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::get<Loaded>(*loader.waitAndPoll()).step, i);
}

TEST(StepReader, WhatIsNoStepOfItsOwnIsRefused) {
    const SortedStep step = SortedStep::build(fieldOf({40, 30, 3}, 1));
    const auto refusal = [&](const std::string& about) {
        return refusalOf(put(tests::testFolder() / "u.isostep", tests::written(step, about)));
    };
    const auto changed = [&](auto change) {
        StepAbout about = aboutAt(0);
        change(about);
        return refusal(textOf(about));
    };
    EXPECT_THAT(refusal("{\"files\": []}"), HasSubstr("the index of a step of another file"));
    EXPECT_THAT(refusal("no JSON"), AllOf(HasSubstr("u.isostep"), HasSubstr("parse error")));
    EXPECT_THAT(refusal("{\"alone\": {}}"), HasSubstr("key 'variable' not found"));
    EXPECT_THAT(refusal("{\"alone\": 7}"), HasSubstr("expected what the step is of"));
    EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("expected what the step is of"));
    EXPECT_THAT(changed([](StepAbout& a) { a.axes[2].coordinates.pop_back(); }),
                HasSubstr("axis 'z': expected 3 coordinates, found 2"));
    EXPECT_THAT(changed([](StepAbout& a) { a.axes[2].coordinates[1] = 2000; }),
                HasSubstr("axis 'z': "));
    EXPECT_THAT(changed([](StepAbout& a) { a.axes[0].spacing = 0; }), HasSubstr("axis 'x': "));
    EXPECT_THAT(changed([](StepAbout& a) { a.axes[0].spacing = 1e308; }), HasSubstr("axis 'x': "));
    auto bytes = tests::written(step, textOf(aboutAt(0)));
    bytes.resize(bytes.size() / 2);
    EXPECT_THAT(refusalOf(put(tests::testFolder() / "cut.isostep", bytes)),
                AllOf(HasSubstr("cut.isostep"), HasSubstr("damaged")));
}

// A grid of 2^32 points of which one is there takes a few bytes.
TEST(StepReader, AnAxisLongerThanAnyDataIsRefusedBeforeItIsMade) {
    Field field;
    field.grid = tests::gridOf({1, 1, 1});
    field.values = std::vector<float>{1};
    auto bytes = tests::written(SortedStep::build(field), textOf(StepAbout{}));
    StepHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    header.size = {1, ~0u, 1};
    header.missing = ~0u - 1;
    std::memcpy(bytes.data(), &header, sizeof header);
    tests::sumAnew(bytes);
    EXPECT_THAT(refusalOf(put(tests::testFolder() / "long.isostep", bytes)),
                HasSubstr("expected at most 16777216 points, found 4294967295"));
}

TEST(StepReader, DamageBehindTheHeaderIsToldWhereItIsRead) {
    const SortedStep step = SortedStep::build(fieldOf({200, 200, 3}, 1));
    auto bytes = tests::written(step, textOf(aboutAt(0)));
    bytes[kHeaderBytes + 100] ^= std::byte{1};
    const fs::path path = put(tests::testFolder() / "u.isostep", bytes);
    StepMaker maker(openReader(std::span(&path, 1)), 0, RangeSet::everything());
    const auto made = maker.make(0);
    try {
        (void)made->columns();
        FAIL() << "nothing was told";
    } catch (const std::exception& error) {
        EXPECT_THAT(error.what(), HasSubstr("u.isostep is a damaged sorted step"));
    }
    const auto reader = openReader(std::span(&path, 1));
    EXPECT_THROW((void)reader->read(0, 0), FileError);
}

}  // namespace
}  // namespace timeseries

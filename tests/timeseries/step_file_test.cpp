#include "timeseries/index/step_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "tests/support/random_field.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"
#include "tests/support/selection_oracle.h"
#include "tests/support/step_bytes.h"
#include "timeseries/index/step_header.h"

namespace timeseries {
namespace {

using testing::HasSubstr;

SortedStep never(const std::string& why) {
    ADD_FAILURE() << "the step was asked for again: " << why;
    throw std::runtime_error(why);
}

SortedStep storedOf(const SortedStep& step,
                    std::function<SortedStep(const std::string&)> again = never) {
    return SortedStep::stored(tests::opened(tests::written(step)), step.sharedGrid(), false,
                              {std::move(again)});
}

template <typename T>
void expectSame(const SortedStep& expected, const SortedStep& step, std::mt19937_64& random) {
    ASSERT_EQ(step.size(), expected.size());
    const auto extent = [](const StepStatistics& s) {
        return std::vector{toText(s.min),
                           toText(s.max),
                           toText(s.finiteMin),
                           toText(s.finiteMax),
                           std::to_string(s.points),
                           std::to_string(s.missing)};
    };
    EXPECT_EQ(extent(step.statistics()), extent(expected.statistics()));
    EXPECT_EQ(step.finite(), expected.finite());
    EXPECT_EQ(step.quantiles(1025), expected.quantiles(1025));
    EXPECT_EQ(step.quantiles(5), expected.quantiles(5));
    // Ranges first, before all is there.
    const std::vector<T> awkward = oracle::awkwardValues<T>();
    for (int i = 0; i < 20; ++i) {
        const auto any = [&] {
            return random() % 2 == 0 ? expected.value(random() % expected.size())
                                     : numberOf(awkward[random() % awkward.size()]);
        };
        Range range{{any(), random() % 2 == 0}, {any(), random() % 2 == 0}};
        if (oracle::real(range.hi.value) < oracle::real(range.lo.value))
            std::swap(range.lo.value, range.hi.value);
        const RangeSet ranges({range});
        EXPECT_EQ(step.select(ranges), expected.select(ranges)) << ranges.text();
        const double edge = toDouble(any());
        EXPECT_EQ(step.countBelow(edge), expected.countBelow(edge)) << edge;
    }
    const std::uint64_t one = random() % step.size();
    EXPECT_EQ(step.gridIndex(one), expected.gridIndex(one));
    const Columns a = step.columns(), b = expected.columns();
    EXPECT_TRUE(std::ranges::equal(a.gridIndex, b.gridIndex));
    EXPECT_EQ(std::memcmp(std::get<std::span<const T>>(a.values).data(),
                          std::get<std::span<const T>>(b.values).data(), step.size() * sizeof(T)),
              0);
}

template <typename T>
class StepFileOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(StepFileOf, Types);

TYPED_TEST(StepFileOf, HoldsTheListToTheLastPoint) {
    std::mt19937_64 random(5);
    // One point, one block to the point, several, of odd sizes, planes and lines.
    const std::vector<std::array<std::size_t, 3>> sizes{{1, 1, 1},     {32, 32, 32},  {70, 41, 37},
                                                        {33, 1, 2000}, {70000, 1, 1}, {5, 300, 1}};
    for (const auto& size : sizes)
        for (int kind = 0; kind < 4; ++kind) {
            SCOPED_TRACE(testing::Message()
                         << size[0] << " x " << size[1] << " x " << size[2] << ", kind " << kind);
            const SortedStep step =
                SortedStep::build(tests::randomField<TypeParam>(random, size, kind));
            if (step.size() == 0) continue;
            expectSame<TypeParam>(step, storedOf(step), random);
        }
}

// The histogram's counts, against every value.
TYPED_TEST(StepFileOf, CountsWhatIsLess) {
    std::mt19937_64 random(6);
    for (int kind = 0; kind < 4; ++kind) {
        const SortedStep step =
            SortedStep::build(tests::randomField<TypeParam>(random, {9, 8, 7}, kind));
        const auto values = std::get<std::span<const TypeParam>>(step.columns().values);
        for (int i = 0; i < 200; ++i) {
            const double edge = i % 2 == 0 ? toDouble(step.value(random() % step.size()))
                                           : std::bit_cast<double>(random());
            const auto less = std::ranges::count_if(values, [&](TypeParam value) {
                return static_cast<oracle::Real>(value) < static_cast<oracle::Real>(edge);
            });
            EXPECT_EQ(step.countBelow(edge), less) << edge;
        }
        EXPECT_EQ(step.countBelow(std::numeric_limits<double>::infinity()),
                  std::ranges::count_if(values, [](TypeParam value) {
                      return static_cast<double>(value) < std::numeric_limits<double>::infinity();
                  }));
        EXPECT_EQ(step.countBelow(-std::numeric_limits<double>::infinity()), 0u);
    }
}

SortedStep smooth(std::array<std::size_t, 3> size = {60, 50, 40}) {
    const auto grid = tests::gridOf(size);
    return tests::stepOf(grid, [&](std::size_t i) {
        const auto p = grid->position(i);
        return static_cast<float>(std::sin(p.x * .1) + std::cos(p.y * .13) * p.z);
    });
}

TEST(StepFile, IsTheSameBytesOnAnyNumberOfThreads) {
    const SortedStep step = smooth();
    const auto once = tests::written(step, "about", 1);
    EXPECT_EQ(tests::written(step, "about", 2), once);
    EXPECT_EQ(tests::written(step, "about", 7), once);
    EXPECT_EQ(tests::opened(once)->about(), "about");
}

TEST(StepFile, ReadsNoMoreThanTheBlocksOfARange) {
    const SortedStep step = smooth({64, 64, 64});
    const SortedStep stored = storedOf(step);
    const std::uint64_t before = stored.bytes();
    const timeseries::Run some{kStepBlock + 5, 10};
    (void)stored.columns({&some, 1});
    EXPECT_EQ(stored.bytes() - before, kStepBlock * (sizeof(float) + 4));
    // Ends of ranges are found by their keys, which are not kept.
    EXPECT_EQ(stored.count(RangeSet::parse("0:1")), step.count(RangeSet::parse("0:1")));
    EXPECT_EQ(stored.bytes() - before, kStepBlock * (sizeof(float) + 4));
}

TEST(StepFile, IsReadByManyAtOnce) {
    const SortedStep step = smooth({64, 64, 64});
    const SortedStep stored = storedOf(step);
    const Columns expected = step.columns();
    std::vector<std::jthread> readers;
    for (unsigned k = 0; k < 4; ++k)
        readers.emplace_back([&, k] {
            std::mt19937_64 random(k);
            for (int i = 0; i < 50; ++i) {
                const timeseries::Run run{random() % step.size(), 1};
                EXPECT_EQ(stored.columns({&run, 1}).gridIndex[run.first],
                          expected.gridIndex[run.first]);
            }
        });
}

TEST(StepFile, OpenedAgainHoldsNoPointsButTheSameCells) {
    const SortedStep step = smooth({64, 64, 64});
    const SortedStep stored = storedOf(step);
    const std::uint64_t atFirst = stored.pointBytes();
    const std::vector<timeseries::Run> runs = {{5, 0}, {10, 100}, {2 * kStepBlock - 1, 2}};
    constexpr std::uint64_t kBlockBytes = kStepBlock * (sizeof(float) + 4);
    EXPECT_EQ(stored.pointBytes(runs), 3 * kBlockBytes) << "of blocks 0, 1 and 2";
    EXPECT_EQ(stored.pointBytes(std::vector<timeseries::Run>{{10, 1}, {20, 1}}), kBlockBytes);
    (void)stored.columns(runs);
    EXPECT_EQ(stored.pointBytes(), atFirst + stored.pointBytes(runs));
    ASSERT_TRUE(stored.cells());

    const SortedStep again = stored.reopened();
    EXPECT_EQ(again.pointBytes(), atFirst);
    EXPECT_EQ(again.cellsIfMade(), stored.cellsIfMade());
    std::mt19937_64 random(5);
    expectSame<float>(step, again, random);
}

TEST(StepFile, OpenedAgainKeepsWhatItIsToldAndWhatWasLookedAtLast) {
    const SortedStep step = smooth({64, 64, 64});
    const SortedStep stored = storedOf(step);
    const std::uint64_t atFirst = stored.pointBytes();
    const auto look = [](const SortedStep& at, std::uint64_t block) {
        const timeseries::Run run{block * kStepBlock + 7, 1};
        (void)at.columns({&run, 1});
    };
    for (const std::uint64_t block : {3, 0, 1, 2, 5, 0, 1}) look(stored, block);
    constexpr std::uint64_t kBlockBytes = kStepBlock * (sizeof(float) + 4);
    // Block 4 is not there, block 3 was looked at before all others, and then 2, 5, 0 and 1.
    const std::vector<timeseries::Run> runs = {{3 * kStepBlock + 5, 10}, {4 * kStepBlock, 1}};
    const SortedStep fewer = stored.reopened(runs, 4 * kBlockBytes - 1);
    EXPECT_EQ(fewer.pointBytes(), atFirst + 3 * kBlockBytes);
    for (const std::uint64_t block : {3, 0, 1}) look(fewer, block);
    EXPECT_EQ(fewer.pointBytes(), atFirst + 3 * kBlockBytes) << "they were there";
    look(fewer, 2);
    // How long ago each was looked at goes on.
    const SortedStep next = fewer.reopened({}, 2 * kBlockBytes);
    for (const std::uint64_t block : {2, 1}) look(next, block);
    EXPECT_EQ(next.pointBytes(), atFirst + 2 * kBlockBytes);

    EXPECT_EQ(stored.reopened(runs, 0).pointBytes(), atFirst + kBlockBytes) << "whatever it takes";
    std::mt19937_64 random(6);
    expectSame<float>(step, fewer, random);
    expectSame<float>(step, stored.reopened({}, ~std::uint64_t{0}), random);
}

TEST(StepFile, OfAnotherGridIsRefused) {
    const SortedStep step = smooth({4, 5, 6});
    EXPECT_THROW((void)SortedStep::stored(tests::opened(tests::written(step)),
                                          tests::gridOf({5, 4, 6}), false, {never}),
                 StepFileError);
}

// Every sentence says which file it is of.
void expectRefused(std::vector<std::byte> bytes, const std::string& what) {
    try {
        tests::opened(std::move(bytes))->check();
        ADD_FAILURE() << what << ": it was believed";
    } catch (const StepFileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("bytes")) << what;
    }
}

TEST(StepFile, ThatEndsEarlyIsRefusedAtEveryLength) {
    const auto whole = tests::written(smooth({20, 20, 20}));
    std::mt19937_64 random(1);
    for (int i = 0; i < tests::rounds(400); ++i) {
        const std::size_t length =
            i < 50 ? whole.size() - 1 - static_cast<std::size_t>(i) : random() % whole.size();
        expectRefused({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)},
                      "length " + std::to_string(length));
    }
}

TEST(StepFile, NoFlippedBitIsBelieved) {
    const auto whole = tests::written(smooth({20, 20, 20}), "about");
    std::mt19937_64 random(2);
    for (int i = 0; i < tests::rounds(2000); ++i) {
        auto bytes = whole;
        const std::size_t at = random() % bytes.size();
        bytes[at] ^= std::byte(1 << random() % 8);
        expectRefused(std::move(bytes), "byte " + std::to_string(at));
    }
}

// A checksum is no defence: whatever a file says, it is refused or a list of points of the grid.
TEST(StepFile, WithRightChecksumsAndWrongContentsIsRefusedOrAList) {
    const SortedStep step = smooth({37, 20, 30});
    const auto whole = tests::written(step, "about");
    std::mt19937_64 random(3);
    int refused = 0;
    for (int i = 0; i < tests::rounds(3000); ++i) {
        auto bytes = whole;
        for (std::uint64_t flips = 1 + random() % 3; flips > 0; --flips) {
            // Half of them in the header, the directory and the heads of blocks.
            const std::size_t at = random() % 2 == 0   ? random() % bytes.size()
                                   : random() % 2 == 0 ? random() % 200
                                                       : bytes.size() - 1 - random() % 9000;
            bytes[at] = std::byte(random());
        }
        tests::sumAnew(bytes);
        try {
            const SortedStep stored = SortedStep::stored(
                tests::opened(std::move(bytes)), step.sharedGrid(), false,
                {[](const std::string& why) -> SortedStep { throw StepFileError(why); }});
            (void)stored.count(RangeSet::parse("0:3"));
            for (const std::uint32_t index : stored.columns().gridIndex)
                ASSERT_LT(index, step.grid().count());
        } catch (const StepFileError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

// Whose sums are right, too: a point that stands twice, in place of another, and what is told of
// all of them.
TEST(StepFile, IsReadWholeToSeeWhetherItTellsTheTruth) {
    const auto whole = tests::written(smooth({64, 48, 40}), "about");
    const auto refusal = [&](const std::function<void(std::vector<std::byte>&)>& change) {
        auto bytes = whole;
        change(bytes);
        tests::sumAnew(bytes);
        try {
            tests::opened(std::move(bytes))->check();
        } catch (const DamagedStepError& error) {
            return std::string(error.what());
        }
        return std::string("believed");
    };
    EXPECT_EQ(refusal([](auto&) {}), "believed");
    const auto file = tests::opened(whole);
    const auto blocks = file->blocks();
    ASSERT_GT(blocks.size(), 2u);
    StepHeader header;
    std::memcpy(&header, whole.data(), sizeof header);
    EXPECT_THAT(refusal([&](auto& bytes) {  // the second block has the first one's points
                    StepBlock second = blocks[1];
                    second.idsAt = blocks[0].idsAt;
                    second.idsBytes = blocks[0].idsBytes;
                    std::memcpy(bytes.data() + header.directory.at + sizeof second, &second,
                                sizeof second);
                }),
                HasSubstr("stands in its list twice"));
    for (std::size_t i = 0; i < header.extent.size(); ++i)
        EXPECT_THAT(refusal([&](auto& bytes) {
                        bytes[offsetof(StepHeader, extent) + 8 * i] ^= std::byte{1};
                    }),
                    HasSubstr("least and greatest values are not those"))
            << i;
    EXPECT_THAT(refusal([&](auto& bytes) { bytes[header.summary.at + 8 + 8 * 5] ^= std::byte{1}; }),
                HasSubstr("quantiles are not those"));
}

// Of another version or machine nothing is damaged.
TEST(StepFile, OfAnotherVersionOrByteOrderIsToldApart) {
    const auto refusal = [&](std::size_t at, std::uint32_t number) {
        auto bytes = tests::written(smooth({20, 20, 20}));
        std::memcpy(bytes.data() + at, &number, sizeof number);
        tests::sumAnew(bytes);
        try {
            (void)tests::opened(std::move(bytes));
        } catch (const OtherStepError& error) {
            return std::string(error.what());
        }
        return std::string("opened");
    };
    EXPECT_EQ(refusal(offsetof(StepHeader, version), kStepVersion), "opened");
    EXPECT_THAT(refusal(offsetof(StepHeader, version), kStepVersion + 1),
                HasSubstr("bytes is of version 2 of the index, expected 1"));
    EXPECT_THROW((void)refusal(offsetof(StepHeader, endian), 0x04030202), DamagedStepError);
    EXPECT_THAT(refusal(offsetof(StepHeader, endian), kOtherEndianMark),
                HasSubstr("bytes was written on a machine of the other byte order"));
}

TEST(StepFile, TurnedOutToBeDamagedIsMadeAgainOnceAndIsTheSame) {
    const SortedStep step = smooth({64, 64, 64});
    auto bytes = tests::written(step);
    bytes[tests::opened(bytes)->blocks()[3].idsAt + 100] ^= std::byte{1};
    int made = 0;
    const SortedStep stored = SortedStep::stored(tests::opened(bytes), step.sharedGrid(), false,
                                                 {[&](const std::string& why) {
                                                     ++made;
                                                     EXPECT_THAT(why, HasSubstr("block 3"));
                                                     return smooth({64, 64, 64});
                                                 }});
    const timeseries::Run good{0, 10};
    (void)stored.columns({&good, 1});
    EXPECT_EQ(made, 0);
    std::mt19937_64 random(4);
    expectSame<float>(step, stored, random);
    EXPECT_EQ(made, 1);
}

TEST(StepFile, WhatCannotBeMadeAgainThrowsEachTime) {
    const SortedStep step = smooth({20, 20, 20});
    auto bytes = tests::written(step);
    bytes[tests::opened(bytes)->blocks()[0].keysAt] ^= std::byte{1};
    const SortedStep stored = SortedStep::stored(
        tests::opened(bytes), step.sharedGrid(), false,
        {[&](const std::string&) -> SortedStep { throw std::runtime_error("gone"); }});
    EXPECT_THROW((void)stored.columns(), std::runtime_error);
    EXPECT_THROW((void)stored.columns(), std::runtime_error);
    EXPECT_THROW((void)stored.count(RangeSet::parse("0:1")), std::runtime_error);
}

TEST(StepFile, StopsWhereItIsToldTo) {
    tests::BytesWritten out;
    EXPECT_FALSE(writeStep(smooth({20, 20, 20}), "", out, [](double) { return false; }));
    EXPECT_TRUE(out.bytes.empty());
}

}  // namespace
}  // namespace timeseries

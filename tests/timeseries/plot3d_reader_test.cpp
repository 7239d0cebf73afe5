// PLOT3D files: told by their sizes, in every way that programs write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/damage.h"
#include "tests/support/files.h"
#include "tests/support/kept_steps.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::plot3d {
namespace {

using namespace tests;
using testing::HasSubstr;
using tests::refusalOf;

struct How {
    bool swapped = false, marked = false, counted = false, isDouble = false, blanks = false;
};

// As a program writes it: records, of numbers in this byte order.
class Plot3dFile {
 public:
    explicit Plot3dFile(const How& how) : how_(how) {}
    template <typename T>
    void record(const std::vector<T>& numbers) {
        mark(numbers.size() * sizeof(T));
        for (const T number : numbers) put(number);
        mark(numbers.size() * sizeof(T));
    }
    void reals(const std::vector<double>& numbers, const std::vector<std::int32_t>& blanks = {}) {
        const std::size_t bytes = numbers.size() * (how_.isDouble ? 8 : 4) + 4 * blanks.size();
        mark(bytes);
        for (const double number : numbers)
            how_.isDouble ? put(number) : put(static_cast<float>(number));
        for (const std::int32_t blank : blanks) put(blank);
        mark(bytes);
    }
    std::filesystem::path write(const std::string& name) const {
        writeBytes(testFolder() / name, bytes_);
        return testFolder() / name;
    }

 private:
    template <typename T>
    void put(T number) {
        auto* const first = reinterpret_cast<char*>(&number);
        if (how_.swapped) std::reverse(first, first + sizeof(T));
        bytes_.append(first, sizeof(T));
    }
    void mark(std::size_t bytes) {
        if (how_.marked) put(static_cast<std::int32_t>(bytes));
    }
    How how_;
    std::string bytes_;
};

constexpr int kI = 5, kJ = 4, kK = 3, kPoints = kI * kJ * kK;

glm::dvec3 placeOf(int i, int j, int k) { return {2.0 * i + 0.5 * j, 1.0 * j, 0.25 * k}; }
double valueOf(int array, int point) { return 100.0 * array + point; }

void begin(Plot3dFile& file, const How& how, std::int32_t across = kI) {
    if (how.counted) file.record(std::vector<std::int32_t>{1});
    file.record(std::vector<std::int32_t>{across, kJ, kK});
}

std::filesystem::path places(const std::string& name, const How& how, double shift = 0) {
    Plot3dFile file(how);
    begin(file, how);
    std::vector<double> numbers;
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < kK; ++k)
            for (int j = 0; j < kJ; ++j)
                for (int i = 0; i < kI; ++i) numbers.push_back(placeOf(i, j, k)[c] + shift);
    std::vector<std::int32_t> blanks(how.blanks ? kPoints : 0, 1);
    if (how.blanks) blanks[7] = 0;
    file.reals(numbers, blanks);
    return file.write(name);
}

std::filesystem::path flow(const std::string& name, const How& how, double time = 0) {
    Plot3dFile file(how);
    begin(file, how);
    file.reals({0.5, 2, 1e6, time});
    std::vector<double> numbers;
    for (int array = 0; array < 5; ++array)
        for (int point = 0; point < kPoints; ++point) numbers.push_back(valueOf(array, point));
    file.reals(numbers);
    return file.write(name);
}

TEST(Plot3d, EveryWayOfWritingIsRead) {
    for (int bits = 0; bits < 32; ++bits) {
        const How how{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0,
                      (bits & 16) != 0};
        freshFolder();
        places("a.xyz", how);
        const auto reader = open(flow("a.q", how, 3.25));
        EXPECT_EQ(reader->format(), "PLOT3D");
        EXPECT_EQ(timesOf(*reader), (std::vector{3.25}));
        EXPECT_EQ(reader->variables()[0].time->name, "time");
        EXPECT_FALSE(reader->variables()[0].time->counted);
        ASSERT_EQ(reader->variables().size(), 6u);
        for (const auto& [name, array] :
             {std::pair{"Density", 0}, {"Momentum[1]", 2}, {"StagnationEnergy", 4}}) {
            const Field field = reader->read(indexOf(*reader, name), 0);
            const int which = array;
            std::visit(
                [&](const auto& values) {
                    ASSERT_EQ(values.size(), std::size_t{kPoints});
                    EXPECT_EQ(sizeof(values[0]), how.isDouble ? 8u : 4u);
                    for (int i = 0; i < kPoints; ++i)
                        EXPECT_EQ(static_cast<double>(values[std::size_t(i)]), valueOf(which, i));
                },
                field.values);
            EXPECT_EQ(field.missing.size(), how.blanks ? std::size_t{kPoints} : 0u);
            if (how.blanks) {
                EXPECT_EQ(std::ranges::find(field.missing, true) - field.missing.begin(), 7);
            }
            EXPECT_LT(glm::distance(field.grid->position(2 + kI * (3 + kJ * 1)), placeOf(2, 3, 1)),
                      1e-5);
        }
        const auto lengths = valuesOf<double>(*reader, "Momentum magnitude");
        EXPECT_DOUBLE_EQ(lengths[9], std::hypot(valueOf(1, 9), valueOf(2, 9), valueOf(3, 9)));
    }
}

// Of a series they are the files' own where they tell steps apart, else the numbers in the names.
TEST(Plot3d, TimesOfASeriesAreThoseOfItsFiles) {
    freshFolder();
    places("a.xyz", {});
    const std::vector files{flow("a.2.q", {}, 0.5), flow("a.4.q", {}, 0.75),
                            flow("a.8.q", {}, 1.5)};
    const auto own = openReader(files);
    EXPECT_EQ(own->variables()[0].time->name, "time");
    EXPECT_EQ(timesOf(*own), (std::vector{0.5, 0.75, 1.5}));
    flow("a.4.q", {}, 0.5);
    const auto twice = openReader(files);
    EXPECT_EQ(twice->variables()[0].time->name, "number");
    EXPECT_EQ(timesOf(*twice), (std::vector{2.0, 4.0, 8.0}));
}

TEST(Plot3d, AFolderIsOfItsFlows) {
    for (const auto& [xyz, q] : {std::pair{"a.xyz", "a.q"}, {"combxyz.bin", "combq.bin"}}) {
        const std::filesystem::path folder = freshFolder();
        places(xyz, {});
        const auto values = flow(q, {}, 0.5);
        const auto series = expandSeries(std::span(&folder, 1));
        EXPECT_THAT(series.files, testing::ElementsAre(values));
        EXPECT_EQ(series.recognised, std::string(q) + ", the only file to open here");
        EXPECT_FALSE(isReadable(testFolder() / xyz));
        EXPECT_THAT(refusalOf(testFolder() / xyz), HasSubstr("found a PLOT3D file of places"));
    }
}

TEST(Plot3d, StepsAreKept) {
    freshFolder();
    places("a.xyz", {});
    expectKept({flow("a.2.q", {}, 0.5), flow("a.4.q", {}, 0.75)}, 1);
}

TEST(Plot3d, ATimeThatIsNoNumberIsNone) {
    for (const bool isDouble : {false, true})
        for (const double time :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()}) {
            const How how{.isDouble = isDouble};
            freshFolder();
            places("a.xyz", how);
            const auto reader = open(flow("a.q", how, time));
            EXPECT_TRUE(reader->variables()[0].time->counted) << time;
            EXPECT_EQ(reader->variables()[0].time->name, "step");
            EXPECT_EQ(timesOf(*reader), (std::vector{0.0}));
        }
}

TEST(Plot3d, OfSeveralPlacesThoseWithTheNameMostLikeItsOwnAreTaken) {
    freshFolder();
    places("other.xyz", {}, 50);
    places("combxyz.bin", {}, 0);
    places("zzz.x", {}, 90);
    const auto reader = open(flow("combq.bin", {}));
    EXPECT_LT(glm::distance(reader->variables()[0].grid->position(1), placeOf(1, 0, 0)), 1e-5);
    EXPECT_THAT(reader->variables()[0].notes,
                testing::Contains("its places are those of combxyz.bin"));
}

TEST(Plot3d, WhatCannotBeDrawnIsTold) {
    freshFolder();
    EXPECT_THAT(
        refusalOf(flow("alone.q", {})),
        HasSubstr("expected the places of its 5 x 4 x 3 points in a PLOT3D file (XYZ) beside "
                  "it, found none"));
    EXPECT_THAT(refusalOf(places("a.xyz", {})),
                HasSubstr("expected values, found a PLOT3D file of places"));
    Plot3dFile two({});
    two.record(std::vector<std::int32_t>{2});
    two.record(std::vector<std::int32_t>{kI, kJ, kK, 2, 2, 2});
    for (const int points : {kPoints, 8}) {
        two.reals({0, 0, 0, 0});
        two.reals(std::vector<double>(std::size_t(5 * points)));
    }
    EXPECT_THAT(refusalOf(two.write("two.q")),
                HasSubstr("expected a PLOT3D file of one grid, found 2"));
    Plot3dFile flat({});
    begin(flat, {});
    flat.reals(std::vector<double>(std::size_t{3 * kPoints}));
    freshFolder();
    flat.write("flat.xyz");
    EXPECT_THAT(refusalOf(flow("flat.q", {})),
                HasSubstr("flat.xyz: expected cells that take space"));
}

// A few bytes more are what some writers leave behind; one number fewer is another file.
TEST(Plot3d, IsToldByItsSize) {
    freshFolder();
    places("a.xyz", {});
    const std::string bytes = readBytes(flow("a.q", {}));
    const auto refusalWith = [&](std::string other) {
        writeBytes(testFolder() / "b.q", other);
        return refusalOf(testFolder() / "b.q");
    };
    EXPECT_EQ(refusalWith(bytes + std::string(25, '\0')), "");
    EXPECT_THAT(refusalWith(bytes + std::string(100, '\0')), HasSubstr("no format that is known"));
    EXPECT_THAT(refusalWith(bytes.substr(0, bytes.size() - 1)),
                HasSubstr("no format that is known"));
}

// The flow, and the places beside it.
TEST(Plot3d, FilesCutOrDamagedAnywhereAreReadOrRefused) {
    for (const How& how : {How{}, How{.swapped = true, .marked = true},
                           How{.counted = true, .isDouble = true, .blanks = true}}) {
        const auto folder = freshFolder();
        const auto at = places("a.xyz", how), q = flow("a.q", how);
        damageInRounds(q, q);
        damageInRounds(at, q);
    }
}

}  // namespace
}  // namespace timeseries::plot3d

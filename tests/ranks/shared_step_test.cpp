// Run by mpirun with 1, 2, 3 and 8 processes (tests/CMakeLists.txt): each of them runs all tests,
// in the same order.
#include "timeseries/ranks/shared_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/ranks/ranks_world.h"
#include "tests/support/random_field.h"
#include "tests/support/step_bytes.h"
#include "timeseries/ranks/isochron_step.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using namespace ranks_world;

template <typename T>
void expectTheFileOfOne(const Field& whole, const GridBox& box, const fs::path& path) {
    const auto size = whole.grid->size();
    const SharedStep shared{
        {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]),
         static_cast<std::uint32_t>(size[2])},
        world().isFirst() ? "about it" : ""};
    ASSERT_EQ(flawOf(world(), box, shared.size), "");
    std::optional<WholeFile> file;
    if (world().isFirst()) file.emplace(path);
    const SortedStep step = SortedStep::build(whole);
    if (step.size() == 0) {
        EXPECT_THROW(
            writeShared(world(), partOf<T>(whole, box), box, shared, file ? &*file : nullptr),
            RanksError);
        return;
    }
    writeShared(world(), partOf<T>(whole, box), box, shared, file ? &*file : nullptr);
    if (!file) return;
    file->finish();
    EXPECT_TRUE(bytesOf(path) == tests::written(step, "about it"));
}

template <typename T>
class SharedStepOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(SharedStepOf, Types);

TYPED_TEST(SharedStepOf, IsTheFileThatOneProcessWrites) {
    const fs::path folder = sharedFolder();
    std::mt19937_64 random(17);  // the same on all ranks
    const std::vector<std::array<std::size_t, 3>> sizes{{1, 1, 1},     {64, 32, 32}, {70, 41, 37},
                                                        {33, 1, 2000}, {5, 300, 1},  {99, 50, 40}};
    for (const auto& size : sizes)
        for (int kind = 0; kind < 4; ++kind) {
            SCOPED_TRACE(testing::Message()
                         << size[0] << " x " << size[1] << " x " << size[2] << ", kind " << kind);
            const Field whole = tests::randomField<TypeParam>(random, size, kind);
            const auto boxes = cutAtRandom(random, size, world().size());
            expectTheFileOfOne<TypeParam>(whole, boxes[world().rank()], folder / "step.isostep");
        }
}

// Ids of 256 blocks lie together: here of the first 256 and of the 11 that are left.
TEST(SharedStep, BlocksThatLieTogetherMayBeOfSeveralRanks) {
    const fs::path folder = sharedFolder();
    Field whole;
    whole.grid = tests::gridOf({250, 250, 140});
    std::vector<std::uint8_t> values(whole.grid->count());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint8_t>(i * i / 1000 % 251);
    whole.values = std::move(values);
    std::mt19937_64 random(3);
    const auto boxes = cutAtRandom(random, {250, 250, 140}, world().size());
    expectTheFileOfOne<std::uint8_t>(whole, boxes[world().rank()], folder / "step.isostep");
}

TEST(SharedStep, AllPointsMissingIsTold) {
    const fs::path folder = sharedFolder();
    Field part;
    const GridBox box{{0, 0, world().rank()}, {4, 4, 1}};
    part.values = std::vector<float>(16, std::nanf(""));
    std::optional<WholeFile> file;
    if (world().isFirst()) file.emplace(folder / "step.isostep");
    try {
        writeShared(world(), part, box, {{4, 4, world().size()}, ""}, file ? &*file : nullptr);
        FAIL();
    } catch (const RanksError& error) {
        EXPECT_THAT(error.what(), HasSubstr("all its points are missing"));
    }
}

TEST(SharedStep, BoxesAreTheGridOrRefused) {
    const auto r = world().rank();
    const auto n = world().size();
    const std::array<std::uint32_t, 3> size{6, 5, 4 * n};
    EXPECT_EQ(flawOf(world(), {{0, 0, 4 * r}, {6, 5, 4}}, size), "");
    EXPECT_THAT(flawOf(world(), {{0, 0, 4 * r}, {6, 5, r == 0 ? 3u : 4u}}, size),
                HasSubstr("of the grid's " + std::to_string(120 * n) + " points"));
    EXPECT_THAT(flawOf(world(), {{0, 0, 4 * r + 1}, {6, 5, 4}}, size),
                HasSubstr("reaches out of the grid's 6 x 5 x"));
    EXPECT_THAT(flawOf(world(), {{~0ull, 0, 0}, {6, 5, 4}}, size), HasSubstr("reaches out"));
    if (n > 1) {
        EXPECT_THAT(flawOf(world(), {{0, 0, r == 1 ? 3u : 4 * r}, {6, 5, 4}}, size),
                    HasSubstr("the boxes of ranks 0 and 1 share points"));
    }
    EXPECT_THAT(flawOf(world(), {}, {1u << 16, 1u << 16, 2}), HasSubstr("expected 1 to 2^32"));
}

TEST(RanksOf, WhatOneFailsAtAllAreTold) {
    const unsigned last = world().size() - 1;
    try {
        world().agreed([&] {
            if (world().rank() == last) throw std::runtime_error("no room at all");
        });
        FAIL() << "rank " << world().rank() << " was not told";
    } catch (const RanksError& error) {
        EXPECT_STREQ(error.what(), "no room at all");
    }
    world().agreed([] {});
}

TEST(RanksOf, WhatIsExchangedComesWholeAndInOrder) {
    // From rank a to rank b go 5000 a + 300 b numbers, of several messages some of them.
    const std::uint64_t n = world().size(), me = world().rank();
    const auto number = [](std::uint64_t a, std::uint64_t b, std::uint64_t i) {
        return a << 48 | b << 32 | i;
    };
    std::vector<std::uint64_t> mine, ends, expected, expectedTo, to;
    for (std::uint64_t b = 0; b < n; ++b) {
        for (std::uint64_t i = 0; i < 5000 * me + 300 * b; ++i) mine.push_back(number(me, b, i));
        ends.push_back(mine.size());
    }
    for (std::uint64_t a = 0; a < n; ++a) {
        for (std::uint64_t i = 0; a != me && i < 5000 * a + 300 * me; ++i)
            expected.push_back(number(a, me, i));
        expectedTo.push_back(expected.size());
    }
    EXPECT_TRUE(std::ranges::equal(world().exchange<std::uint64_t>(mine, ends, to), expected));
    EXPECT_EQ(to, expectedTo);
}

// A simulation's part: slices of a wave, with ghost cells of -7 all around each.
struct Simulation {
    static constexpr std::uint64_t kSide = 20;
    std::uint64_t slices = 3, first = 3 * world().rank();
    std::vector<float> values = std::vector<float>((kSide + 2) * (kSide + 2) * (slices + 2), -7);
    isochron_step step{};

    static float valueAt(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
        return (x + y + z) % 11 == 0 ? -99.f : std::sin(static_cast<float>(x * y + 3 * z));
    }
    Simulation() {
        static const float missing = -99;
        step.variable = "u";
        step.units = "m/s";
        step.time = 1.5;
        step.time_units = "days since 2000-01-01";
        step.type = ISOCHRON_FLOAT;
        step.axis[0] = {nullptr, "m", kSide, 10, 0.5, nullptr};
        step.axis[1] = {"up", "m", kSide, 0, -1, nullptr};
        step.axis[2] = {"z", "m", slices * world().size(), 0, 1, nullptr};
        step.missing = &missing;
        step.first[2] = first;
        step.size[0] = step.size[1] = kSide;
        step.size[2] = slices;
        step.row = kSide + 2;
        step.slice = step.row * (kSide + 2);
        step.values = &values[at(0, 0, 0)];
        for (std::uint64_t z = 0; z < slices; ++z)
            for (std::uint64_t y = 0; y < kSide; ++y)
                for (std::uint64_t x = 0; x < kSide; ++x)
                    values[at(x, y, z)] = valueAt(x, y, first + z);
    }
    static std::size_t at(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
        return x + 1 + (kSide + 2) * (y + 1 + (kSide + 2) * (z + 1));
    }
    // What it says on this rank; "" where it was written.
    std::string write(const fs::path& path) const {
        char why[300] = "nothing was said";
        const int code = isochron_write_step(MPI_COMM_WORLD, path.c_str(), &step, why, sizeof why);
        EXPECT_EQ(code != 0, why[0] != '\0');
        return why;
    }
};

TEST(InSitu, ASimulationsStepIsOpenedAsItWas) {
    const fs::path path = sharedFolder() / "u_0001.isostep";
    ASSERT_EQ(Simulation().write(path), "");
    const auto reader = openReader(std::span(&path, 1));
    ASSERT_EQ(reader->variables().size(), 1u);
    const Variable& u = reader->variables()[0];
    EXPECT_EQ(u.name, "u");
    EXPECT_EQ(u.units, "m/s");
    EXPECT_EQ(u.time->points[0].value, 1.5);
    EXPECT_EQ(u.time->points[0].date, "2000-01-02 12:00:00");
    EXPECT_EQ(u.grid->axes()[0].name, "x");
    EXPECT_EQ(u.grid->axes()[1].name, "up");
    EXPECT_EQ(u.grid->position(1), glm::dvec3(10.5, 0, 0));
    const std::uint64_t side = Simulation::kSide;
    EXPECT_EQ(u.grid->position(side), glm::dvec3(10, -1, 0));

    const Field field = reader->read(0, 0);
    const auto& values = std::get<std::vector<float>>(field.values);
    ASSERT_EQ(values.size(), side * side * 3 * world().size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float expected = Simulation::valueAt(i % side, i / side % side, i / side / side);
        const bool missing = std::isnan(values[i]);
        ASSERT_EQ(missing, expected == -99.f) << i;
        if (missing) continue;
        ASSERT_EQ(values[i], expected) << i;
    }
}

TEST(InSitu, WhatCannotBeIsRefusedOnAllRanksAndTheFileStays) {
    const fs::path path = sharedFolder() / "u.isostep";
    ASSERT_EQ(Simulation().write(path), "");
    const auto before = bytesOf(path);
    const auto refusal = [&](auto change) {
        Simulation simulation;
        change(simulation.step);
        return simulation.write(path);
    };
    const bool last = world().rank() + 1 == world().size();
    EXPECT_THAT(refusal([](isochron_step& s) { s.variable = nullptr; }), HasSubstr("name"));
    EXPECT_THAT(refusal([](isochron_step& s) { s.time = INFINITY; }),
                HasSubstr("expected a finite time, found inf"));
    EXPECT_THAT(refusal([](isochron_step& s) { s.axis[1].spacing = 0; }),
                AllOf(HasSubstr("axis up"), HasSubstr("spacing that is not 0")));
    EXPECT_THAT(refusal([](isochron_step& s) {
                    s.axis[1].origin = 1e15;
                    s.axis[1].spacing = 0.01;
                }),
                AllOf(HasSubstr("axis up"), HasSubstr("monotonic")));
    EXPECT_THAT(refusal([](isochron_step& s) { s.axis[1].origin = s.axis[1].spacing = 1.5e308; }),
                HasSubstr("not all finite"));
    EXPECT_THAT(refusal([](isochron_step& s) { s.axis[0].points = 0; }), HasSubstr("1 to 2^32"));
    EXPECT_THAT(refusal([](isochron_step& s) { s.axis[0].points = ~0ull; }),
                HasSubstr("2^24 points along"));
    EXPECT_THAT(refusal([](isochron_step& s) { s.type = static_cast<isochron_type>(10); }),
                HasSubstr("expected a type"));
    EXPECT_THAT(refusal([&](isochron_step& s) {
                    if (last) s.values = nullptr;
                }),
                HasSubstr("expected the values of its box"));
    EXPECT_THAT(refusal([&](isochron_step& s) {
                    if (last) s.row = 5;
                }),
                HasSubstr("rows and slices"));
    EXPECT_THAT(refusal([&](isochron_step& s) {
                    if (last) s.slice = s.row * (s.size[1] - 1) + s.size[0] - 1;
                }),
                HasSubstr("20 and 438 values, found them 22 and 437 apart"));
    EXPECT_THAT(refusal([&](isochron_step& s) {
                    if (last) s.size[2] = 1;
                }),
                HasSubstr("of the grid's"));
    for (std::uint64_t isochron_step::*apart : {&isochron_step::row, &isochron_step::slice})
        EXPECT_THAT(refusal([&](isochron_step& s) {
                        if (!last) return;
                        s.slice = 0;
                        s.*apart = ~0ull / 2;
                    }),
                    HasSubstr("rows and slices in memory"));
    static const float other = -98;
    if (world().size() > 1) {
        EXPECT_THAT(refusal([&](isochron_step& s) {
                        if (last) s.type = ISOCHRON_INT32;
                    }),
                    HasSubstr("the same type, grid and missing value on all ranks"));
        EXPECT_THAT(refusal([&](isochron_step& s) {
                        if (last) s.missing = &other;
                    }),
                    HasSubstr("the same missing value on all ranks"));
    }
    std::array<char, 100> said{};
    EXPECT_NE(isochron_write_step(MPI_COMM_WORLD, path.c_str(), nullptr, said.data(), said.size()),
              0);
    EXPECT_THAT(said.data(), HasSubstr("expected a step"));
    const double uneven[Simulation::kSide] = {0, 2, 1};
    EXPECT_THAT(refusal([&](isochron_step& s) { s.axis[0].coordinates = uneven; }),
                HasSubstr("axis x"));
    Simulation simulation;
    EXPECT_THAT(simulation.write(path.parent_path() / "none" / "u.isostep"),
                HasSubstr("No such file or directory"));
    world().fromFirst("");
    EXPECT_TRUE(bytesOf(path) == before);
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST(InSitu, AMessageIsCutToItsRoom) {
    Simulation simulation;
    simulation.step.variable = nullptr;
    char why[9] = "********";
    EXPECT_NE(isochron_write_step(MPI_COMM_WORLD, "u.isostep", &simulation.step, why, 8), 0);
    EXPECT_STREQ(why, "expecte");
    EXPECT_NE(isochron_write_step(MPI_COMM_WORLD, "u.isostep", &simulation.step, nullptr, 0), 0);
}

}  // namespace
}  // namespace timeseries

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    if (!timeseries::ranks_world::world().isFirst()) GTEST_FLAG_SET(brief, true);
    const int code = RUN_ALL_TESTS();
    MPI_Finalize();
    return code;
}

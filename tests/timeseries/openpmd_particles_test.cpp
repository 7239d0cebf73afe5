// openPMD particles: where they lie, what they carry, iterations of other numbers of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/openpmd_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/scattered.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

// Within a unit cube, the same from call to call.
std::vector<double> coordinates(std::size_t count, int of) {
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(std::fmod(0.618034 * double(i * i + 7 * i) + 0.37 * of * double(i), 1.0));
    return all;
}

// Of species e: positions in units of 1e-6 m beside offsets in units of 1e-3 m.
void putSpecies(OpenPmdFile& file, int iteration, std::size_t count) {
    const std::string species = fmt::format("data/{}/particles/e/", iteration);
    for (int c = 0; c < 3; ++c) {
        const std::string axis(1, "xyz"[c]);
        file.put(species + "position/" + axis, coordinates(count, c));
        file.say(species + "position/" + axis, "unitSI", 1e-6);
        file.constant(species + "positionOffset/" + axis, std::int64_t{c + 1}, {count});
        file.say(species + "positionOffset/" + axis, "unitSI", 1e-3);
        std::vector<float> momentum;
        for (std::size_t i = 0; i < count; ++i) momentum.push_back(float(i) + 0.25f * float(c));
        file.put(species + "momentum/" + axis, momentum);
    }
    file.say(species + "momentum", "unitDimension", std::vector<double>{1, 1, -1, 0, 0, 0, 0});
    std::vector<std::uint64_t> id;
    for (std::size_t i = 0; i < count; ++i) id.push_back((std::uint64_t{1} << 63) + i);
    file.put(species + "id", id);
    file.constant(species + "charge", -1.0, {count});
    file.say(species + "charge", "unitSI", 1.602e-19);
    file.put(species + "particlePatches/numParticles", std::vector<std::uint64_t>{count});
    file.put(species + "particlePatches/offset/x", std::vector<double>{0});
}

TEST(OpenPmdParticles, LieAtPositionsBesideOffsets) {
    OpenPmdFile file;
    file.iteration(4, 1.5);
    putSpecies(file, 4, 100);
    const auto reader = open(file.close());
    std::vector<std::string> names;
    for (const Variable& variable : reader->variables()) names.push_back(variable.name);
    EXPECT_THAT(names, testing::UnorderedElementsAre("e/momentum/x", "e/momentum/y", "e/momentum/z",
                                                     "e/id", "e/charge"));
    EXPECT_TRUE(reader->damaged().empty());
    EXPECT_THAT(timesOf(*reader), ElementsAre(1.5));
    const Variable& momentum = reader->variables()[indexOf(*reader, "e/momentum/y")];
    EXPECT_EQ(momentum.units, "m kg s-1");
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < 100; ++i)
        places.emplace_back(1e-6 * coordinates(100, 0)[i] + 1e-3,
                            1e-6 * coordinates(100, 1)[i] + 2e-3,
                            1e-6 * coordinates(100, 2)[i] + 3e-3);
    EXPECT_EQ(*momentum.grid->mesh(), meshOfScattered(places));
    EXPECT_EQ(momentum.grid->axes()[0].units, "m");
    EXPECT_EQ(valuesOf<float>(*reader, "e/momentum/y")[7], 7.25f);
    EXPECT_EQ(valuesOf<std::uint64_t>(*reader, "e/id")[99], (std::uint64_t{1} << 63) + 99);
    EXPECT_EQ(valuesOf<double>(*reader, "e/charge"), std::vector<double>(100, -1));
}

// There may be none at first.
TEST(OpenPmdParticles, ComeAndGo) {
    OpenPmdFile file;
    for (const auto& [n, count] : {std::pair(0, 0), std::pair(10, 40), std::pair(20, 25)}) {
        file.iteration(n, n);
        if (count > 0) {
            putSpecies(file, n, std::size_t(count));
            continue;
        }
        file.constant(fmt::format("data/{}/particles/e/position/x", n), 0.0, {0});
        file.constant(fmt::format("data/{}/particles/e/momentum/x", n), 0.0f, {0});
    }
    const auto reader = open(file.close());
    EXPECT_THAT(timesOf(*reader), ElementsAre(10, 20));
    EXPECT_EQ(valuesOf<float>(*reader, "e/momentum/x", 0).size(), 40u);
    const Field second = reader->read(indexOf(*reader, "e/momentum/x"), 1);
    EXPECT_EQ(second.grid->count(), 25u);
    EXPECT_EQ(std::get<std::vector<float>>(second.values).size(), 25u);
    const Field again = reader->read(indexOf(*reader, "e/id"), 0);
    EXPECT_EQ(again.grid->count(), 40u);
}

TEST(OpenPmdParticles, InAPlaneLieInIt) {
    OpenPmdFile file;
    file.put("data/0/particles/p/position/x", std::vector<std::int32_t>{1, 2, 3, 5});
    file.put("data/0/particles/p/position/z", std::vector<float>{0, 1, 0, 1});
    file.put("data/0/particles/p/weighting", std::vector<float>{1, 2, 3, 4});
    const auto reader = open(file.close());
    EXPECT_EQ(reader->variables()[0].name, "p/weighting");
    EXPECT_NEAR(reader->variables()[0].grid->position(3).x, 5, 1e-6);
    EXPECT_NEAR(reader->variables()[0].grid->position(3).z, 1, 1e-6);
    EXPECT_EQ(reader->variables()[0].grid->position(3).y, 0);
}

TEST(OpenPmdParticles, WithoutAPlaceAreNotDrawn) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    OpenPmdFile file;
    file.put("data/0/particles/p/position/x", std::vector<double>{nan, 2, infinity, 5, 6});
    file.put("data/0/particles/p/weighting", std::vector<float>{1, 2, 3, 4, 5});
    const auto reader = open(file.close());
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.absent(), 2u);
    EXPECT_GT(tests::volume(mesh, 1), 0);
    EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("2 of 5 points")));
}

TEST(OpenPmdParticles, NumbersThatDoNotFitAreRefused) {
    const auto told = [](const auto& change) {
        OpenPmdFile file;
        file.put("data/3/particles/p/position/x", std::vector<double>{1, 2, 3});
        change(file);
        return refusalOf(file.close());
    };
    using File = OpenPmdFile&;
    const std::string p = "data/3/particles/p/";
    const auto weigh = [&](File f) { f.put(p + "weighting", std::vector<float>{1, 2, 3}); };
    EXPECT_EQ(told(weigh), "");
    EXPECT_THAT(told([](File) {}), HasSubstr("data: expected a mesh or particles with positions"));
    EXPECT_THAT(told([&](File f) {
                    f.put(p + "weighting", std::vector<float>{1, 2});
                }),
                HasSubstr("iteration 3: record component 'p/weighting': expected 3 numbers"));
    EXPECT_THAT(told([&](File f) {
                    f.put(p + "weighting", std::vector<float>{1, 2, 3}, 3);
                }),
                HasSubstr("expected 3 numbers"));
    EXPECT_THAT(told([&](File f) {
                    weigh(f);
                    f.put(p + "position/y", std::vector<double>{1, 2});
                }),
                HasSubstr("'p/position/y': expected a number of each of 3 particles, found 2"));
    EXPECT_THAT(told([&](File f) {
                    weigh(f);
                    f.say(p + "position/x", "unitSI", std::vector<double>{});
                }),
                HasSubstr("expected unitSI"));
    EXPECT_THAT(told([&](File f) {
                    weigh(f);
                    f.say(p + "position/x", "unitSI", 0.0);
                }),
                HasSubstr("expected unitSI, a number that is not 0"));
    EXPECT_THAT(told([&](File f) {
                    weigh(f);
                    f.put("data/4/particles/p/position/x", std::vector<double>{1, 2, 3});
                    f.put("data/4/particles/p/weighting", std::vector<double>{1, 2, 3});
                }),
                HasSubstr("iteration 4: record component 'p/weighting': expected 3 numbers of "
                          "type float32"));
    // All of them in one place that a few bytes state.
    const auto constant = [](std::uint64_t count) {
        OpenPmdFile file;
        file.constant("data/0/particles/p/position/x", 1.0, {count});
        file.constant("data/0/particles/p/weighting", 1.0, {count});
        return refusalOf(file.close());
    };
    EXPECT_THAT(constant(std::uint64_t{1} << 31), HasSubstr("expected values that a file of"));
}

}  // namespace
}  // namespace timeseries

#include "timeseries/readers/sequence_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/files.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::timesOf;
using Path = std::filesystem::path;

// What a fake file holds. Step t of variable v is filled with first + t + 100 v.
struct Content {
    std::vector<std::string> variables{"v"};
    TimeAxis time{"step", "", "", {{0, ""}}, true};
    std::string units = "K";
    ValueType type = ValueType::F32;
    std::vector<double> x{0, 1};
    float first = 0;
    bool nameless = false;
};

TimeAxis seconds(const std::vector<double>& values, const std::string& units = "s") {
    TimeAxis axis{"time", units, "", {}};
    for (const double value : values) axis.points.push_back({value, ""});
    return axis;
}

class FakeReader final : public Reader {
 public:
    FakeReader(const Path& path, const Content& content, int& open)
        : paths_{path}, content_(content), open_(open) {
        ++open_;
        const auto grid = std::make_shared<Grid>(std::array<Axis, 3>{
            Axis{"x", "", content.x}, Axis{"y", "", {0, 1}}, Axis{"z", "", {0}}});
        const auto time = std::make_shared<TimeAxis>(content.time);
        for (const std::string& name : content.variables) {
            Variable variable;
            variable.name = name;
            variable.nameless = content.nameless;
            variable.units = content.units;
            variable.type = content.type;
            variable.grid = grid;
            variable.time = time;
            variables_.push_back(variable);
        }
    }
    ~FakeReader() override { --open_; }
    FakeReader(const FakeReader&) = delete;
    FakeReader& operator=(const FakeReader&) = delete;
    std::string format() const override { return "fake"; }
    std::span<const Path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override {
        const float value = content_.first + static_cast<float>(step + 100 * variable);
        const auto& grid = variables_[variable].grid;
        return {grid, std::vector<float>(grid->count(), value), {}};
    }

 private:
    std::vector<Path> paths_;
    Content content_;
    int& open_;
    std::vector<Variable> variables_;
};

class Sequence : public testing::Test {
 protected:
    std::unique_ptr<Reader> open(const GlanceAt& glanceAt = {}) {
        std::vector<Path> paths;
        for (const auto& [name, content] : files_) paths.emplace_back(name);
        const auto openOne = [this](const Path& path) -> std::unique_ptr<Reader> {
            ++opened_;
            if (path == broken_) throw FileError(path.string() + ": expected more bytes");
            auto reader = std::make_unique<FakeReader>(path, files_.at(path.string()), open_);
            mostOpen_ = std::max(mostOpen_, open_);
            return reader;
        };
        return openSequence(paths, openOne, glanceAt);
    }
    // Of files of one step as they are now; nothing of others.
    std::unique_ptr<Reader> openAtAGlance() {
        return open([this](const Path& path) -> std::optional<Glance> {
            const Content& content = files_.at(path.string());
            if (content.time.points.size() > 1) return std::nullopt;
            Glance glance{std::make_shared<const TimeAxis>(content.time), content.variables, ""};
            if (path == broken_) glance.flaw = path.string() + ": expected more bytes";
            return glance;
        });
    }
    std::string failure() {
        try {
            open();
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    }

    std::map<std::string, Content> files_;
    Path broken_;
    int open_ = 0, opened_ = 0, mostOpen_ = 0;
};

float firstValue(Reader& reader, std::size_t variable, std::size_t step) {
    return std::get<std::vector<float>>(reader.read(variable, step).values)[0];
}

TEST_F(Sequence, FilesWithoutTimesAreNumberedAsTheirNamesAre) {
    files_ = {{"a_001.f", {.first = 1}}, {"a_041.f", {.first = 2}}, {"a_082.f", {.first = 3}}};
    const auto reader = open();
    EXPECT_EQ(reader->format(), "fake");
    EXPECT_EQ(reader->files().size(), 3u);
    EXPECT_EQ(reader->variables()[0].time->name, "number");
    EXPECT_EQ(reader->variables()[0].time->units, "");
    EXPECT_THAT(timesOf(*reader), ElementsAre(1, 41, 82));
    EXPECT_THAT(reader->variables()[0].notes, IsEmpty());
    for (const std::size_t step : {2u, 0u, 1u, 2u})
        EXPECT_EQ(firstValue(*reader, 0, step), static_cast<float>(step + 1));
    EXPECT_EQ(reader->read(0, 1).grid, reader->variables()[0].grid) << "shared";
    EXPECT_EQ(reader->stepsOf(0, 1)->first, 1u);
    EXPECT_EQ(reader->stepsOf(0, 1)->count, 1u);
}

TEST_F(Sequence, DecimalNumbersOfTheNamesAreTimes) {
    files_ = {{"t_0.25.f", {}}, {"t_0.50.f", {}}, {"t_1.10.f", {}}};
    EXPECT_THAT(timesOf(*open()), ElementsAre(.25, .5, 1.1));
}

TEST_F(Sequence, FilesWithoutTimesAndNumbersAreCounted) {
    files_ = {{"friday.f", {}}, {"monday.f", {}}};
    const auto reader = open();
    EXPECT_EQ(reader->variables()[0].time->name, "step");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1));
}

TEST_F(Sequence, TimesOfTheFilesAreTakenWhereTheyAscend) {
    files_ = {{"a_1.f", {.time = seconds({0.5, 1})}},
              {"a_2.f", {.time = seconds({3}), .first = 10}},
              {"a_3.f", {.time = seconds({4, 8, 9}), .first = 20}}};
    const auto reader = open();
    EXPECT_EQ(reader->variables()[0].time->name, "time");
    EXPECT_EQ(reader->variables()[0].time->units, "s");
    EXPECT_THAT(timesOf(*reader), ElementsAre(0.5, 1, 3, 4, 8, 9));
    EXPECT_EQ(firstValue(*reader, 0, 1), 1);
    EXPECT_EQ(firstValue(*reader, 0, 2), 10);
    EXPECT_EQ(firstValue(*reader, 0, 5), 22);
    EXPECT_EQ(reader->stepsOf(0, 2)->first, 3u);
    EXPECT_EQ(reader->stepsOf(0, 2)->count, 3u);
}

TEST_F(Sequence, EqualTimesAreToldAndNotUsed) {
    files_ = {{"a_1.f", {.time = seconds({5})}}, {"a_4.f", {.time = seconds({5})}}};
    const auto equal = open();
    EXPECT_THAT(timesOf(*equal), ElementsAre(1, 4));
    EXPECT_EQ(equal->variables()[0].time->name, "number");
    EXPECT_THAT(equal->variables()[0].notes,
                ElementsAre("the files' own times are not used, steps are numbered as the files "
                            "are: a_1.f and a_4.f both have 5"));
    files_.at("a_4.f").time = seconds({std::nan("")});
    EXPECT_THAT(open()->variables()[0].notes,
                ElementsAre(HasSubstr("a_4.f has one that is no number")));
    files_.at("a_4.f").time = seconds({9}, "h");
    EXPECT_THAT(open()->variables()[0].notes, ElementsAre(HasSubstr("in \"h\"")));
    files_.at("a_4.f").time = seconds({9});
    files_.at("a_4.f").time.name = "TimeStep";
    EXPECT_THAT(timesOf(*open()), ElementsAre(1, 4));
    EXPECT_THAT(open()->variables()[0].notes,
                ElementsAre(HasSubstr("those of a_1.f are called 'time', those of a_4.f "
                                      "'TimeStep'")));
    files_.at("a_4.f").time = Content{}.time;
    EXPECT_THAT(open()->variables()[0].notes, ElementsAre(HasSubstr("a_4.f has none")));
}

TEST_F(Sequence, OverlappingFilesOfSeveralStepsAreRefused) {
    files_ = {{"a_1.f", {.time = seconds({1, 5})}}, {"a_2.f", {.time = seconds({2, 6})}}};
    EXPECT_EQ(failure(),
              "a_1.f and a_2.f: variable 'v': expected times that do not overlap, found 1 to 5 and "
              "2 to 6");
}

TEST_F(Sequence, FilesThatDifferAreRefusedNamingBoth) {
    const auto with = [&](const Content& other) {
        files_ = {{"a_1.f", {}}, {"a_2.f", {}}, {"a_3.f", other}};
        return failure();
    };
    EXPECT_THAT(with({.units = "degC"}),
                "a_1.f and a_3.f: variable 'v': expected the same units, found \"K\" and \"degC\"");
    EXPECT_THAT(with({.type = ValueType::I16}), HasSubstr("same type, found float32 and int16"));
    EXPECT_THAT(with({.x = {0, 1, 2}}),
                HasSubstr("same grid, found 2 x 2 x 1 and 3 x 2 x 1 points"));
    EXPECT_THAT(with({.x = {0, 2}}), HasSubstr("same grid, but their 2 x 2 x 1 points lie"));
    EXPECT_THAT(with({.variables = {"w"}}), HasSubstr("but the second has no 'v'"));
}

TEST_F(Sequence, VariablesAreMatchedByName) {
    files_ = {{"a_1.f", {.variables = {"u", "v"}}},
              {"a_2.f", {.variables = {"extra", "v", "u"}, .first = 10}}};
    const auto reader = open();
    ASSERT_EQ(reader->variables().size(), 2u);
    EXPECT_EQ(firstValue(*reader, 0, 1), 10 + 200);
    EXPECT_EQ(firstValue(*reader, 1, 1), 10 + 100);
    EXPECT_EQ(reader->variables()[0].time, reader->variables()[1].time);
    EXPECT_THAT(reader->variables()[0].notes,
                Contains("'extra' is not in the first file: it is left out"));
}

TEST_F(Sequence, NamelessArraysAreOneVariableNamedAsTheFilesAre) {
    const auto nameOf = [&](const std::vector<std::string>& stems) {
        files_.clear();
        for (const std::string& stem : stems)
            files_[stem + ".f"] = {.variables = {stem}, .nameless = true};
        return open()->variables()[0].name;
    };
    EXPECT_EQ(nameOf({"run_009", "run_010"}), "run");
    EXPECT_EQ(nameOf({"a", "ab"}), "a");
    EXPECT_EQ(nameOf({"1", "2"}), "values");
    EXPECT_EQ(nameOf({"t\u00e9", "t\u00e8"}), "t") << "no half of a character";

    files_ = {{"r1.f", {.variables = {"r1"}, .first = 1, .nameless = true}},
              {"r2.f", {.variables = {"r2"}, .first = 2, .nameless = true}}};
    const auto reader = open();
    EXPECT_THAT(reader->variables()[0].notes, IsEmpty());
    EXPECT_EQ(firstValue(*reader, 0, 1), 2);
    files_.at("r2.f").nameless = false;
    EXPECT_THAT(failure(), HasSubstr("but the second has no 'r1'"));
}

TEST_F(Sequence, AnUnreadableFileIsNamed) {
    files_ = {{"a_1.f", {}}, {"a_2.f", {}}};
    broken_ = "a_2.f";
    EXPECT_EQ(failure(), "a_2.f: expected more bytes");
}

TEST_F(Sequence, FewFilesAreOpenAtOnce) {
    for (int i = 0; i < 20; ++i)
        files_[fmt::format("a_{:02}.f", i)] = {.first = static_cast<float>(i)};
    const auto reader = open();
    EXPECT_EQ(opened_, 20);
    EXPECT_LE(mostOpen_, 2);
    for (std::size_t step = 0; step < 20; ++step)
        for (int again = 0; again < 3; ++again)
            EXPECT_EQ(firstValue(*reader, 0, step), static_cast<float>(step));
    EXPECT_EQ(opened_, 40);
    EXPECT_LE(mostOpen_, 4);
}

TEST_F(Sequence, AFileThatChangedIsToldWhenItIsRead) {
    files_ = {{"a_1.f", {}}, {"a_2.f", {}}};
    const auto reader = open();
    files_.at("a_2.f").x = {0, 1, 2};
    EXPECT_THROW(reader->read(0, 1), FileError);
    EXPECT_EQ(firstValue(*reader, 0, 0), 0);
    files_.at("a_2.f") = {.time = seconds({1, 2})};
    EXPECT_THROW(reader->read(0, 1), FileError);
    files_.at("a_2.f") = {.first = 7};
    EXPECT_EQ(firstValue(*reader, 0, 1), 7);
}

TEST_F(Sequence, ATimeThatChangedIsToldWhenItIsRead) {
    files_ = {{"a_1.f", {.time = seconds({1})}}, {"a_2.f", {.time = seconds({2})}}};
    const auto reader = open();
    files_.at("a_2.f").time = seconds({3});
    try {
        reader->read(0, 1);
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_STREQ(error.what(),
                     "a_2.f: expected the time 2 as when the series was opened, found 3");
    }
    // Where steps are numbered by names, times are not told.
    files_.at("a_2.f").time = seconds({1});
    const auto numbered = open();
    files_.at("a_2.f").time = seconds({3});
    EXPECT_EQ(firstValue(*numbered, 0, 1), 0);
}

TEST_F(Sequence, FilesThatAreGlancedAtAreOpenedWhenTheirStepIsRead) {
    for (int i = 0; i < 20; ++i)
        files_[fmt::format("a_{:02}.f", i)] = {.time = seconds({0.5 * i}),
                                               .first = static_cast<float>(i)};
    const auto reader = openAtAGlance();
    EXPECT_EQ(opened_, 1);
    ASSERT_EQ(timesOf(*reader).size(), 20u);
    for (std::size_t step = 0; step < 20; ++step) {
        EXPECT_EQ(timesOf(*reader)[step], 0.5 * static_cast<double>(step));
        EXPECT_EQ(reader->stepsOf(0, step)->first, step);
        EXPECT_EQ(firstValue(*reader, 0, step), static_cast<float>(step));
    }
    EXPECT_EQ(opened_, 20) << "the first once";
    EXPECT_LE(mostOpen_, 4);
}

TEST_F(Sequence, WhatAGlanceShowsOfMisfitsIsTold) {
    files_ = {{"a_1.f", {}},
              {"a_2.f", {.variables = {"w"}}},
              {"a_3.f", {.first = 3}},
              {"a_4.f", {.variables = {"v", "x"}}},
              {"a_5.f", {.first = 5}}};
    broken_ = "a_3.f";
    const auto reader = openAtAGlance();
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre("'w' is not in the first file: it is left out",
                            "'x' is not in the first file: it is left out",
                            "the steps of 2 of 5 files cannot be read, the first: a_1.f and a_2.f: "
                            "expected the same variables, but the second has no 'v'"));
    EXPECT_THROW(reader->read(0, 1), FileError);
    EXPECT_THROW(reader->read(0, 2), FileError);
    EXPECT_EQ(firstValue(*reader, 0, 4), 5);
    broken_ = "";
    EXPECT_EQ(firstValue(*reader, 0, 2), 3) << "it is whole now";
    EXPECT_NO_THROW(reader->expectToFit(3));
    EXPECT_THROW(reader->expectToFit(1), FileError);
}

TEST_F(Sequence, FilesOfSeveralStepsAreOpenedForThem) {
    files_ = {{"a_1.f", {.time = seconds({0, 1})}},
              {"a_2.f", {.time = seconds({2, 3, 4}), .first = 2}},
              {"a_3.f", {.time = seconds({5}), .first = 5}}};
    const auto reader = openAtAGlance();
    EXPECT_EQ(opened_, 2);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1, 2, 3, 4, 5));
    for (std::size_t step = 0; step < 6; ++step)
        EXPECT_EQ(firstValue(*reader, 0, step), static_cast<float>(step));
}

// NetCDF files joined by their numbers, for they have no times.
TEST(NetcdfNumbered, FilesWithoutTimeAreNumberedAsTheirNamesAre) {
    const Path folder = tests::freshFolder();
    std::vector<Path> paths;
    for (const char* name : {"a_1.nc", "a_41.nc", "a_82.nc"}) {
        tests::NetcdfBuilder file(name);
        const int y = file.dimension("y", 2), x = file.dimension("x", 2);
        const int v = file.variable("v", NC_FLOAT, {y, x});
        file.write(v, std::vector<float>(4, 1));
        paths.push_back(folder / name);
        std::filesystem::rename(file.close(), paths.back());
    }
    const auto reader = openReader(paths);
    EXPECT_EQ(reader->variables()[0].time->name, "number");
    EXPECT_THAT(timesOf(*reader), ElementsAre(1, 41, 82));
    EXPECT_EQ(reader->stepsOf(0, 2)->first, 2u);
}

// As where a simulation keeps its last files alone.
TEST(NetcdfNumbered, AFileThatIsGoneIsToldWhenItIsRead) {
    const Path folder = tests::freshFolder();
    std::vector<Path> paths;
    for (int i = 0; i < 9; ++i) {
        tests::NetcdfBuilder file("a.nc");
        const int y = file.dimension("y", 2), x = file.dimension("x", 2);
        file.write(file.variable("v", NC_FLOAT, {y, x}), std::vector<float>(4, 1));
        paths.push_back(folder / fmt::format("a_{}.nc", i));
        std::filesystem::rename(file.close(), paths.back());
    }
    const auto reader = openReader(paths);
    std::filesystem::remove(paths[4]);
    try {
        reader->read(0, 4);
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_EQ(error.what(), paths[4].string() + ": expected a file, but there is none");
    }
    EXPECT_NO_THROW(reader->read(0, 5));
}

}  // namespace
}  // namespace timeseries

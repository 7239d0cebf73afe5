#include "app/choices/preferences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "app/choices/user_files.h"
#include "tests/support/files.h"
#include "tests/support/variable.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Preferences, ReadAsTheyWereWritten) {
    const auto folder = tests::freshFolder();
    const auto file = folder / "made" / "preferences.json";
    for (const char* name : {"a.nc", "b.nc"}) tests::writeBytes(folder / name, "");
    Preferences preferences{.recent = {},
                            .uiScale = 1.5,
                            .frameMilliseconds = 25,
                            .moving = Moving::Error,
                            .movingError = 0.25,
                            .movingRung = {Model::Points, 8, 2},
                            .costs = {.points = {{1e6 / 3, 0.1, 2e6}}, .cells = {{0, 70, 5e4}}}};
    remember(preferences, {folder / "a.nc"});
    remember(preferences, {folder});
    remember(preferences, {folder / "*.n[co]"});
    remember(preferences, {folder / "b.nc", folder / "a.nc"});
    writePreferences(preferences, file);
    const auto [read, problem] = readPreferences(file);
    EXPECT_EQ(read, preferences);
    EXPECT_EQ(problem, "");
    EXPECT_EQ(readPreferences(folder / "gone.json").preferences, Preferences{});
    EXPECT_EQ(readPreferences(folder / "gone.json").problem, "");
}

TEST(Preferences, RecentFilesAreTheTenNewestOnceEach) {
    const auto folder = tests::freshFolder();
    Preferences preferences;
    for (int i = 0; i < 12; ++i) remember(preferences, {folder / fmt::format("{}", i)});
    remember(preferences, {folder / "x" / ".." / "5"});
    remember(preferences, {folder / "8" / ""});
    std::vector<std::string> names;
    for (const Named& named : preferences.recent) names.push_back(shortName(named));
    EXPECT_THAT(names, ElementsAre("8", "5", "11", "10", "9", "7", "6", "4", "3", "2"));
}

// JSON holds UTF-8 alone.
TEST(Preferences, RecentFilesOfLatin1AndOfPercentSignsAreFoundAgain) {
    const auto folder = tests::freshFolder();
    Preferences preferences;
    for (const char* name : {"t\xe9l\xe9.nc", "10%.nc", "%E9.nc"}) {
        tests::writeBytes(folder / name, "");
        remember(preferences, {folder / name});
    }
    ASSERT_EQ(preferences.recent.size(), 3u);
    writePreferences(preferences, folder / "p.json");
    EXPECT_EQ(readPreferences(folder / "p.json").preferences.recent, preferences.recent);
    tests::writeBytes(folder / "p.json", R"({"recentFilesEscaped": true, "recentFiles": ["%x"]})");
    EXPECT_THAT(readPreferences(folder / "p.json").problem, HasSubstr("%"));
}

TEST(Preferences, SeveralFilesAreAnotherThingThanTheFirstOfThem) {
    Preferences preferences;
    remember(preferences, {"/a.nc"});
    remember(preferences, {"/a.nc", "/b.nc", "/c.nc"});
    EXPECT_THAT(preferences.recent, ElementsAre(Named{"/a.nc", "/b.nc", "/c.nc"}, Named{"/a.nc"}));
    EXPECT_EQ(shortName(preferences.recent[0]), "a.nc and 2 more");
}

TEST(Preferences, RecentFilesThatAreGoneAreLeftOut) {
    const auto folder = tests::freshFolder();
    tests::writeBytes(folder / "here", "");
    Preferences preferences;
    const std::vector<Named> there = {{folder / "here"},
                                      {folder / "run_*.nc"},
                                      {folder / "*" / "?.nc"},
                                      {folder / "here", folder}};
    for (const Named& named : there) remember(preferences, named);
    remember(preferences, {folder / "gone"});
    remember(preferences, {folder / "gone" / "run_*.nc"});
    remember(preferences, {folder / "here", folder / "gone"});
    writePreferences(preferences, folder / "p.json");
    EXPECT_THAT(readPreferences(folder / "p.json").preferences.recent,
                testing::UnorderedElementsAreArray(there));
}

TEST(Preferences, ADamagedFileIsToldAndTheUsualOnesHold) {
    const auto file = tests::freshFolder() / "preferences.json";
    for (const auto& [text, why] : std::vector<std::pair<std::string, std::string>>{
             {"", "not JSON"},
             {"{\"uiScale\": 2", "not JSON at byte"},
             {"[]", "not a JSON object"},
             {R"({"uiScale": "big"})", "uiScale is not a number from 0.5 to 4"},
             {R"({"uiScale": 100})", "uiScale"},
             {R"({"frameMilliseconds": 0})", "frameMilliseconds"},
             {R"({"frameMilliseconds": 1e999})", "beyond all doubles"},
             {R"({"movingRung": 7})", "movingRung has no model"},
             {R"({"movingRung": {"model": "cells", "stride": 32}})",
              "stride is not a number from 1 to 16"},
             {R"({"moving": "fast"})", "moving is none of pace, error, fixed and all"},
             {R"({"moving": 1})", "moving is none of"},
             {R"({"movingError": 2})", "movingError is not a number from 0.0001 to 1"},
             {R"({"recentFiles": "a.nc"})", "recentFiles is not a list of texts"},
             {R"({"recentFiles": [[]]})", "recentFiles"},
             {R"({"recentFiles": [["a.nc", ["b.nc"]]]})", "recentFiles"},
             {R"({"recentFiles": [1]})", "recentFiles"},
             {std::string("\x00\xff", 2), "not JSON"}}) {
        tests::writeBytes(file, text);
        const auto [preferences, problem] = readPreferences(file);
        EXPECT_EQ(preferences, Preferences{}) << text;
        EXPECT_THAT(problem, HasSubstr(why)) << text;
        EXPECT_THAT(problem, HasSubstr(file.string())) << text;
    }
}

TEST(Preferences, WhatCannotBeReadIsToldLikeDamage) {
    const auto folder = tests::freshFolder();
    std::filesystem::create_directory(folder / "folder.json");
    ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
    std::filesystem::create_symlink("/proc/self/mem", folder / "no_bytes.json");  // it has no first
    for (const auto& [name, why] : {std::pair("folder.json", "expected a file, but it is a folder"),
                                    std::pair("pipe.json", "expected an ordinary file"),
                                    std::pair("no_bytes.json", "it cannot be read")}) {
        const auto [preferences, problem] = readPreferences(folder / name);
        EXPECT_EQ(preferences, Preferences{}) << name;
        EXPECT_EQ(problem, fmt::format("{}: the preferences are not used: {}",
                                       (folder / name).string(), why));
    }
    EXPECT_EQ(readPreferences(folder / "none.json").problem, "");
}

TEST(Preferences, CostsThatCannotBeAreNotKnownAndTheOthersHold) {
    const auto file = tests::freshFolder() / "preferences.json";
    const auto costs = [&](const std::string& text) {
        tests::writeBytes(file, R"({"uiScale": 2, "drawingCosts": )" + text + "}");
        const auto [preferences, problem] = readPreferences(file);
        EXPECT_EQ(problem, "") << text;
        EXPECT_EQ(preferences.uiScale, 2) << text;
        return preferences.costs;
    };
    const std::string cells =
        R"("cells": {"fixedNanoseconds": 1e6, "perSplatNanoseconds": 30, "splats": 40000})";
    const DrawingCosts known{.points = {}, .cells = {{1e6, 30, 40'000}}};
    const auto pointsOf = [](const std::string& fixed, const std::string& perSplat,
                             const std::string& splats) {
        return R"({"fixedNanoseconds": )" + fixed + R"(, "perSplatNanoseconds": )" + perSplat +
               R"(, "splats": )" + splats + "}";
    };
    ASSERT_TRUE(costs(R"({"points": )" + pointsOf("0", "1", "1") + "}").points);
    for (const std::string& points :
         {std::string("3"), std::string("{}"), std::string("null"), std::string("[1, 2, 3]"),
          std::string(R"({"fixedNanoseconds": 1, "perSplatNanoseconds": 1})"),
          pointsOf("-1", "1", "1"), pointsOf("1e12", "1", "1"), pointsOf("1", "0", "1"),
          pointsOf("1", "-5", "1"), pointsOf("1", "1e300", "1"), pointsOf("1", "1", "0"),
          pointsOf("1", "1", "1e12"), pointsOf("null", "1", "1"), pointsOf("\"1\"", "1", "1")})
        EXPECT_EQ(costs(R"({"points": )" + points + ", " + cells + "}"), known) << points;
    for (const char* none : {"3", "{}", "null", "[]", "\"fast\""})
        EXPECT_EQ(costs(none), DrawingCosts{}) << none;
}

TEST(Preferences, AKeyOfALaterVersionIsNoDamage) {
    const auto file = tests::freshFolder() / "preferences.json";
    tests::writeBytes(file, R"({"uiScale": 2, "later": {}})");
    EXPECT_EQ(readPreferences(file).problem, "");
    EXPECT_EQ(readPreferences(file).preferences.uiScale, 2);
}

TEST(UserFiles, AreWhereTheEnvironmentSays) {
    const tests::Variable home("HOME", "/home/ann");
    {
        const tests::Variable config("XDG_CONFIG_HOME", "/c"), state("XDG_STATE_HOME", "/s");
        EXPECT_EQ(configFolder(), "/c/isochron");
        EXPECT_EQ(stateFolder(), "/s/isochron");
    }
    {
        // What is not absolute counts as unset.
        const tests::Variable config("XDG_CONFIG_HOME", "c"), state("XDG_STATE_HOME", "");
        EXPECT_EQ(configFolder(), "/home/ann/.config/isochron");
        EXPECT_EQ(stateFolder(), "/home/ann/.local/state/isochron");
    }
    const tests::Variable config("XDG_CONFIG_HOME", std::nullopt), nowhere("HOME", std::nullopt);
    EXPECT_EQ(configFolder(), "");
}

TEST(UserFiles, AWriteThatFailsLeavesWhatWasThere) {
    const auto folder = tests::freshFolder();
    std::filesystem::create_directories(folder / "a.json");  // in the way
    EXPECT_THROW(writeWhole(folder / "a.json", "text"), std::runtime_error);
    writeWhole(folder / "b.json", "first");
    writeWhole(folder / "b.json", "second");
    EXPECT_EQ(tests::readBytes(folder / "b.json"), "second");
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator(folder)) ++files;
    EXPECT_EQ(files, 2u);  // no partial file stays
}

}  // namespace
}  // namespace app

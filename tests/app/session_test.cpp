#include "app/choices/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/files/picture_files.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "tests/support/files.h"
#include "tests/support/random_explorer.h"
#include "tests/support/rounds.h"

namespace app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using tests::RandomExplorer;
using timeseries::RangeSet;

namespace fs = std::filesystem;

TEST(Session, EveryExplorerComesBackAsItWas) {
    RandomExplorer next(20);
    for (int i = 0; i < tests::rounds(600); ++i) {
        const Explorer e = next();
        for (const char* folder : {"/data/run", "/", "/data/run/deeper/still", "/elsewhere"}) {
            // Through text, as a file would hold it.
            const std::string text = toJson(e, folder).dump();
            const Explorer back = fromJson(json::parse(text), folder);
            ASSERT_TRUE(back == e)
                << "case " << i << ": " << text << "\nbecame " << toJson(back, folder).dump();
        }
    }
}

// 3.0 for each 3, as other programs write whole numbers.
json asDoubles(json value) {
    if (value.is_structured())
        for (json& each : value) each = asDoubles(std::move(each));
    if (!value.is_number_integer()) return value;
    const auto number = value.get<double>();
    return std::abs(number) < 0x1p53 ? json(number) : value;
}

TEST(Session, WholeNumbersMayHaveAPoint) {
    RandomExplorer next(21);
    for (int i = 0; i < tests::rounds(200); ++i) {
        const Explorer e = next();
        const std::string text = asDoubles(toJson(e, "/data")).dump();
        ASSERT_THAT(text, HasSubstr("\"isochron\":1.0"));
        ASSERT_TRUE(fromJson(json::parse(text), "/data") == e) << "case " << i << ": " << text;
    }
}

TEST(Session, AnExplorerWithNothingChosenComesBack) {
    EXPECT_TRUE(fromJson(toJson({}, "/a"), "/a") == Explorer{});
}

// As sessions were written before a picture was placed beside its legend: a view and no shift.
TEST(Session, AViewOfWhichNoShiftIsSaidStandsInTheMiddle) {
    json old = toJson({}, "/a");
    ASSERT_EQ(old["view"]["shift"], "auto");
    old["view"].erase("shift");
    EXPECT_EQ(fromJson(old, "/a").view.shift, glm::dvec2(0));
}

TEST(Session, WhatNobodyTouchedIsNotWritten) {
    const json plain = toJson({}, "/a");
    EXPECT_FALSE(plain.contains("play"));
    EXPECT_FALSE(plain["view"].contains("target"));
    EXPECT_FALSE(plain["view"].contains("projection"));
    Explorer e;
    e.layers = {{RangeSet::parse("0:1"), {}, {}}, {RangeSet::parse("0:1"), {}, {}, false}};
    e.play.tick = 3;
    EXPECT_EQ(toJson(e, "/a")["play"], json({{"tick", 3}}));
    EXPECT_FALSE(toJson(e, "/a")["layers"][0].contains("visible"));
    EXPECT_EQ(toJson(e, "/a")["layers"][1]["visible"], false);
}

TEST(Session, PathsAreRelativeToTheSessionsFolder) {
    Explorer e;
    e.files = {"/data/run/fire.nc", "/data/other.nc"};
    EXPECT_EQ(toJson(e, "/data/run")["files"], json({"fire.nc", "../other.nc"}));
    // Where the files are nowhere, they are looked for where they were; without that, beside it.
    EXPECT_EQ(fromJson(toJson(e, "/data/run"), "/moved/run").files, e.files);
    EXPECT_EQ(fromJson(toJson(e, "/data/run", Paths::Relative), "/moved/run").files,
              (std::vector<fs::path>{"/moved/run/fire.nc", "/moved/other.nc"}));
}

TEST(Session, ItsFilesAreFoundWhereTheyWereElseWhereTheyWouldBeFromIt) {
    const fs::path root = tests::freshFolder();
    Explorer e;
    e.files = {root / "a" / "data" / "fire.nc", root / "a" / "data" / "x*.nc"};
    for (const char* folder : {"a/data", "b/data", "a/pictures"})
        fs::create_directories(root / folder);
    const json session = toJson(e, root / "a" / "pictures");
    const std::vector<fs::path> moved{root / "b" / "data" / "fire.nc",
                                      root / "b" / "data" / "x*.nc"};
    const auto movedFiles = [&] { return fromJson(session, root / "b" / "pictures").files; };
    for (const fs::path& each : {e.files[0], moved[0]}) tests::writeBytes(each, "");
    // Other data under the same name beside it are not taken for them.
    EXPECT_EQ(movedFiles(), e.files);
    fs::remove_all(root / "a");
    EXPECT_EQ(movedFiles(), moved);
    EXPECT_EQ(missingFile(fromJson(session, root / "b" / "pictures")), std::nullopt);
    fs::remove_all(root / "b");
    EXPECT_EQ(movedFiles(), e.files);
    EXPECT_EQ(missingFile(fromJson(session, root / "b" / "pictures")), e.files[0]);
}

TEST(Session, WhatIsPublishedKeepsNoAbsolutePath) {
    Explorer e;
    e.files = {"/home/somebody/fire.nc"};
    EXPECT_THAT(toJson(e, "/home/somebody").dump(), HasSubstr("somebody"));
    EXPECT_THAT(toJson(e, "/home/somebody", Paths::Relative).dump(),
                testing::Not(HasSubstr("somebody")));
}

TEST(Session, PathsWithDotsLeadToTheSameFile) {
    const fs::path here = fs::current_path();
    const auto backFrom = [&](const fs::path& file, const fs::path& folder) {
        Explorer e;
        e.files = {file};
        const fs::path back = fromJson(toJson(e, folder), folder).files.at(0);
        return fs::absolute(back).lexically_normal();
    };
    const fs::path file = "sub/fire.nc";
    for (const char* folder :
         {"", ".", "out", "./out", "out/.", "../out", "../../out/x", "sub", "sub/../out", "sub/"})
        EXPECT_EQ(backFrom(file, folder), here / "sub/fire.nc") << "session in '" << folder << "'";
    for (const char* folder : {"", ".", "out", "../out"})
        EXPECT_EQ(backFrom("../fire.nc", folder), (here / "../fire.nc").lexically_normal())
            << "session in '" << folder << "'";
}

TEST(Session, AbsolutePathsInAFileStayWhatTheyAre) {
    const json session = {{"isochron", 1}, {"files", {"/abs/fire.nc", "near.nc"}}};
    EXPECT_EQ(fromJson(session, "/folder").files,
              (std::vector<fs::path>{"/abs/fire.nc", "/folder/near.nc"}));
}

TEST(Session, PathsThatAreNoUtf8ComeBackByteForByte) {
    Explorer e;
    e.files = {"/data/n\xe9.nc", "/data/100%41.nc", "/data/\xff\xc3\xa9\xc3.nc"};
    const json session = toJson(e, "/data");
    EXPECT_EQ(session["files"], json({"n%E9.nc", "100%2541.nc", "%FF\u00e9%C3.nc"}));
    EXPECT_TRUE(fromJson(json::parse(session.dump()), "/data") == e);
    // Of a folder, too: the session's own is not in the relative path.
    e.files = {"/d\xe9/100%41.nc"};
    EXPECT_TRUE(fromJson(json::parse(toJson(e, "/d\xe9").dump()), "/d\xe9") == e);
    // Others stand as they are.
    e.files = {"/data/100%41.nc"};
    EXPECT_EQ(toJson(e, "/data")["files"], json({"100%41.nc"}));
    EXPECT_FALSE(toJson(e, "/data").contains("filesEscaped"));
}

TEST(Session, APictureGivesBackTheSessionThatItCarries) {
    const fs::path folder = tests::freshFolder();
    RandomExplorer next(44);
    for (int i = 0; i < 30; ++i) {
        const Explorer e = next();
        const render::Metadata texts{{kSessionKey, toJson(e, folder).dump()}};
        const render::Image image({3, 2}, glm::vec4(0.5f));
        render::writePng(folder / "a.png", image, texts);
        EXPECT_TRUE(readSession(folder / "a.png") == e);
        const std::array views{render::ExrView{"", image}};
        render::writeExr(folder / "a.exr", views, texts);
        EXPECT_TRUE(readSession(folder / "a.exr") == e);
    }
}

TEST(Session, APicturesEndingMayBeInCapitals) {
    const fs::path folder = tests::freshFolder();
    Explorer e;
    e.files = {"/data/a.nc"};
    const render::Metadata texts{{kSessionKey, toJson(e, folder).dump()}};
    for (const char* name : {"a.PNG", "a.EXR", "a.Png"}) {
        write(folder / name, Stereo::Off, {{render::Image({3, 2}), {}, {}}}, texts);
        EXPECT_TRUE(holdsSession(name));
        EXPECT_TRUE(readSession(folder / name) == e) << name;
    }
    // As the formats' first bytes say.
    EXPECT_EQ(tests::readBytes(folder / "a.PNG").substr(1, 3), "PNG");
    EXPECT_EQ(tests::readBytes(folder / "a.EXR").substr(0, 2), "v/");
    EXPECT_TRUE(holdsSession("a.JSON"));
}

}  // namespace
}  // namespace app

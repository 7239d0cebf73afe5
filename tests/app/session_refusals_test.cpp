// Sessions that cannot be used: what is wrong, and where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "app/choices/choice_text.h"
#include "app/choices/session.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "tests/support/files.h"
#include "tests/support/random_explorer.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using tests::RandomExplorer;

namespace fs = std::filesystem;

void expectRefused(const json& session, const std::string& place) {
    try {
        fromJson(session, "/");
        ADD_FAILURE() << session.dump() << " was accepted";
    } catch (const ChoiceError& error) {
        EXPECT_THAT(error.what(), HasSubstr(place)) << session.dump();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST(Session, UnknownKeysAreNamedWhereverTheyStand) {
    expectRefused({{"isochron", 1}, {"filez", {"a.nc"}}}, "'filez'");
    expectRefused({{"isochron", 1}, {"Isochron", 1}}, "'Isochron'");
    expectRefused({{"isochron", 1}, {"layers", {{{"range", "0:1"}, {"colour", "#ffffff"}}}}},
                  "'colour'");
    expectRefused({{"isochron", 1}, {"sweep", {{"animation", "0:1"}, {"steps", 3}}}}, "'steps'");
    expectRefused({{"isochron", 1}, {"view", {{"roll", 3}}}}, "'roll'");
    expectRefused({{"isochron", 1}, {"stereo", {{"distance", 3}}}}, "'distance'");
    expectRefused({{"isochron", 1}, {"play", {{"speed", 3}}}}, "'speed'");
    expectRefused({{"isochron", 1}, {"", 0}}, "''");
}

TEST(Session, APathThatNoFileCanHaveIsRefused) {
    const std::string nul("a\0.nc", 5);
    expectRefused({{"isochron", 1}, {"files", {nul}}}, "session.files: has a path with a NUL");
    expectRefused({{"isochron", 1}, {"files", {"a.nc"}}, {"filesWere", {"/" + nul}}},
                  "session.filesWere: has a path with a NUL");
    const auto escaped = [](const char* path) {
        return json{{"isochron", 1}, {"filesEscaped", true}, {"files", {path}}};
    };
    expectRefused(escaped("a%00.nc"), "NUL");
    for (const char* path : {"%", "a%4", "%G1", "%-1", "%4.nc", "% 4"})
        expectRefused(escaped(path), "hexadecimal");
    EXPECT_EQ(fromJson(escaped("%61%2f%E9"), "/").files, (std::vector<fs::path>{"/a/\xe9"}));
    expectRefused({{"isochron", 1}, {"filesEscaped", 1}}, "session.filesEscaped");
}

TEST(Session, AnotherVersionIsRefused) {
    for (const json& version :
         {json(0), json(2), json(-1), json("1"), json(nullptr), json(true), json(1.5), json({1})})
        expectRefused({{"isochron", version}}, "session.isochron");
    expectRefused(json::object(), "session.isochron");
}

TEST(Session, WhatIsNotAnObjectIsRefused) {
    for (const json& session : {json(), json(1), json("text"), json::array(), json(true)})
        expectRefused(session, "session");
}

TEST(Session, WrongTypesAreNamedByKey) {
    const json wrong[] = {nullptr,
                          true,
                          3,
                          2.5,
                          "text",
                          json::array(),
                          json::array({json::array()}),
                          json::object(),
                          {{"x", 1}},
                          json::array({1, 2})};
    // Per key, the entries of `wrong` that it takes for what it is.
    const std::map<std::string, std::set<int>> fits = {
        {"files", {5}}, {"filesWere", {5}}, {"axes", {7}}, {"variable", {4}}, {"steps", {}},
        {"keep", {}},   {"layers", {5}},    {"sweep", {}}, {"splat", {}},     {"splatSize", {2, 3}},
        {"order", {}},  {"clip", {}},       {"scale", {}}, {"view", {7}},     {"stereo", {7}},
        {"size", {}},   {"play", {7}}};
    for (const auto& [key, taken] : fits)
        for (int i = 0; i < static_cast<int>(std::size(wrong)); ++i) {
            const json session = {{"isochron", 1}, {key, wrong[i]}};
            if (taken.contains(i)) {
                EXPECT_NO_THROW(fromJson(session, "/")) << session.dump();
            } else {
                expectRefused(session, "session." + key);
            }
        }
    const std::map<std::string, std::map<std::string, std::set<int>>> fitsInside = {
        {"view",
         {{"azimuth", {2, 3}},
          {"elevation", {2, 3}},
          {"distance", {2, 3}},
          {"target", {}},
          {"projection", {}}}},
        {"play",
         {{"first", {2}},
          {"last", {2}},
          {"stride", {2}},
          {"ending", {}},
          {"backward", {1}},
          {"realTimes", {1}},
          {"stepsPerSecond", {2, 3}},
          {"timeUnitsPerSecond", {2, 3}},
          {"timeMoves", {1}},
          {"sweepMoves", {1}},
          {"tick", {2}}}},
        {"stereo", {{"mode", {}}, {"eyeDistance", {2, 3}}, {"convergence", {2, 3}}}},
        {"sweep",
         {{"animation", {}},
          {"delta", {2, 3}},
          {"timerSteps", {2}},
          {"timerStep", {2}},
          {"tick", {2}},
          {"frequency", {2, 3}},
          {"swing", {1}},
          {"color", {}},
          {"colormap", {}},
          {"opacity", {}},
          {"visible", {1}}}}};
    for (const auto& [outer, keys] : fitsInside)
        for (const auto& [key, taken] : keys)
            for (int i = 0; i < static_cast<int>(std::size(wrong)); ++i) {
                json session = {{"isochron", 1}};
                if (outer == "sweep") session[outer]["animation"] = "0:1";
                session[outer][key] = wrong[i];
                if (taken.contains(i)) {
                    EXPECT_NO_THROW(fromJson(session, "/")) << session.dump();
                } else {
                    expectRefused(session, "session." + outer + "." + key);
                }
            }
}

TEST(Session, ValuesOutOfBoundsAreRefused) {
    const auto with = [](const char* key, const json& value) {
        return json{{"isochron", 1}, {key, value}};
    };
    expectRefused(with("splatSize", 0), "session.splatSize");
    expectRefused(with("splatSize", -1), "session.splatSize");
    expectRefused(with("size", "0x10"), "session.size");
    expectRefused(with("scale", {1, 2}), "session.scale");
    expectRefused(with("scale", {1, 2, 0}), "session.scale");
    expectRefused(with("view", {{"distance", 0}}), "distance");
    // As the command line: what it cannot have written is not read.
    expectRefused(with("view", {{"distance", 1e7}}), "distance");
    expectRefused(with("stereo", {{"convergence", 1e7}}), "convergence");
    expectRefused(with("stereo", {{"eyeDistance", 1e7}}), "session.stereo.eyeDistance");
    expectRefused(with("splatSize", 1e4), "session.splatSize");
    expectRefused(with("stereo", {{"convergence", 0}}), "convergence");
    expectRefused(with("stereo", {{"eyeDistance", -0.1}}), "eye");
    for (const json& target : {json{1, 2}, json{1, 2, 3, 4}, json{1e7, 0, 0}})
        expectRefused(with("view", {{"target", target}}), "session.view.target");
    expectRefused(with("view", {{"projection", "isometric"}}), "session.view.projection");
    for (const char* shift : {"", "0", "0,1.5", "left"})
        expectRefused(with("view", {{"shift", shift}}), "session.view.shift");
    for (const json& play :
         {json{{"first", -1}}, json{{"first", 3}, {"last", 2}}, json{{"stride", 0}},
          json{{"ending", "never"}}, json{{"stepsPerSecond", -1}}, json{{"tick", -1}}})
        expectRefused(with("play", play), "session.play");
    for (const json& layer :
         {json{{"range", ""}}, json{{"range", "2:1"}}, json{{"range", "0:1"}, {"opacity", 1.01}},
          json{{"range", "0:1"}, {"opacity", -0.01}}, json{{"range", "0:1"}, {"mapLow", 1}},
          json{{"range", "0:1"}, {"colormap", "jet"}}, json{{"range", "0:1"}, {"color", "red"}}})
        expectRefused(with("layers", json::array({layer})), "session.layers");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"timerSteps", 0}}), "session.sweep");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"timerSteps", 1 << 30}, {"timerStep", -1}}),
                  "session.sweep");
    for (const int tick : {-1, 4})
        expectRefused(with("sweep", {{"animation", "0:1"}, {"timerSteps", 4}, {"tick", tick}}),
                      "session.sweep");
    expectRefused(with("axes", {{"w", {{"flip", true}}}}), "'w'");
    expectRefused(with("axes", {{"z", {{"down", true}}}}), "'down'");
    expectRefused(with("axes", {{"z", {{"flip", 1}}}}), "session.axes.z.flip");
    expectRefused(with("filesWere", json::array({"/a.nc"})), "session.filesWere");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"delta", -1}}), "session.sweep");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"frequency", -1}}), "session.sweep");
}

TEST(Session, MoreLayersThanAreDrawnAreRefused) {
    json session = {{"isochron", 1}};
    for (std::size_t i = 0; i <= render::kMaxLayers; ++i)
        session["layers"].push_back({{"range", "0:1"}});
    expectRefused(session, "session.layers");
}

// The text of a session file that cannot be used.
std::string refusal(const std::string& bytes) {
    const fs::path file = tests::freshFolder() / "session.json";
    tests::writeBytes(file, bytes);
    try {
        readSession(file);
    } catch (const timeseries::FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr(file.string()));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "accepted: " << bytes.substr(0, 200);
    return {};
}

TEST(Session, AKeyThatStandsTwiceInAnObjectIsNamed) {
    EXPECT_THAT(refusal(R"({"isochron":1,"variable":"a","variable":"b"})"),
                HasSubstr("session.json: an object has the key 'variable' twice"));
    EXPECT_THAT(
        refusal(R"({"isochron":1,"layers":[{"range":"0:1"},{"range":"0:1","range":"0:1"}]})"),
        HasSubstr("'range' twice"));
    EXPECT_THAT(refusal(R"({"isochron":1,"view":{"azimuth":1},"vi\u0065w":{}})"),
                HasSubstr("'view' twice"));
}

TEST(Session, AFileThatIsNoJsonSaysWhere) {
    for (const char* bytes : {"", " ", "{", "isochron", "{\"isochron\":1,}", "{\"isochron\":1}}",
                              "{'isochron':1}", "{\"isochron\":NaN}", "{\"isochron\":1",
                              "{\"isochron\":1,\"variable\":\"\xff\xfe\"}", "\xff\xd8\xff"})
        EXPECT_THAT(refusal(bytes), HasSubstr("not JSON at byte"));
}

TEST(Session, HugeNumbersAreRefusedWithTheFilesName) {
    for (const char* number : {"1e999", "-1e999", "1e99999999999999999999"}) {
        refusal("{\"isochron\":" + std::string(number) + "}");
        refusal("{\"isochron\":1,\"view\":{\"azimuth\":" + std::string(number) + "}}");
    }
    for (const char* number :
         {"1e300", "9007199254740992.0", "8.5", "18446744073709551616", "9223372036854775808",
          "123456789012345678901234567890", "1073741825"})
        refusal("{\"isochron\":1,\"sweep\":{\"animation\":\"0:1\",\"timerSteps\":" +
                std::string(number) + "}}");
    refusal("{\"isochron\":4294967297}");  // 1 once the upper half is lost
}

TEST(Session, DeepNestingIsRefusedNotOverflowing) {
    constexpr std::size_t kDeep = 100'000;
    const std::string open(kDeep, '['), close(kDeep, ']');
    for (const char* key :
         {"isochron", "files", "layers", "sweep", "view", "stereo", "scale", "variable", "other"})
        refusal("{\"isochron\":1,\"" + std::string(key) + "\":" + open + close + "}");
    refusal("{\"isochron\":1,\"layers\":[{\"range\":" + open + close + "}]}");
    std::string objects;
    for (std::size_t i = 0; i < kDeep; ++i) objects += "{\"a\":";
    refusal(objects + "1" + std::string(kDeep, '}'));
}

TEST(Session, EveryCutOfAFileIsRefused) {
    Explorer e = RandomExplorer(4)();
    const std::string whole = toJson(e, "/").dump();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_THAT(refusal(whole.substr(0, length)), HasSubstr("not JSON at byte")) << length;
}

TEST(Session, ASingleChangedByteNeverCrashes) {
    const fs::path file = tests::freshFolder() / "session.json";
    std::mt19937 random(9);
    RandomExplorer next(6);
    for (int i = 0; i < 1500; ++i) {
        std::string bytes = toJson(next(), "/").dump();
        bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
        tests::writeBytes(file, bytes);
        try {
            const Explorer e = readSession(file);
            EXPECT_TRUE(fromJson(toJson(e, "/"), "/") == fromJson(toJson(e, "/"), "/"));
        } catch (const timeseries::FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
        }
    }
}

TEST(Session, PicturesWithoutASessionAreRefusedByName) {
    const fs::path folder = tests::freshFolder();
    const auto refusal = [&](const char* name) {
        try {
            readSession(folder / name);
        } catch (const timeseries::FileError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const render::Image image({3, 2});
    const std::array views{render::ExrView{"", image}};
    render::writePng(folder / "bare.png", image);
    render::writeExr(folder / "bare.exr", views);
    render::writePng(folder / "odd.png", image, {{kSessionKey, "{\"isochron\":1,\"colour\":2}"}});
    render::writePng(folder / "cut.png", image, {{kSessionKey, "{"}});
    tests::writeBytes(folder / "text.png", "no picture");
    tests::writeBytes(folder / "text.exr", "no picture");
    for (const char* name : {"bare.png", "bare.exr", "odd.png", "cut.png", "text.png", "text.exr",
                             "none.png", "none.exr"}) {
        EXPECT_THAT(refusal(name), HasSubstr((folder / name).string()));
        EXPECT_EQ(refusal(name).find('\n'), std::string::npos);
    }
    EXPECT_THAT(refusal("bare.png"), HasSubstr("carries no session"));
    EXPECT_THAT(refusal("bare.exr"), HasSubstr("carries no session"));
    EXPECT_THAT(refusal("odd.png"), HasSubstr("'colour'"));
    EXPECT_THAT(refusal("cut.png"), HasSubstr("not JSON at byte"));
}

TEST(Session, AMissingFileAndAFolderAreNamed) {
    const fs::path folder = tests::freshFolder();
    for (const fs::path& file : {folder / "none.json", folder}) {
        try {
            readSession(file);
            ADD_FAILURE() << file;
        } catch (const timeseries::FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr(file.string()));
        }
    }
}

}  // namespace
}  // namespace app

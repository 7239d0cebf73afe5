#include "app/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "app/choice_text.h"
#include "tests/support/files.h"
#include "timeseries/reader.h"

namespace app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using timeseries::Bound;
using timeseries::RangeSet;

namespace fs = std::filesystem;

// Explorers with every choice made or left open by chance.
class RandomExplorer {
 public:
    explicit RandomExplorer(unsigned seed) : random_(seed) {}

    Explorer operator()() {
        Explorer e;
        for (std::size_t i = 0; i <= random_() % 3; ++i) e.files.push_back(pick(kFiles));
        if (maybe()) e.variable = pick(kNames);
        if (maybe()) {
            e.steps = StepChoice{random_() % 40, {}};
            if (maybe()) e.steps->last = e.steps->first + random_() % 4;
        }
        if (maybe()) e.keep = ranges();
        if (maybe()) {
            e.sweep.emplace();
            e.sweep->animation = ranges();
            e.sweep->delta = std::abs(number());
            e.sweep->timerSteps = 1 + static_cast<std::int64_t>(random_() % 1000);
            e.sweep->step = 1 + static_cast<std::int64_t>(random_() % 9);
            e.sweep->frequency = unit();
            e.sweep->path = maybe() ? timeseries::SweepPath::Loop : timeseries::SweepPath::Swing;
            e.sweepLayer = styled({});
        }
        const std::size_t most = render::kMaxLayers - (e.sweep ? 1 : 0);
        for (std::size_t i = random_() % (most + 1); i > 0; --i)
            e.layers.push_back(styled(random_() % 5 == 0 ? RangeSet() : ranges()));
        e.footprint = {maybe() ? render::Kernel::Point : render::Kernel::Quartic,
                       0.001 + 5 * unit()};
        e.order = maybe() ? render::Order::None : render::Order::BackToFront;
        if (maybe()) e.clip = clip();
        if (maybe()) e.scale = glm::dvec3(0.1 + unit(), 1e-9 + unit(), 1 + 1e9 * unit());
        e.view = {720 * unit() - 360, 180 * unit() - 90, {}};
        if (maybe()) e.view.distance = 0.01 + 9 * unit();
        e.stereo.mode = static_cast<Stereo>(random_() % 5);
        if (maybe()) e.stereo.eyeDistance = maybe() ? 0 : unit();
        if (maybe()) e.stereo.convergence = 0.01 + unit();
        e.size = {pixels(), pixels()};
        return e;
    }

 private:
    static constexpr const char* kFiles[] = {"/data/run/fire.nc", "/data/run/b/c d.nc",
                                             "/other/é 世界.nc", "/data/x.nc", "/data/run/'q'.nc"};
    static constexpr const char* kNames[] = {"T", "air temperature", "θ", "a\"b\\c\n", "0"};

    template <typename T, std::size_t N>
    T pick(const T (&from)[N]) {
        return from[random_() % N];
    }
    int pixels() { return 1 + static_cast<int>(random_() % 16384); }
    bool maybe() { return random_() % 2 == 0; }
    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    double number() {
        const double awkward[] = {0,       -0.0, 1.0 / 3, 1e300,  -1e300, 5e-324,
                                  600,     0.1,  -2.5,    1e-300, 1e20,   9007199254740993.0,
                                  1e15 + 1};
        return random_() % 3 == 0 ? awkward[random_() % std::size(awkward)]
                                  : std::ldexp(unit() - 0.5, static_cast<int>(random_() % 80) - 40);
    }
    timeseries::Number exact() {
        if (random_() % 4 == 0) return (std::int64_t{1} << 60) + static_cast<int>(random_() % 9);
        if (random_() % 8 == 0) return std::numeric_limits<std::uint64_t>::max() - random_() % 9;
        return number();
    }
    RangeSet ranges() {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        for (;;) {
            std::vector<timeseries::Range> some(1 + random_() % 3);
            for (auto& range : some) {
                range = {{exact(), maybe()}, {exact(), maybe()}};
                if (timeseries::compare(range.lo.value, range.hi.value) > 0)
                    std::swap(range.lo, range.hi);
                if (random_() % 6 == 0) range.lo = {-kInfinity, random_() % 4 == 0};
                if (random_() % 6 == 0) range.hi = {kInfinity, random_() % 4 == 0};
            }
            if (RangeSet set(some); !set.empty()) return set;
        }
    }
    LayerChoice styled(RangeSet set) {
        LayerChoice layer{std::move(set), {}, {}};
        if (maybe()) layer.opacity = unit();
        switch (random_() % 3) {
            case 0:
                layer.color = glm::dvec3(random_() % 256, random_() % 256, random_() % 256) / 255.0;
                break;
            case 1: {
                MapChoice map{
                    *render::colorMapNamed(render::colorMapNames()[random_() % 4]), {}, {}};
                if (maybe()) map.lo = number();
                if (maybe()) map.hi = number();
                layer.color = map;
                break;
            }
            default:
                break;
        }
        return layer;
    }
    ClipBox clip() {
        ClipBox box{};
        for (int a = 0; a < 3; ++a) {
            const double x = number(), y = number();
            box.lo[a] = maybe() ? std::min(x, y) : -std::numeric_limits<double>::infinity();
            box.hi[a] = maybe() ? std::max(x, y) : std::numeric_limits<double>::infinity();
        }
        return box;
    }
    std::mt19937_64 random_;
};

TEST(Session, EveryExplorerComesBackAsItWas) {
    RandomExplorer next(20);
    for (int i = 0; i < 600; ++i) {
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

TEST(Session, AnExplorerWithNothingChosenComesBack) {
    EXPECT_TRUE(fromJson(toJson({}, "/a"), "/a") == Explorer{});
}

TEST(Session, PathsAreRelativeToTheSessionsFolder) {
    Explorer e;
    e.files = {"/data/run/fire.nc", "/data/other.nc"};
    EXPECT_EQ(toJson(e, "/data/run")["files"], json({"fire.nc", "../other.nc"}));
    // The folder moved as a whole: the paths go with it.
    EXPECT_EQ(fromJson(toJson(e, "/data/run"), "/moved/run").files,
              (std::vector<fs::path>{"/moved/run/fire.nc", "/moved/other.nc"}));
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
    expectRefused({{"isochron", 1}, {"", 0}}, "''");
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
        {"files", {5}}, {"variable", {4}}, {"steps", {}},         {"keep", {}},  {"layers", {5}},
        {"sweep", {}},  {"splat", {}},     {"splatSize", {2, 3}}, {"order", {}}, {"clip", {}},
        {"scale", {}},  {"view", {7}},     {"stereo", {7}},       {"size", {}}};
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
        {"view", {{"azimuth", {2, 3}}, {"elevation", {2, 3}}, {"distance", {2, 3}}}},
        {"stereo", {{"mode", {}}, {"eyeDistance", {2, 3}}, {"convergence", {2, 3}}}},
        {"sweep",
         {{"animation", {}},
          {"delta", {2, 3}},
          {"timerSteps", {2}},
          {"timerStep", {2}},
          {"frequency", {2, 3}},
          {"swing", {1}},
          {"color", {}},
          {"colormap", {}},
          {"opacity", {}}}}};
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
    expectRefused(with("stereo", {{"eyeDistance", 1e7}}), "eye distance");
    expectRefused(with("splatSize", 1e4), "size");
    expectRefused(with("stereo", {{"convergence", 0}}), "convergence");
    expectRefused(with("stereo", {{"eyeDistance", -0.1}}), "eye");
    for (const json& layer :
         {json{{"range", ""}}, json{{"range", "2:1"}}, json{{"range", "0:1"}, {"opacity", 1.01}},
          json{{"range", "0:1"}, {"opacity", -0.01}}, json{{"range", "0:1"}, {"mapLow", 1}},
          json{{"range", "0:1"}, {"colormap", "jet"}}, json{{"range", "0:1"}, {"color", "red"}}})
        expectRefused(with("layers", json::array({layer})), "session.layers");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"timerSteps", 0}}), "session.sweep");
    expectRefused(with("sweep", {{"animation", "0:1"}, {"timerSteps", 1 << 30}, {"timerStep", -1}}),
                  "session.sweep");
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
    for (const char* number : {"1e300", "18446744073709551616", "9223372036854775808",
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

TEST(Session, OfEqualKeysOneCountsAndNothingBreaks) {
    const fs::path file = tests::freshFolder() / "session.json";
    tests::writeBytes(file, R"({"isochron":1,"variable":"a","variable":"b"})");
    const std::string variable = readSession(file).variable;
    EXPECT_TRUE(variable == "a" || variable == "b");
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

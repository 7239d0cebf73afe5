#include "app/choices/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/choices/choice_text.h"
#include "app/choices/idle_choices.h"
#include "app/choices/session.h"
#include "tests/support/files.h"
#include "tests/support/parsed_options.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

using testing::HasSubstr;
using testing::Not;
using timeseries::RangeSet;
using namespace app::parsing;

TEST(Options, HelpIsNoFailureAndNamesTheCommand) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"-h"},
                                                      {"info", "--help"},
                                                      {"count", "--help"},
                                                      {"render", "--help"},
                                                      {"view", "--help"},
                                                      {"render", "-h"},
                                                      {"render", "a.nc", "--help"}}) {
        const Command command = parsed(arguments);
        const auto& exit = std::get<Exit>(command);
        EXPECT_EQ(exit.code, 0);
        EXPECT_THAT(exit.text, HasSubstr("Exit codes"));
        EXPECT_THAT(exit.text,
                    HasSubstr(arguments.size() == 1 ? "isochron" : "isochron " + arguments[0]));
    }
}

TEST(Options, TheVersionIsTold) {
    const auto exit = std::get<Exit>(parsed({"--version"}));
    EXPECT_EQ(exit.code, 0);
    EXPECT_THAT(exit.text, testing::MatchesRegex("isochron [0-9]+[.][0-9]+[.][0-9]+"));
}

TEST(Options, HelpListsEveryOptionOfRenderAndView) {
    const std::string help = std::get<Exit>(parsed({"render", "--help"})).text;
    const std::string helpOfView = std::get<Exit>(parsed({"view", "--help"})).text;
    for (const char* option :
         {"--session",   "--variable",  "--step",         "--range",       "--keep",
          "--color",     "--colormap",  "--opacity",      "--splat",       "--splat-size",
          "--order",     "--sweep",     "--delta",        "--timer-steps", "--timer-step",
          "--frequency", "--swing",     "--clip",         "--scale",       "--view",
          "--size",      "--stereo",    "--eye-distance", "--convergence", "--channel",
          "--device",    "--output",    "--hide",         "--target",      "--orthographic",
          "--tick",      "--portable",  "--flip",         "--name-axis",   "--splatter",
          "--model",     "--no-legend", "--shift"}) {
        EXPECT_THAT(help, HasSubstr(option));
        const bool isOfFiles =
            std::set<std::string_view>{"--device", "--splatter", "--channel", "--portable"}
                .contains(option);
        EXPECT_EQ(helpOfView.find(option) == std::string::npos, isOfFiles) << option;
    }
    EXPECT_THAT(helpOfView, HasSubstr("--display"));
    EXPECT_THAT(help, Not(HasSubstr("--display")));
}

TEST(Options, EveryCommandTakesALimitOfThreadsAndACache) {
    for (std::vector<std::string> line : {std::vector<std::string>{"info", "a.nc"},
                                          {"count", "a.nc", "--range", "0:1"},
                                          {"render", "a.nc", "-o", "a.png"},
                                          {"view", "a.nc"},
                                          {"view", "--display", "headless", "a.nc", "-o", "a.png"},
                                          {"index", "a.nc"},
                                          {"cache"}}) {
        EXPECT_EQ(commonOf(parsed(line)).threads, 0u) << line[0];
        line.insert(line.end(), {"--threads", "3"});
        EXPECT_EQ(commonOf(parsed(line)).threads, 3u) << line[0];
        line.back() = "0";
        EXPECT_THAT(refused(line), HasSubstr("--threads")) << line[0];
        line.resize(line.size() - 2);
        EXPECT_EQ(commonOf(parsed(line)).cache, "") << line[0];
        line.insert(line.end(), {"--cache", "off"});
        EXPECT_EQ(commonOf(parsed(line)).cache, "off") << line[0];
        line.back() = "";
        EXPECT_THAT(refused(line), HasSubstr("--cache")) << line[0];
        line.resize(line.size() - 2);
        EXPECT_EQ(commonOf(parsed(line)).cacheSize, std::nullopt) << line[0];
        line.insert(line.end(), {"--cache-size", "200GB"});
        EXPECT_EQ(commonOf(parsed(line)).cacheSize, 200'000'000'000u) << line[0];
    }
}

// As of a script whose variable is not set. Beside a session it asks for the default one.
TEST(Options, AnEmptyNameOfAVariableIsRefusedWhereItIsCounted) {
    EXPECT_THAT(refused({"count", "a.nc", "--range", "0:1", "--variable", ""}),
                HasSubstr("--variable: is an empty text"));
}

TEST(Options, StepsInMemoryTakeWhatIsChosenInUnitsOfBytes) {
    const auto line = [](const char* size) {
        return std::vector<std::string>{"view", "a.nc", "--memory", size};
    };
    EXPECT_EQ(commonOf(parsed({"view", "a.nc"})).memory, 0u);
    EXPECT_EQ(commonOf(parsed(line("8GB"))).memory, 8'000'000'000u);
    EXPECT_EQ(commonOf(parsed(line("8 gib"))).memory, std::uint64_t{8} << 30);
    EXPECT_EQ(commonOf(parsed(line("1500"))).memory, 1500u);
    for (const char* wrong : {"0", "-1GB", "GB", "1.5GB", "8 apples", "99999999999GB", ""})
        EXPECT_THAT(refused(line(wrong)),
                    HasSubstr(std::string("'") + wrong + "' is not a size such as"));
    EXPECT_EQ(commonOf(parsed({"render", "a.nc", "-o", "a.png", "--memory", "1MB"})).memory,
              1'000'000u);
    EXPECT_EQ(commonOf(parsed({"measure", "a.nc", "--memory", "1MB"})).memory, 1'000'000u);
    EXPECT_THAT(refused({"info", "a.nc", "--memory", "1MB"}), HasSubstr("--memory"));
}

TEST(Options, StepsAreIndexedOfVariablesAndSteps) {
    const auto index = [](const std::vector<std::string>& more) {
        std::vector<std::string> line{"index", "a.nc", "b.nc"};
        line.insert(line.end(), more.begin(), more.end());
        return std::get<IndexOptions>(parsed(line));
    };
    EXPECT_EQ(index({}).files.size(), 2u);
    EXPECT_TRUE(index({}).variables.empty());
    EXPECT_FALSE(index({}).steps.last);
    EXPECT_FALSE(index({}).beside);
    EXPECT_FALSE(index({}).check);
    const IndexOptions some =
        index({"--variable", "T", "--variable", "u", "--step", "3:9:2", "--jobs", "2", "--beside"});
    EXPECT_EQ(some.variables, (std::vector<std::string>{"T", "u"}));
    EXPECT_EQ(some.steps.stride, 2u);
    EXPECT_EQ(some.jobs, 2u);
    EXPECT_TRUE(some.beside);
    EXPECT_TRUE(index({"--check"}).check);
    EXPECT_THAT(refused({"index", "a.nc", "--jobs", "0"}), HasSubstr("--jobs"));
    EXPECT_THAT(refused({"index", "a.nc", "--check", "--beside"}), HasSubstr("--beside"));
    EXPECT_THAT(refused({"index"}), HasSubstr("FILE"));
    using Action = CacheOptions::Action;
    EXPECT_EQ(std::get<CacheOptions>(parsed({"cache"})).action, Action::List);
    EXPECT_EQ(std::get<CacheOptions>(parsed({"cache", "clear"})).action, Action::Clear);
    EXPECT_THAT(refused({"cache", "shrink"}), HasSubstr("shrink"));
}

TEST(Options, WrongCommandLinesExitWithTwo) {
    refused({""});
    EXPECT_THAT(refused({"info"}), HasSubstr("FILE"));
    EXPECT_THAT(refused({"count", "a.nc"}), HasSubstr("--range"));
    EXPECT_THAT(refused({"count", "--range", "0:1"}), HasSubstr("FILE"));
    EXPECT_THAT(refused({"render", "a.nc"}), HasSubstr("--output"));
    EXPECT_THAT(refused({"render", "-o", "o.png"}), HasSubstr("FILE"));
    EXPECT_THAT(refused({"info", "a.nc", "--bogus"}), HasSubstr("--bogus"));
    EXPECT_THAT(refused({"--bogus"}), HasSubstr("--bogus"));
    EXPECT_THAT(renderRefused({"--bogus", "3"}), HasSubstr("--bogus"));
    EXPECT_THAT(renderRefused({"--size"}), HasSubstr("--size"));
    EXPECT_THAT(renderRefused({"--size", "1x1", "--size", "2x2"}), HasSubstr("--size"));
    refused({"info", "a.nc", "count", "a.nc", "--range", "0:1"});
}

// In words about what was typed, not about what a parser required and received.
TEST(Options, WrongCommandLinesAreToldInSentences) {
    const std::string help = " (see isochron --help)";
    EXPECT_EQ(renderRefused({"--size"}), "--size has no value" + help);
    EXPECT_EQ(renderRefused({"--size", "1x1", "--size", "2x2", "--size", "3x3"}),
              "--size is given 3 times, where one is expected" + help);
    EXPECT_EQ(renderRefused({"--bogus", "3"}), "there is no option --bogus" + help);
    EXPECT_EQ(refused({"render", "a.nc", "--outptu", "o.png"}),
              "there is no option --outptu" + help)
        << "which is why --output is not there";
    EXPECT_EQ(refused({"render", "a.nc"}), "--output is required" + help);
    for (const std::vector<std::string>& behind :
         {std::vector<std::string>{"count", "--", "a.nc", "--range", "1:2"},
          {"count", "a.nc", "--", "--range", "1:2"}})
        EXPECT_EQ(refused(behind), "--range stands behind --, which ends the options" + help);
    EXPECT_EQ(refused({"cache", "list", "clear"}), "'clear' is not expected" + help);
    EXPECT_EQ(refused({"cache", "shrink"}), "ACTION: 'shrink' is not one of list, clear" + help);
    EXPECT_EQ(renderRefused({"--threads", "1.5"}),
              "--threads: '1.5' is not a whole number from 1 to 1024" + help);
    EXPECT_EQ(renderRefused({"--splatter", "gpu"}),
              "--splatter: 'gpu' is not one of any, gl, cpu, exact" + help);
}

TEST(Options, WhatDoesNothingBesideOthersIsTold) {
    for (const std::vector<std::string>& idle :
         {std::vector<std::string>{"--light", "full", "--model", "points"},
          {"--light", "full", "--order", "none"},
          {"--light-from", "10,20", "--model", "points"},
          {"--light-from", "10,20", "--light", "off"},
          {"--opacity-per", "length", "--model", "points"},
          {"--eye-distance", "0.1"},
          {"--convergence", "2", "--stereo", "off"}})
        EXPECT_THAT(idleChoices(explorer(idle)),
                    testing::ElementsAre(testing::StartsWith(idle[0])));
    for (const std::vector<std::string>& fine :
         {std::vector<std::string>{},
          {"--light", "off", "--model", "points"},
          {"--light", "full", "--light-from", "10,20"},
          {"--model", "points", "--order", "none"},
          {"--opacity-per", "length"},
          {"--eye-distance", "0.1", "--stereo", "side-by-side"}})
        EXPECT_THAT(idleChoices(explorer(fine)), testing::IsEmpty());
}

TEST(Options, WithoutACommandAFileIsViewed) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"a.nc", "b.nc", "--range", "0:1", "--size", "8x6"},
          {"view", "a.nc", "b.nc", "--range", "0:1", "--size", "8x6"},
          {"view", "--range", "0:1", "--size", "8x6", "a.nc", "b.nc"}}) {
        Explorer e;
        e.files = {"a.nc", "b.nc"};
        e.layers = {{RangeSet::parse("0:1"), {}, {}}};
        e.size = {8, 6};
        EXPECT_TRUE(as<ViewOptions>(arguments).explorer == e);
    }
    EXPECT_EQ(as<ViewOptions>({"info.nc"}).explorer.files.at(0), "info.nc");
    EXPECT_EQ(as<ViewOptions>({"./info"}).explorer.files.at(0), "./info");
    EXPECT_THAT(refused({"a.nc", "-o", "b.png"}), HasSubstr("-o"));
    EXPECT_THAT(refused({"a.nc", "--opacity", "2"}), HasSubstr("--opacity"));
}

TEST(Options, WhereAFileIsViewed) {
    EXPECT_EQ(as<ViewOptions>({"a.nc"}).display, Display::Auto);
    EXPECT_EQ(as<ViewOptions>({"a.nc", "--display", "auto"}).display, Display::Auto);
    EXPECT_EQ(as<ViewOptions>({"a.nc", "--display", "desktop"}).display, Display::Desktop);
    EXPECT_EQ(as<ViewOptions>({"view", "a.nc", "--display", "headset"}).display, Display::Headset);
    EXPECT_THAT(refused({"a.nc", "--display", "vr"}), HasSubstr("headset"));
}

TEST(Options, ViewedHeadlessAFileIsRendered) {
    const auto viewed =
        as<RenderOptions>({"a.nc", "--range", "0:1", "--display", "headless", "-o", "b.png"});
    const auto rendered = as<RenderOptions>({"render", "a.nc", "--range", "0:1", "-o", "b.png"});
    EXPECT_TRUE(viewed.explorer == rendered.explorer);
    EXPECT_EQ(viewed.output, rendered.output);
    EXPECT_EQ(viewed.by.device, rendered.by.device);
    EXPECT_THAT(refused({"a.nc", "--display", "headless"}), HasSubstr("-o"));
    EXPECT_THAT(refused({"a.nc", "--display", "desktop", "-o", "b.png"}), HasSubstr("headless"));
    EXPECT_THAT(refused({"a.nc", "--display", "headless", "-o", "b.txt"}), HasSubstr("b.txt"));
}

TEST(Options, AWindowNeedsNoFile) {
    EXPECT_TRUE(as<ViewOptions>({}).explorer == Explorer{});
    EXPECT_TRUE(as<ViewOptions>({"view"}).explorer == Explorer{});
}

TEST(Options, InfoTakesFilesAndAFlag) {
    const auto one = as<InfoOptions>({"info", "a.nc"});
    EXPECT_EQ(one.files, (std::vector<std::filesystem::path>{"a.nc"}));
    EXPECT_FALSE(one.json);
    const auto two = as<InfoOptions>({"info", "--json", "a.nc", "b c.nc"});
    EXPECT_EQ(two.files, (std::vector<std::filesystem::path>{"a.nc", "b c.nc"}));
    EXPECT_TRUE(two.json);
}

TEST(Options, FileNamesMayLookLikeLists) {
    EXPECT_EQ(as<InfoOptions>({"info", "[a,b].nc"}).files,
              (std::vector<std::filesystem::path>{"[a,b].nc"}));
}

TEST(Options, CountTakesWhatItSays) {
    const auto count =
        as<CountOptions>({"count", "a.nc", "b.nc", "--variable", "T", "--range", "0:1,3:4",
                          "--range", "(5,6)", "--keep", "0:10", "--step", "2:5", "--json"});
    EXPECT_EQ(count.files.size(), 2u);
    EXPECT_EQ(count.variable, "T");
    EXPECT_EQ(count.ranges, (std::vector{RangeSet::parse("0:1,3:4"), RangeSet::parse("(5,6)")}));
    EXPECT_EQ(count.keep, RangeSet::parse("0:10"));
    EXPECT_EQ(count.steps, (StepChoice{2, 5}));
    EXPECT_TRUE(count.json);
    const auto plain = as<CountOptions>({"count", "a.nc", "--range", "0:1"});
    EXPECT_EQ(plain.steps, (StepChoice{0, {}}));
    EXPECT_FALSE(plain.keep);
}

TEST(Options, MeasureTakesWhatItSays) {
    const auto measure = as<MeasureOptions>(
        {"measure", "a.nc",  "--range",  "0:1",   "--size", "320x240", "--step",          "4",
         "--views", "2",     "--frames", "7",     "--rays", "5",       "--json",          "--csv",
         "t.csv",   "--svg", "t.svg",    "--png", "t.png",  "--modes", "cells,points 1/4"});
    EXPECT_EQ(measure.explorer.layers.front().ranges, RangeSet::parse("0:1"));
    EXPECT_EQ(measure.explorer.size, glm::ivec2(320, 240));
    EXPECT_EQ(measure.views, 2u);
    EXPECT_EQ(measure.frames, 7u);
    EXPECT_EQ(measure.rays, 5u);
    EXPECT_EQ(measure.modes, (std::vector<std::string>{"cells", "points 1/4"}));
    EXPECT_TRUE(measure.json);
    EXPECT_EQ(measure.csv, "t.csv");
    EXPECT_EQ(measure.svg, "t.svg");
    EXPECT_EQ(measure.png, "t.png");
    const auto byGl =
        as<MeasureOptions>({"measure", "a.nc", "--splatter", "gl", "--device", "gpu"});
    EXPECT_EQ(byGl.by.splatter, render::SplatterChoice::Gl);
    EXPECT_EQ(byGl.by.device, "gpu");
    const auto plain = as<MeasureOptions>({"measure", "a.nc"});
    EXPECT_EQ(plain.views, 3u);
    EXPECT_GE(plain.frames, 3u);
    EXPECT_FALSE(plain.json);
    EXPECT_TRUE(plain.modes.empty());
    EXPECT_EQ(plain.by.splatter, render::SplatterChoice::ByDevice) << "as pictures are drawn";
    EXPECT_TRUE(plain.csv.empty() && plain.svg.empty() && plain.png.empty());
}

TEST(Options, BadValuesAreRefusedByTheNameOfTheirOption) {
    const std::pair<const char*, std::vector<const char*>> bad[] = {
        {"flip", {"", "w", "xy", "x,x"}},
        {"name-axis", {"", "depth", "z=", "w=depth"}},
        {"step", {"", "a", "-1", "3:2", "1.5"}},
        {"range", {"", "a", "2:1", "nan:1", "[1,2", "1:2,", "1~-1"}},
        {"keep", {"", "a", "2:1"}},
        {"color", {"", "red", "#12345", "#1234567"}},
        {"colormap",
         {"", "jet", "Viridis", "viridis=", "viridis=1", "viridis=a:1", "viridis=1:2:3",
          "viridis=nan:1", "viridis=0:inf", "=0:1"}},
        {"hide", {"", "0", "-1", "9", "a", "1.5"}},
        {"target", {"", "1", "1,2", "1,2,3,4", "a,b,c", "1,2,nan", "1e7,0,0"}},
        {"opacity", {"", "-0.1", "1.1", "a", "nan", "inf", "-nan"}},
        {"splat", {"", "ball"}},
        {"splat-size", {"", "0", "-1", "1e9", "nan", "inf", "a"}},
        {"order", {"", "front"}},
        {"model", {"", "voxels"}},
        {"clip", {"", "0:1", "1:0,0:1,0:1"}},
        {"scale", {"", "1", "0,1,1", "1,1,nan", "1e300,1,1", "1,1e-13,1", "1e300"}},
        {"view", {"", "1", "a,b", "1,2,0", "1,2,1e7", "1,2,1e-7"}},
        {"shift", {"", "0", "0,1.5", "a,b", "nan,0", "0,0,0"}},
        {"size", {"", "0x0", "1x", "16385x1", "-1x1"}},
        {"stereo", {"", "both"}},
        {"eye-distance", {"", "-1", "nan", "inf", "a", "1e7"}},
        {"convergence", {"", "0", "-1", "nan", "inf"}},
        {"channel", {"", "depth", "opticaldepth"}},
        {"device", {"", "gl", "GPU"}},
        {"splatter", {"", "gpu", "double"}}};
    for (const auto& [option, values] : bad)
        for (const char* value : values) {
            const std::string text = renderRefused({std::string("--") + option, value});
            // "splat-size 0 is ..." or "splat size '0'": the first word of the option is enough.
            const std::string word =
                option == std::string("keep")
                    ? "range"
                    : std::string(option).substr(0, std::string(option).find('-'));
            EXPECT_THAT(text, HasSubstr(word)) << option << " '" << value << "'";
        }
    for (const auto& [option, values] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"--delta", {"-1", "nan", "inf", ""}},
             {"--timer-steps", {"0", "-1", "1.5", "1073741825", "nan", ""}},
             {"--timer-step", {"0", "-1", "1.5", "1073741825", ""}},
             {"--frequency", {"-1", "nan", "inf", ""}}})
        for (const std::string& value : values)
            EXPECT_THAT(renderRefused({"--sweep", "0:1", option, value}), HasSubstr(option))
                << value;
    EXPECT_THAT(renderRefused({"--sweep", ""}), HasSubstr("range"));
}

TEST(Options, AnEmptyTextIsNoChoiceThatWasNotMade) {
    refused({"count", "a.nc", "--range", "0:1", "--keep", ""});
    refused({"count", "a.nc", "--range", "0:1", "--step", ""});
    refused({"count", "a.nc", "--range", ""});
    EXPECT_EQ(refused({"count", "a.nc", "--range=", "--cache", "off"}),
              "--range= has no value (see isochron --help)");
    refused({"render", "a.nc", "-o", ""});
    refused({"render", "", "-o", "o.png"});
    refused({"info", ""});
}

TEST(Options, TheOutputsEndingDecidesTheFormat) {
    for (const char* output : {"o", "o.jpg", "png", ".png", "o.png/", "", "o.png.txt"})
        refused({"render", "a.nc", "-o", output});
    const auto png = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "a.nc", "-o", "o.png"});
        return refused(more);
    };
    EXPECT_THAT(png({"--stereo", "multiview"}), HasSubstr(".exr"));
    EXPECT_THAT(png({"--channel", "opticalDepth"}), HasSubstr(".exr"));
    renderRefused({"--channel", "opticalDepth", "--stereo", "side-by-side"});
    renderRefused({"--channel", "splatCount", "--stereo", "top-bottom"});
    for (const char* stereo : {"off", "multiview", "left-right"})
        EXPECT_TRUE(render({"--channel", "splatCount", "--stereo", stereo}).splatCount);
}

}  // namespace
}  // namespace app

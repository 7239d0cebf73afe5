#include "app/choices/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/choices/choice_text.h"
#include "app/choices/session.h"
#include "tests/support/files.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

using testing::HasSubstr;
using testing::Not;
using timeseries::RangeSet;

Command parsed(const std::vector<std::string>& arguments) {
    std::vector<const char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return parse(pointers);
}

template <typename T>
T as(const std::vector<std::string>& arguments) {
    Command command = parsed(arguments);
    if (const auto* exit = std::get_if<Exit>(&command))
        throw std::runtime_error("exit " + std::to_string(exit->code) + ": " + exit->text);
    return std::get<T>(command);
}

// `isochron render a.nc -o o.exr` and these.
RenderOptions render(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.nc", "-o", "o.exr"});
    return as<RenderOptions>(more);
}
Explorer explorer(const std::vector<std::string>& more) { return render(more).explorer; }

// Refused with exit code 2 in one sentence, which is returned.
std::string refused(const std::vector<std::string>& arguments) {
    const Command command = parsed(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += " '" + argument + "'";
    const auto* exit = std::get_if<Exit>(&command);
    if (exit == nullptr) {
        ADD_FAILURE() << "accepted:" << line;
        return {};
    }
    EXPECT_EQ(exit->code, 2) << line;
    EXPECT_FALSE(exit->text.empty()) << line;
    EXPECT_EQ(exit->text.find('\n'), std::string::npos) << line << ": " << exit->text;
    return exit->text;
}
std::string renderRefused(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.nc", "-o", "o.exr"});
    return refused(more);
}

glm::dvec3 rgb(const LayerChoice& layer) { return std::get<glm::dvec3>(layer.color.value()); }
std::string_view mapName(const LayerChoice& layer) {
    return std::get<MapChoice>(layer.color.value()).map.name();
}

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
         {"--session",   "--variable", "--step",         "--range",       "--keep",
          "--color",     "--colormap", "--opacity",      "--splat",       "--splat-size",
          "--order",     "--sweep",    "--delta",        "--timer-steps", "--timer-step",
          "--frequency", "--swing",    "--clip",         "--scale",       "--view",
          "--size",      "--stereo",   "--eye-distance", "--convergence", "--channel",
          "--device",    "--output",   "--hide",         "--target",      "--orthographic",
          "--tick",      "--portable", "--flip",         "--name-axis",   "--splatter",
          "--model"}) {
        EXPECT_THAT(help, HasSubstr(option));
        const bool isOfFiles =
            std::set<std::string_view>{"--device", "--splatter", "--channel", "--portable"}
                .contains(option);
        EXPECT_EQ(helpOfView.find(option) == std::string::npos, isOfFiles) << option;
    }
    EXPECT_THAT(helpOfView, HasSubstr("--display"));
    EXPECT_THAT(help, Not(HasSubstr("--display")));
}

TEST(Options, EveryCommandTakesALimitOfThreads) {
    for (std::vector<std::string> line :
         {std::vector<std::string>{"info", "a.nc"},
          {"count", "a.nc", "--range", "0:1"},
          {"render", "a.nc", "-o", "a.png"},
          {"view", "a.nc"},
          {"view", "--display", "headless", "a.nc", "-o", "a.png"}}) {
        EXPECT_EQ(threadsOf(parsed(line)), 0u) << line[0];
        line.insert(line.end(), {"--threads", "3"});
        EXPECT_EQ(threadsOf(parsed(line)), 3u) << line[0];
        line.back() = "0";
        EXPECT_THAT(refused(line), HasSubstr("--threads")) << line[0];
    }
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
    EXPECT_EQ(viewed.device, rendered.device);
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
        {"measure", "a.nc", "--range", "0:1", "--size", "320x240", "--step", "4", "--views", "2",
         "--frames", "7", "--rays", "5", "--json", "--csv", "t.csv", "--svg", "t.svg"});
    EXPECT_EQ(measure.explorer.layers.front().ranges, RangeSet::parse("0:1"));
    EXPECT_EQ(measure.explorer.size, glm::ivec2(320, 240));
    EXPECT_EQ(measure.views, 2u);
    EXPECT_EQ(measure.frames, 7u);
    EXPECT_EQ(measure.rays, 5u);
    EXPECT_TRUE(measure.json);
    EXPECT_EQ(measure.csv, "t.csv");
    EXPECT_EQ(measure.svg, "t.svg");
    const auto plain = as<MeasureOptions>({"measure", "a.nc"});
    EXPECT_EQ(plain.views, 3u);
    EXPECT_GE(plain.frames, 3u);
    EXPECT_FALSE(plain.json);
    EXPECT_TRUE(plain.csv.empty() && plain.svg.empty());
}

TEST(Options, RangesKeepTheirBracketsCommasAndSigns) {
    for (const char* text : {"[600,1600]", "[600,1600)", "(600,1600]", "(600,1600)", "-3:0", "-3",
                             "-3:-1", "min:-2", "-1e5~3", "[1,2],[3,4]", "(1,2),(3,4)", "min:max",
                             "600:1600", "850~50", "300:400,900:max", "[-5,-4]"}) {
        const auto want = std::vector{RangeSet::parse(text)};
        EXPECT_EQ(as<CountOptions>({"count", "a.nc", "--range", text}).ranges, want) << text;
        EXPECT_EQ(as<CountOptions>({"count", "a.nc", std::string("--range=") + text}).ranges, want)
            << text;
        EXPECT_EQ(as<CountOptions>({"count", "--range", text, "a.nc"}).ranges, want) << text;
        const Explorer e = explorer({"--range", text, "--keep", text});
        ASSERT_EQ(e.layers.size(), 1u) << text;
        EXPECT_EQ(e.layers[0].ranges, want[0]) << text;
        EXPECT_EQ(e.keep, want[0]) << text;
    }
}

TEST(Options, WithoutOptionsEverythingIsLeftOpen) {
    const RenderOptions options = render({});
    Explorer e;
    e.files = {"a.nc"};
    EXPECT_TRUE(options.explorer == e);
    EXPECT_EQ(options.output, "o.exr");
    EXPECT_EQ(options.device, "any");
    EXPECT_FALSE(options.opticalDepth || options.splatCount);
}

TEST(Options, EveryRenderOptionArrives) {
    const RenderOptions options = render({"--variable",
                                          "T",
                                          "--step",
                                          "3:7",
                                          "--range",
                                          "600:1600",
                                          "--keep",
                                          "500:max",
                                          "--color",
                                          "#336699",
                                          "--opacity",
                                          "0.25",
                                          "--splat",
                                          "point",
                                          "--splat-size",
                                          "3.5",
                                          "--order",
                                          "none",
                                          "--clip",
                                          "0:1,2:3,min:max",
                                          "--scale",
                                          "1,2,3",
                                          "--view",
                                          "-30,45,2.5",
                                          "--target",
                                          "0.5,-1,2e-3",
                                          "--orthographic",
                                          "--size",
                                          "320x240",
                                          "--stereo",
                                          "multiview",
                                          "--eye-distance",
                                          "0.1",
                                          "--convergence",
                                          "4",
                                          "--channel",
                                          "opticalDepth",
                                          "--channel",
                                          "splatCount",
                                          "--device",
                                          "cpu"});
    const Explorer& e = options.explorer;
    EXPECT_EQ(e.variable, "T");
    EXPECT_EQ(e.steps, (StepChoice{3, 7}));
    EXPECT_EQ(e.keep, RangeSet::parse("500:max"));
    ASSERT_EQ(e.layers.size(), 1u);
    EXPECT_EQ(e.layers[0].ranges, RangeSet::parse("600:1600"));
    EXPECT_EQ(rgb(e.layers[0]), parseColor("#336699"));
    EXPECT_EQ(e.layers[0].opacity, 0.25);
    EXPECT_EQ(e.footprint.kernel, render::Kernel::Point);
    EXPECT_EQ(e.footprint.size, 3.5);
    EXPECT_EQ(e.order, render::Order::None);
    EXPECT_EQ(e.clip, parseClip("0:1,2:3,min:max"));
    EXPECT_EQ(e.scale, glm::dvec3(1, 2, 3));
    EXPECT_EQ(e.view, (ViewChoice{-30, 45, 2.5, {0.5, -1, 2e-3}, Projection::Orthographic}));
    EXPECT_EQ(e.size, glm::ivec2(320, 240));
    EXPECT_EQ(e.stereo, (StereoChoice{Stereo::MultiView, 0.1, 4.0}));
    EXPECT_TRUE(options.opticalDepth && options.splatCount);
    EXPECT_EQ(options.device, "cpu");
}

TEST(Options, EveryStereoModeAndDeviceIsTaken) {
    for (const char* mode : {"off", "side-by-side", "top-bottom", "multiview", "left-right"})
        EXPECT_EQ(explorer({"--stereo", mode}).stereo.mode, parseStereo(mode));
    for (const char* device : {"any", "gpu", "cpu"})
        EXPECT_EQ(render({"--device", device}).device, device);
    using Choice = ::render::SplatterChoice;
    EXPECT_EQ(render({}).splatter, Choice::ByDevice);
    EXPECT_EQ(render({"--splatter", "any"}).splatter, Choice::ByDevice);
    EXPECT_EQ(render({"--splatter", "gl"}).splatter, Choice::Gl);
    EXPECT_EQ(render({"--splatter", "cpu"}).splatter, Choice::Cpu);
    EXPECT_EQ(render({"--splatter", "exact"}).splatter, Choice::Exact);
}

TEST(Options, CellsAreDrawnUnlessSplatsAreChosen) {
    EXPECT_EQ(explorer({}).model, Model::Cells);
    EXPECT_EQ(explorer({"--splat", "point"}).model, Model::Points);
    EXPECT_EQ(explorer({"--splat-size", "2"}).model, Model::Points);
    EXPECT_EQ(explorer({"--splat-size", "2", "--model", "cells"}).model, Model::Cells);
    // The truth of points.
    EXPECT_EQ(render({"--splatter", "exact"}).explorer.model, Model::Points);
    EXPECT_THAT(renderRefused({"--model", "cells", "--splatter", "exact"}),
                HasSubstr("--splatter exact draws points"));
}

TEST(Options, TheSweepTakesItsSettings) {
    const Explorer e = explorer({"--sweep", "300:400,900:1600", "--delta", "25", "--timer-steps",
                                 "128", "--timer-step", "4", "--frequency", "0.5", "--swing"});
    ASSERT_TRUE(e.sweep);
    EXPECT_EQ(*e.sweep, (timeseries::SweepSettings{RangeSet::parse("300:400,900:1600"), 25, 128, 4,
                                                   0.5, timeseries::SweepPath::Swing}));
    const Explorer plain = explorer({"--sweep", "min:max"});
    EXPECT_EQ(*plain.sweep, (timeseries::SweepSettings{RangeSet::everything(), 0, 256, 1, 0.1,
                                                       timeseries::SweepPath::Loop}));
    for (const std::vector<std::string>& alone : {std::vector<std::string>{"--delta", "1"},
                                                  {"--timer-steps", "2"},
                                                  {"--timer-step", "2"},
                                                  {"--frequency", "1"},
                                                  {"--tick", "1"},
                                                  {"--swing"}})
        EXPECT_THAT(renderRefused(alone), HasSubstr(alone[0] + " needs --sweep"));
}

TEST(Options, AxesAreFlippedAndNamed) {
    const Explorer e =
        explorer({"--flip", "y,z", "--name-axis", "z=depth", "--name-axis", "x=easting"});
    EXPECT_EQ(e.axes[0], (AxisChoice{false, "easting"}));
    EXPECT_EQ(e.axes[1], (AxisChoice{true, ""}));
    EXPECT_EQ(e.axes[2], (AxisChoice{true, "depth"}));
}

TEST(Options, ATickIsOneOfTheSweeps) {
    EXPECT_FALSE(explorer({"--sweep", "0:9"}).oneTick);
    const auto ticked = [](const char* tick) {
        // 0, 3, 6, 9 of ten.
        return std::vector<std::string>{"--sweep",      "0:9", "--timer-steps", "10",
                                        "--timer-step", "3",   "--tick",        tick};
    };
    const Explorer e = explorer(ticked("3"));
    EXPECT_TRUE(e.oneTick);
    EXPECT_EQ(e.play.tick, 3);
    EXPECT_THAT(renderRefused(ticked("4")), HasSubstr("--tick: 4 is none of the sweep's, 0 to 3"));
    EXPECT_THAT(renderRefused(ticked("-1")), HasSubstr("--tick"));
    EXPECT_THAT(renderRefused(ticked("a")), HasSubstr("--tick"));
}

TEST(Options, ColorsAndMapsTakeTheLayersInTheOrderWritten) {
    const Explorer e = explorer({"--range", "0:1", "--color", "#ff0000", "--range", "2:3",
                                 "--range", "4:5", "--colormap", "inferno", "--color", "#0000ff",
                                 "--opacity", "0.1", "--opacity", "0.2"});
    ASSERT_EQ(e.layers.size(), 3u);
    EXPECT_EQ(rgb(e.layers[0]), parseColor("#ff0000"));
    EXPECT_EQ(mapName(e.layers[1]), "inferno");
    EXPECT_EQ(rgb(e.layers[2]), parseColor("#0000ff"));
    EXPECT_EQ(e.layers[0].opacity, 0.1);
    EXPECT_EQ(e.layers[1].opacity, 0.2);
    EXPECT_FALSE(e.layers[2].opacity);
}

TEST(Options, MapsTakeTheValuesOfTheirEnds) {
    const auto map = [](const char* text) {
        return std::get<MapChoice>(explorer({"--colormap", text}).layers.at(0).color.value());
    };
    const render::ColorMap inferno = *render::colorMapNamed("inferno");
    EXPECT_EQ(map("inferno"), (MapChoice{inferno, {}, {}}));
    EXPECT_EQ(map("inferno=300:1600"), (MapChoice{inferno, 300.0, 1600.0}));
    EXPECT_EQ(map("inferno=-1e-3:"), (MapChoice{inferno, -1e-3, {}}));
    EXPECT_EQ(map("inferno=:-5"), (MapChoice{inferno, {}, -5.0}));
    EXPECT_EQ(map("inferno=2:1"), (MapChoice{inferno, 2.0, 1.0})) << "the middle everywhere";
}

TEST(Options, HiddenLayersAreCountedAsStylesAre) {
    const Explorer e = explorer(
        {"--range", "0:1", "--range", "2:3", "--sweep", "5:9", "--hide", "1", "--hide", "3"});
    EXPECT_FALSE(e.sweepLayer.visible);
    EXPECT_TRUE(e.layers.at(0).visible);
    EXPECT_FALSE(e.layers.at(1).visible);
    EXPECT_FALSE(explorer({"--hide", "1"}).layers.at(0).visible) << "the first choice";
    EXPECT_THAT(renderRefused({"--range", "0:1", "--hide", "2"}), HasSubstr("--hide 2"));
}

TEST(Options, TheSweptLayerTakesTheFirstStyle) {
    const Explorer e = explorer({"--range", "0:1", "--sweep", "5:9", "--color", "#ff0000",
                                 "--colormap", "cividis", "--opacity", "0.3"});
    EXPECT_EQ(rgb(e.sweepLayer), parseColor("#ff0000"));
    EXPECT_EQ(e.sweepLayer.opacity, 0.3);
    EXPECT_EQ(mapName(e.layers.at(0)), "cividis");
    EXPECT_FALSE(e.layers.at(0).opacity);
}

TEST(Options, OneStyleWithoutARangeIsTheFirstChoices) {
    const Explorer e = explorer({"--color", "#ff0000", "--opacity", "0.3"});
    ASSERT_EQ(e.layers.size(), 1u);
    EXPECT_TRUE(e.layers[0].ranges.empty());
    EXPECT_EQ(rgb(e.layers[0]), parseColor("#ff0000"));
}

TEST(Options, MoreStylesThanLayersAreRefused) {
    renderRefused({"--color", "#ff0000", "--color", "#00ff00"});
    renderRefused({"--range", "0:1", "--color", "#ff0000", "--colormap", "inferno"});
    renderRefused({"--range", "0:1", "--opacity", "0.1", "--opacity", "0.2"});
    std::vector<std::string> nine;
    for (int i = 0; i < 9; ++i) nine.insert(nine.end(), {"--range", "0:1"});
    EXPECT_THAT(renderRefused(nine), HasSubstr("8"));
    nine.resize(16);
    EXPECT_EQ(explorer(nine).layers.size(), 8u);
    nine.insert(nine.end(), {"--sweep", "0:1"});
    renderRefused(nine);
}

TEST(Options, ZeroAndOneAreOpacities) {
    EXPECT_EQ(explorer({"--opacity", "0"}).layers.at(0).opacity, 0);
    EXPECT_EQ(explorer({"--opacity", "1"}).layers.at(0).opacity, 1);
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

class OptionsWithSession : public testing::Test {
 protected:
    OptionsWithSession() : file_(tests::freshFolder() / "s.json") {
        saved_.files = {file_.parent_path() / "saved.nc"};
        saved_.variable = "T";
        saved_.steps = StepChoice{4, 4};
        saved_.keep = RangeSet::parse("0:2000");
        saved_.layers = {{RangeSet::parse("600:1600"), parseColor("#112233"), 0.5},
                         {RangeSet::parse("300:400"), parseColor("#445566"), 0.6}};
        saved_.sweep.emplace();
        saved_.sweep->animation = RangeSet::parse("300:1600");
        saved_.sweep->delta = 20;
        saved_.sweepLayer = {{}, parseColor("#778899"), 0.7};
        saved_.footprint = {render::Kernel::Point, 2};
        saved_.order = render::Order::BackToFront;
        saved_.axes[0] = {true, "height"};
        saved_.clip = parseClip("0:1,0:1,0:1");
        saved_.scale = glm::dvec3(1, 2, 3);
        saved_.view = {1, 2, 3.0, {0.1, 0.2, 0.3}};
        saved_.stereo = {Stereo::TopBottom, 0.2, 5.0};
        saved_.size = {64, 48};
        tests::writeBytes(saved_.files.front(), "");
        tests::writeBytes(file_, toJson(saved_, file_.parent_path()).dump());
    }
    Explorer with(std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "--session", file_.string(), "-o", "o.exr"});
        return as<RenderOptions>(more).explorer;
    }
    std::filesystem::path file_;
    Explorer saved_;
};

TEST_F(OptionsWithSession, AloneItIsTheSession) { EXPECT_TRUE(with({}) == saved_); }

TEST_F(OptionsWithSession, ItMayStandWhereAFileDoes) {
    EXPECT_TRUE(as<ViewOptions>({file_.string()}).explorer == saved_);
    const std::vector<std::string> rendered{"render", file_.string(), "--step", "7", "-o", "o.exr"};
    Explorer otherStep = saved_;
    otherStep.steps = StepChoice{7, 7};
    EXPECT_TRUE(as<RenderOptions>(rendered).explorer == otherStep);
    EXPECT_THROW(parsed({"view", "/none.json"}), timeseries::FileError);
}

TEST_F(OptionsWithSession, WhoseDataAreGoneNeedsOthersBesideIt) {
    std::filesystem::remove(saved_.files.front());
    try {
        with({});
        ADD_FAILURE() << "accepted";
    } catch (const timeseries::FileError& error) {
        for (const std::string& named :
             {file_.string() + ": ", saved_.files.front().string(), "--session " + file_.string()})
            EXPECT_THAT(error.what(), HasSubstr(named));
    }
    EXPECT_EQ(with({"other.nc"}).files.front(), "other.nc");
}

TEST_F(OptionsWithSession, AnOptionBesideItWinsAndLeavesTheRest) {
    const auto expectOnly = [&](const std::vector<std::string>& more, auto change) {
        Explorer e = saved_;
        change(e);
        EXPECT_TRUE(with(more) == e) << more.front();
    };
    expectOnly({"other.nc"}, [](Explorer& e) { e.files = {"other.nc"}; });
    expectOnly({"--variable", "U"}, [](Explorer& e) { e.variable = "U"; });
    expectOnly({"--variable", ""}, [](Explorer& e) { e.variable = ""; });
    expectOnly({"--step", "7"}, [](Explorer& e) { e.steps = StepChoice{7, 7}; });
    expectOnly({"--flip", "z"}, [](Explorer& e) {
        for (AxisChoice& axis : e.axes) axis.flip = false;
        e.axes[2].flip = true;
    });
    expectOnly({"--flip", "none"}, [](Explorer& e) { e.axes[0].flip = false; });
    expectOnly({"--name-axis", "x=a"}, [](Explorer& e) { e.axes[0].name = "a"; });
    expectOnly({"--keep", "1:2"}, [](Explorer& e) { e.keep = RangeSet::parse("1:2"); });
    expectOnly({"--range", "1:2"}, [](Explorer& e) {
        e.layers = {{RangeSet::parse("1:2"), {}, {}}};
    });
    expectOnly({"--color", "#ffffff"}, [](Explorer& e) { e.sweepLayer.color = glm::dvec3(1); });
    expectOnly({"--opacity", "0.1"}, [](Explorer& e) { e.sweepLayer.opacity = 0.1; });
    expectOnly({"--sweep", "5:6"}, [](Explorer& e) {
        e.sweep.emplace();
        e.sweep->path = timeseries::SweepPath::Loop;
        e.sweep->animation = RangeSet::parse("5:6");
    });
    expectOnly({"--delta", "3"}, [](Explorer& e) { e.sweep->delta = 3; });
    expectOnly({"--tick", "9"}, [](Explorer& e) {
        e.oneTick = true;
        e.play.tick = 9;
    });
    expectOnly({"--timer-steps", "9"}, [](Explorer& e) { e.sweep->timerSteps = 9; });
    // Which are of points.
    expectOnly({"--splat", "kernel"}, [](Explorer& e) {
        e.footprint.kernel = render::Kernel::Quartic;
        e.model = Model::Points;
    });
    expectOnly({"--splat-size", "1"}, [](Explorer& e) {
        e.footprint.size = 1;
        e.model = Model::Points;
    });
    expectOnly({"--model", "points"}, [](Explorer& e) { e.model = Model::Points; });
    expectOnly({"--order", "none"}, [](Explorer& e) { e.order = render::Order::None; });
    expectOnly({"--clip", "1:2,1:2,1:2"}, [](Explorer& e) { e.clip = parseClip("1:2,1:2,1:2"); });
    expectOnly({"--scale", "1,1,1"}, [](Explorer& e) { e.scale = glm::dvec3(1); });
    expectOnly({"--view", "9,8"}, [](Explorer& e) {
        e.view = {9, 8, {}, e.view.target};  // another target is --target's
    });
    expectOnly({"--target", "1,2,3"}, [](Explorer& e) { e.view.target = {1, 2, 3}; });
    expectOnly({"--orthographic"},
               [](Explorer& e) { e.view.projection = Projection::Orthographic; });
    expectOnly({"--hide", "2"}, [](Explorer& e) { e.layers[0].visible = false; });
    expectOnly({"--size", "5x6"}, [](Explorer& e) { e.size = {5, 6}; });
    expectOnly({"--stereo", "off"}, [](Explorer& e) { e.stereo.mode = Stereo::Off; });
    expectOnly({"--eye-distance", "0"}, [](Explorer& e) { e.stereo.eyeDistance = 0; });
    expectOnly({"--convergence", "1"}, [](Explorer& e) { e.stereo.convergence = 1; });
}

TEST_F(OptionsWithSession, AFileThatCannotBeReadIsNoWrongArgument) {
    // Exit code 1, as for any file: main catches it.
    EXPECT_THROW(parsed({"render", "--session", "/none.json", "-o", "o.png"}),
                 timeseries::FileError);
    tests::writeBytes(file_, "{");
    EXPECT_THROW(with({}), timeseries::FileError);
}

}  // namespace
}  // namespace app

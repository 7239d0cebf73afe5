// What render draws, from its options.
#include "app/choices/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/choices/choice_text.h"
#include "app/choices/session.h"
#include "tests/support/files.h"
#include "tests/support/parsed_options.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using namespace app::parsing;

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
    EXPECT_EQ(options.by.device, "any");
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
                                          "--shift",
                                          "0.25,-0.5",
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
    EXPECT_EQ(
        e.view,
        (ViewChoice{
            -30, 45, 2.5, {0.5, -1, 2e-3}, Projection::Orthographic, glm::dvec2(0.25, -0.5)}));
    EXPECT_EQ(e.size, glm::ivec2(320, 240));
    EXPECT_EQ(e.stereo, (StereoChoice{Stereo::MultiView, 0.1, 4.0}));
    EXPECT_TRUE(options.opticalDepth && options.splatCount);
    EXPECT_EQ(options.by.device, "cpu");
}

TEST(Options, EveryStereoModeAndDeviceIsTaken) {
    for (const char* mode : {"off", "side-by-side", "top-bottom", "multiview", "left-right"})
        EXPECT_EQ(explorer({"--stereo", mode}).stereo.mode, parseStereo(mode));
    for (const char* device : {"any", "gpu", "cpu"})
        EXPECT_EQ(render({"--device", device}).by.device, device);
    using Choice = ::render::SplatterChoice;
    EXPECT_EQ(render({}).by.splatter, Choice::ByDevice);
    EXPECT_EQ(render({"--splatter", "any"}).by.splatter, Choice::ByDevice);
    EXPECT_EQ(render({"--splatter", "gl"}).by.splatter, Choice::Gl);
    EXPECT_EQ(render({"--splatter", "cpu"}).by.splatter, Choice::Cpu);
    EXPECT_EQ(render({"--splatter", "exact"}).by.splatter, Choice::Exact);
}

TEST(Options, CellsAreDrawnUnlessSplatsAreChosen) {
    EXPECT_EQ(explorer({}).model, Model::Cells);
    EXPECT_EQ(explorer({"--splat", "point"}).model, Model::Points);
    EXPECT_EQ(explorer({"--splat-size", "2"}).model, Model::Points);
    EXPECT_EQ(explorer({"--splat-size", "2", "--model", "cells"}).model, Model::Cells);
    EXPECT_THAT(renderRefused({"--range", "1:2", "--model", "auto", "--model", "points", "--model",
                               "points"}),
                testing::HasSubstr("2 colours, opacities or models for 1 layer:"));
    EXPECT_EQ(explorer({"--model", "auto", "--model", "points"}).layers.at(0).model, Model::Points);
}

TEST(Options, TheTruthDrawsAllByOneModel) {
    for (const char* model : {"cells", "points"})
        EXPECT_EQ(render({"--splatter", "exact", "--model", model}).explorer.model,
                  model == std::string("cells") ? Model::Cells : Model::Points);
    EXPECT_THAT(renderRefused({"--splatter", "exact", "--range", "1:2", "--model", "cells",
                               "--range", "3:4", "--model", "points"}),
                HasSubstr("draws all layers by cells, or all by points"));
}

TEST(Options, TheSweepTakesItsSettings) {
    const Explorer e = explorer({"--sweep", "300:400,900:1600", "--delta", "25", "--timer-steps",
                                 "128", "--timer-step", "4", "--frequency", "0.5", "--swing"});
    ASSERT_TRUE(sweepOf(e));
    EXPECT_EQ(*sweepOf(e), (timeseries::SweepSettings{RangeSet::parse("300:400,900:1600"), 25, 128,
                                                      4, 0.5, timeseries::SweepPath::Swing}));
    const Explorer plain = explorer({"--sweep", "min:max"});
    EXPECT_EQ(*sweepOf(plain), (timeseries::SweepSettings{RangeSet::everything(), 0, 256, 1, 0.1,
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
    EXPECT_EQ(map("inferno=2:1"), (MapChoice{inferno, 2.0, 1.0})) << "turned round";
}

TEST(Options, HiddenLayersAreCountedAsStylesAre) {
    const Explorer e = explorer(
        {"--range", "0:1", "--range", "2:3", "--sweep", "5:9", "--hide", "1", "--hide", "3"});
    EXPECT_FALSE(e.layers.front().visible);
    EXPECT_TRUE(e.layers.at(1).visible);
    EXPECT_FALSE(e.layers.at(2).visible);
    EXPECT_FALSE(explorer({"--hide", "1"}).layers.at(0).visible) << "the first choice";
    EXPECT_THAT(renderRefused({"--range", "0:1", "--hide", "2"}), HasSubstr("--hide 2"));
}

TEST(Options, TheSweptLayerTakesTheFirstStyle) {
    const Explorer e = explorer({"--range", "0:1", "--sweep", "5:9", "--color", "#ff0000",
                                 "--colormap", "cividis", "--opacity", "0.3"});
    EXPECT_EQ(rgb(e.layers.at(0)), parseColor("#ff0000"));
    EXPECT_EQ(e.layers.front().opacity, 0.3);
    EXPECT_EQ(mapName(e.layers.at(1)), "cividis");
    EXPECT_FALSE(e.layers.at(1).opacity);
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

}  // namespace
}  // namespace app

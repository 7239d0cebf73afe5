// Options beside a session.
#include "app/choices/options.h"
#include "app/choices/sweep_edits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

class OptionsWithSession : public testing::Test {
 protected:
    OptionsWithSession() : file_(tests::freshFolder() / "s.json") {
        saved_.files = {file_.parent_path() / "saved.nc"};
        saved_.variable = "T";
        saved_.steps = StepChoice{4, 4};
        saved_.keep = RangeSet::parse("0:2000");
        saved_.layers = {{RangeSet::parse("600:1600"), parseColor("#112233"), 0.5},
                         {RangeSet::parse("300:400"), parseColor("#445566"), 0.6}};
        setSweep(saved_, {});
        sweepOf(saved_)->animation = RangeSet::parse("300:1600");
        sweepOf(saved_)->delta = 20;
        saved_.layers.front().color = parseColor("#778899");
        saved_.layers.front().opacity = 0.7;
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
        e.layers = {e.layers.front(), {RangeSet::parse("1:2"), {}, {}}};
    });
    expectOnly({"--color", "#ffffff"}, [](Explorer& e) { e.layers.front().color = glm::dvec3(1); });
    expectOnly({"--opacity", "0.1"}, [](Explorer& e) { e.layers.front().opacity = 0.1; });
    expectOnly({"--sweep", "5:6"}, [](Explorer& e) {
        setSweep(e, {});
        sweepOf(e)->path = timeseries::SweepPath::Loop;
        sweepOf(e)->animation = RangeSet::parse("5:6");
    });
    expectOnly({"--delta", "3"}, [](Explorer& e) { sweepOf(e)->delta = 3; });
    expectOnly({"--tick", "9"}, [](Explorer& e) {
        e.oneTick = true;
        e.play.tick = 9;
    });
    expectOnly({"--timer-steps", "9"}, [](Explorer& e) { sweepOf(e)->timerSteps = 9; });
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
    for (const char* word : {"auto", "cells"})
        expectOnly({"--model", word}, [](Explorer& e) { e.model = Model::Cells; });
    // The first is of all, whatever they were; further ones of each in turn.
    saved_.layers[1].model = Model::Points;
    tests::writeBytes(file_, toJson(saved_, file_.parent_path()).dump());
    expectOnly({"--model", "cells"}, [](Explorer& e) { e = allBy(Model::Cells, e); });
    expectOnly({"--model", "points", "--model", "auto", "--model", "points", "--model", "cells"},
               [](Explorer& e) {
                   e = allBy(Model::Points, e);
                   e.layers[1].model = Model::Points;
                   e.layers[2].model = Model::Cells;
               });
    expectOnly({"--order", "none"}, [](Explorer& e) { e.order = render::Order::None; });
    expectOnly({"--clip", "1:2,1:2,1:2"}, [](Explorer& e) { e.clip = parseClip("1:2,1:2,1:2"); });
    expectOnly({"--scale", "1,1,1"}, [](Explorer& e) { e.scale = glm::dvec3(1); });
    expectOnly({"--view", "9,8"}, [](Explorer& e) {
        e.view = {9, 8, {}, e.view.target};  // another target is --target's
        e.view.shift = glm::dvec2(0);
    });
    expectOnly({"--shift", "0.1,-1"}, [](Explorer& e) { e.view.shift = glm::dvec2(0.1, -1); });
    expectOnly({"--shift", "auto"}, [](Explorer& e) { e.view.shift.reset(); });
    expectOnly({"--target", "1,2,3"}, [](Explorer& e) { e.view.target = {1, 2, 3}; });
    expectOnly({"--orthographic"},
               [](Explorer& e) { e.view.projection = Projection::Orthographic; });
    expectOnly({"--no-legend"}, [](Explorer& e) { e.legend = false; });
    expectOnly({"--hide", "2"}, [](Explorer& e) { e.layers[1].visible = false; });
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

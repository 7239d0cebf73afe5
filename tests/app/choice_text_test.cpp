#include "app/choices/choice_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace app {
namespace {

using testing::HasSubstr;

// The text is refused, in one sentence that quotes it.
void expectRefused(const std::function<void(std::string_view)>& parse, const std::string& text) {
    try {
        parse(text);
        ADD_FAILURE() << "'" << text << "' was accepted";
    } catch (const ChoiceError& error) {
        EXPECT_THAT(error.what(), HasSubstr("'" + text + "'"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST(ChoiceText, StepsAreOneARangeOrAll) {
    EXPECT_EQ(parseSteps("12"), (StepChoice{12, 12}));
    EXPECT_EQ(parseSteps("0"), (StepChoice{0, 0}));
    EXPECT_EQ(parseSteps("0:30"), (StepChoice{0, 30}));
    EXPECT_EQ(parseSteps("7:7"), (StepChoice{7, 7}));
    EXPECT_EQ(parseSteps("all"), (StepChoice{0, {}}));
    EXPECT_EQ(parseSteps("18446744073709551615").first, std::numeric_limits<std::size_t>::max());
}

TEST(ChoiceText, StepsWithoutALastGoToTheEndOfTheSeries) {
    EXPECT_EQ(parseSteps("3:"), (StepChoice{3, {}}));
    EXPECT_EQ(parseSteps("0:"), parseSteps("all"));
}

TEST(ChoiceText, StepsHaveAStride) {
    EXPECT_EQ(parseSteps("1:9:4"), (StepChoice{1, 9, 4}));
    EXPECT_EQ(parseSteps("3::2"), (StepChoice{3, {}, 2}));
    EXPECT_EQ(parseSteps("0::1"), parseSteps("all"));
    EXPECT_EQ(parseSteps("2:5:100"), (StepChoice{2, 5, 100}));
}

TEST(ChoiceText, StepsAreWrittenAsTheyAreRead) {
    std::mt19937 random(5);
    for (int i = 0; i < 500; ++i) {
        StepChoice steps{random() % 40, {}};
        if (random() % 3 != 0) steps.last = steps.first + random() % 3;
        if (random() % 3 != 0) steps.stride = 1 + random() % 5;
        EXPECT_EQ(parseSteps(stepsText(steps)), steps) << stepsText(steps);
    }
}

TEST(ChoiceText, MalformedStepsAreRefused) {
    for (const char* text : {"",
                             ":",
                             ":3",
                             "1:2:0",
                             "1:2:-1",
                             "1:2:3:4",
                             "1:2:",
                             ":2:3",
                             "3:2:1",
                             "3:2",
                             "-1",
                             "+1",
                             "1.5",
                             "1e3",
                             " 1",
                             "1 ",
                             "ALL",
                             "all:",
                             "a",
                             "0x1",
                             "18446744073709551616",
                             "1:18446744073709551616",
                             "1;2",
                             "1,2",
                             "::",
                             "1::"})
        expectRefused([](std::string_view t) { parseSteps(t); }, text);
}

TEST(ChoiceText, ColorsHaveSixHexDigits) {
    EXPECT_EQ(parseColor("#000000"), glm::dvec3(0));
    EXPECT_EQ(parseColor("#ffFFff"), glm::dvec3(1));
    EXPECT_EQ(parseColor("#336699"), glm::dvec3(51, 102, 153) / 255.0);
    for (const char* text : {"", "#", "336699", "#33669", "#3366990", "#33669g", "#-33669",
                             "#+33669", "# 33669", "red", "#0x3366", "##33669"})
        expectRefused([](std::string_view t) { parseColor(t); }, text);
}

TEST(ChoiceText, EveryColorIsWrittenAsItIsRead) {
    for (int c = 0; c < 256; ++c) {
        const glm::dvec3 srgb = glm::dvec3(c, 255 - c, (c * 7) % 256) / 255.0;
        EXPECT_EQ(parseColor(colorText(srgb)), srgb) << colorText(srgb);
    }
}

TEST(ChoiceText, AClipBoxHasAClosedRangeAnAxis) {
    EXPECT_EQ(parseClip("0:1,-2:3.5,1e3:2e3"), (ClipBox{{0, -2, 1000}, {1, 3.5, 2000}}));
    EXPECT_EQ(parseClip("min:max,min:0,5:max"),
              (ClipBox{{-kInfinity, -kInfinity, 5}, {kInfinity, 0, kInfinity}}));
    for (const char* text : {"", ",", ",,", "0:1", "0:1,0:1", "0:1,0:1,0:1,0:1", "0:1,0:1,(0:1]",
                             "0:1,0:1,", "0:1,0:1,1:0", "0:1,nan:1,0:1", "a:b,0:1,0:1"})
        expectRefused([](std::string_view t) { parseClip(t); }, text);
}

TEST(ChoiceText, ClipBoxesAreWrittenAsTheyAreRead) {
    std::mt19937 random(11);
    const double ends[] = {-kInfinity, -1e300, -3.25, -0.1, 0, 1.0 / 3, 7, 1e20, kInfinity};
    for (int i = 0; i < 500; ++i) {
        ClipBox box{};
        for (int a = 0; a < 3; ++a) {
            const std::size_t lo = random() % 8, hi = lo + 1 + random() % (8 - lo);
            box.lo[a] = ends[lo];
            box.hi[a] = ends[hi];
        }
        EXPECT_EQ(parseClip(clipText(box)), box) << clipText(box);
    }
}

TEST(ChoiceText, AxesAreFlippedAndNamedByTheirLetters) {
    for (int bits = 0; bits < 8; ++bits) {
        const std::array<bool, 3> flips{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
        std::array<AxisChoice, 3> axes;
        for (std::size_t a = 0; a < 3; ++a) axes[a].flip = flips[a];
        EXPECT_EQ(parseFlips(flipsText(axes)), flips) << flipsText(axes);
    }
    EXPECT_EQ(parseFlips("z,x"), (std::array{true, false, true}));
    for (const char* text : {"", "a", "xz", "x,,z", "x,x", "X", "x,none", ","})
        expectRefused([](std::string_view t) { parseFlips(t); }, text);
    EXPECT_EQ(parseAxisName("z=depth"), std::pair(std::size_t{2}, std::string("depth")));
    EXPECT_EQ(parseAxisName("x=a=b c").second, "a=b c");
    for (const char* text : {"", "z", "z=", "w=depth", "=depth", "zdepth", "zz=depth"})
        expectRefused([](std::string_view t) { parseAxisName(t); }, text);
}

TEST(ChoiceText, ScalesArePositiveAndSuchAsAPictureHasRoomFor) {
    EXPECT_EQ(parseScale("1,1,20"), glm::dvec3(1, 1, 20));
    EXPECT_EQ(parseScale("1e-3,2.5,1"), glm::dvec3(1e-3, 2.5, 1));
    EXPECT_EQ(parseScale("1e-12,1e12,1"), glm::dvec3(1e-12, 1e12, 1));
    for (const char* text :
         {"", "1", "1,1", "1,1,1,1", "0,1,1", "1,-1,1", "1,1,nan", "1,1,inf", "1,,1", "1, 1,1",
          "a,b,c", "1;1;1", "1,1,1e999", "1e300,1,1", "1,1.1e12,1", "1,1,0.9e-12"})
        expectRefused([](std::string_view t) { parseScale(t); }, text);
}

TEST(ChoiceText, AShiftIsTwoSharesOfThePictureOrTheProgramsOwn) {
    for (const char* text : {"auto", "0,0", "0.25,-1", "-0.0625,0.5"})
        EXPECT_EQ(shiftText(parseShift(text)), text);
    EXPECT_FALSE(parseShift("auto"));
    for (const char* text : {"", "0", "0,1.01", "0,0,0", "nan,0", "inf,0", "x,y", "Auto", "0 0"})
        expectRefused([](std::string_view t) { parseShift(t); }, text);
}

TEST(ChoiceText, AViewHasTwoAnglesAndPerhapsADistance) {
    const glm::dvec3 target(1, 2, 3);
    for (const char* text : {"-400,90,0.1", "30,20", "0.125,-7"}) {
        ViewChoice view{1, 2, 3, target};
        takeView(view, text);
        EXPECT_EQ(viewText(view), text);
        EXPECT_EQ(view.target, target);
    }
    const auto inTheMiddle = [](ViewChoice view) {
        view.shift = glm::dvec2(0);
        return view;
    };
    ViewChoice near{1, 2, 3};
    takeView(near, "-400,90,0.1");
    EXPECT_EQ(near, inTheMiddle({-400, 90, 0.1}));
    takeView(near, "30,20");
    EXPECT_EQ(near, inTheMiddle({30, 20, {}}));
    for (const char* text : {"", "30", "30,20,0", "30,20,-1", "30,20,4,5", "nan,0", "inf,0",
                             "30,20,inf", "30,20,nan", "x,y", "30,", ",20", "30 20"})
        expectRefused(
            [](std::string_view t) {
                ViewChoice view;
                takeView(view, t);
            },
            text);
}

TEST(ChoiceText, SizesAreWholePixelsWithinLimits) {
    EXPECT_EQ(parseSize("1200x900"), glm::ivec2(1200, 900));
    EXPECT_EQ(parseSize("1x1"), glm::ivec2(1));
    EXPECT_EQ(parseSize("16384x16384"), glm::ivec2(16384));
    for (const char* text :
         {"", "x", "1200", "1200x", "x900", "0x900", "1200x0", "-1x1", "16385x1", "1x16385",
          "1.5x2", "1x2x3", "1200X900", "1200 x 900", "1200*900", "99999999999x1"})
        expectRefused([](std::string_view t) { parseSize(t); }, text);
}

TEST(ChoiceText, NamesAreReadAsTheyAreWritten) {
    for (const char* name : {"off", "side-by-side", "top-bottom", "multiview", "left-right"})
        EXPECT_EQ(stereoName(parseStereo(name)), name);
    for (const char* name : {"kernel", "point"}) EXPECT_EQ(kernelName(parseKernel(name)), name);
    for (const char* name : {"none", "depth"}) EXPECT_EQ(orderName(parseOrder(name)), name);
    for (const std::string_view name : render::colorMapNames())
        EXPECT_EQ(parseColorMap(name).name(), name);
}

TEST(ChoiceText, UnknownNamesAreRefusedWithTheKnownOnes) {
    for (const char* text : {"", "Off", "none ", "kernels", "jet"}) {
        expectRefused([](std::string_view t) { parseStereo(t); }, text);
        expectRefused([](std::string_view t) { parseKernel(t); }, text);
        expectRefused([](std::string_view t) { parseOrder(t); }, text);
        expectRefused([](std::string_view t) { parseColorMap(t); }, text);
    }
    try {
        parseOrder("sideways");
        FAIL();
    } catch (const ChoiceError& error) {
        EXPECT_STREQ(error.what(), "order 'sideways' is not one of none, depth");
    }
}

}  // namespace
}  // namespace app

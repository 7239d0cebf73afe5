// What is said of a picture's error.
#include "app/picture/error_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace app {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

TEST(ErrorText, SaysWhereNoErrorIsKnown) {
    const Rung points{Model::Points}, cells{Model::Cells};
    EXPECT_EQ(unknownErrorText({}, points), "error not known yet");
    std::optional<DepthErrors> errors{std::in_place};
    EXPECT_EQ(unknownErrorText(errors, points), "") << "nothing is seen";
    errors->rungs = {{.rung = points, .depth = 0.1}};
    EXPECT_EQ(unknownErrorText(errors, points), "");
    EXPECT_EQ(unknownErrorText(errors, cells), "error not known yet") << "of points alone";
    errors->rungs.clear();
    errors->whyNone = "there is not enough memory";
    EXPECT_EQ(unknownErrorText(errors, points), "error not known");
}

TEST(ErrorText, IsRoundedToWhatASampleTells) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(depthErrorText(0.0004), "error below 0.1 %");
    EXPECT_EQ(depthErrorText(0.0041), "error about 0.4 %");
    EXPECT_EQ(depthErrorText(0.123), "error about 12 %");
    EXPECT_EQ(depthErrorText(9.99), "error about 999 %");
    EXPECT_EQ(depthErrorText(327.87), "error above 1000 %");
    EXPECT_EQ(depthErrorText(kInfinite), "error above 1000 %") << "where nothing is to be seen";
    EXPECT_EQ(depthErrorText(std::numeric_limits<double>::quiet_NaN()), "");
}

auto part(const char* name, const char* size, const char* what) {
    return testing::AllOf(Field(&PartLine::name, name), Field(&PartLine::size, size),
                          Field(&PartLine::what, HasSubstr(what)));
}

// What draws still fewer is no truer.
TEST(ErrorText, OfFewerPointsThanAnyoneLookedAtTheErrorIsMore) {
    RungError error{.rung = {Model::Points, 16}, .depth = 0.18, .order = 0};
    error.parts = ErrorParts{.model = 0.06, .subset = 0.17, .pixels = 0};
    const Rung fewer{Model::Points, 64};
    EXPECT_EQ(boundOf(error, error.rung), Bound::About);
    EXPECT_EQ(boundOf(error, fewer), Bound::Least);
    EXPECT_EQ(depthErrorText(error.depth, Bound::Least), "error above 18 %");
    EXPECT_EQ(depthErrorText(0.004, Bound::Least), "error above 0.4 %");
    EXPECT_EQ(depthErrorText(0.0001, Bound::Least), "error above 0 %");
    EXPECT_THAT(partLines(error, Ordering::OneColor, fewer)[1],
                part("subset", "above 17 %", "1 of 64 points"));
    EXPECT_THAT(partLines(error, Ordering::OneColor)[1], part("subset", "17 %", "1 of 16 points"));
    // Also where only all of them were looked at.
    error.rung.stride = 1;
    error.parts->subset = 0;
    EXPECT_THAT(partLines(error, Ordering::OneColor, fewer)[1],
                part("subset", "above 0 %", "1 of 64 points"));
}

TEST(ErrorText, LightIsToldWhereOrderShows) {
    RungError error{.rung = {}, .depth = 0.03, .order = 0.08};
    EXPECT_EQ(lightErrorText(error, Ordering::Mixed), ", light 8 % (colours mixed)");
    EXPECT_EQ(lightErrorText(error, Ordering::ByDepth), ", light 8 % (colours within a cell)");
    error.order = 0.0009;
    EXPECT_EQ(lightErrorText(error, Ordering::Mixed), "");
    error.order = std::nan("");
    EXPECT_EQ(lightErrorText(error, Ordering::Mixed), "");
}

TEST(ErrorText, PartsAreFourAndSayWhyTheyAreNone) {
    RungError cells{.rung = {Model::Cells}, .depth = 0.03, .order = 0};
    cells.parts = ErrorParts{.model = 0.029, .subset = 0, .pixels = 0};
    EXPECT_THAT(
        partLines(cells, Ordering::OneColor),
        ElementsAre(part("model", "3 %", "cells in place"), part("subset", "none", "all is drawn"),
                    part("pixels", "none", "as many rays"), part("order", "none", "one colour")));
    RungError points{.rung = {Model::Points, 8}, .depth = 0.5, .order = 0.21};
    points.parts = ErrorParts{.model = 0.3, .subset = 0.4, .pixels = 0.0002};
    EXPECT_THAT(partLines(points, Ordering::Mixed),
                ElementsAre(part("model", "30 %", "points in place"),
                            part("subset", "40 %", "1 of 8 points"),
                            part("pixels", "below 0.1 %", "few rays"),
                            part("order", "21 %", "colours mixed")));
    cells.order = std::nan("");  // some points among them
    EXPECT_EQ(partLines(cells, Ordering::ByDepth).front().what,
              "cells and points in place of the field between points");
    points.order = std::nan("");  // some among cells
    EXPECT_THAT(partLines(points, Ordering::ByDepth).back(),
                part("order", "not known", "points among cells"));
    points.order = 1e-9;
    EXPECT_THAT(partLines(points, Ordering::ByDepth).back(),
                part("order", "none", "points by depth"));
    EXPECT_THAT(partLines(points, Ordering::Mixed).back(),
                part("order", "none", "no colours meet"));
}

}  // namespace
}  // namespace app

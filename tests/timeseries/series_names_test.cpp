// Numbers in files' names: decimals, powers of ten and signs, and what is none of these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/series_folder.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using tests::names;
using SeriesNames = tests::SeriesFolder;

TEST_F(SeriesNames, FractionsAreNotGuessed) {
    make({"t_0.25.nc", "t_0.5.nc", "u_0.25.nc", "u_0.50.nc"});
    const ExpandedSeries alone = expand("t_0.5.nc");
    EXPECT_THAT(names(alone), ElementsAre("t_0.5.nc"));
    EXPECT_THAT(alone.notes, ElementsAre(HasSubstr("may be decimal or whole")));
    EXPECT_THAT(names(expand("u_0.50.nc")), ElementsAre("u_0.25.nc", "u_0.50.nc"));
    EXPECT_THAT(names(expand({"t_0.5.nc", "t_0.25.nc"})), ElementsAre("t_0.5.nc", "t_0.25.nc"));
    EXPECT_THAT(expand({"t_0.5.nc", "t_0.25.nc"}).notes, IsEmpty());
    EXPECT_THAT(expand("t*.nc").notes,
                ElementsAre(HasSubstr("t_0.5.nc and t_0.25.nc may be decimal or whole, and are "
                                      "taken as whole")));
    EXPECT_THAT(expand("u*.nc").notes, IsEmpty());
    std::filesystem::create_directory(folder_ / "only");
    make({"only/v_0.95.nc", "only/v_1.05.nc", "only/v_1.1.nc"});
    EXPECT_THAT(expand("only").notes,
                ElementsAre(HasSubstr("may be decimal or whole, and are taken as whole")));
}

TEST_F(SeriesNames, DecimalNumbersAreOneNumber) {
    make({"t_0.5.vti", "t_1.0.vti", "t_1.5.vti", "t_10.0.vti", "wave_0.25s.nrrd", "wave_0.50s.nrrd",
          "wave_1.00s.nrrd", "p7_09.80.nc", "p7_10.20.nc", "u_0.5.nc", "u_1.25.nc", "u_2.nc4"});
    const ExpandedSeries series = expand("t_1.0.vti");
    EXPECT_THAT(names(series), ElementsAre("t_0.5.vti", "t_1.0.vti", "t_1.5.vti", "t_10.0.vti"));
    EXPECT_THAT(series.here, Optional(1u));
    EXPECT_EQ(series.recognised,
              "4 files t_0.5.vti to t_10.0.vti, numbers 0.5 to 10.0 every 0.5, with gaps");
    EXPECT_THAT(series.notes, ElementsAre("16 numbers are missing: 2.0 to 9.5"));
    EXPECT_THAT(ascendingNumbers(series.files), Optional(ElementsAre(0.5, 1, 1.5, 10)));
    EXPECT_EQ(expand("t_*.vti").recognised, series.recognised);

    const ExpandedSeries waves = expand("wave_0.25s.nrrd");
    EXPECT_EQ(waves.recognised,
              "3 files wave_0.25s.nrrd to wave_1.00s.nrrd, numbers 0.25 to 1.00 every 0.25, with "
              "gaps");
    EXPECT_THAT(waves.notes, ElementsAre("number 0.75 is missing"));
    EXPECT_EQ(expand("p7_10.20.nc").recognised,
              "2 files p7_09.80.nc to p7_10.20.nc, numbers 9.80 and 10.20");
    EXPECT_THAT(names(expand("u_0.5.nc")), ElementsAre("u_0.5.nc", "u_1.25.nc"));
    EXPECT_EQ(expand("u_0.5.nc").recognised, "2 files u_0.5.nc to u_1.25.nc, numbers 0.5 and 1.25");
}

// Each digit counts: as doubles these are not what the names say.
TEST_F(SeriesNames, DecimalNumbersAreToldAsTheyAreWritten) {
    make({"t_0.1.nc", "t_0.2.nc", "t_0.3.nc", "u_0.100.nc", "u_0.137.nc", "u_1.205.nc",
          "v_1234567890.123456789012.nc", "v_1234567891.123456789012.nc"});
    EXPECT_EQ(expand("t_0.1.nc").recognised,
              "3 files t_0.1.nc to t_0.3.nc, numbers 0.1 to 0.3 every 0.1");
    EXPECT_EQ(expand("u_0.100.nc").recognised,
              "3 files u_0.100.nc to u_1.205.nc, numbers 0.100, 0.137, 1.205: uneven");
    EXPECT_THAT(expand("v_1234567890.123456789012.nc").recognised,
                HasSubstr("numbers 1234567890.123456789012 to 1234567891.123456789012"));
    EXPECT_THAT(ascendingNumbers(expand("u_0.100.nc").files),
                Optional(ElementsAre(.1, .137, 1.205)));
}

TEST_F(SeriesNames, ADecimalNumberStandsTwiceInSeveralForms) {
    make({"t_1.5.nc", "t_01.5.nc", "t_2.0.nc", "u_1.5.nc", "u_01.5.nc"});
    const ExpandedSeries series = expand("t_2.0.nc");
    EXPECT_THAT(names(series), ElementsAre("t_01.5.nc", "t_1.5.nc", "t_2.0.nc"));
    EXPECT_THAT(series.notes, ElementsAre("number 1.5 stands twice: t_01.5.nc and t_1.5.nc"));
    EXPECT_THAT(names(expand("u_1.5.nc")), ElementsAre("u_1.5.nc"));
}

TEST_F(SeriesNames, WhereDecimalsAndWholesAreOrderedOtherwiseNoneIsGuessed) {
    make({"t_1.9.nc", "t_1.10.nc", "t_2.0.nc", "u_0.5.nc", "u_1.50.nc", "w_1.5.nc", "w_1.75.nc"});
    for (const char* name : {"t_1.9.nc", "t_1.10.nc", "t_2.0.nc", "u_0.5.nc", "w_1.5.nc"}) {
        const ExpandedSeries alone = expand(name);
        EXPECT_THAT(names(alone), ElementsAre(name));
        EXPECT_EQ(alone.here, std::nullopt) << name;
        EXPECT_THAT(alone.notes, ElementsAre(HasSubstr("may be decimal or whole"))) << name;
    }
    const ExpandedSeries together = expand("t_*.nc");
    EXPECT_THAT(together.recognised, HasSubstr("in the order of their names"));
    EXPECT_THAT(together.notes, ElementsAre(HasSubstr("may be decimal or whole")));
    EXPECT_EQ(ascendingNumbers(together.files), std::nullopt);
}

// As decimals they would be 1.001, 1.002 and then 2.001, far from all before.
TEST_F(SeriesNames, NumbersThatBeginAnewAfterADotAreTwo) {
    make({"run1.001.nc", "run1.002.nc", "run1.003.nc", "run2.001.nc", "run2.002.nc",
          "ym_2000.11.nc", "ym_2000.12.nc", "ym_2001.11.nc"});
    const ExpandedSeries run = expand("run1.002.nc");
    EXPECT_EQ(run.recognised, "3 files run1.001.nc to run1.003.nc, numbers 1 to 3");
    EXPECT_THAT(run.notes, ElementsAre(HasSubstr("2 files run2.001.nc to run2.002.nc are not")));
    EXPECT_EQ(expand("ym_2000.11.nc").recognised,
              "2 files ym_2000.11.nc to ym_2000.12.nc, numbers 11 and 12");
    const ExpandedSeries all = expand("ym*");
    EXPECT_EQ(all.recognised,
              "3 files ym_2000.11.nc to ym_2001.11.nc, in the order of their names");
    EXPECT_EQ(ascendingNumbers(all.files), std::nullopt);
    // These go on across the whole numbers, or are too few to tell of two.
    make({"s_0.0.nc", "s_0.5.nc", "s_1.0.nc", "s_1.5.nc", "l_0.1.nc", "l_1.0.nc", "l_10.0.nc"});
    EXPECT_EQ(expand("s_0.0.nc").recognised,
              "4 files s_0.0.nc to s_1.5.nc, numbers 0.0 to 1.5 every 0.5");
    EXPECT_THAT(ascendingNumbers(expand("l_10.0.nc").files), Optional(ElementsAre(.1, 1, 10)));
}

TEST_F(SeriesNames, WhatIsCountedAfterADotIsWhole) {
    make({"Re100.0001.vti", "Re100.0002.vti", "Re100.0004.vti"});
    const ExpandedSeries series = expand("Re100.0001.vti");
    EXPECT_EQ(series.recognised,
              "3 files Re100.0001.vti to Re100.0004.vti, numbers 1 to 4, with gaps");
    EXPECT_THAT(ascendingNumbers(series.files), Optional(ElementsAre(1, 2, 4)));
}

TEST_F(SeriesNames, VersionsAndDatesAreNotDecimal) {
    make({"v1.2_0003.vti", "v1.3_0003.vti", "v1.3_0004.vti", "x1.2_3.vti", "x2.0_3.vti",
          "x2.0_4.vti", "w0.1.5.vti", "w0.2.0.vti"});
    // The last number varies among the others, so that the one before may be a version's.
    const ExpandedSeries versions = expand("v1.2_0003.vti");
    EXPECT_THAT(names(versions), ElementsAre("v1.2_0003.vti", "v1.3_0003.vti"));
    EXPECT_THAT(versions.recognised, HasSubstr("numbers 2 and 3"));
    EXPECT_THAT(versions.notes, ElementsAre(HasSubstr("v1.3_0004.vti is not taken")));
    EXPECT_THAT(names(expand("x1.2_3.vti")), ElementsAre("x1.2_3.vti"));
    EXPECT_THAT(names(expand("v1.3_0003.vti")), ElementsAre("v1.3_0003.vti", "v1.3_0004.vti"));
    EXPECT_THAT(names(expand("w0.1.5.vti")), ElementsAre("w0.1.5.vti"));
}

// As Python and C write times below 1e-4, and large ones, beside others in full.
TEST_F(SeriesNames, PowersOfTenAreNumbers) {
    make({"t_0.0001.nc", "t_9e-05.nc", "t_1.5e-05.nc", "t_2.50E-05.nc", "t_0.00105.nc",
          "u1e-05.vti", "u2e-04.vti", "u1.5e+03.vti", "x_1e-05a.nc", "x_2e-05a.nc", "y_1e5.nc",
          "y_1e6.nc", "z_1e-3.nc", "z_1e-2.nc", "z_1e+0.nc", "node1e5.nc", "node1e6.nc"});
    const ExpandedSeries series = expand("t_9e-05.nc");
    EXPECT_THAT(names(series), ElementsAre("t_1.5e-05.nc", "t_2.50E-05.nc", "t_9e-05.nc",
                                           "t_0.0001.nc", "t_0.00105.nc"));
    EXPECT_THAT(series.here, Optional(2u));
    EXPECT_THAT(ascendingNumbers(series.files),
                Optional(ElementsAre(1.5e-05, 2.5e-05, 9e-05, 0.0001, 0.00105)));
    EXPECT_THAT(ascendingNumbers(expand("u2e-04.vti").files),
                Optional(ElementsAre(1e-05, 2e-04, 1500)));
    EXPECT_THAT(ascendingNumbers(expand("y_1e5.nc").files), Optional(ElementsAre(1e5, 1e6)));
    EXPECT_THAT(ascendingNumbers(expand("z_1e-3.nc").files), Optional(ElementsAre(1e-3, 1e-2, 1)));
    // A letter behind it, or before one without a sign: it may be anything.
    EXPECT_THAT(ascendingNumbers(expand("x_1e-05a.nc").files), Optional(ElementsAre(1, 2)));
    EXPECT_THAT(ascendingNumbers(expand("node1e5.nc").files), Optional(ElementsAre(5, 6)));
}

TEST_F(SeriesNames, AMinusThatFollowsNoLetterAndNoDigitIsASign) {
    make({"t_-3.nc", "t_-12.nc", "t_0.nc", "t_7.nc", "day=-1.5.nc", "day=-1.25.nc", "day=0.5.nc",
          "run-3.nc", "run-4.nc", "s_-1e-05.nc", "s_-2.5e-05.nc", "d_2000-01-04.nc",
          "d_2000-01-05.nc"});
    const ExpandedSeries series = expand("t_0.nc");
    EXPECT_THAT(names(series), ElementsAre("t_-12.nc", "t_-3.nc", "t_0.nc", "t_7.nc"));
    EXPECT_EQ(series.recognised, "4 files t_-12.nc to t_7.nc, numbers -12, -3, 0, 7: uneven");
    EXPECT_THAT(ascendingNumbers(series.files), Optional(ElementsAre(-12, -3, 0, 7)));
    const ExpandedSeries days = expand("day=0.5.nc");
    EXPECT_EQ(days.recognised,
              "3 files day=-1.5.nc to day=0.5.nc, numbers -1.5 to 0.5 every 0.25, with gaps");
    EXPECT_THAT(ascendingNumbers(days.files), Optional(ElementsAre(-1.5, -1.25, 0.5)));
    EXPECT_THAT(ascendingNumbers(expand("s_-1e-05.nc").files),
                Optional(ElementsAre(-2.5e-05, -1e-05)));
    EXPECT_THAT(ascendingNumbers(expand("run-3.nc").files), Optional(ElementsAre(3, 4)));
    EXPECT_THAT(ascendingNumbers(expand("d_2000-01-04.nc").files), Optional(ElementsAre(4, 5)));
    EXPECT_THAT(names(expand("t_*.nc")), ElementsAre("t_-12.nc", "t_-3.nc", "t_0.nc", "t_7.nc"));
}

TEST_F(SeriesNames, DecimalsOfOneRunAreTakenAndOthersTold) {
    make({"run1_0.5.nc", "run1_1.0.nc", "run1_1.5.nc", "run2_0.5.nc", "run2_1.0.nc"});
    const ExpandedSeries series = expand("run1_1.0.nc");
    EXPECT_EQ(series.recognised,
              "3 files run1_0.5.nc to run1_1.5.nc, numbers 0.5 to 1.5 every 0.5");
    EXPECT_THAT(series.notes, ElementsAre(HasSubstr("2 files run2_0.5.nc to run2_1.0.nc are not")));
}

TEST_F(SeriesNames, NamesOfAnotherNumberOfDotsAreTold) {
    make({"t_0.5.nc", "t_1.nc", "t_1.5.nc", "t_2.nc", "t_2.5.nc", "x_1.nc"});
    const ExpandedSeries decimal = expand("t_0.5.nc");
    EXPECT_THAT(names(decimal), ElementsAre("t_0.5.nc", "t_1.5.nc", "t_2.5.nc"));
    EXPECT_THAT(decimal.notes,
                ElementsAre("2 files t_1.nc to t_2.nc are not taken: they have another number of "
                            "dots; name the files in their order"));
    const ExpandedSeries whole = expand("t_1.nc");
    EXPECT_THAT(names(whole), ElementsAre("t_1.nc", "t_2.nc"));
    EXPECT_THAT(whole.notes, ElementsAre(HasSubstr("3 files t_0.5.nc to t_2.5.nc are not taken")));
    EXPECT_THAT(names(expand("x_1.nc")), ElementsAre("x_1.nc"));
}

TEST_F(SeriesNames, NumbersBeyondIntegersAreOrdered) {
    const std::string big(30, '9'), bigger = "1" + std::string(30, '0'), huge(200, '7');
    make({"a" + bigger + ".nc", "a" + big + ".nc", "a00012.nc", "a" + huge + ".nc"});
    EXPECT_THAT(names(expand("a00012.nc")), ElementsAre("a00012.nc", "a" + big + ".nc",
                                                        "a" + bigger + ".nc", "a" + huge + ".nc"));
}

}  // namespace
}  // namespace timeseries

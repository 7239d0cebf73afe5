#include "timeseries/readers/series_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using tests::freshFolder;
using tests::writeBytes;
using Path = std::filesystem::path;

// Empty files of these names, in the folder of the test.
class SeriesFiles : public testing::Test {
 protected:
    void make(const std::vector<std::string>& names) {
        for (const std::string& name : names) writeBytes(folder_ / name, "");
    }
    ExpandedSeries expand(const std::string& name) const { return expand({name}); }
    ExpandedSeries expand(std::initializer_list<std::string> names) const {
        std::vector<Path> paths;
        for (const std::string& name : names) paths.push_back(folder_ / name);
        return expandSeries(paths);
    }
    std::string failure(const std::string& name) const {
        try {
            expand(name);
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    }

    const Path folder_ = freshFolder();
};

std::vector<std::string> names(const ExpandedSeries& series) {
    std::vector<std::string> all;
    for (const Path& file : series.files) all.push_back(file.filename().string());
    return all;
}

TEST_F(SeriesFiles, AMemberOpensItsSeriesInTheOrderOfTheNumbers) {
    make({"a_10.vti", "a_9.vti", "a_11.vti", "b_12.vti", "a_12.vtr", "a_.vti", "a_1_1.vti",
          "xa_8.vti"});
    const ExpandedSeries series = expand("a_10.vti");
    EXPECT_THAT(names(series), ElementsAre("a_9.vti", "a_10.vti", "a_11.vti"));
    EXPECT_THAT(series.here, Optional(1u));
    EXPECT_EQ(series.files[1], folder_ / "a_10.vti");
    EXPECT_EQ(series.recognised, "3 files a_9.vti to a_11.vti, numbers 9 to 11");
    EXPECT_THAT(series.notes, IsEmpty());
}

TEST_F(SeriesFiles, EvenUnevenAndMissingNumbersAreTold) {
    make({"even_001.nc", "even_041.nc", "even_081.nc", "odd_1.nc", "odd_41.nc", "odd_82.nc",
          "gap_0.nc", "gap_10.nc", "gap_20.nc", "gap_40.nc", "gap_70.nc", "gap_120.nc", "two_3.nc",
          "two_7.nc", "one_1.nc", "one_2.nc", "one_4.nc"});
    const ExpandedSeries even = expand("even_041.nc");
    EXPECT_EQ(even.recognised, "3 files even_001.nc to even_081.nc, numbers 1 to 81 every 40");
    EXPECT_THAT(even.notes, IsEmpty());
    const ExpandedSeries odd = expand("odd_41.nc");
    EXPECT_EQ(odd.recognised, "3 files odd_1.nc to odd_82.nc, numbers 1, 41, 82: uneven");
    EXPECT_THAT(odd.notes, IsEmpty());
    const ExpandedSeries gap = expand("gap_0.nc");
    EXPECT_EQ(gap.recognised,
              "6 files gap_0.nc to gap_120.nc, numbers 0 to 120 every 10, with gaps");
    EXPECT_THAT(gap.notes, ElementsAre("7 numbers are missing: 30, 50, 60, 80 to 110"));
    EXPECT_EQ(expand("two_7.nc").recognised, "2 files two_3.nc to two_7.nc, numbers 3 and 7");
    EXPECT_THAT(expand("one_1.nc").notes, ElementsAre("number 3 is missing"));
}

TEST_F(SeriesFiles, ManyGapsAreTrimmed) {
    std::vector<std::string> files;
    for (int i = 0; i < 24; i += 2) files.push_back("g" + std::to_string(i) + ".nc");
    files.push_back("g1.nc");
    make(files);
    EXPECT_THAT(expand("g0.nc").notes,
                ElementsAre("10 numbers are missing: 3, 5, 7, 9, 11, 13, 15, 17 and 2 more"));
}

TEST_F(SeriesFiles, NumbersThatStandTwiceAreToldAndKept) {
    make({"a_1.nc", "a_01.nc", "a_002.nc", "b_1.nc", "b_01.nc"});
    const ExpandedSeries series = expand("a_002.nc");
    EXPECT_THAT(names(series), ElementsAre("a_01.nc", "a_1.nc", "a_002.nc"));
    EXPECT_THAT(series.notes, ElementsAre("number 1 stands twice: a_01.nc and a_1.nc"));
    EXPECT_EQ(ascendingNumbers(series.files), std::nullopt);
    // No other number: no series.
    const ExpandedSeries alone = expand("b_1.nc");
    EXPECT_THAT(names(alone), ElementsAre("b_1.nc"));
    EXPECT_EQ(alone.here, std::nullopt);
    EXPECT_THAT(alone.notes, ElementsAre(HasSubstr("b_1.nc and b_01.nc; only the file named")));
}

TEST_F(SeriesFiles, TheLastNumberThatVariesCounts) {
    make({"run01_001_v2.vti", "run01_041_v2.vti", "run02_001_v2.vti", "run02_041_v2.vti",
          "run03_099_v2.vti"});
    const ExpandedSeries series = expand("run01_041_v2.vti");
    EXPECT_THAT(names(series), ElementsAre("run01_001_v2.vti", "run01_041_v2.vti"));
    EXPECT_THAT(series.notes,
                ElementsAre("3 files run02_001_v2.vti to run03_099_v2.vti are not taken: they "
                            "differ in another number, or in several; a folder or a pattern opens "
                            "them together"));
}

TEST_F(SeriesFiles, AFileStaysAloneWithoutSiblingsThatDifferInOneNumber) {
    make({"b_7.nc", "word.nc", "x_1.pvd", "x_2.pvd", ".h_1.nc"});
    std::filesystem::create_directory(folder_ / "b_8.nc");
    for (const char* name : {"b_7.nc", "word.nc", "x_1.pvd", "not_there_1.nc"}) {
        const ExpandedSeries series = expand(name);
        EXPECT_THAT(names(series), ElementsAre(name));
        EXPECT_EQ(series.recognised, "");
        EXPECT_EQ(series.here, std::nullopt);
        EXPECT_THAT(series.notes, IsEmpty());
    }
}

TEST_F(SeriesFiles, FilesThatDifferInSeveralNumbersAreTold) {
    make({"a_1_1.nc", "a_2_2.nc"});
    const ExpandedSeries alone = expand("a_1_1.nc");
    EXPECT_THAT(names(alone), ElementsAre("a_1_1.nc"));
    EXPECT_EQ(alone.recognised, "");
    EXPECT_THAT(alone.notes, ElementsAre("a_2_2.nc is not taken: it differs in another number, or "
                                         "in several"));
}

TEST_F(SeriesFiles, ACollectionStandsAloneAndForItsFolder) {
    writeBytes(folder_ / "x.pvd", "CDF\1");  // begins as something that is read
    writeBytes(folder_ / "x_1.vti", "CDF\1");
    writeBytes(folder_ / "x_2.vti", "CDF\1");
    EXPECT_THAT(names(expand("")), ElementsAre("x.pvd"));
    EXPECT_THAT(names(expand("x.pvd")), ElementsAre("x.pvd"));
    EXPECT_THAT(names(expand("x_2.vti")), ElementsAre("x_1.vti", "x_2.vti"));
    EXPECT_THAT(failure("x*"), HasSubstr("x.pvd: expected it alone"));
}

// ParaView's JSON, which lists its files with their times.
TEST_F(SeriesFiles, AListOfASeriesStandsForItsFolder) {
    make({"case_0.vtm", "case_1.vtm", "case_2.vtm"});
    tests::writeBytes(folder_ / "case_1.vtm.series", R"({"file-series-version": "1.0"})");
    for (const char* name : {"case_0.vtm", "case_1.vtm", "case_2.vtm"})
        tests::writeBytes(folder_ / name, "<VTKFile type=\"vtkMultiBlockDataSet\">");
    EXPECT_THAT(names(expand("")), ElementsAre("case_1.vtm.series"));
    EXPECT_THAT(names(expand("case_1.vtm.series")), ElementsAre("case_1.vtm.series"));
    EXPECT_THAT(failure("case_*"), HasSubstr("case_1.vtm.series: expected it alone"));
}

TEST_F(SeriesFiles, ANumberMayStandWhereAnExtensionWould) {
    make({"plt.0010", "plt.0020", "plt.txt", "2000", "2001", "v.nc4", "v.nc3"});
    EXPECT_THAT(names(expand("plt.0020")), ElementsAre("plt.0010", "plt.0020"));
    EXPECT_THAT(names(expand("2000")), ElementsAre("2000", "2001"));
    EXPECT_THAT(names(expand("v.nc4")), ElementsAre("v.nc4"));
}

TEST_F(SeriesFiles, FractionsAreNotGuessed) {
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

TEST_F(SeriesFiles, DecimalNumbersAreOneNumber) {
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
TEST_F(SeriesFiles, DecimalNumbersAreToldAsTheyAreWritten) {
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

TEST_F(SeriesFiles, ADecimalNumberStandsTwiceInSeveralForms) {
    make({"t_1.5.nc", "t_01.5.nc", "t_2.0.nc", "u_1.5.nc", "u_01.5.nc"});
    const ExpandedSeries series = expand("t_2.0.nc");
    EXPECT_THAT(names(series), ElementsAre("t_01.5.nc", "t_1.5.nc", "t_2.0.nc"));
    EXPECT_THAT(series.notes, ElementsAre("number 1.5 stands twice: t_01.5.nc and t_1.5.nc"));
    EXPECT_THAT(names(expand("u_1.5.nc")), ElementsAre("u_1.5.nc"));
}

TEST_F(SeriesFiles, WhereDecimalsAndWholesAreOrderedOtherwiseNoneIsGuessed) {
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
TEST_F(SeriesFiles, NumbersThatBeginAnewAfterADotAreTwo) {
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

TEST_F(SeriesFiles, WhatIsCountedAfterADotIsWhole) {
    make({"Re100.0001.vti", "Re100.0002.vti", "Re100.0004.vti"});
    const ExpandedSeries series = expand("Re100.0001.vti");
    EXPECT_EQ(series.recognised,
              "3 files Re100.0001.vti to Re100.0004.vti, numbers 1 to 4, with gaps");
    EXPECT_THAT(ascendingNumbers(series.files), Optional(ElementsAre(1, 2, 4)));
}

TEST_F(SeriesFiles, VersionsAndDatesAreNotDecimal) {
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
TEST_F(SeriesFiles, PowersOfTenAreNumbers) {
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

TEST_F(SeriesFiles, AMinusThatFollowsNoLetterAndNoDigitIsASign) {
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

TEST_F(SeriesFiles, DecimalsOfOneRunAreTakenAndOthersTold) {
    make({"run1_0.5.nc", "run1_1.0.nc", "run1_1.5.nc", "run2_0.5.nc", "run2_1.0.nc"});
    const ExpandedSeries series = expand("run1_1.0.nc");
    EXPECT_EQ(series.recognised,
              "3 files run1_0.5.nc to run1_1.5.nc, numbers 0.5 to 1.5 every 0.5");
    EXPECT_THAT(series.notes, ElementsAre(HasSubstr("2 files run2_0.5.nc to run2_1.0.nc are not")));
}

TEST_F(SeriesFiles, NamesOfAnotherNumberOfDotsAreTold) {
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

TEST_F(SeriesFiles, NumbersBeyondIntegersAreOrdered) {
    const std::string big(30, '9'), bigger = "1" + std::string(30, '0'), huge(200, '7');
    make({"a" + bigger + ".nc", "a" + big + ".nc", "a00012.nc", "a" + huge + ".nc"});
    EXPECT_THAT(names(expand("a00012.nc")), ElementsAre("a00012.nc", "a" + big + ".nc",
                                                        "a" + bigger + ".nc", "a" + huge + ".nc"));
}

TEST_F(SeriesFiles, AFolderOfOneNumberedSeriesIsIt) {
    make({"a_2.nc", "a_10.nc", ".hidden"});
    std::filesystem::create_directory(folder_ / "more");
    const ExpandedSeries series = expand("");
    EXPECT_THAT(names(series), ElementsAre("a_2.nc", "a_10.nc"));
    EXPECT_EQ(series.here, std::nullopt);
    EXPECT_EQ(series.recognised, "2 files a_2.nc to a_10.nc, numbers 2 and 10");
}

TEST_F(SeriesFiles, AFolderOfOneExtensionIsASeriesByName) {
    make({"monday.nc", "friday.nc"});
    const ExpandedSeries series = expand("");
    EXPECT_THAT(names(series), ElementsAre("friday.nc", "monday.nc"));
    EXPECT_EQ(series.recognised, "2 files friday.nc to monday.nc, in the order of their names");
}

TEST_F(SeriesFiles, DatesFollowEachOther) {
    make({"t_2001-01-01.nc", "t_2000-12-31.nc", "t_2000-2-1.nc"});
    EXPECT_THAT(names(expand("")),
                ElementsAre("t_2000-2-1.nc", "t_2000-12-31.nc", "t_2001-01-01.nc"));
}

TEST_F(SeriesFiles, AFolderPassesOverWhatIsNoField) {
    make({"readme.md", "zebra.txt"});
    writeBytes(folder_ / "a_1.nc", "CDF\1");
    writeBytes(folder_ / "a_2.nc", "CDF\1");
    EXPECT_THAT(names(expand("")), ElementsAre("a_1.nc", "a_2.nc"));
}

TEST_F(SeriesFiles, SeveralCandidatesAreListed) {
    for (const char* name : {"a_1.nc", "a_2.nc", "b_1.nc", "b_2.nc", "c.nc"})
        writeBytes(folder_ / name, "CDF\1");
    EXPECT_THAT(failure(""), HasSubstr("expected a folder that holds one series, found a_*.nc (2 "
                                       "files), b_*.nc (2 files), c.nc; name one of them"));
    const Path two = folder_ / "two";
    std::filesystem::create_directory(two);
    EXPECT_THAT(failure("two"), HasSubstr("found no files in it"));
    writeBytes(two / "a.nc", "CDF\1");
    writeBytes(two / "b.nrrd", "NRRD0004");
    EXPECT_THAT(failure("two"), HasSubstr("found a.nc, b.nrrd; name one"));
}

TEST_F(SeriesFiles, NoCandidateIsAFileThatIsNotRead) {
    for (const char* name : {"b_1.grb", "b_2.grb"}) writeBytes(folder_ / name, "GRIB");
    make({"notes.txt"});
    EXPECT_EQ(failure(""),
              (folder_ / "").string() +
                  ": expected a folder that holds NetCDF, NRRD, NIfTI, MRC, FITS or VTK "
                  "files that are read, found b_*.grb (2 files), a GRIB file; notes.txt");
    // Of one extension too.
    const Path one = folder_ / "one";
    std::filesystem::create_directory(one);
    for (const char* name : {"a_1.dat", "a_2.dat", "b_1.dat"}) writeBytes(one / name, "GRIB");
    EXPECT_THAT(failure("one"), HasSubstr("found a_*.dat (2 files), a GRIB file; b_1.dat, a"));
    for (const char* name : {"b_1.dat", "b_2.dat"}) writeBytes(one / name, "CDF\1");
    EXPECT_THAT(names(expand("one")), ElementsAre("b_1.dat", "b_2.dat"));
}

TEST_F(SeriesFiles, APatternIsExpanded) {
    make({"a_1.nc", "a_10.nc", "a_2.nc", "a_3.txt", "[1].nc"});
    const ExpandedSeries series = expand("a_*.nc");
    EXPECT_THAT(names(series), ElementsAre("a_1.nc", "a_2.nc", "a_10.nc"));
    EXPECT_EQ(series.here, std::nullopt);
    EXPECT_THAT(names(expand("a_[13].*")), ElementsAre("a_1.nc", "a_3.txt"));
    EXPECT_THAT(names(expand({"a_1?.nc", "a_2.nc"})), ElementsAre("a_2.nc", "a_10.nc"));
    // A file of that very name is no pattern.
    EXPECT_THAT(names(expand("[1].nc")), ElementsAre("[1].nc"));
    EXPECT_THAT(failure("z*.nc"), HasSubstr("z*.nc: no file has such a name"));
}

TEST_F(SeriesFiles, SeveralNamedKeepTheirOrderUnlessNumbered) {
    EXPECT_THAT(names(expand({"b.nc", "a.nc"})), ElementsAre("b.nc", "a.nc"));
    EXPECT_EQ(expand({"b.nc", "a.nc"}).recognised, "2 files b.nc to a.nc, in the order given");
    EXPECT_THAT(names(expand({"a10.nc", "a9.nc"})), ElementsAre("a9.nc", "a10.nc"));
    EXPECT_THAT(names(expand({"x/a10.nc", "a9.nc"})), ElementsAre("a10.nc", "a9.nc"));
    EXPECT_THAT(expand({"a1.nc", "a1.nc", "a2.nc"}).notes,
                ElementsAre("number 1 stands twice: a1.nc and a1.nc"));
}

TEST(AscendingNumbers, AreThoseOfTheNames) {
    EXPECT_THAT(ascendingNumbers(std::vector<Path>{"a_1.nc", "a_41.nc"}),
                Optional(ElementsAre(1, 41)));
    EXPECT_EQ(ascendingNumbers(std::vector<Path>{"a_41.nc", "a_1.nc"}), std::nullopt);
    EXPECT_EQ(ascendingNumbers(std::vector<Path>{"a_1.nc"}), std::nullopt);
    EXPECT_EQ(ascendingNumbers(std::vector<Path>{"a.nc", "b.nc"}), std::nullopt);
    EXPECT_EQ(ascendingNumbers(std::vector<Path>{"a" + std::string(400, '1') + ".nc",
                                                 "a" + std::string(400, '2') + ".nc"}),
              std::nullopt);
}

}  // namespace
}  // namespace timeseries

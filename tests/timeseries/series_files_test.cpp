#include "timeseries/readers/series_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/series_folder.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using tests::names;
using tests::writeBytes;
using Path = std::filesystem::path;
using SeriesFiles = tests::SeriesFolder;

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
    writeBytes(folder_ / "case_1.vtm.series", R"({"file-series-version": "1.0"})");
    for (const char* name : {"case_0.vtm", "case_1.vtm", "case_2.vtm"})
        writeBytes(folder_ / name, "<VTKFile type=\"vtkMultiBlockDataSet\">");
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

// Folders r1 to r3, each with the step a.nc; as a user whom permissions bind.
class PatternOfFolders : public SeriesFiles {
 protected:
    PatternOfFolders() {
        for (const char* folder : {"r1", "r2", "r3"}) {
            std::filesystem::create_directory(folder_ / folder);
            writeBytes(folder_ / folder / "a.nc", "");
        }
        wasRoot_ = geteuid() == 0 && setresuid(kNobody, kNobody, 0) == 0;
    }
    ~PatternOfFolders() override {
        allow("r2", 0700);
        become(0);
    }
    void allow(const char* folder, unsigned mode) const {
        become(0);
        std::filesystem::permissions(folder_ / folder, std::filesystem::perms(mode));
        become(kNobody);
    }

 private:
    static constexpr uid_t kNobody = 65534;
    void become(uid_t user) const {
        if (!wasRoot_) return;
        EXPECT_EQ(setresuid(user, user, 0), 0);
    }
    bool wasRoot_ = false;
};

TEST_F(PatternOfFolders, OneThatCannotBeListedIsNotLeftOut) {
    for (const char* pattern : {"r*/*.nc", "r*/a.nc", "r[12]/a.nc", "r2/*.nc"}) {
        EXPECT_EQ(failure(pattern), "") << pattern;
        allow("r2", 0);
        EXPECT_THAT(failure(pattern), HasSubstr("expected a pattern whose folders can be listed"));
        allow("r2", 0755);
    }
    // Nor one above the last.
    for (const char* folder : {"r1", "r2", "r3"}) {
        allow(folder, 0777);
        std::filesystem::create_directory(folder_ / folder / "in");
        writeBytes(folder_ / folder / "in" / "b.nc", "");
        allow(folder, 0755);
    }
    for (const char* pattern : {"r*/in/*.nc", "r*/in/b.nc", "r*/*/b.nc"}) {
        EXPECT_EQ(expand(pattern).files.size(), 3u) << pattern;
        allow("r2", 0);
        EXPECT_THAT(failure(pattern), HasSubstr("folders can be listed")) << pattern;
        allow("r2", 0755);
    }
    // One that is not asked for does not matter.
    allow("r2", 0);
    EXPECT_EQ(expand("r[13]/*.nc").files.size(), 2u);
}

TEST_F(PatternOfFolders, WhatIsNoFolderOrHasNoSuchFileIsLeftOut) {
    allow(".", 0777);
    std::filesystem::create_directory(folder_ / "r4");
    writeBytes(folder_ / "r5", "a file");
    std::filesystem::create_symlink("nowhere", folder_ / "r6");
    std::filesystem::create_symlink("r7", folder_ / "r7");  // to itself
    for (const char* pattern : {"r*/*.nc", "r*/a.nc", "*/a.n?"})
        EXPECT_EQ(expand(pattern).files.size(), 3u) << pattern;
    for (const char* pattern : {"r4/*.nc", "r5/*.nc", "r6/*.nc", "r7/*.nc", "r8/*.nc", "r8/*/*.nc"})
        EXPECT_THAT(failure(pattern), HasSubstr("no file has such a name")) << pattern;
    allow(".", 0755);
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

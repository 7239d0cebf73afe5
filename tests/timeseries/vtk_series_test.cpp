// Numbered VTK files of which one does not fit, is damaged, or changes: its step is refused alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/vtk_numbered.h"

namespace timeseries {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::cubesOfStep;
using tests::cubesText;
using tests::dataArray;
using tests::expectStep;
using tests::refusalOfStep;
using tests::threeCubes;
using tests::timeOfStep;
using tests::timesOf;
using tests::timeValue;
using Path = std::filesystem::path;

TEST(VtkSeries, AMisfitIsRefusedWhenItsStepIsRead) {
    const Path folder = tests::freshFolder();
    const std::string p = dataArray("Int32", "p", std::vector<int>(12, 1)),
                      q = dataArray("Int32", "q", std::vector<int>(12, 1)),
                      field = timeValue(timeOfStep(1));
    struct Misfit {
        std::string text, refusal, note;
    };
    for (const Misfit& misfit :
         {Misfit{cubesText(field, q), "expected the same variables, but the second has no 'p'",
                 "expected the same variables, but the second has no 'p'"},
          Misfit{cubesText(field, dataArray("Int16", "p", std::vector<int>(12, 1))),
                 "variable 'p': expected the same type, found int32 and int16", ""},
          Misfit{cubesText(field, dataArray("Int32", "p", std::vector<int>(24, 1), 2)),
                 "expected the same variables, but the second has no 'p'",
                 "expected the same variables, but the second has no 'p'"},
          Misfit{tests::imageText({.points = p, .field = field}),
                 "variable 'p': expected the same grid", ""}}) {
        auto paths = threeCubes(folder);
        tests::writeBytes(paths[1], misfit.text);
        const auto reader = openReader(paths);
        EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
        for (int again = 0; again < 2; ++again) {
            EXPECT_THAT(refusalOfStep(*reader, 1),
                        AllOf(HasSubstr(paths[1].string()), HasSubstr(misfit.refusal)));
            expectStep(*reader, 0);
            expectStep(*reader, 2);
        }
        std::string notes;
        for (const std::string& note : reader->variables()[0].notes) notes += note + '\n';
        EXPECT_THAT(notes, HasSubstr(misfit.note));
        EXPECT_EQ(notes.find("the steps of 1 of 3 files cannot be read: ") != notes.npos,
                  !misfit.note.empty());
    }
    // One more is left out, and told.
    auto paths = threeCubes(folder);
    tests::writeBytes(paths[1], cubesText(field, q + p));
    const auto reader = openReader(paths);
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre("'q' is not in the first file: it is left out"));
    expectStep(*reader, 1);
}

// Wherever it is cut, its step alone is refused, and no step has a time that is not its file's.
TEST(VtkSeries, ATruncatedFileIsRefusedWhenItsStepIsRead) {
    const Path folder = tests::freshFolder();
    const std::string whole = cubesOfStep(1);
    const std::size_t begin = whole.find("<VTKFile") + 40, told = whole.find("</FieldData>") + 12;
    auto paths = threeCubes(folder);
    for (std::size_t cut = begin; cut + 2 < whole.size(); cut += 23) {
        SCOPED_TRACE(cut);
        tests::writeBytes(paths[1], whole.substr(0, cut));
        const auto reader = openReader(paths);
        if (cut >= told)
            EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
        else
            EXPECT_THAT(timesOf(*reader), ElementsAre(5, 15, 25));
        EXPECT_EQ(reader->variables()[0].time->name, cut >= told ? "time" : "number");
        EXPECT_THAT(reader->variables()[0].notes,
                    testing::Contains(AllOf(HasSubstr("the steps of 1 of 3 files cannot be read"),
                                            HasSubstr(paths[1].string()))));
        EXPECT_THAT(refusalOfStep(*reader, 1), testing::StartsWith(paths[1].string() + ": "));
        expectStep(*reader, 0);
        expectStep(*reader, 2);
    }
    // Once it is written to its end it is read.
    tests::writeBytes(paths[1], whole.substr(0, whole.size() / 2));
    const auto reader = openReader(paths);
    tests::writeBytes(paths[1], whole);
    expectStep(*reader, 1);
}

TEST(VtkSeries, AFileThatGoesOrChangesIsRefusedUntilItIsAsItWas) {
    auto paths = threeCubes(tests::freshFolder());
    const auto reader = openReader(paths);
    std::filesystem::remove(paths[1]);
    EXPECT_EQ(refusalOfStep(*reader, 1),
              paths[1].string() + ": expected a file, but there is none");
    expectStep(*reader, 2);
    const std::string p = dataArray("Int32", "p", std::vector<int>(12, 7));
    tests::writeBytes(paths[1], cubesText(timeValue(9), p));
    EXPECT_EQ(refusalOfStep(*reader, 1),
              fmt::format("{}: expected the time {} as when the series was opened, found 9",
                          paths[1].string(), timeOfStep(1)));
    tests::writeBytes(paths[1], cubesText("", p));
    EXPECT_THAT(refusalOfStep(*reader, 1), HasSubstr("as when the series was opened, found none"));
    tests::writeBytes(paths[1], cubesOfStep(1));
    expectStep(*reader, 1);
    expectStep(*reader, 0);
}

// Also of a file that is open: as the first is with the series, and any that was read.
TEST(VtkSeries, AnOpenFileThatIsWrittenAnewIsReadAnew) {
    auto paths = threeCubes(tests::freshFolder());
    const auto reader = openReader(paths);
    expectStep(*reader, 1);
    const std::string other = dataArray("Int32", "p", std::vector<int>(12, 7));
    for (const int step : {0, 1}) {
        tests::writeBytes(paths[step], cubesText(timeValue(90), other));
        EXPECT_THAT(refusalOfStep(*reader, step),
                    HasSubstr("when the series was opened, found 90"));
        tests::writeBytes(paths[step], cubesText(timeValue(timeOfStep(step)), other));
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(0, step).values),
                  std::vector<std::int32_t>(12, 7));
    }
}

// A grid a step, in the box of the first.
TEST(VtkSeries, CellsMayMoveComeAndGo) {
    const Path folder = tests::freshFolder();
    auto paths = threeCubes(folder);
    const std::string less =
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
        "<FieldData>" +
        timeValue(timeOfStep(1)) +
        "</FieldData><Piece NumberOfPoints=\"3\" NumberOfCells=\"0\"><PointData>" +
        dataArray("Int32", "p", std::vector<int>{4, 5, 6}) + "</PointData><Points>" +
        dataArray("Float64", "at", std::vector<double>{0, 0, 0, .5, 0, 0, 0, .25, 0}, 3) +
        "</Points><Cells>" + dataArray("Int64", "connectivity", std::vector<int>{}) +
        dataArray("Int64", "offsets", std::vector<int>{}) +
        dataArray("UInt8", "types", std::vector<int>{}) +
        "</Cells></Piece></UnstructuredGrid></VTKFile>";
    tests::writeBytes(paths[1], less);
    const auto reader = openReader(paths);
    EXPECT_EQ(reader->variables()[0].grid->count(), 12u);
    const Field field = reader->read(0, 1);
    EXPECT_EQ(field.grid->count(), 3u);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(field.values),
              (std::vector<std::int32_t>{4, 5, 6}));
    EXPECT_TRUE(reader->sources(0, 1).files.empty()) << "not the places of the series";
    EXPECT_THAT(reader->sources(0, 2).files, ElementsAre(paths[2]));
    EXPECT_EQ(reader->read(0, 2).grid, reader->variables()[0].grid);
}

TEST(VtkSeries, TheFirstFileIsReadWithTheSeries) {
    auto paths = threeCubes(tests::freshFolder());
    tests::writeBytes(paths[0], cubesOfStep(0).substr(0, 900));
    EXPECT_THAT(tests::refusalOf(paths), HasSubstr(paths[0].string()));
}

}  // namespace
}  // namespace timeseries

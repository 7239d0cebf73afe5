// Numbered VTK files as a series: of each its time is read with the series, the rest when its step
// is shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tests/support/vtk_numbered.h"
#include "timeseries/readers/vtk/vtk_time.h"

namespace timeseries {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::cubesText;
using tests::dataArray;
using tests::expectStep;
using tests::fieldNumber;
using tests::numberedFiles;
using tests::refusalOfStep;
using tests::threeCubes;
using tests::timeOfStep;
using tests::timesOf;
using tests::timeValue;
using Path = std::filesystem::path;

// A way in which VTK writes files.
struct TimeForm {
    int mode;  // vtkXMLWriter's
    vtkXMLWriter::CompressorType compressor;
    bool base64, bigEndian;
    int header = vtkXMLWriter::UInt32;
};

std::vector<TimeForm> allTimeForms() {
    std::vector<TimeForm> forms{{vtkXMLWriter::Ascii, vtkXMLWriter::NONE, false, false}};
    for (const auto compressor :
         {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA})
        for (const bool bigEndian : {false, true})
            for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
                forms.push_back({vtkXMLWriter::Binary, compressor, true, bigEndian, header});
                forms.push_back({vtkXMLWriter::Appended, compressor, true, bigEndian, header});
                forms.push_back({vtkXMLWriter::Appended, compressor, false, bigEndian, header});
            }
    return forms;
}

template <typename Writer, typename Data>
void writeForm(const TimeForm& form, Data& data, const Path& path) {
    const vtkNew<Writer> writer;
    writer->SetDataMode(form.mode);
    writer->SetCompressorType(form.compressor);
    writer->SetEncodeAppendedData(form.base64);
    writer->SetByteOrder(form.bigEndian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
    writer->SetHeaderType(form.header);
    writer->SetFileName(path.c_str());
    writer->SetInputData(&data);
    ASSERT_EQ(writer->Write(), 1);
}

template <typename Data>
void addStep(Data& data, std::size_t step) {
    const vtkNew<vtkFloatArray> values;
    values->SetName("p");
    for (vtkIdType n = 0; n < data.GetNumberOfPoints(); ++n)
        values->InsertNextValue(static_cast<float>(100 * step + static_cast<std::size_t>(n)));
    data.GetPointData()->AddArray(values);
    const vtkNew<vtkDoubleArray> before, time;  // it need not be the first of the appended values
    before->SetName("gamma");
    before->InsertNextValue(1.4);
    time->SetName("TimeValue");
    time->InsertNextValue(timeOfStep(step));
    data.GetFieldData()->AddArray(before);
    data.GetFieldData()->AddArray(time);
}

void writeStepFile(const TimeForm& form, bool isImage, std::size_t step, const Path& path) {
    if (isImage) {
        const vtkNew<vtkImageData> image;
        image->SetDimensions(2, 2, 2);
        addStep(*image, step);
        return writeForm<vtkXMLImageDataWriter>(form, *image, path);
    }
    const vtkNew<vtkUnstructuredGrid> cube;
    const vtkNew<vtkPoints> points;
    for (int n = 0; n < 8; ++n) points->InsertNextPoint(n & 1, n >> 1 & 1, n >> 2);
    cube->SetPoints(points);
    const vtkIdType corners[]{0, 1, 2, 3, 4, 5, 6, 7};
    cube->InsertNextCell(11, 8, corners);
    addStep(*cube, step);
    writeForm<vtkXMLUnstructuredGridWriter>(form, *cube, path);
}

TEST(VtkGlance, TimesAreTheFilesOwnInEveryForm) {
    const Path folder = tests::freshFolder();
    int number = 0;
    for (const TimeForm& form : allTimeForms())
        for (const bool isImage : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {} {} {} {} {}", form.mode, int(form.compressor),
                                     form.base64, form.bigEndian, form.header, isImage));
            std::vector<Path> paths;
            ++number;
            for (std::size_t i = 0; i < 3; ++i) {
                paths.push_back(folder / fmt::format("s{}_{}.x", number, i));
                writeStepFile(form, isImage, i, paths.back());
                const VtkTold told = vtkTimeOf(readXml(paths.back()));
                EXPECT_EQ(told.byVtkAlone, form.compressor == vtkXMLWriter::LZMA);
                if (!told.byVtkAlone) {
                    EXPECT_EQ(told.time.value().value, timeOfStep(i));
                }
            }
            const auto reader = openReader(paths);
            EXPECT_EQ(reader->variables()[0].time->name, "time");
            EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
            EXPECT_THAT(reader->variables()[0].notes, IsEmpty());
            for (const std::size_t step : {2u, 0u, 1u})
                EXPECT_EQ(tests::valuesOf<float>(*reader, "p", step)[7],
                          static_cast<float>(100 * step + 7));
        }
}

// What a file tells alone, where VTK reads its field data, is what it tells in a series.
TEST(VtkGlance, ATimeIsWhatVtkReadsOfTheFieldData) {
    const std::string two = "NumberOfTuples=\"2\"", pair = two + " NumberOfComponents=\"1\"";
    const std::string v = fieldNumber("Float64", "TimeValue", "2.5");
    for (const std::string& field : std::vector<std::string>{
             "",
             v,
             fieldNumber("Float32", "TIME", "0.1"),
             fieldNumber("Int32", "Time", " \n -7\t"),
             fieldNumber("Int64", "TimeValue", "9007199254740993"),
             fieldNumber("UInt8", "CYCLE", "200"),
             fieldNumber("Int32", "TimeStep", "12") + v,
             v + fieldNumber("Int32", "CYCLE", "12"),
             fieldNumber("Int32", "TimeStep", "12") + fieldNumber("Int32", "CYCLE", "13"),
             v + fieldNumber("Float64", "TIME", "3.5"),
             v + fieldNumber("Float64", "TimeValue", "3.5"),
             fieldNumber("Float64", "TimeValue", "2.5 3.5", two),
             fieldNumber("Float64", "TimeValue", "", ""),
             fieldNumber("Float64", "TimeValue", "2.5 1 2",
                         "NumberOfTuples=\"1\" NumberOfComponents=\"3\""),
             fieldNumber("Float64", "timevalue", "2.5"),
             fieldNumber("Float64", " TimeValue", "2.5"),
             fieldNumber("Float64", "TimeValue", "+2.5e-3"),
             fieldNumber("Float64", "TimeValue", "1e-320"),
             fieldNumber("Float64", "TimeValue", std::string(300, '0') + "2.5"),
             "<Array type=\"String\" Name=\"Time\" NumberOfTuples=\"1\" format=\"ascii\">"
             "50 46 53 0</Array>" +
                 v,
             v + "</FieldData><FieldData>" + fieldNumber("Float64", "TimeValue", "3.5"),
             v + "</FieldData><FieldData>",
         }) {
        const Path path = tests::write(
            "a.vtu", cubesText(field, dataArray("Int32", "p", std::vector<int>(12, 1))));
        const TimeAxis alone = *tests::open(path)->variables()[0].time;
        const VtkTold told = vtkTimeOf(readXml(path));
        if (told.byVtkAlone) continue;
        EXPECT_EQ(alone.counted, !told.time) << field;
        if (told.time) {
            EXPECT_EQ(alone.name, told.time->name) << field;
            EXPECT_EQ(alone.points[0].value, told.time->value) << field;
        }
    }
}

TEST(VtkGlance, FieldDataMayStandBehindThePiece) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < 3; ++i) {
        std::string text = cubesText("", dataArray("Int32", "p", std::vector<int>(12, int(i))));
        texts.push_back(text.insert(text.find("</UnstructuredGrid>"),
                                    "<FieldData>" + timeValue(timeOfStep(i)) + "</FieldData>"));
    }
    EXPECT_THAT(timesOf(*openReader(numberedFiles(tests::freshFolder(), texts))),
                ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
}

TEST(VtkGlance, WithoutTimesStepsAreNumberedAsTheFilesAre) {
    const std::string points = dataArray("Int32", "p", std::vector<int>(12, 0));
    const auto reader = openReader(numberedFiles(
        tests::freshFolder(), {cubesText(timeValue(1), points), cubesText("", points)}));
    EXPECT_THAT(timesOf(*reader), ElementsAre(5, 15));
    EXPECT_EQ(reader->variables()[0].time->name, "number");
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre("the files' own times are not used, steps are numbered as the files "
                            "are: run_15.vtu has none"));
}

TEST(VtkGlance, FilesOfOtherKindsAreReadSoToo) {
    const Path folder = tests::freshFolder();
    const auto told = [&](const std::string& extension, const auto& textOf) {
        const auto paths = numberedFiles(folder, {textOf(0), textOf(1), textOf(2)}, extension);
        const auto reader = openReader(paths);
        EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)))
            << extension;
        for (const std::size_t step : {1u, 2u, 0u})
            EXPECT_EQ(tests::valuesOf<std::int32_t>(*reader, "p", step)[11], int(step));
        std::filesystem::remove(paths[1]);
        EXPECT_THAT(refusalOfStep(*openReader(std::vector{paths[0], paths[2]}), 1), IsEmpty());
    };
    const auto points = [](std::size_t i) {
        return dataArray("Int32", "p", std::vector<int>(12, static_cast<int>(i)));
    };
    told("vti", [&](std::size_t i) {
        return tests::imageText({.points = points(i), .field = timeValue(timeOfStep(i))});
    });
    told("vts", [&](std::size_t i) {
        std::string text = tests::structuredText({.points = points(i)});
        return text.insert(text.find("<Piece"),
                           "<FieldData>" + timeValue(timeOfStep(i)) + "</FieldData>");
    });
    told("vtk", [&](std::size_t i) {
        std::string text = fmt::format(
            "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
            "FIELD FieldData 1\nTimeValue 1 1 double\n{}\nDIMENSIONS 3 2 2\n"
            "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 12\nSCALARS p int\nLOOKUP_TABLE default\n",
            timeOfStep(i));
        for (int n = 0; n < 12; ++n) text += fmt::format("{} ", i);
        return text + "\n";
    });
}

// The second part tells it, one before holds nothing of the grid.
TEST(VtkGlance, FilesInPartsHaveTheFirstTimeOfAPart) {
    const Path folder = tests::freshFolder();
    std::vector<std::string> wholes;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string points = dataArray("Int32", "p", std::vector<int>(12, int(i)));
        tests::writeBytes(folder / fmt::format("{}_empty.vtu", i),
                          "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData>" +
                              timeValue(-1) +
                              "</FieldData><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>"
                              "</UnstructuredGrid></VTKFile>");
        tests::writeBytes(folder / fmt::format("{}_a.vtu", i), cubesText("", points));
        tests::writeBytes(folder / fmt::format("{}_b.vtu", i),
                          cubesText(timeValue(timeOfStep(i)), points));
        wholes.push_back("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>");
        for (const char* part : {"empty", "a", "b"})
            wholes.back() += fmt::format("<Piece Source=\"{}_{}.vtu\"/>", i, part);
        wholes.back() += "</PUnstructuredGrid></VTKFile>";
    }
    const auto paths = numberedFiles(folder, wholes, "pvtu");
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
    EXPECT_THAT(tests::valuesOf<std::int32_t>(*reader, "p", 2),
                ElementsAreArray(std::vector<int>(24, 2)));
    std::filesystem::remove(folder / "1_b.vtu");
    const auto without = openReader(paths);
    EXPECT_THAT(without->variables()[0].notes,
                testing::Contains(AllOf(HasSubstr("the steps of 1 of 3 files cannot be read"),
                                        HasSubstr("1_b.vtu: expected a file"))));
    EXPECT_THAT(refusalOfStep(*without, 1), HasSubstr("1_b.vtu: expected a file"));
    EXPECT_THAT(refusalOfStep(*without, 2), IsEmpty());
}

// As VTK's own writers put it: of a list of blocks beside it, of parts within it.
TEST(VtkGlance, FilesThatNameOthersMayHaveATimeThemselves) {
    const Path folder = tests::freshFolder();
    std::vector<std::string> lists, wholes;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string points = dataArray("Int32", "p", std::vector<int>(12, int(i)));
        tests::writeBytes(folder / fmt::format("{}.vti", i),
                          tests::imageText({.points = points, .field = timeValue(-1)}));
        tests::writeBytes(folder / fmt::format("{}.vtu", i), cubesText(timeValue(-1), points));
        const std::string time = "<FieldData>" + timeValue(timeOfStep(i)) + "</FieldData>";
        lists.push_back(fmt::format(
            "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet index=\"0\" "
            "file=\"{}.vti\"/></vtkMultiBlockDataSet>{}</VTKFile>",
            i, time));
        wholes.push_back(
            fmt::format("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>{}<Piece "
                        "Source=\"{}.vtu\"/></PUnstructuredGrid></VTKFile>",
                        time, i));
    }
    for (const auto& [texts, extension] : {std::pair(lists, "vtm"), {wholes, "pvtu"}}) {
        const auto paths = numberedFiles(folder, texts, extension);
        EXPECT_THAT(timesOf(*openReader(paths)), ElementsAre(timeOfStep(0), timeOfStep(1)))
            << extension;
        EXPECT_THAT(timesOf(*openReader(std::span(paths).last(1))), ElementsAre(timeOfStep(1)))
            << extension;
    }
}

TEST(VtkGlance, AppendedValuesMayBeCutOff) {
    const Path folder = tests::freshFolder();
    std::vector<Path> paths;
    for (std::size_t i = 0; i < 3; ++i) {
        paths.push_back(folder / fmt::format("a_{}.vtu", i));
        writeStepFile({vtkXMLWriter::Appended, vtkXMLWriter::NONE, false, false}, false, i,
                      paths.back());
    }
    const std::string whole = tests::readBytes(paths[1]);
    const std::size_t values = whole.find('_', whole.find("<AppendedData")) + 1;
    for (const std::size_t cut : {values, values + 3, values + 12, values + 23, values + 24,
                                  values + 60, whole.size() - 60}) {
        tests::writeBytes(paths[1], whole.substr(0, cut));
        const auto reader = openReader(paths);
        // Two numbers of field data stand first, 12 bytes each; the second is the time.
        if (cut >= values + 24)
            EXPECT_THAT(timesOf(*reader), ElementsAre(timeOfStep(0), timeOfStep(1), timeOfStep(2)));
        else
            EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1, 2));
        EXPECT_THAT(refusalOfStep(*reader, 1), HasSubstr(paths[1].string())) << cut;
        EXPECT_EQ(tests::valuesOf<float>(*reader, "p", 2)[7], 207);
    }
}

// What nothing tells to be a VTK file costs its own step, as what is cut off does.
TEST(VtkGlance, AFileThatIsNoneOfVtkIsRefusedWhenItsStepIsRead) {
    const Path folder = tests::freshFolder();
    for (const std::size_t bad : {1u, 2u})
        for (const std::string& text :
             {std::string(), std::string("<?xml version=\"1.0\"?>\n"), std::string(300, '\0'),
              std::string("\x89PNG\r\n\x1a\n and so on"), std::string("no such thing")}) {
            SCOPED_TRACE(fmt::format("file {}: {}", bad, text));
            auto paths = threeCubes(folder);
            tests::writeBytes(paths[bad], text);
            const auto reader = openReader(paths);
            EXPECT_THAT(timesOf(*reader), ElementsAre(5, 15, 25)) << "as the files are numbered";
            EXPECT_THAT(reader->variables()[0].notes,
                        testing::Contains(AllOf(HasSubstr("the steps of 1 of 3 files cannot be"),
                                                HasSubstr(paths[bad].string()))));
            EXPECT_THAT(refusalOfStep(*reader, bad), HasSubstr(paths[bad].string()));
            for (const std::size_t step : {std::size_t{0}, 3 - bad}) expectStep(*reader, step);
        }
}

// What is named beside a series by mistake is told before any is read.
TEST(VtkGlance, AFileOfAnotherKindIsRefusedAtOnce) {
    const Path folder = tests::freshFolder();
    const auto files = threeCubes(folder);
    tests::writeBytes(folder / "run_35.vtu", "NRRD0004\n");
    EXPECT_THAT(tests::refusalOf({files[0], folder / "run_35.vtu"}),
                HasSubstr("run_35.vtu: expected the format of"));
    tests::writeBytes(folder / "notes.txt", "no such thing");
    EXPECT_THAT(tests::refusalOf({files[0], folder / "notes.txt"}),
                HasSubstr("notes.txt: expected a NetCDF"));
    EXPECT_THAT(tests::refusalOf({files[0], folder / "run_99.vtu"}),
                HasSubstr("run_99.vtu: expected a file, but there is none"));
    tests::writeBytes(files[0], "");
    EXPECT_THAT(tests::refusalOf(files), HasSubstr("but it is empty")) << "the first is read";
}

// Lists that are joined are opened each: how many steps they have stands in them.
TEST(VtkGlance, ListsAreJoinedAsBefore) {
    const Path folder = tests::freshFolder();
    const auto files = threeCubes(folder);
    const auto list = [&](const std::string& name, const std::vector<std::size_t>& steps) {
        std::string text = "<VTKFile type=\"Collection\"><Collection>";
        for (const std::size_t step : steps)
            text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>", step,
                                files[step].filename().string());
        tests::writeBytes(folder / name, text + "</Collection></VTKFile>");
        return folder / name;
    };
    const auto reader = openReader(std::vector{list("a.pvd", {0, 1}), list("b.pvd", {2})});
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1, 2));
    for (const std::size_t step : {0u, 2u, 1u}) expectStep(*reader, step);
    tests::writeBytes(folder / "b.pvd", "<VTKFile type=\"Collection\"><Collection>");
    EXPECT_THAT(tests::refusalOf({folder / "a.pvd", folder / "b.pvd"}), HasSubstr("b.pvd: line 1"));
}

}  // namespace
}  // namespace timeseries

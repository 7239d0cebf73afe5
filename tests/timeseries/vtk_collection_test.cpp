// VTK collections (.pvd): several files as steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "tests/support/read_variables.h"
#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::dataArray;
using tests::imageText;
using tests::open;
using tests::refusalOfRead;
using Path = std::filesystem::path;

Path collection(const std::string& sets) {
    return tests::write(
        "all.pvd", "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>");
}

std::string member(const std::string& time, const Path& file, const std::string& more = "") {
    return "<DataSet timestep=\"" + time + "\" " + more + " file=\"" + file.filename().string() +
           "\"/>";
}

TEST(VtkCollection, TimesAreRealAndMembersAreReadOneByOne) {
    std::vector<Path> files;
    for (int i = 0; i < 3; ++i)
        files.push_back(
            tests::write(fmt::format("{}.vti", i),
                         imageText({.points = dataArray("Int32", "p", std::vector<int>(12, i))})));
    const auto reader = open(
        collection(member("1.5", files[1]) + member("0.1", files[0]) + member("1e3", files[2])));
    EXPECT_EQ(reader->format(), "VTK collection of image data (XML)");
    const auto& points = reader->variables()[0].time->points;
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points[0].value, 0.1);
    EXPECT_EQ(points[1].value, 1.5);
    EXPECT_EQ(points[2].value, 1000);
    for (const std::size_t step : {2u, 0u, 1u})
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(0, step).values)[3], step);
}

// As vtkXMLCollectionReader has them: all data sets of one time, told apart by group and part.
TEST(VtkCollection, PartsOfOneTimeAreOneStep) {
    const auto image = [](const std::string& name, int value, int shift) {
        return tests::write(
            name, imageText({.attributes = fmt::format("Origin=\"{} 0 0\"", shift),
                             .points = dataArray("Int32", "p", std::vector<int>(12, value))}));
    };
    const Path a = image("a.vti", 1, 0), b = image("b.vti", 2, 50), c = image("c.vti", 3, 0),
               d = image("d.vti", 4, 50), e = image("e.vti", 5, 90);
    const auto valuesOf = [](Reader& reader, std::size_t step) {
        const Field field = reader.read(0, step);
        std::map<int, int> counts;
        for (const int value : std::get<std::vector<std::int32_t>>(field.values)) ++counts[value];
        return counts;
    };
    using Counts = std::map<int, int>;
    const auto reader =
        open(collection(member("2", c, "group=\"\" part=\"0\"") + member("1", a, "part=\"0\"") +
                        member("1", b, "part=\"1\"") + member("2", d, "part=\"1\"") +
                        member("2", e, "group=\"x\" part=\"1\"")));
    const auto& points = reader->variables()[0].time->points;
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].value, 1);
    EXPECT_EQ(points[1].value, 2);
    EXPECT_EQ(valuesOf(*reader, 0), (Counts{{1, 12}, {2, 12}}));
    EXPECT_EQ(valuesOf(*reader, 1), (Counts{{3, 12}, {4, 12}, {5, 12}}));
    EXPECT_THAT(reader->sources(0, 0).files, ElementsAre(a, b));
    EXPECT_EQ(reader->read(0, 0).grid->count(), 24u);

    const auto without = [](const Path& file, const std::string& part) {
        return "<DataSet " + part + " file=\"" + file.filename().string() + "\"/>";
    };
    const auto timeless = open(collection(without(a, "part=\"0\"") + without(b, "part=\"1\"")));
    ASSERT_EQ(timeless->variables()[0].time->points.size(), 1u);
    EXPECT_EQ(valuesOf(*timeless, 0), (Counts{{1, 12}, {2, 12}}));
    // No parts: steps without times.
    const auto steps = open(collection(without(a, "") + without(b, "")));
    EXPECT_EQ(steps->variables()[0].time->points.size(), 2u);
    EXPECT_THAT(
        open(collection(member("0", a, "part=\"0\"") + member("0", b, "part=\"1\"") +
                        member("1", a, "part=\"0\"") + member("1", "none.vti", "part=\"1\"")))
            ->variables()[0]
            .notes,
        testing::Contains("1 of 4 files are missing, the first none.vti"));
}

TEST(VtkCollection, AttributesAreReadHoweverTheyAreWritten) {
    const auto image = [](int value) {
        return imageText({.points = dataArray("Int32", "p", std::vector<int>(12, value))});
    };
    const Path amp = tests::write("a&b 1.vti", image(1)), plain = tests::write("2.vti", image(2));
    const Path other = tests::write("3.vti", image(3));
    std::string escaped = amp.filename().string();
    escaped.replace(escaped.find('&'), 1, "&amp;");
    const std::string sets = fmt::format(
        "<!-- by hand -->\n<DataSet timestep = ' 1.5\n' group='' part=' 0 ' file=\" {} \"/>\n"
        "<DataSet file='./{}' name=\"x\" part=\"0\"\n\ttimestep=\"-2.5E-1\"></DataSet>"
        "<Other file='none'/><DataSet file=\"{}\" timestep=\"00\" part=\"0\" group=\"\"/>",
        escaped, plain.filename().string(), other.string());
    const Path path =
        tests::write("odd.pvd",
                     "\xEF\xBB\xBF<?xml version='1.0' encoding='UTF-8'?>\r\n<VTKFile byte_order = "
                     "'BigEndian' version=\"0.1\" type=' Collection '><Collection>" +
                         sets + "</Collection>\n</VTKFile>\n");
    const auto reader = open(path);
    const auto& points = reader->variables()[0].time->points;
    ASSERT_EQ(points.size(), 3u);
    for (const auto& [step, time, value] :
         {std::tuple{0, -0.25, 2}, std::tuple{1, 0.0, 3}, std::tuple{2, 1.5, 1}}) {
        EXPECT_EQ(points[static_cast<std::size_t>(step)].value, time);
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(
                      reader->read(0, static_cast<std::size_t>(step)).values)[11],
                  value);
    }
}

TEST(VtkCollection, WithoutTimesStepsAreCountedAsTheyStand) {
    const auto named = [](int value) {
        return tests::write(
            fmt::format("{}.vti", value),
            imageText({.points = dataArray("Int32", "p", std::vector<int>(12, value))}));
    };
    std::string sets;
    for (const int value : {7, 3, 5})
        sets += "<DataSet file=\"" + named(value).filename().string() + "\"/>";
    const auto reader = open(collection(sets));
    EXPECT_TRUE(reader->variables()[0].time->counted);
    for (const auto& [step, value] : {std::pair{0u, 7}, std::pair{1u, 3}, std::pair{2u, 5}})
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(0, step).values)[0], value);
}

TEST(VtkCollection, OnePartAtEachTimeIsAStepWhicheverItIs) {
    std::string sets;
    for (const auto& [time, part] : {std::pair{2, 0}, std::pair{0, 1}, std::pair{1, 0}}) {
        const Path file = tests::write(
            fmt::format("{}.vti", time),
            imageText({.points = dataArray("Int32", "p", std::vector<int>(12, time))}));
        sets += member(std::to_string(time), file, fmt::format("group=\"g\" part=\"{}\"", part));
    }
    const auto reader = open(collection(sets));
    ASSERT_EQ(reader->variables()[0].time->points.size(), 3u);
    for (const std::size_t step : {0u, 1u, 2u}) {
        EXPECT_EQ(reader->variables()[0].time->points[step].value, step);
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(0, step).values)[3], step);
    }
}

// ParaView's JSON says the same.
TEST(VtkCollection, AListOfFilesIsASeriesToo) {
    std::string files;
    for (const double time : {2.5, 0.0, 1.0}) {
        const Path file = tests::write(
            fmt::format("{}.vti", time),
            imageText({.points = dataArray("Float32", "p", std::vector<double>(12, time))}));
        files += fmt::format("{}{{\"name\": \"{}\", \"time\": {}}}", files.empty() ? "" : ", ",
                             file.filename().string(), time);
    }
    const auto listed = [](const std::string& what) {
        return tests::write("all.vti.series",
                            "{ \"file-series-version\": \"1.0\", \"files\": " + what + "}");
    };
    const auto reader = open(listed("[" + files + "]"));
    ASSERT_EQ(reader->variables()[0].time->points.size(), 3u);
    for (const auto& [step, time] : {std::pair{0u, 0.0f}, std::pair{1u, 1.0f}, {2u, 2.5f}}) {
        EXPECT_EQ(reader->variables()[0].time->points[step].value, time);
        EXPECT_EQ(std::get<std::vector<float>>(reader->read(0, step).values)[7], time);
    }
    EXPECT_THAT(refusalOfRead(listed("[]")), HasSubstr("files: expected a file, found none"));
    EXPECT_THAT(refusalOfRead(listed("7")), HasSubstr("expected JSON with a list of \"files\""));
    EXPECT_THAT(refusalOfRead(listed("[")), HasSubstr("expected JSON with a list of \"files\""));
    EXPECT_THAT(refusalOfRead(listed("[7]")),
                HasSubstr("files[0]: expected the \"name\" of a file"));
    EXPECT_THAT(refusalOfRead(listed("[{\"name\": \"a\", \"time\": \"b\"}]")),
                HasSubstr("files[0]: expected a finite number"));
    EXPECT_THAT(refusalOfRead(listed("[" + files + ", {\"name\": \"a\"}]")),
                HasSubstr("expected a time of each file or of none"));
    EXPECT_THAT(refusalOfRead(listed("[" + files + "," + files + "]")),
                HasSubstr("expected times that differ, found 0 twice"));
}

TEST(VtkCollection, AListThatNamesItselfOrAListIsToldSo) {
    const std::string itself = "expected the names of other files, but it names itself",
                      list =
                          "expected a grid, as what a list of files names, found a list of files";
    const Path folder = tests::freshFolder();
    const auto refused = [&](const std::string& name, const std::string& bytes) {
        tests::writeBytes(folder / name, bytes);
        return refusalOfRead(folder / name);
    };
    const auto collected = [](const std::string& of) {
        return "<VTKFile type=\"Collection\"><Collection>" + member("0", of) +
               "</Collection></VTKFile>";
    };
    const auto series = [](const std::string& of) {
        return R"({"file-series-version": "1.0", "files": [{"name": ")" + of + R"(", "time": 1}]})";
    };
    const auto blocks = [](const std::string& of) {
        return R"(<VTKFile type="vtkMultiBlockDataSet"><vtkMultiBlockDataSet><DataSet index="0" file=")" +
               of + R"("/></vtkMultiBlockDataSet></VTKFile>)";
    };
    EXPECT_THAT(refused("all.pvd", collected("all.pvd")),
                HasSubstr("all.pvd: Collection: " + itself));
    EXPECT_THAT(refused("a.vtu.series", series("a.vtu.series")),
                HasSubstr("a.vtu.series: files: " + itself));
    EXPECT_THAT(refused("a.vtm", blocks("a.vtm")), HasSubstr(itself));
    // What leads back to it by way of another.
    tests::writeBytes(folder / "b.vtu.series", series("all.pvd"));
    EXPECT_THAT(refused("all.pvd", collected("b.vtu.series")), HasSubstr("b.vtu.series: " + list));
    EXPECT_THAT(refusalOfRead(folder / "b.vtu.series"), HasSubstr("all.pvd: " + list));
    tests::writeBytes(folder / "b.vtm", blocks("all.pvd"));
    EXPECT_THAT(refused("all.pvd", collected("b.vtm")),
                HasSubstr("all.pvd: expected a grid, as a block of b.vtm, found a file that names "
                          "others"));
}

TEST(VtkCollection, WhatDiffersIsTold) {
    const Path good = tests::write(
        "a.vti", imageText({.points = dataArray("Int32", "p", std::vector<int>(12, 1))}));
    const Path finer = tests::write(
        "b.vti", imageText({.attributes = "Spacing=\"1 1 1\"",
                            .points = dataArray("Int32", "p", std::vector<int>(12, 1))}));
    const Path other = tests::write(
        "c.vti", imageText({.points = dataArray("Int16", "p", std::vector<int>(12, 1))}));
    EXPECT_THAT(refusalOfRead(collection(member("0", good) + member("1", finer)), 1),
                HasSubstr("expected the grid of"));
    EXPECT_THAT(refusalOfRead(collection(member("0", good) + member("1", other)), 1),
                HasSubstr("'p': expected int32 of 1 components"));
    EXPECT_THAT(refusalOfRead(collection(member("0", good) + member("0", finer))),
                HasSubstr("expected times that differ, found 0 twice"));
    EXPECT_THAT(refusalOfRead(
                    collection(member("0", good, "part=\"1\"") + member("0", finer, "part=\"1\""))),
                HasSubstr("expected times that differ, found 0 twice"));
    EXPECT_THAT(refusalOfRead(
                    collection(member("0", good, "part=\"0\"") + member("0", good, "part=\"1\""))),
                AllOf(HasSubstr("expected files that differ, found "), HasSubstr("a.vti again")));
    EXPECT_THAT(refusalOfRead(
                    collection(member("0", good, "part=\"0\"") + member("0", other, "part=\"1\""))),
                HasSubstr("'p': expected int32 of 1 components, as in another block"));
    EXPECT_THAT(refusalOfRead(collection(member("nan", good))),
                HasSubstr("expected a finite number"));
    EXPECT_THAT(refusalOfRead(collection("")), HasSubstr("expected a file, found none"));
    const Path gap = collection(member("0", good) + member("1", "none.vti"));
    EXPECT_THAT(open(gap)->variables()[0].notes,
                ElementsAre("1 of 2 files are missing, the first none.vti"));
    EXPECT_THAT(refusalOfRead(gap, 1), HasSubstr("none.vti: expected a file, but there is none"));
    EXPECT_THAT(refusalOfRead(collection(member("0", "none.vti"))), HasSubstr("there is none"));
    EXPECT_THAT(refusalOfRead(collection("<DataSet file=\"..\"/>")), HasSubstr("it is a folder"));
    EXPECT_THAT(refusalOfRead(collection("<DataSet file=\"/dev/zero\"/>")),
                HasSubstr("/dev/zero: expected an ordinary file"));
}

}  // namespace
}  // namespace timeseries

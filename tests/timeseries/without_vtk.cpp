// VTK and OpenVDB files in a build without them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

TEST(WithoutVtk, ItsFilesAreRecognisedAndTheWayToReadThemIsTold) {
    const auto path = tests::testFolder() / "file";
    for (const char* bytes : {"# vtk DataFile Version 3.0\n", "<VTKFile type=\"ImageData\"/>",
                              "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"/>"}) {
        tests::writeBytes(path, bytes);
        EXPECT_TRUE(isReadable(path)) << bytes;
        try {
            openReader(std::span(&path, 1));
            FAIL() << bytes;
        } catch (const FileError& error) {
            EXPECT_EQ(error.what(), path.string() +
                                        ": expected a build that reads VTK files, which `./run "
                                        "--with-vtk " +
                                        path.string() + "` makes");
        }
    }
}

// Nobody shall install VTK for what is not read then either.
TEST(WithoutVtk, TypesThatAreNotReadAreToldBeforeTheWay) {
    const auto refusal = [](const std::filesystem::path& path) -> std::string {
        try {
            openReader(std::span(&path, 1));
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    };
    const auto mesh = tests::testFolder() / "mesh.htg", list = tests::testFolder() / "list.pvd",
               old = tests::testFolder() / "old.vtk";
    tests::writeBytes(mesh, "<VTKFile type=\"HyperTreeGrid\" version=\"1.0\"></VTKFile>");
    tests::writeBytes(list,
                      "<VTKFile type=\"Collection\"><Collection>"
                      "<DataSet timestep=\"0\" file=\"mesh.htg\"/></Collection></VTKFile>");
    tests::writeBytes(old, "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET FIELD\n");
    EXPECT_THAT(refusal(mesh),
                testing::StartsWith(mesh.string() + " is a VTK file of type HyperTreeGrid; "));
    EXPECT_THAT(refusal(list),
                testing::StartsWith(mesh.string() + " is a VTK file of type HyperTreeGrid; "));
    EXPECT_THAT(refusal(old), testing::StartsWith(old.string() + " is a VTK file of type field; "));
    for (const auto& path : {mesh, list, old})
        EXPECT_THAT(refusal(path), testing::Not(testing::HasSubstr("--with-vtk")));
}

TEST(WithoutVtk, TheWayCanBePastedWhateverTheFilesName) {
    const auto path = tests::testFolder() / "it's one.vti";
    tests::writeBytes(path, "# vtk DataFile Version 3.0\n");
    try {
        openReader(std::span(&path, 1));
        FAIL();
    } catch (const FileError& error) {
        EXPECT_THAT(
            error.what(),
            testing::HasSubstr("`./run --with-vtk '" +
                               (tests::testFolder() / "it'\\''s one.vti").string() + "'` makes"));
    }
}

TEST(WithoutOpenVdb, ItsFilesAreRecognisedAndTheWayToReadThemIsTold) {
    const auto path = tests::testFolder() / "file";
    tests::writeBytes(path, std::string(" BDV\0\0\0\0", 8));
    EXPECT_TRUE(isReadable(path));
    try {
        openReader(std::span(&path, 1));
        FAIL();
    } catch (const FileError& error) {
        EXPECT_EQ(error.what(), path.string() +
                                    ": expected a build that reads OpenVDB files, which `./run "
                                    "--with-openvdb " +
                                    path.string() + "` makes");
    }
}

}  // namespace
}  // namespace timeseries

// VTK files in a build without VTK.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/files.h"
#include "timeseries/reader.h"

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

}  // namespace
}  // namespace timeseries

#include "timeseries/readers/other_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/deflated.h"
#include "tests/support/files.h"
#include "tests/support/shared_data.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_files.h"

namespace timeseries {
namespace {

using namespace std::string_literals;
using Path = std::filesystem::path;

const std::string kTail =
    "; isochron reads NetCDF, Exodus II, VTKHDF, XDMF, Zarr, OpenFOAM, AMReX, NRRD, NIfTI, MRC, "
    "FITS, "
    "PLOT3D, CSV "
    "and, of VTK, image data, rectilinear, structured and unstructured grids, polygons (.vti, "
    ".vtr, .vts, "
    ".vtu, .vtp, .pvti and so on, .vtm, .vthb, .vtk, .pvd, .series), OpenVDB";

// What opening a file or folder says it is.
std::string told(const Path& path) {
    try {
        openReader(expandSeries(std::span(&path, 1)).files);
    } catch (const FileError& error) {
        const std::string what = error.what();
        if (what == path.string() +
                        ": expected a NetCDF, NRRD, NIfTI, MRC, FITS, XDMF, CSV, VTK or OpenVDB "
                        "file, found "
                        "no format "
                        "that is known")
            return "unknown";
        EXPECT_TRUE(what.starts_with(path.string() + " is ")) << what;
        EXPECT_TRUE(what.ends_with(kTail)) << what;
        const std::size_t begin = path.string().size() + 4, end = what.size() - kTail.size();
        return what.substr(std::min(begin, end), end - std::min(begin, end));
    }
    return "read";
}

std::string toldOf(const std::string& bytes) {
    const Path path = tests::testFolder() / "file";
    tests::writeBytes(path, bytes);
    return told(path);
}

// Zeros with these bytes at a place, as long as a beginning that is looked at.
std::string at(std::size_t place, const std::string& bytes) {
    std::string file(2 * kBeginningBytes, '\0');
    return file.replace(place, bytes.size(), bytes);
}

// The signs are those of the formats' own documents.
TEST(OtherFormats, AreNamed) {
    for (const auto& [bytes, name] : std::vector<std::pair<std::string, std::string>>{
             {at(0, "GRIB"), "a GRIB file"},
             {tests::byGzip(at(0, "GRIB")), "a GRIB file"},
             {at(128, "DICM"), "a DICOM file"},
             {at(0, "II*\0"s), "a TIFF file"},
             {at(0, "MM\0*"s), "a TIFF file"},
             {at(0, "\x93NUMPY\1\0"s), "a NumPy array (.npy)"},
             {at(257, "ustar"), "a tar archive"},
             {at(0, "PK\3\4"), "a zip archive"},
             {"<?xml version=\"1.0\"?>\n<VTKFile type=\"HyperTreeGrid\"/>",
              "a VTK file of type HyperTreeGrid"},
             {"# vtk DataFile Version 3.0\nt\nBINARY\nDATASET FIELD\n", "a VTK file of type field"},
             {tests::byGzip("CDF\1"s), "compressed by gzip, and must be unpacked first"},
             {"BZh91AY&SY", "compressed by bzip2, and must be unpacked first"},
             {"just words", "unknown"},
             {std::string(5000, '\1'), "unknown"},
             {"\x1f\x8b"s, "compressed by gzip, and must be unpacked first"},
         })
        EXPECT_EQ(toldOf(bytes), name);
}

// What is read may hold the signs of others among its values.
TEST(OtherFormats, SignsInsideAFileThatIsReadTellNothing) {
    std::string file = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 10 10 10\nencoding: raw\n\n";
    const std::size_t header = file.size();
    file += std::string(1000, '\0');
    for (const auto& [place, sign] :
         {std::pair{208, "MAP "s}, {257, "ustar"s}, {128, "DICM"s}, {344, "n+1\0"s}}) {
        ASSERT_GT(static_cast<std::size_t>(place), header);
        file.replace(static_cast<std::size_t>(place), sign.size(), sign);
    }
    EXPECT_EQ(toldOf(file), "read");
}

TEST(OtherFormats, AnAdios2FileIsAFolder) {
    const Path store = tests::testFolder() / "run.bp";
    std::filesystem::create_directories(store);
    tests::writeBytes(store / "md.idx", "");
    tests::writeBytes(store / "md.0", "");
    EXPECT_EQ(told(store), "an ADIOS2 file (BP)");
}

TEST(OtherFormats, RealFilesAreNamed) {
    if (!std::filesystem::exists(tests::sharedData("grids")))
        GTEST_SKIP() << "no real data at " << tests::sharedData("grids");
    for (const auto& [file, name] : std::vector<std::pair<std::string, std::string>>{
             {"grids/no_checkpoint.h5",
              "an HDF5 file that no NetCDF wrote, without an array of three dimensions"},
             {"dx_mri/mri.general", "an OpenDX header"},
             {"dx_mri/MRI.data", "unknown"},
             {"overview.png", "a PNG picture"},
         })
        EXPECT_EQ(told(tests::sharedData(file)), name) << file;
}

}  // namespace
}  // namespace timeseries
